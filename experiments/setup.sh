# shellcheck shell=bash disable=SC2034  (tables are read by the scripts that source this)
# Sourced by experiments/run.sh and tests/run.sh: install what is missing, configure, build.
# Everything said here goes to stderr; stdout belongs to the program that is run afterwards.

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd -P)
build_folder=$root/build

# package|why.  Nothing is listed that another package of the list already depends on.
program_packages=(
  "g++|C++20 compiler, with OpenMP"
  "cmake|configures the build"
  "ninja-build|runs the build"
  "git|names the commit in every manifest"
  "libeigen3-dev|vectors and matrices"
  "libcli11-dev|command line"
  "libfmt-dev|numbers in texts"
  "libkainjow-mustache-dev|templates of pages"
  "libtomlplusplus-dev|scene and fabric files"
  "nlohmann-json3-dev|manifests"
  "libceres-dev|least squares of hysteron fit"
  "libcgal-dev|exact predicates that check for intersections; reads PLY meshes"
  "libtinyobjloader-dev|reads OBJ meshes"
  "libstb-dev|text in pictures"
  "fonts-dejavu-core|font of the captions"
  "libpng-dev|writes PNG, with zlib"
  "libegl-dev|OpenGL without a display: headers and EGL"
  "libgl1-mesa-dri|OpenGL in software, where no GPU draws"
  "gnuplot-nox|draws the plots"
)
# Not every release has these.
optional_program_packages=(
  "libosmesa6|second way to draw in software; Mesa 25.1 dropped it"
)

say() { printf '%s\n' "$*" >&2; }

fail() {
  say "$(basename "$0"): $*"
  exit 1
}

is_installed() { [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]; }

has_candidate() { [[ -n $(apt-cache show --no-all-versions "$1" 2>/dev/null) ]]; }

# missing_of ROW...: prints the rows whose package is not installed.
missing_of() {
  local row
  for row in "$@"; do is_installed "${row%%|*}" || printf '%s\n' "$row"; done
}

as_root() { if [[ $(id -u) == 0 ]]; then "$@"; else sudo "$@"; fi; }

apt_install() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends \
    -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@" >&2
}

# install_missing REQUIRED OPTIONAL (names of tables): no apt call and no network if everything is there.
install_missing() {
  local -n required_table=$1 optional_table=$2
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    say "No apt here: this system must have its own packages for ${required_table[*]%%|*}."
    return
  fi
  local required optional row rows=()
  mapfile -t required < <(missing_of "${required_table[@]}")
  mapfile -t optional < <(missing_of "${optional_table[@]}")

  if [[ $(id -u) != 0 ]] && ! command -v sudo >/dev/null; then
    [[ ${#required[@]} == 0 ]] && return
    fail "packages are missing, and installing takes root or sudo; as root: apt-get install ${required[*]%%|*}"
  fi
  if [[ ${#required[@]} -gt 0 ]]; then
    rows=("${required[@]}")
    as_root apt-get update -q >&2 || say "apt-get update failed: going on with the package lists at hand."
  fi
  for row in "${optional[@]}"; do
    if has_candidate "${row%%|*}"; then
      rows+=("$row")
    else
      say "Going on without ${row%%|*} (${row#*|}): apt does not know it here."
    fi
  done
  [[ ${#rows[@]} == 0 ]] && return

  say "Installing with apt; nothing is downloaded from elsewhere, and nothing else is needed:"
  for row in "${rows[@]}"; do say "$(printf '  %-20s %s' "${row%%|*}" "${row#*|}")"; done
  apt_install "${rows[@]%%|*}"
}

# configure [CMAKE_OPTION...]: options of a build folder that exists stay as they are unless named here.
configure() {
  local generator=()
  [[ -f $build_folder/CMakeCache.txt ]] || generator=(-G Ninja -DCMAKE_BUILD_TYPE=Release)
  cmake -S "$root" -B "$build_folder" "${generator[@]}" "$@" >&2
}

build() { cmake --build "$build_folder" --parallel "$(nproc)" "$@" >&2; }
