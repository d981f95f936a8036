'use strict';
(() => {
const $ = selector => document.querySelector(selector), all = selector => [...document.querySelectorAll(selector)];
const root = document.documentElement, data = JSON.parse($('#data').textContent), rows = data.rows, wide = data.width, high = data.height;
const state = {row: data.selected, hovered: -1, mode: 'divider', split: .5, pin: null, hidden: new Set(), text: '', front: false, sort: -2, down: false};
const around = 5;  // pixels that the magnifier shows beside its middle, each way

// ---- pictures: 8-bit RGBA of the truth (-1) and of rows, once they are asked for
const kept = new Map();
function pixels(row) {
  if (!kept.has(row)) kept.set(row, load(row));
  return kept.get(row);
}
async function load(row) {
  const image = new Image(), shown = row < 0 ? null : $(`.sheet .pic[data-i="${row}"] img`);
  const source = row < 0 ? getComputedStyle(root).getPropertyValue('--truth').trim().replace(/^url\(["']?|["']?\)$/g, '') : shown ? shown.src : '';
  if (!source.startsWith('data:')) return null;
  image.src = source;
  await image.decode();
  const canvas = document.createElement('canvas');
  canvas.width = wide; canvas.height = high;
  const context = canvas.getContext('2d', {willReadFrequently: true});
  if (row >= 0) context.putImageData((await pixels(-1)).copy(), 0, 0);
  context.drawImage(image, 0, 0);
  const got = context.getImageData(0, 0, wide, high);
  got.copy = () => new ImageData(new Uint8ClampedArray(got.data), wide, high);
  return got;
}

// ---- differences: the classes of the scale, of the root mean square over a pixel's colors
const styles = () => getComputedStyle(root);
const hex = color => [1, 3, 5].map(i => parseInt(color.trim().slice(i, i + 2), 16));
const classColors = () => data.classes.map((_, k) => k === 0 ? null : hex(styles().getPropertyValue('--k' + k)));
const signColors = {darker: [[36, 64, 95], [47, 104, 154], [70, 150, 205], [111, 208, 255]], brighter: [[92, 59, 32], [150, 95, 40], [210, 145, 60], [255, 207, 122]]};
const signLimits = [.005, .01, .02, .05];
const offOf = (a, b, k) => Math.sqrt(((a[k] - b[k]) ** 2 + (a[k + 1] - b[k + 1]) ** 2 + (a[k + 2] - b[k + 2]) ** 2) / 3) / 255;
const classOf = off => data.classes.filter(one => off >= one.from).length - 1;
const dim = (a, k) => { const gray = 14 + .16 * (.3 * a[k] + .59 * a[k + 1] + .11 * a[k + 2]); return [gray, gray, gray]; };
function differenceColor(truth, row, k, mode, colors) {
  const off = offOf(truth, row, k);
  if (mode === 'difference') return colors[classOf(off)] || dim(truth, k);
  const sum = row[k] + row[k + 1] + row[k + 2] - truth[k] - truth[k + 1] - truth[k + 2], size = signLimits.filter(limit => Math.abs(sum) / 765 >= limit).length;
  return size === 0 ? dim(truth, k) : signColors[sum < 0 ? 'darker' : 'brighter'][size - 1];
}
function difference(truth, row, mode) {
  const made = new ImageData(wide, high), colors = classColors();
  for (let k = 0; k < made.data.length; k += 4) {
    const color = differenceColor(truth.data, row.data, k, mode, colors);
    made.data[k] = color[0]; made.data[k + 1] = color[1]; made.data[k + 2] = color[2]; made.data[k + 3] = 255;
  }
  return made;
}
function put(canvas, image) { canvas.width = wide; canvas.height = high; canvas.getContext('2d').putImageData(image, 0, 0); }

async function flipMap(row) {
  const image = $(`.sheet figure[data-i="${row}"] .flip`);
  if (!image) return null;
  await image.decode();
  const canvas = new OffscreenCanvas(wide, high), context = canvas.getContext('2d');
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, wide, high);
}

// ---- the chosen row
async function view() {
  const number = state.row, truth = await pixels(-1), row = await pixels(number), map = await flipMap(number);
  if (number !== state.row) return;
  const mode = state.mode === 'flip' && !map ? 'difference' : state.mode;
  $('#modes [data-mode=flip]').hidden = !map;
  all('#modes button').forEach(button => button.setAttribute('aria-pressed', button.dataset.mode === mode));
  $('.view').hidden = $('.magnifier').hidden = $('#modes').hidden = !row;
  $('#classes').hidden = !row || mode === 'signed' || mode === 'flip'; $('#signs').hidden = !row || mode !== 'signed'; $('#flips').hidden = !row || mode !== 'flip';
  if (!row) return;
  const left = $('#left'), right = $('#right'), isSplit = mode === 'divider';
  put(left, mode === 'flip' ? map : mode === 'row' ? row : mode === 'difference' || mode === 'signed' ? difference(truth, row, mode) : truth);
  right.hidden = $('#divider').hidden = $('.tag.right').hidden = !isSplit;
  if (isSplit) {
    put(right, row);
    right.style.clipPath = `inset(0 0 0 ${100 * state.split}%)`;
    $('#divider').style.left = 100 * state.split + '%';
    $('#divider').setAttribute('aria-valuenow', Math.round(100 * state.split));
  }
  $('.tag.left').textContent = isSplit || mode === 'truth' ? 'truth' : mode === 'row' ? rows[number].name : mode === 'flip' ? 'FLIP against the truth' : 'difference from the truth';
  $('.tag.right').textContent = rows[number].name;
  magnify();
}
function place() { return state.pin || rows[state.row].worst; }
async function magnify(over) {
  const number = state.row, truth = await pixels(-1), row = await pixels(number), at = over || (rows[number].worst && place());
  if (!row || number !== state.row || !at) return;
  const size = 2 * around + 1, colors = classColors(), names = ['truth', 'row', 'difference'];
  names.forEach(name => {
    const canvas = $('#m-' + name), made = new ImageData(size, size);
    for (let j = 0; j < size; j++) for (let i = 0; i < size; i++) {
      const x = at[0] + i - around, y = at[1] + j - around, to = 4 * (j * size + i);
      if (x < 0 || y < 0 || x >= wide || y >= high) continue;
      const k = 4 * (y * wide + x), color = name === 'truth' ? truth.data.slice(k, k + 3) : name === 'row' ? row.data.slice(k, k + 3) : differenceColor(truth.data, row.data, k, state.mode === 'signed' ? 'signed' : 'difference', colors);
      made.data.set([color[0], color[1], color[2], 255], to);
    }
    canvas.width = canvas.height = size;
    canvas.getContext('2d').putImageData(made, 0, 0);
  });
  const k = 4 * (at[1] * wide + at[0]), cells = all('.magnifier tbody tr').map(line => [...line.cells].slice(1)), off = offOf(truth.data, row.data, k);
  for (let c = 0; c < 3; c++) {
    const apart = row.data[k + c] - truth.data[k + c];
    cells[0][c].textContent = truth.data[k + c]; cells[1][c].textContent = row.data[k + c]; cells[2][c].textContent = apart > 0 ? '+' + apart : String(apart).replace('-', '\u2212');
  }
  $('#at').textContent = at[0] + ', ' + at[1];
  $('#off').textContent = (100 * off).toFixed(1) + ' % of white: ' + data.classes[classOf(off)].words;
  const cross = $('#cross').style;
  cross.left = 100 * (at[0] - around) / wide + '%'; cross.top = 100 * (at[1] - around) / high + '%'; cross.width = 100 * size / wide + '%'; cross.height = 100 * size / high + '%';
}
function choose(row) {
  if (row === null || row < 0 || row >= rows.length) return;
  state.row = row; state.pin = null;
  if (location.protocol !== 'about:') history.replaceState(null, '', '#' + encodeURIComponent(rows[row].name));
  $('#name').textContent = rows[row].name; $('#says').textContent = rows[row].says; $('#command').textContent = rows[row].command || '';
  all('#selected .cmd').forEach(line => { line.hidden = !rows[row].command; });
  all('.chosen').forEach(element => element.classList.remove('chosen'));
  all(`.pt[data-i="${row}"], .rows tr[data-i="${row}"], .sheet figure[data-i="${row}"]`).forEach(element => element.classList.add('chosen'));
  steps(row); worstPixel(row);
  view();
}

function steps(row) {
  const own = rows[row].steps || [], most = Math.max(...own.map(step => step[1]));
  $('#steps').hidden = own.length < 2;
  $('#steps tbody').replaceChildren(...own.map(([name, ms]) => {
    const line = document.createElement('tr'), bar = document.createElement('i');
    for (const words of [name, ms.toPrecision(3), '']) line.insertCell().textContent = words;
    bar.style.width = 100 * ms / most + '%';
    line.lastChild.append(bar);
    return line;
  }));
}
function worstPixel(row) {
  const plot = $(`.sheet figure[data-i="${row}"] .probe`);
  $('#probe').hidden = !plot;
  if (plot) $('#probe img').src = plot.src;
}

// ---- which rows are shown, and in which order
const isShown = row => !state.hidden.has(row.technique) && (!state.front || row.front) && row.name.toLowerCase().includes(state.text);
function filter() {
  all('.rows tbody tr').forEach(line => { line.hidden = !isShown(rows[+line.dataset.i]); });
  all('.sheet figure').forEach(figure => { figure.hidden = !isShown(rows[+figure.dataset.i]); });
  all('.plot [data-i]').forEach(element => element.classList.toggle('away', !isShown(rows[+element.dataset.i])));
  $('#count').textContent = rows.filter(isShown).length + ' of ' + rows.length + ' rows';
}
function sort(key, head) {
  state.down = state.sort === key ? !state.down : false; state.sort = key;
  const column = head.cellIndex, body = $('.rows tbody'), value = line => { const cell = line.cells[column]; return cell && cell.dataset.v !== undefined ? +cell.dataset.v : Infinity; };
  const order = (a, b) => column === 0 ? rows[+a.dataset.i].name.localeCompare(rows[+b.dataset.i].name) : value(a) === value(b) ? 0 : value(a) - value(b);
  [...body.rows].sort((a, b) => state.down ? order(b, a) : order(a, b)).forEach(line => body.append(line));
  all('.rows th').forEach(other => other.removeAttribute('aria-sort'));
  head.setAttribute('aria-sort', state.down ? 'descending' : 'ascending');
}
function step(by) {
  const shown = all('.rows tbody tr').filter(line => !line.hidden).map(line => +line.dataset.i);
  if (shown.length) choose(shown[(shown.indexOf(state.row) + by + shown.length) % shown.length]);
}
function axes(event) {
  const isChosen = plot => plot.dataset.up === $('#up').value && plot.dataset.across === $('#across').value;
  if (!all('#plots .one').some(isChosen)) $(event.target.id === 'up' ? '#across' : '#up').selectedIndex = 0;  // a page inside of another lacks some
  all('#plots .one').forEach(plot => { plot.hidden = !isChosen(plot); });
}

// ---- pointers
const tip = document.createElement('div');
tip.id = 'tip'; tip.hidden = true;
document.body.append(tip);
const rowAt = event => { const element = event.target.closest('[data-i]'); return element ? +element.dataset.i : -1; };
function hover(row, event) {
  if (row !== state.hovered) {
    state.hovered = row;
    all('.hovered').forEach(element => element.classList.remove('hovered'));
    if (row >= 0) all(`.pt[data-i="${row}"], .rows tr[data-i="${row}"]`).forEach(element => element.classList.add('hovered'));
  }
  tip.hidden = row < 0 || !event;
  if (tip.hidden) return;
  tip.replaceChildren(Object.assign(document.createElement('b'), {textContent: rows[row].name}), document.createElement('br'), rows[row].says);
  tip.style.left = Math.min(innerWidth - tip.offsetWidth - 12, event.clientX + 16) + 'px'; tip.style.top = Math.min(innerHeight - tip.offsetHeight - 12, event.clientY + 14) + 'px';
}
$('#plots').addEventListener('pointermove', event => hover(rowAt(event), event));
$('#plots').addEventListener('pointerleave', () => hover(-1));
$('#plots').addEventListener('click', event => choose(rowAt(event)));
$('.rows tbody').addEventListener('pointerover', event => hover(rowAt(event)));
$('.rows tbody').addEventListener('pointerleave', () => hover(-1));
$('.rows tbody').addEventListener('click', event => choose(rowAt(event)));
$('.rows tbody').addEventListener('keydown', event => { if (event.key === 'Enter') choose(rowAt(event)); });
$('.sheet').addEventListener('click', event => { const row = rowAt(event); if (row >= 0) { choose(row); $('#selected').scrollIntoView({block: 'start'}); } });
all('.rows th button').forEach(button => button.addEventListener('click', () => sort(+button.dataset.k, button.closest('th'))));
all('.technique').forEach(button => button.addEventListener('click', () => {
  const technique = button.dataset.t;
  if (!state.hidden.delete(technique)) state.hidden.add(technique);
  button.setAttribute('aria-pressed', !state.hidden.has(technique));
  filter();
}));
$('#filter').addEventListener('input', event => { state.text = event.target.value.trim().toLowerCase(); filter(); });
$('#front').addEventListener('click', event => { state.front = !state.front; event.target.setAttribute('aria-pressed', state.front); filter(); });
['#up', '#across'].forEach(selector => $(selector).addEventListener('change', axes));
all('#modes button').forEach(button => button.addEventListener('click', () => mode(button.dataset.mode)));
function mode(name) { state.mode = name; view(); }
const share = event => { const box = $('.view').getBoundingClientRect(); return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height]; };
const limit = (value, most) => Math.max(0, Math.min(most, value));
const pixelAt = ([x, y]) => [limit(Math.floor(x * wide), wide - 1), limit(Math.floor(y * high), high - 1)];
function split(at) { state.split = limit(at, 1); view(); }
let drags = false, dragged = false;
$('#divider').addEventListener('pointerdown', event => { drags = dragged = true; $('.view').setPointerCapture(event.pointerId); event.preventDefault(); $('#divider').focus(); });
$('.view').addEventListener('pointermove', event => { if (drags) split(share(event)[0]); else magnify(pixelAt(share(event))); });
$('.view').addEventListener('pointerup', () => { drags = false; });
$('.view').addEventListener('pointerleave', () => magnify());
$('.view').addEventListener('click', event => { if (dragged) dragged = false; else { state.pin = pixelAt(share(event)); magnify(); } });
$('#worst').addEventListener('click', () => { state.pin = null; magnify(); });

// ---- small pictures, and those on top, which are copies of them
async function maps(on) {
  $('#maps').setAttribute('aria-pressed', on); $('#photos').setAttribute('aria-pressed', !on);
  const truth = await pixels(-1);
  for (const picture of all('.sheet .pic[data-i]')) {
    let canvas = picture.querySelector('canvas');
    const row = canvas ? null : await pixels(+picture.dataset.i);
    if (row) { canvas = document.createElement('canvas'); put(canvas, difference(truth, row, 'difference')); picture.append(canvas); }
    if (canvas) canvas.hidden = !on;
  }
}
$('#maps').addEventListener('click', () => maps(true)); $('#photos').addEventListener('click', () => maps(false));
all('.pic[data-copy]').forEach(picture => {
  const image = $(`.sheet .pic[data-i="${picture.dataset.copy}"] img`);
  if (image) picture.append(image.cloneNode()); else picture.closest('figure').hidden = true;
});

// ---- keys
function move(by) { const at = place(); if (!at) return; state.pin = [limit(at[0] + by[0], wide - 1), limit(at[1] + by[1], high - 1)]; magnify(); }
document.addEventListener('keydown', event => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (/INPUT|SELECT/.test(event.target.tagName)) { if (event.key === 'Escape') event.target.blur(); return; }
  const modes = ['divider', 'truth', 'row', 'difference', 'signed', 'flip'], arrow = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
  const act = {j: () => step(1), k: () => step(-1), f: () => mode(state.mode === 'truth' ? 'row' : 'truth'), d: () => mode(state.mode === 'difference' ? 'divider' : 'difference'),
    '[': () => split(state.split - .05), ']': () => split(state.split + .05), w: () => { state.pin = null; magnify(); }, r: () => choose(data.selected),
    m: () => maps($('#maps').getAttribute('aria-pressed') !== 'true'), t: page.theme, '/': () => $('#filter').focus(), '?': page.showKeys}[event.key];
  if (act) act();
  else if (event.key >= '1' && event.key <= '6') mode(modes[+event.key - 1]);
  else if (arrow && event.target.id === 'divider') split(state.split + .02 * arrow[0]);
  else if (arrow && event.target.classList.contains('view')) move(arrow);
  else return;
  event.preventDefault();
});

// ---- legends and the start
$('#classes').innerHTML = data.classes.map((one, k) => `<span><i class="k${k}"></i>${one.words}</span>`).join('');
$('#signs').innerHTML = [...signColors.darker].reverse().map((color, k) => [color, k === 0 ? 'darker by 5 %' : '']).concat(signColors.brighter.map((color, k) => [color, k === 3 ? 'brighter by 5 %' : '']))
  .map(([color, words]) => `<span><i style="background:rgb(${color})"></i>${words}</span>`).join('');
filter();
const named = rows.findIndex(row => '#' + encodeURIComponent(row.name) === location.hash);
choose(named >= 0 ? named : state.row);
if (rows.some(row => row.worst)) maps(true).then(() => { root.dataset.ready = '1'; }); else root.dataset.ready = '1';
})();
