#!/usr/bin/env bash
# Fails if a source is not formatted as .clang-format says; 77 (skipped) without clang-format 14, because other
# versions format differently.  tests/format.sh --fix rewrites the files.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

for program in clang-format-14 clang-format none; do
  [[ $("$program" --version 2>/dev/null) == *"version 14."* ]] && break
done
if [[ $program == none ]]; then
  echo "clang-format 14 is not installed: style not checked"
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
