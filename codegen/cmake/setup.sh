# SPDX-License-Identifier: MIT
# For bash scripts, to be sourced: the set-up that test/run.sh and the demos have in common. It stops with a
# reason when it cannot.
#
#   lqg_install_packages              what lqgen needs: installed on Debian and Ubuntu, named elsewhere
#   lqg_install <Debian package>…     the same for more
#   lqg_find_lqgen                    LQGEN is the lqgen to run: the one that it names already, else that of
#                                     `lqg_build`, made now
#   lqg_build                         the build folder that all scripts share, and test/run.sh: build/, or build-<CC>/
#   lqg_build_lqgen <target>…         lqgen and more in lqg_build, with what it needs; shows how far it is
#   lqg_print_help <script>           the comment at its top
#   lqg_configure <folder> <option>…  cmake on the whole project, with CC and CXX
#   lqg_compile <folder> <option>…    on all processors

lqg_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

# CC alone names the C++ compiler, too.
if [ -n "${CC:-}" ] && [ -z "${CXX:-}" ]; then
  case $CC in
    *clang*) export CXX=${CC/clang/clang++} ;;
    *gcc*) export CXX=${CC/gcc/g++} ;;
  esac
fi

lqg_build=$lqg_root/build${CC:+-$(basename "$CC")}

lqg_stop() {
  echo "$1" >&2
  exit 1
}

lqg_has_command() { command -v "$1" >/dev/null 2>&1; }

# Whether the C++ compiler finds a header. Debian keeps Eigen in a folder of its own.
lqg_has_header() {
  echo "#include <$1>" | "${CXX:-c++}" -std=c++17 -I/usr/include/eigen3 -fsyntax-only -x c++ - >/dev/null 2>&1
}

# apt-get as root, by sudo if need be; fails where there is neither.
lqg_apt_get() {
  if [ "$(id -u)" = 0 ]; then
    DEBIAN_FRONTEND=noninteractive apt-get "$@"
  elif lqg_has_command sudo && { [ -t 0 ] || sudo -n true 2>/dev/null; }; then
    sudo DEBIAN_FRONTEND=noninteractive apt-get "$@"
  else
    return 1
  fi
}

lqg_install() {
  [ $# -gt 0 ] || return 0
  if lqg_has_command apt-get; then
    echo "Installing $*"
    { lqg_apt_get -q update && lqg_apt_get -q install -y --no-install-recommends "$@"; } ||
      lqg_stop "Could not install these packages; please do it as root:  apt-get install $*"
  else
    lqg_stop "Please install what Debian calls: $*
Fedora:  dnf install cmake gcc-c++ make eigen3-devel boost-devel mpfr-devel gmp-devel tomlplusplus-devel \\
           cli11-devel json-devel mbedtls-devel
Arch:    pacman -S cmake gcc make eigen boost mpfr gmp tomlplusplus cli11 nlohmann-json mbedtls
macOS:   brew install cmake eigen boost mpfr gmp tomlplusplus cli11 nlohmann-json mbedtls
On these three also csv.h of fast-cpp-csv-parser (github.com/ben-strasser/fast-cpp-csv-parser), its folder in
-DFAST_CPP_CSV_PARSER_INCLUDE_DIR=…; and Chart.js: npm pack chart.js@3.9.1, unpacked, its file in
-DLQG_CHART_JS=…/package/dist/chart.min.js"
  fi
}

lqg_install_packages() {
  local missing=()
  lqg_has_command cmake || missing+=(cmake)
  lqg_has_command make || missing+=(make)
  lqg_has_command "${CC:-cc}" || missing+=("${CC:-gcc}")
  lqg_has_command "${CXX:-c++}" || missing+=("${CC:-g++}")
  lqg_install "${missing[@]}"

  missing=()
  lqg_has_header Eigen/Core || missing+=(libeigen3-dev)
  lqg_has_header boost/multiprecision/mpfr.hpp || missing+=(libboost-dev)
  lqg_has_header mpfr.h || missing+=(libmpfr-dev)
  lqg_has_header toml++/toml.h || missing+=(libtomlplusplus-dev)
  lqg_has_header CLI/CLI.hpp || missing+=(libcli11-dev)
  lqg_has_header libfccp/csv.h || lqg_has_header fast-cpp-csv-parser/csv.h || lqg_has_header csv.h ||
    missing+=(libfccp-dev)
  lqg_has_header nlohmann/json.hpp || missing+=(nlohmann-json3-dev)
  lqg_has_header mbedtls/md.h || missing+=(libmbedtls-dev)
  [ -e /usr/share/javascript/chart.js/chart.min.js ] || missing+=(libjs-chart.js)
  lqg_install "${missing[@]}"
}

lqg_configure() {
  local folder=$1
  shift
  cmake -S "$lqg_root" -B "$folder" "$@" || lqg_stop "CMake could not configure $folder"
}

lqg_compile() {
  local folder=$1
  shift
  cmake --build "$folder" --parallel "$(getconf _NPROCESSORS_ONLN)" "$@" ||
    lqg_stop "The build in $folder failed"
}

lqg_build_lqgen() {
  local log=$lqg_build/lqgen.log is_new=-DLQG_BUILD_TESTS=OFF  # of a folder that test/run.sh has made they stay
  [ ! -e "$lqg_build/CMakeCache.txt" ] || is_new=
  lqg_install_packages
  mkdir -p "$lqg_build"
  echo "Building lqgen in $lqg_build (a few minutes the first time)" >&2
  { cmake -S "$lqg_root" -B "$lqg_build" -DLQG_BUILD_CODEGEN=ON ${is_new:+"$is_new"} &&
    cmake --build "$lqg_build" --parallel "$(getconf _NPROCESSORS_ONLN)" --target lqgen "$@"; } 2>&1 |
    tee "$log" | lqg_show_progress || {
    tail -n 20 "$log" >&2
    lqg_stop "The build failed: $log"
  }
}

# How far a build by make is: one line that changes on a terminal, else one line for every tenth.
lqg_show_progress() {
  local is_terminal=0
  [ ! -t 2 ] || is_terminal=1
  awk -v is_terminal=$is_terminal '
    match($0, /^\[ *[0-9]+%\]/) {
      percent = substr($0, 2, RLENGTH - 3) + 0
      if (is_terminal) { printf "\r  %3d %%", percent; fflush() }
      else if (percent >= shown + 10) { shown = percent; printf "  %3d %%\n", percent; fflush() }
    }
    END { if (is_terminal) print "" }' >&2
}

lqg_find_lqgen() {
  if [ -z "${LQGEN:-}" ]; then
    lqg_build_lqgen
    LQGEN=$lqg_build/codegen/lqgen
  fi
  [ -f "$LQGEN" ] && [ -x "$LQGEN" ] || lqg_stop "LQGEN: expected the path of an lqgen, found $LQGEN"
  LQGEN=$(realpath "$LQGEN")
  export LQGEN
}

lqg_print_help() { sed -n '2,/^[^#]/{/SPDX-/d;/^#/{s/^# \{0,1\}//;p}}' "$1"; }
