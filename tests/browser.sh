#!/usr/bin/env bash
# Opens pages of results from disk in headless Chromium, on a phone's width and on a desk's, and checks that they
# work there: a title, every picture loaded, nothing wider than the window, sequences that play, pictures that
# enlarge, cloth that turns by keys and by dragging, links that lead to files, and not a word on the console.
#   tests/browser.sh [--hysteron PROGRAM] PAGE.html...
# With --hysteron a run with frames and a gallery are made of the first page's folder; the run's report and both as
# self-contained pages, moved away from their folders, are checked too, and the report of a small run whose cloth can be
# turned, with WebGL and without.
# 77 (skipped) without Chromium.
set -euo pipefail

for browser in "${CHROMIUM:-chromium}" chromium-browser google-chrome none; do
  command -v "$browser" >/dev/null && break
done
if [[ $browser == none ]]; then
  echo "chromium is not installed: pages not looked at"
  exit 77
fi

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# url_of PATH: file:// URL; spaces are all that needs care in folders of a build.
url_of() { printf 'file://%s' "${1// /%20}"; }

# Writes the copy of a page that reports on itself to the window that frames it.  Links still lead to the page's
# own folder.
probed_copy() {
  local page=$1 copy=$2 base
  base=$(url_of "$(dirname "$(readlink -f "$page")")")/
  {
    sed "0,/<head>/s||<head><base href=\"$base\"><script>window.faults = []; addEventListener('error', e => faults.push(e.message \|\| 'a file is missing'), true);</script>|" "$page"
    cat <<'EOF'
<script>
const wait = ms => new Promise(done => setTimeout(done, ms));
const wrong = (fault, is) => { if (is) faults.push(fault); };
async function probe_turn(figure) {
  const webgl = document.createElement('canvas').getContext('webgl');
  for (let i = 0; webgl && i < 50 && figure.hidden; ++i) await wait(100);
  wrong(webgl ? 'shows no cloth' : 'shows cloth without WebGL', figure.hidden !== !webgl);
  if (!webgl || figure.hidden) return;
  const canvas = figure.querySelector('canvas');
  const press = key => { canvas.dispatchEvent(new KeyboardEvent('keydown', {key})); return canvas.toDataURL(); };
  const drag = (type, x) => canvas.dispatchEvent(new PointerEvent(type, {clientX: x, clientY: 50, pointerId: 1}));
  canvas.setPointerCapture = () => 0;  // of a pointer that there is
  const before = press('+'), after = press('-'), turned = press('ArrowLeft');
  wrong('does not come nearer', before === after);
  wrong('does not turn by keys', after === turned);
  drag('pointerdown', 50);
  drag('pointermove', 90);
  wrong('does not turn by dragging', canvas.toDataURL() === turned);
  drag('pointerup', 90);
  wrong('draws nothing', canvas.toDataURL() === Object.assign(document.createElement('canvas'),
    {width: canvas.width, height: canvas.height}).toDataURL());
}
async function probe() {
  wrong('no title', !document.title);
  wrong('no viewport', !document.querySelector('meta[name=viewport]'));
  const width = document.documentElement.clientWidth;
  const wide = () => wrong('wider than the window by ' + (document.documentElement.scrollWidth - width),
                           document.documentElement.scrollWidth > width);
  wide();
  for (const folded of document.querySelectorAll('details')) folded.open = true;
  const images = [...document.images];
  for (const image of images) image.loading = 'eager';  // decode() of a lazy picture waits for a reader to come near
  await Promise.all(images.map(image => image.decode().catch(() => 0)));
  for (const image of images) wrong('not loaded: ' + image.alt, !image.naturalWidth);
  wide();
  for (const link of document.querySelectorAll('a[href^="#"]')) {
    wrong('no place ' + link.hash, !document.getElementById(decodeURIComponent(link.hash.slice(1))));
  }
  const seen = player => [...player.querySelectorAll('figure')].filter(f => f.offsetHeight).map(f => f.innerText).join();
  for (const player of document.querySelectorAll('.player')) {
    if (player.querySelectorAll('figure').length < 2) continue;
    const before = seen(player);
    player.querySelector('button').click();
    await wait(250);
    wrong('does not play', seen(player) === before);
    player.querySelector('button').click();
  }
  const zoom = document.querySelector('a.zoom');
  if (zoom && innerWidth >= 700) {
    const full = zoom.href || zoom.querySelector('img').src;
    zoom.querySelector('img').click();
    const large = document.querySelector('dialog[open] img');
    for (let i = 0; i < 50 && !(large?.src === full && large.naturalWidth); ++i) await wait(100);
    wrong('does not enlarge', large?.src !== full || !large.naturalWidth);
    document.querySelector('dialog[open]')?.click();
    await wait(100);
    wrong('does not close', document.querySelector('dialog[open]'));
  }
  for (const figure of document.querySelectorAll('figure.turn')) await probe_turn(figure);
  return {images: images.length, players: document.querySelectorAll('.player').length, title: document.title, width};
}
addEventListener('load', () => probe().then(found => parent.postMessage({...found, faults}, '*'),
                                            error => parent.postMessage({faults: [String(error)]}, '*')));
</script>
EOF
  } >"$copy"
}

