# SPDX-License-Identifier: MIT
# For bash scripts that make packages, to be sourced: the same bytes come out whatever the umask, the time zone, the
# language and the modes of the checked-out files.
#
#   settle <folder>    modes and times of all that is in it
umask 022
export TZ=UTC LC_ALL=C
# Packages need a time: the beginning of the year in LICENSE, unless SOURCE_DATE_EPOCH has been set.
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-1767225600}

settle() {
  find "$1" -type d -exec chmod 755 {} +
  find "$1" -type f -perm -u+x -exec chmod 755 {} +
  find "$1" -type f ! -perm -u+x -exec chmod 644 {} +
  find "$1" -depth -exec touch --no-dereference --date="@$SOURCE_DATE_EPOCH" {} +
}
