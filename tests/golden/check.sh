#!/usr/bin/env bash
# Pictures of quick runs against the accepted ones in this folder, by `hysteron diff`:
#   tests/golden/check.sh PROGRAM FOLDER [NAME...]
# Each run is left in FOLDER/NAME, its last picture as FOLDER/NAME-actual.png; a picture beyond the limits also
# leaves NAME-expected.png and NAME-heat.png there.  Exit code 1 if any picture is beyond, or a run fails.
set -euo pipefail
# shellcheck source=tests/golden/scenes.sh
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/scenes.sh"

[[ $# -ge 2 ]] || { echo "usage: check.sh PROGRAM FOLDER [NAME...]" >&2; exit 2; }
program=$(readlink -f "$1")
mkdir -p "$2"
folder=$(cd "$2" && pwd -P)
shift 2
[[ $# -gt 0 ]] || set -- "${!golden_runs[@]}"

# Drawn in software, because drivers round differently: a GPU's own EGL is not asked.
export LIBGL_ALWAYS_SOFTWARE=1
mesa=/usr/share/glvnd/egl_vendor.d/50_mesa.json
[[ ! -e $mesa ]] || export __EGL_VENDOR_LIBRARY_FILENAMES=$mesa

# picture_of NAME: runs it and leaves NAME-actual.png.
picture_of() {
  local frames
  rm -rf "${folder:?}/$1" "$folder/$1"-*.png
  # The table holds words.
  # shellcheck disable=SC2086
  "$program" ${golden_runs[$1]} --size "$golden_size" --quiet --out "$folder/$1" >"$folder/$1.txt" || return 1
  frames=("$folder/$1"/frames/*.png)
  cp "${frames[-1]}" "$folder/$1-actual.png"
}

failed=()
for name in "$@"; do
  [[ -v golden_runs[$name] ]] || { echo "no such run: $name; there are: ${!golden_runs[*]}" >&2; exit 2; }
  expected=$golden_folder/$name.png actual=$folder/$name-actual.png heat=$folder/$name-heat.png
  echo "$name:"
  if ! picture_of "$name"; then
    failed+=("$name")
  elif [[ ! -e $expected ]]; then
    echo "no picture has been accepted yet"
    failed+=("$name")
  elif ! "$program" diff "$actual" "$expected" "${golden_limits[@]}" --out "$heat"; then
    cp "$expected" "$folder/$name-expected.png"
    failed+=("$name")
  else
    rm "$heat"
  fi
done
[[ ${#failed[@]} == 0 ]] && exit
cat <<END
Not as accepted: ${failed[*]}.  Look at -actual.png, -expected.png and -heat.png in $folder.
If the change is meant: $golden_folder/accept.sh $folder ${failed[*]}
END
exit 1
