#!/usr/bin/env bash
# Takes pictures that check.sh left in FOLDER as the accepted ones:
#   tests/golden/accept.sh FOLDER [NAME...]
# Look at them first.
set -euo pipefail
# shellcheck source=tests/golden/scenes.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/scenes.sh"

[[ $# -ge 1 ]] || { echo "usage: accept.sh FOLDER [NAME...], FOLDER as given to check.sh" >&2; exit 2; }
folder=$1
shift
[[ $# -gt 0 ]] || set -- "${!golden_runs[@]}"
for name in "$@"; do cp -v "$folder/$name-actual.png" "$golden_folder/$name.png"; done