# Writes a page that frames the copy at both widths and prints on the console what they report.
write_frame() {
  cat >"$2" <<EOF
<!doctype html><title>frame</title>
<script>
let missing = 2;
addEventListener('message', event => {
  const found = event.data, at = ' at ' + found.width + ' px: ';
  for (const fault of found.faults) console.log('FAULT' + at + fault);
  console.log('SEEN' + at + found.images + ' pictures, ' + found.players + ' players, ' + found.title);
  if (--missing === 0) console.log('DONE');
});
</script>
<iframe src="$1" style="width: 390px; height: 844px; border: 0"></iframe>
<iframe src="$1" style="width: 1280px; height: 800px; border: 0"></iframe>
EOF
}

webgl=(--use-angle=swiftshader --enable-unsafe-swiftshader)  # drawn in software

# The console of a page until it says DONE, one message a line.  Chromium's own --dump-dom does not wait for frames.
console_of() {
  local browser_id
  : >"$scratch/log"
  "$browser" --headless=new --no-sandbox --disable-gpu --disable-dev-shm-usage --no-first-run \
    --user-data-dir="$scratch/profile" --host-resolver-rules="MAP * ~NOTFOUND" --enable-logging=stderr --v=0 \
    "${webgl[@]}" --remote-debugging-port=0 "$1" >/dev/null 2>"$scratch/log" &
  browser_id=$!
  for ((tenths = 0; tenths < 600; ++tenths)); do
    grep -q 'CONSOLE.*"DONE"' "$scratch/log" && break
    kill -0 "$browser_id" 2>/dev/null || break
    sleep 0.1
  done
  kill "$browser_id" 2>/dev/null || true
  wait "$browser_id" 2>/dev/null || true
  sed -nE 's/^.*CONSOLE[^"]*"(.*)", source: .*$/\1/p' "$scratch/log"
}

# Relative links of a page to files that are not there.
missing_files() {
  local folder link
  folder=$(dirname "$1")
  grep -oE ' (href|src)="[^"#]+"' "$1" | grep -v 'src="data:' | sort -u | cut -d'"' -f2 | while read -r link; do
    [[ -e $folder/$(printf '%b' "${link//%/\\x}") ]] || echo "FAULT: leads nowhere: $link"
  done
}

check() {
  local page=$1 copy=$scratch/page.html frame=$scratch/frame.html messages faults
  probed_copy "$page" "$copy"
  write_frame "$(url_of "$copy")" "$frame"
  messages=$(console_of "$(url_of "$frame")")
  faults=$(
    grep -vE '^(SEEN|DONE)|GPU stall due to ReadPixels' <<<"$messages" || true
    missing_files "$page"
  )
  [[ $messages == *DONE* ]] || faults+=$'\nFAULT: not every window reported'
  echo "$page"
  grep '^SEEN' <<<"$messages" || true
  [[ -z $faults ]] || { echo "$faults"; return 1; }
}

# Makes a run's folder with frames: another run's manifest, its pictures as frames.
run_with_frames() {
  local results=$1 run=$scratch/made/run picture number=0 manifests
  manifests=("$results"/drape-*/manifest.json)
  mkdir -p "$run/frames"
  cp "${manifests[0]}" "$run/"
  for picture in "$results"/drape-*/*.png; do
    cp "$picture" "$run/frames/$(printf '%04d' "$number").png"
    number=$((number + 1))
  done
}

# made/run/report.html links its frames; alone/ holds self-contained pages and nothing that they were made of.
make_pages() {
  local program=$1 results=$2 made=$scratch/made alone=$scratch/alone
  run_with_frames "$results"
  mkdir "$alone"
  "$program" report --self-contained "$made" "$made/run" >&2
  mv "$made/index.html" "$made/run/report.html" "$alone/"
  "$program" report "$made/run" >&2
  "$program" swing --quick --seconds 0.2 --fps 10 --size 240x180 --quiet --out "$made/turned" >&2
}

program=
if [[ ${1:-} == --hysteron ]]; then
  program=$2
  shift 2
fi
[[ $# -gt 0 ]] || { echo "usage: tests/browser.sh [--hysteron PROGRAM] PAGE.html..."; exit 2; }
failed=0
for page in "$@"; do check "$page" || failed=1; done
if [[ -n $program ]]; then
  make_pages "$program" "$(dirname "$1")"
  for page in made/run/report.html made/turned/report.html alone/index.html alone/report.html; do
    check "$scratch/$page" || failed=1
  done
  webgl=(--disable-3d-apis)
  check "$scratch/made/turned/report.html" || failed=1
fi
exit $failed
