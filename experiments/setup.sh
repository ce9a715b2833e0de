# shellcheck shell=bash disable=SC2034
# SC2034 is disabled because the scripts that source this file read its tables.
# experiments/run.sh and tests/run.sh source this file to install missing packages, configure and build.
# Its messages go to stderr, the output of apt, cmake and the compiler to build/log; stdout belongs to the
# program that is run afterwards.

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd -P)
build_folder=$root/build

# Each row is package|why.  Packages that another one of the list depends on are not listed.
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
  "libcgal-dev|exact predicates that check for intersections"
  "libstb-dev|text in pictures"
  "fonts-dejavu-core|font of the captions"
  "libpng-dev|reads and writes PNG, with zlib"
  "libegl-dev|OpenGL without a display: headers and EGL"
  "libgl1-mesa-dri|OpenGL in software, where no GPU draws"
  "gnuplot-nox|draws the plots"
)
# Not every release has these packages.
optional_program_packages=(
  "libosmesa6|second way to draw in software; Mesa 25.1 dropped it"
)

log_file=$build_folder/log  # log of the last set-up
mkdir -p "$build_folder"
: >"$log_file"

say() { printf '%s\n' "$*" >&2; }

fail() {
  say "$(basename "$0"): $*"
  exit 1
}

# latest_progress prints the last line of the log in which ninja, make or apt report progress.
latest_progress() {
  tail -c 50000 "$log_file" | grep -aoE '^(\[ *[0-9]+(/[0-9]+|%)\]|Unpacking |Setting up ).*' | tail -n 1
}

# show_progress TITLE PID shows the progress until that process ends, in one line that is overwritten, or without a
# terminal in one line a minute.
show_progress() {
  local title=$1 pid=$2 start=$SECONDS minutes=0
  while sleep 1 && kill -0 "$pid" 2>/dev/null; do
    if [[ -t 2 ]]; then
      printf '\r\033[K%.79s' "$title, $((SECONDS - start)) s: $(latest_progress)" >&2
    elif (((SECONDS - start) / 60 > minutes)); then
      minutes=$(((SECONDS - start) / 60))
      say "  $minutes min: $(latest_progress | cut -c -100)"
    fi
  done
  [[ ! -t 2 ]] || printf '\r\033[K' >&2
}

# logged TITLE COMMAND... runs it with its output in the log; if it fails, shows the log's end and ends the script.
logged() {
  local title=$1 start=$SECONDS
  shift
  printf '== %s\n' "$*" >>"$log_file"
  [[ -t 2 ]] || say "$title"
  "$@" >>"$log_file" 2>&1 </dev/null &
  local pid=$!
  show_progress "$title" "$pid"
  if ! wait "$pid"; then
    say "The last lines of $log_file:"
    tail -n 40 "$log_file" >&2
    fail "failed: $title. The whole log: $log_file"
  fi
  ((SECONDS - start < 5)) || say "$title: done in $((SECONDS - start)) s"
}

is_installed() { [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]; }

has_candidate() { [[ -n $(apt-cache show --no-all-versions "$1" 2>/dev/null) ]]; }

# missing_of ROW... prints the rows whose package is not installed.
missing_of() {
  local row
  for row in "$@"; do is_installed "${row%%|*}" || printf '%s\n' "$row"; done
}

as_root() { if [[ $(id -u) == 0 ]]; then "$@"; else sudo "$@"; fi; }

apt_install() {
  logged "Installing packages" as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q \
    --no-install-recommends -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@"
}

# install_missing REQUIRED OPTIONAL, names of tables, calls neither apt nor the network if nothing is missing.
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
    as_root apt-get update -q >>"$log_file" 2>&1 ||
      say "apt-get update failed: going on with the package lists at hand."
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

# configure [CMAKE_OPTION...] keeps the options of an existing build folder unless they are named here.
configure() {
  local preset=()
  [[ -f $build_folder/CMakeCache.txt ]] || preset=(--preset release)
  logged "Configuring" cmake -S "$root" -B "$build_folder" "${preset[@]}" "$@"
}

build() { logged "Building" cmake --build "$build_folder" --parallel "$(nproc)" "$@"; }
