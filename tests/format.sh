#!/usr/bin/env bash
# Fails if a source is not formatted as .clang-format says; 77 (skipped) without clang-format 14, because other
# versions format differently.  tests/format.sh --fix rewrites the files.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

for program in clang-format-14 clang-format; do
  if [[ $("$program" --version 2>/dev/null) == *"version 14."* ]]; then
    mode=(--dry-run --Werror)
    [[ ${1:-} != --fix ]] || mode=(-i)
    find sim render experiments tests \( -name '*.cpp' -o -name '*.h' \) -print0 | xargs -0 "$program" "${mode[@]}"
    exit
  fi
done
echo "clang-format 14 is not installed: style not checked"
exit 77
