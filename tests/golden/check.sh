#!/usr/bin/env bash
# Pictures of quick runs against the accepted ones in this folder, by `hysteron diff`:
#   tests/golden/check.sh PROGRAM FOLDER [NAME...]
# Each run is left in FOLDER/NAME, its picture as FOLDER/NAME-actual.png; a picture beyond the limits also
# leaves NAME-expected.png and NAME-heat.png there.  Exit code 1 if any picture is beyond, or a run fails; 77 if only a
# page was asked for and Chromium is not installed.
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

browser=$(command -v "${CHROMIUM:-chromium}" chromium-browser google-chrome | head -1 || true)

# screenshot PAGE PNG: the page as a window of golden_window shows it, after its scripts have come to rest: the cloth that
# can be turned is unpacked behind the first layout.
screenshot() {
  "$browser" --headless --no-sandbox --disable-gpu --hide-scrollbars --force-device-scale-factor=1 \
    --user-data-dir="$folder/.browser" --window-size="$golden_window" --virtual-time-budget=10000 \
    --screenshot="$2" "file://${1// /%20}" \
    >/dev/null 2>&1
}

# picture_of NAME: runs it and leaves NAME-actual.png.
picture_of() {
  local file=${golden_files[$1]:-} frames size=(--size "$golden_size")
  [[ $1 != plot ]] || size=() # nothing is rendered
  rm -rf "${folder:?}/$1" "$folder/$1"-*.png
  # The table holds words.
  # shellcheck disable=SC2086
  "$program" ${golden_runs[$1]} "${size[@]}" --quiet --out "$folder/$1" >"$folder/$1.txt" || return 1
  case $file in
    *.html) screenshot "$folder/$1/$file" "$folder/$1-actual.png" ;;
    *.png) cp "$folder/$1/$file" "$folder/$1-actual.png" ;;
    *)
      frames=("$folder/$1"/frames/*.png)
      cp "${frames[-1]}" "$folder/$1-actual.png"
      ;;
  esac
}

failed=()
for name in "$@"; do
  [[ -v golden_runs[$name] ]] || { echo "no such run: $name; there are: ${!golden_runs[*]}" >&2; exit 2; }
  expected=$golden_folder/$name.png actual=$folder/$name-actual.png heat=$folder/$name-heat.png
  echo "$name:"
  if [[ ${golden_files[$name]:-} == *.html && -z $browser ]]; then
    echo "chromium is not installed: the page was not looked at"
    [[ $# -gt 1 ]] || exit 77
    continue
  fi
  read -ra limits <<<"${golden_limits[$name]:-$golden_default_limits}"
  if ! picture_of "$name"; then
    failed+=("$name")
  elif [[ ! -e $expected ]]; then
    echo "no picture has been accepted yet"
    failed+=("$name")
  elif ! "$program" diff "$actual" "$expected" "${limits[@]}" --out "$heat"; then
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
