#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# One file of tests with the Python that prepare.sh set up:  run.sh <environment> <test file> <home>
#
# Octave, Scilab and Matplotlib write into the home of who runs them: here it is a folder of the build.
set -euo pipefail
if [ ! -e "$1/ready" ]; then
  echo "Not found: $1, which package.python.prepare makes"
  exit 0
fi
mkdir -p "$3/temporary"
export HOME=$3 TMPDIR=$3/temporary XDG_CACHE_HOME=$3/.cache XDG_CONFIG_HOME=$3/.config
exec "$1/bin/python" -B "$2" --verbose
