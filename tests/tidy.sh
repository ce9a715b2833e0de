#!/usr/bin/env bash
# tests/tidy.sh [--seconds LIMIT] [COMMIT | FILE...]: clang-tidy 14 as .clang-tidy says, each warning an error, on the
# sources that differ from COMMIT (HEAD~1 unless named); of a header a source that includes it.  Each takes some ten seconds
# to a minute.  Compile commands are those of the preset debug in build-debug/, where nothing but the version's header is
# built.  77 (skipped) without clang-tidy 14 or git's history.
# --seconds is for .ci/run: when the time is over it ends what it has not finished, and says how many it has read.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

for program in clang-tidy-14 clang-tidy none; do
  [[ $("$program" --version 2>/dev/null) == *"version 14."* ]] && break
done
[[ $program != none ]] || { echo "clang-tidy 14 is not installed: nothing checked" && exit 77; }
git rev-parse HEAD >/dev/null 2>&1 || { echo "no git repository: nothing checked" && exit 77; }

limit=0
if [[ ${1:-} == --seconds ]]; then limit=$2 && shift 2; fi
changed=("$@")
if [[ $# == 0 || ! -e $1 ]]; then
  base=${1:-HEAD~1}
  git rev-parse --verify --quiet HEAD~1 >/dev/null || base=${1:-HEAD}  # a clone without history
  commit=$(git rev-parse --verify "$base^{commit}")
  mapfile -t changed < <(git diff --name-only --diff-filter=d "$commit" -- '*.cpp' '*.h')
fi

# sources_of FILE...: what clang-tidy can compile, each once.
sources_of() {
  local file
  for file in "$@"; do
    if [[ $file == *.h ]]; then git grep -lF "#include \"$file\"" -- '*.cpp' | sed -n 1p; else echo "$file"; fi
  done | grep -vE '^tests/(fuzz/(target|one_experiment)|examples/(consumer|subproject)/)' | sort -u
}
mapfile -t sources < <(sources_of "${changed[@]}")
[[ ${#sources[@]} -gt 0 ]] || { echo "no source to check" && exit 0; }

cmake --preset debug -DCGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE=ON >/dev/null
cmake --build --preset debug --target hysteron_version >/dev/null
checked=$(mktemp)
trap 'rm -f "$checked"' EXIT
begin=$((EPOCHSECONDS - SECONDS))

# check FILE: fails if clang-tidy finds something in time.
check() {
  local left=0 status=0
  if [[ $limit != 0 ]]; then
    left=$((begin + limit - EPOCHSECONDS))
    ((left > 0)) || return 0
  fi
  timeout "$left" "$program" -p build-debug --quiet --warnings-as-errors='*' "$1" 2>&1 |
    sed '/ warnings generated\.$/d' || status=$?
  [[ $status != 124 ]] || return 0
  echo "$1" >>"$checked"
  return "$status"
}
export -f check
export limit begin program checked
status=0
printf '%s\n' "${sources[@]}" | xargs -P "$(nproc)" -I{} bash -o pipefail -c 'check {}' || status=1
echo "clang-tidy has read $(wc -l <"$checked") of ${#sources[@]} sources"
exit "$status"
