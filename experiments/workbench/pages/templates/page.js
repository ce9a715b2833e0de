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
