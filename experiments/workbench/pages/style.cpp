#include "experiments/workbench/pages/style.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kStyle = R"css(
:root { color-scheme: light dark; --ink: #1b1f24; --soft: #5d6670; --line: #d9dde2; --paper: #fff; --panel: #f5f6f8;
  --accent: #2f5d8c; --good: #1e7a46; --bad: #b3401f; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e8eb; --soft: #9aa3ad; --line: #333a42; --paper: #14171b;
  --panel: #1d2126; --accent: #8ab6e6; --good: #6fcf97; --bad: #f2936b; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1080px; padding: 1.5rem 1rem 4rem; background: var(--paper); color: var(--ink);
  font: 16px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", sans-serif; }
a { color: var(--accent); text-underline-offset: .15em; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .4rem; }
h2 { font-size: 1.1rem; margin: 2.2rem 0 .7rem; padding-bottom: .3rem; border-bottom: 1px solid var(--line); }
h1, h2, h3, p, summary, figcaption { overflow-wrap: anywhere; }
p.about { color: var(--soft); margin: 0 0 1rem; }
pre { background: var(--panel); border: 1px solid var(--line); border-radius: 8px; padding: .7rem .9rem; margin: 0;
  overflow-x: auto; white-space: pre-wrap; overflow-wrap: anywhere; font-size: .85rem; }
.state { display: inline-block; border-radius: 99px; padding: .05rem .7rem; font-size: .8rem; color: var(--paper);
  vertical-align: middle; background: var(--good); } .state.bad { background: var(--bad); }
.cards { display: grid; gap: .7rem; grid-template-columns: repeat(auto-fill, minmax(170px, 1fr)); }
.card { background: var(--panel); border: 1px solid var(--line); border-radius: 10px; padding: .7rem .9rem; }
.card b { display: block; font-size: 1.35rem; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
.card b small { font-size: .8rem; font-weight: 500; color: var(--soft); }
.card span { color: var(--soft); font-size: .82rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .88rem; }
th { text-align: left; color: var(--soft); font-weight: 600; vertical-align: bottom; }
th, td { padding: .32rem .9rem .32rem 0; border-bottom: 1px solid var(--line); } td { vertical-align: top; }
th + th, td + td, .n { text-align: right; font-variant-numeric: tabular-nums; } td { white-space: nowrap; }
th.t, td.t { text-align: left; font-variant-numeric: normal; white-space: normal; }
td code { display: block; white-space: normal; color: var(--soft); font-size: .8rem; min-width: 16rem;
  overflow-wrap: anywhere; }
figure { margin: 0 0 1rem; } figcaption { color: var(--soft); font-size: .82rem; margin-top: .25rem; }
img { max-width: 100%; height: auto; border-radius: 6px; border: 1px solid var(--line); display: block; }
.plot img, a.zoom img { background: #fff; }
.strip { display: grid; gap: .6rem; grid-template-columns: repeat(auto-fill, minmax(150px, 1fr)); }
.strip figure { margin: 0; }
.controls { display: flex; gap: .8rem; align-items: center; margin-top: .4rem; max-width: 640px; }
.controls input { flex: 1; min-width: 0; accent-color: var(--accent); }
.controls button { font: inherit; font-size: .88rem; padding: .3rem 1rem; border-radius: 8px; cursor: pointer;
  border: 1px solid var(--line); background: var(--panel); color: var(--ink); min-width: 5.5rem; }
@media screen { .player.on .strip { display: block; max-width: 640px; } .player.on figure:not(.now) { display: none; }
  .player.on img { width: 100%; } }
.charts { display: grid; gap: .8rem; grid-template-columns: repeat(auto-fill, minmax(min(100%, 300px), 1fr)); }
svg { width: 100%; height: auto; display: block; background: var(--panel); border-radius: 8px; }
svg polyline { fill: none; stroke: var(--accent); stroke-width: 1.6; stroke-linejoin: round; }
svg text { fill: var(--soft); font-size: 11px; } svg text.title { fill: var(--ink); font-size: 12.5px; }
details { margin: .8rem 0; } summary { color: var(--soft); cursor: pointer; font-size: .88rem; }
a.zoom { display: block; cursor: zoom-in; } a.zoom img { width: 100%; }
dialog.large { border: 0; padding: 0; outline: 0; margin: auto; max-width: 98vw; max-height: 98vh; background: none;
  cursor: zoom-out; }
dialog.large img { max-width: 98vw; max-height: 92vh; width: auto; background: #fff; }
dialog.large p { margin: .5rem 0 0; text-align: center; color: #fff; font-size: .88rem; }
dialog.large::backdrop { background: rgba(15, 18, 22, .85); }
body.gallery { max-width: 1240px; }
.gallery h2 { font-size: 1.45rem; margin: 3.5rem 0 .3rem; border: 0; padding: 0; }
.gallery h2 + p { color: var(--soft); margin: 0; } .gallery h2 + p::first-letter { text-transform: uppercase; }
.gallery h3 { font-size: 1.1rem; margin: 0 0 .1rem; } h3 a { color: inherit; text-decoration: none; }
.gallery article { border-top: 1px solid var(--line); margin-top: 1.1rem; padding-top: 1.1rem; scroll-margin-top: .5rem; }
.gallery article + article { margin-top: 2.4rem; }
.gallery article > * { margin-bottom: 1rem; } .gallery article > h3 { margin-bottom: .1rem; }
p.about span { display: inline-block; } .gallery p.about, p.files { font-size: .88rem; }
.gallery table { width: auto; min-width: min(100%, 24rem); } p.files { color: var(--soft); }
.gallery .card { padding: .45rem .75rem; } .gallery .card b { font-size: 1.1rem; }
.gallery .cards { grid-template-columns: repeat(auto-fill, minmax(150px, 1fr)); gap: .5rem; }
.gallery pre { font-size: .8rem; padding: .5rem .75rem; }
.grid { display: grid; gap: 1rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 300px), 1fr)); }
.grid.wide { grid-template-columns: repeat(auto-fit, minmax(min(100%, 400px), 1fr)); } .grid figure { margin: 0; }
.grid.wide figure:only-child { max-width: 44rem; } .grid:not(.wide) img { max-height: 34rem; object-fit: contain; }
nav { font-size: .88rem; line-height: 1.35; } nav a { display: block; text-decoration: none; padding: .16rem 0;
  overflow-wrap: anywhere; } nav b { display: block; margin: .9rem 0 .1rem; }
nav div { break-inside: avoid; }
@media (max-width: 1019px) { nav { columns: 2 150px; column-gap: 1.5rem; margin: 1.2rem 0 0; }
  nav div:first-child b { margin-top: 0; } }
@media screen and (min-width: 1020px) { body.gallery { display: grid; grid-template-columns: 200px minmax(0, 1fr);
    column-gap: 2.6rem; } body.gallery > header { grid-column: 1 / 3; }
  nav { position: sticky; top: 0; max-height: 100vh; overflow-y: auto; align-self: start; padding: 0 .5rem 2rem 0;
    scrollbar-width: thin; } main > section:first-child h2 { margin-top: .8rem; } }
@media print { body, body.gallery { max-width: none; padding: 0; font-size: 10pt; } 
  h2, h3, h2 + p, p.about { break-after: avoid; break-inside: avoid; }
  figure, .card, tr, svg, pre { break-inside: avoid; } .controls, dialog { display: none; }
  img { max-height: 17cm; width: auto; } a.zoom img { width: auto; } .scroll { overflow: visible; } table { font-size: .8em; }
  a { color: inherit; text-decoration: none; } nav { columns: 3; }
  .grid img { max-height: 9cm; } .grid.wide { grid-template-columns: repeat(2, 1fr); }
  .grid:not(.wide), .charts { grid-template-columns: repeat(3, 1fr); } }
)css";

constexpr const char* kScript = R"js(
'use strict';
for (const player of document.querySelectorAll('.player')) {
  const frames = [...player.querySelectorAll('figure')];
  if (frames.length < 2) continue;
  const bar = document.createElement('div'), button = document.createElement('button');
  const slider = Object.assign(document.createElement('input'),
    {type: 'range', min: 0, max: frames.length - 1, value: 0, ariaLabel: 'frame'});
  let timer = 0;
  const show = i => { frames.forEach((frame, k) => frame.classList.toggle('now', k === i)); slider.value = i; };
  const stop = () => { clearInterval(timer); timer = 0; button.textContent = 'Play'; };
  const load = () => frames.forEach(frame => { frame.querySelector('img').loading = 'eager'; });
  const start = () => { load(); button.textContent = 'Pause';
    timer = setInterval(() => show((+slider.value + 1) % frames.length), 160); };
  button.type = 'button';
  button.onclick = () => timer ? stop() : start();
  slider.oninput = () => { load(); stop(); show(+slider.value); };
  bar.className = 'controls';
  bar.append(button, slider);
  player.append(bar);
  player.classList.add('on');
  stop();
  show(0);
}
const pictures = [...document.querySelectorAll('a.zoom')];
function enlarge(number) {
  const dialog = document.createElement('dialog'), picture = new Image(), caption = document.createElement('p');
  const show = i => {
    number = (i + pictures.length) % pictures.length;
    const link = pictures[number], full = new Image();
    picture.src = link.querySelector('img').src;
    caption.textContent = link.querySelector('img').alt;
    full.onload = () => { if (pictures[number] === link) picture.src = full.src; };
    full.src = link.href || picture.src;
  };
  dialog.className = 'large';
  dialog.append(picture, caption);
  dialog.onclick = () => dialog.close();
  dialog.onclose = () => dialog.remove();
  dialog.onkeydown = event => {
    if (event.key === 'ArrowRight') show(number + 1);
    if (event.key === 'ArrowLeft') show(number - 1);
  };
  show(number);
  document.body.append(dialog);
  dialog.showModal();
}
pictures.forEach((link, i) => link.addEventListener('click', event => {
  if (event.ctrlKey || event.metaKey || event.shiftKey || innerWidth < 700) return;  // a phone zooms by itself
  event.preventDefault();
  enlarge(i);
}));
)js";

}  // namespace

const char* page_style() { return kStyle; }
const char* page_script() { return kScript; }

}  // namespace hysteron::experiments
