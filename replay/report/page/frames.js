'use strict';
(() => {
const frames = [...document.querySelectorAll('.frame')], inside = frame => frame.querySelector('iframe').contentDocument;
const root = document.documentElement;
let at = Math.max(0, frames.findIndex(frame => frame.open));  // the frame that was opened last

// ---- each frame's page: as high as it is, as dark as this one
function fit(frame) {
  const own = inside(frame);
  if (own?.body?.offsetHeight) frame.querySelector('iframe').style.height = own.body.offsetHeight + 4 + 'px';
}
function shade(frame) {
  const own = inside(frame);
  if (own?.documentElement) own.documentElement.dataset.theme = getComputedStyle(root).colorScheme === 'dark' ? 'dark' : 'light';
}
const isThere = frame => Boolean(inside(frame)?.documentElement?.dataset.ready);
const shadeAll = () => frames.forEach(shade);
function settle(frame) {
  shade(frame);
  fit(frame);
  new ResizeObserver(() => fit(frame)).observe(inside(frame).body);
}
frames.forEach((frame, index) => {
  const page = frame.querySelector('iframe'), own = page.contentDocument;
  if (own && own.URL === 'about:srcdoc' && own.readyState === 'complete') settle(frame);
  else page.addEventListener('load', () => settle(frame), {once: true});
  frame.addEventListener('toggle', () => { fit(frame); if (frame.open) at = index; });
});
document.querySelector('#theme').addEventListener('click', shadeAll);

// ---- cells of the matrix
function open(index) {
  const frame = frames[index];
  frame.open = true;
  at = index;
  frame.scrollIntoView({block: 'start'});
  return frame;
}
function choose(frame, row) {
  if (!isThere(frame)) { setTimeout(() => choose(frame, row), 50); return; }
  inside(frame).querySelector(`tr[data-i="${row}"]`).click();
}
document.querySelectorAll('.matrix a').forEach(cell => cell.addEventListener('click', event => {
  event.preventDefault();
  choose(open(+cell.dataset.frame), cell.dataset.row);
}));

// ---- keys
function go(by) { open(Math.max(0, Math.min(frames.length - 1, at + by))).querySelector('summary').focus(); }
document.addEventListener('keydown', event => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const act = {n: () => go(1), p: () => go(-1), t: () => { page.theme(); shadeAll(); }, '?': page.showKeys}[event.key];
  if (!act) return;
  act();
  event.preventDefault();
});
root.dataset.ready = '1';
})();
