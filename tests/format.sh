#!/usr/bin/env bash
# tests/format.sh [--install] [--fix]: fails if a source is not formatted as .clang-format says; --fix rewrites the files.
# Other versions than clang-format 14 format differently (19, which Debian 13 has, a file in twenty): 77 (skipped) without
# it.  --install gets it from pip's index into build-format/ where the system has none.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

wanted=14.0.6
find_program() {
  for program in clang-format-14 clang-format build-format/bin/clang-format none; do
    if [[ $("$program" --version 2>/dev/null) == *"version ${wanted%%.*}."* ]]; then break; fi
  done
}
find_program
if [[ ${1:-} == --install ]]; then
  shift
  if [[ $program == none ]]; then
    python3 -m venv build-format
    build-format/bin/pip install --quiet "clang-format==$wanted"
    find_program
  fi
fi
if [[ $program == none ]]; then
  echo "clang-format ${wanted%%.*} is not installed: style not checked (tests/format.sh --install gets it)"
  exit 77
fi

mapfile -d '' files < <(find sim render experiments python tests \( -name '*.cpp' -o -name '*.h' \) -print0)
if [[ ${1:-} == --fix ]]; then
  exec "$program" -i "${files[@]}"
fi
if ! messages=$("$program" --dry-run --Werror "${files[@]}" 2>&1); then
  echo "Not formatted (tests/format.sh --fix does it):"
  grep -oE '^[^: ]+:[0-9]+:[0-9]+: error.*' <<<"$messages" | cut -d: -f1 | uniq -c || echo "$messages"
  exit 1
fi
