#!/usr/bin/env bash
# tests/tidy.sh [COMMIT | FILE...]: clang-tidy 14 as .clang-tidy says, each warning an error, on the sources that differ
# from COMMIT (HEAD~1 unless named); of a header a source that includes it.  Each takes some ten seconds to a minute.
# Compile commands are those of the preset debug in build-debug/, where nothing but the version's header is built.
# 77 (skipped) without clang-tidy 14.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

for program in clang-tidy-14 clang-tidy none; do
  [[ $("$program" --version 2>/dev/null) == *"version 14."* ]] && break
done
[[ $program != none ]] || { echo "clang-tidy 14 is not installed: nothing checked" && exit 77; }

changed=("$@")
if [[ $# == 0 || ! -e $1 ]]; then
  commit=$(git rev-parse --verify "${1:-HEAD~1}^{commit}")
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
echo "clang-tidy on ${#sources[@]} sources"
printf '%s\n' "${sources[@]}" |
  xargs -P "$(nproc)" -n 1 "$program" -p build-debug --quiet --warnings-as-errors='*' 2>&1 |
  sed '/ warnings generated\.$/d' || exit 1
