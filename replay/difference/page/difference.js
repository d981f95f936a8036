'use strict';
const root = document.documentElement;
const $ = (which, of = document) => of.querySelector(which), $$ = (which, of = document) => [...of.querySelectorAll(which)];

// ---- one picture, large: an article's panels by key
const articles = $$('article[data-name]'), viewer = $('#viewer'), picture = $('#picture'), divider = $('#divider');
let at = 0, mode = 'b', opener = null;
const panel = key => $(`.whole [data-key="${key}"]`, articles[at]);
function show(index, key) {
  at = Math.max(0, Math.min(articles.length - 1, index));
  mode = key === 'divider' || panel(key) ? key : 'b';
  const article = articles[at];
  $('#name').textContent = article.dataset.name;
  $('#scale').textContent = panel(mode === 'divider' ? 'b' : mode).dataset.scale;
  for (const button of $$('#modes button')) {
    button.hidden = button.dataset.mode !== 'divider' && !panel(button.dataset.mode);
    button.setAttribute('aria-pressed', button.dataset.mode === mode);
  }
  picture.style.cssText = article.style.cssText;
  picture.replaceChildren();
  const image = mode === 'a' ? null : $('img', panel(mode === 'divider' ? 'b' : mode));
  if (image) picture.append(image.cloneNode());
  divider.hidden = mode !== 'divider';
  fit();
  split();
}
function fit() {
  const [wide, high] = articles[at].dataset.size.split(' ').map(Number), stage = $('#stage');
  const room = Math.min(stage.clientWidth / wide, (stage.clientHeight - 40) / high), scale = room > 1 ? Math.floor(room) : room;
  picture.style.width = wide * scale + 'px';
  picture.style.height = high * scale + 'px';
}
function split() {
  const image = $('img', picture), line = $('i', picture);
  if (line) line.remove();
  if (!image) return;
  image.style.clipPath = mode === 'divider' ? `inset(0 0 0 ${divider.value}%)` : '';
  if (mode !== 'divider') return;
  const made = document.createElement('i');
  made.style.left = divider.value + '%';
  picture.append(made);
}
function open(index, key) {
  opener = document.activeElement;
  viewer.hidden = false;
  show(index, key);
  $('#close').focus();
}
function close() {
  viewer.hidden = true;
  if (opener) opener.focus();
}
articles.forEach((article, index) => {
  for (const each of $$('.whole .pic', article)) each.onclick = () => open(index, each.dataset.key);
});
for (const button of $$('#modes button')) button.onclick = () => show(at, button.dataset.mode);
divider.oninput = split;
$('#close').onclick = close;
addEventListener('resize', () => viewer.hidden || fit());

// ---- the table
const filter = $('#filter'), differing = $('#differing'), rows = $$('tbody tr');
function filterRows() {
  const words = filter.value.toLowerCase(), only = differing.getAttribute('aria-pressed') === 'true';
  for (const row of rows) row.hidden = !row.textContent.toLowerCase().includes(words) || (only && row.dataset.verdict === 'same');
  $('#count').textContent = rows.filter(row => !row.hidden).length + ' of ' + rows.length;
}
filter.oninput = filterRows;
differing.onclick = () => { differing.setAttribute('aria-pressed', differing.getAttribute('aria-pressed') !== 'true'); filterRows(); };
filterRows();

// ---- keys
const actions = {f: () => show(at, mode === 'a' ? 'b' : 'a'), j: () => show(at + 1, mode), k: () => show(at - 1, mode),
  1: () => show(at, 'divider'), 2: () => show(at, 'a'), 3: () => show(at, 'b'), 4: () => show(at, 'difference'), 5: () => show(at, 'flip'),
  '[': () => { divider.value -= 2; split(); }, ']': () => { divider.value = +divider.value + 2; split(); }, Escape: close};
addEventListener('keydown', event => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches('input[type=search]')) return;
  if (event.key === 't') page.theme();
  else if (!viewer.hidden && actions[event.key]) { actions[event.key](); event.preventDefault(); }
});
root.dataset.ready = '1';
