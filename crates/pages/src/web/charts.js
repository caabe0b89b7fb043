'use strict';
// Draws charts when they come into being, keeps cursors and zooms of one recording together, and answers to keys.
const plots = [...document.querySelectorAll('.plot')];
const CONFIG = { displayModeBar: false, responsive: false, doubleClick: false, showTips: false };
// Of a chart across the page, and of one beside another: A4 and Letter, less their margins.
const PRINT_WIDTHS = [670, 325];
let printing = false;

function specOf(el) {
  el.spec ??= JSON.parse(document.getElementById(el.dataset.chart).textContent);
  return el.spec;
}

function peers(el) {
  const link = specOf(el).link;
  return link ? plots.filter(p => p.drawn && specOf(p).link === link) : [el];
}

function draw(el) {
  const width = printing ? PRINT_WIDTHS[el.closest('.grid') ? 1 : 0] : el.clientWidth;
  if (!width) return;
  const spec = specOf(el);
  const { data, layout } = BUILD[spec.kind](spec, el.view, width);
  layout.width = width;
  Plotly.react(el, data, layout, CONFIG);
  if (el.values) values(el, el.cursor);
  if (el.drawn) return;
  el.drawn = true;
  el.on('plotly_relayout', e => relaid(el, e));
  el.on('plotly_doubleclick', () => reset(el));
  el.on('plotly_hover', e => hovered(el, e));
  el.on('plotly_unhover', () => cursor(el, null));
}

// The reader has zoomed. Only time plots keep the view themselves, because their points depend on it.
function relaid(el, change) {
  if (specOf(el).kind !== 'time') return;
  const range = change['xaxis.range'] ?? [change['xaxis.range[0]'], change['xaxis.range[1]']];
  if (range[0] !== undefined) show(el, range);
  else if (change['xaxis.autorange']) show(el, null);
}

function show(el, view) {
  for (const peer of peers(el)) {
    if (specOf(peer).kind !== 'time') continue;
    peer.view = view;
    draw(peer);
  }
}

let telling = false;

function hovered(el, event) {
  const point = event.points?.[0];
  if (point) cursor(el, point.x);
}

// Shows one instant in all plots of a recording; `null` takes it away.
function cursor(el, t) {
  if (telling || specOf(el).kind !== 'time') return;
  telling = true;
  values(el, t);
  for (const peer of plots) {
    if (!peer.drawn || peer === el) continue;
    const spec = specOf(peer);
    if (spec.kind === 'time' && spec.link === specOf(el).link) {
      if (t === null) Plotly.Fx.unhover(peer); else Plotly.Fx.hover(peer, { xval: t }, 'xy');
      values(peer, t);
    }
    if (spec.kind === 'path') markOnPath(peer, specOf(el).link, t);
  }
  telling = false;
}

function markOnPath(el, link, t) {
  const run = specOf(el).runs.find(r => r.link === link);
  if (!run) return;
  const at = t === null ? null : run.path[Math.min(firstAt(run.time, t), run.path.length - 1)];
  Plotly.restyle(el, { x: [at ? [at[0]] : []], y: [at ? [at[1]] : []] }, [el.data.length - 1]);
}

// The instants at which the keyboard's cursor can stand.
function stops(el) {
  const spec = specOf(el);
  if (spec.kind === 'time') return spec.time;
  return spec.kind === 'lines' && !spec.equal ? spec.x[0] ?? [] : [];
}

function viewOf(el) {
  return el.layout.xaxis.range.map(Number);
}

function zoom(el, factor, centre) {
  const [a, b] = viewOf(el);
  const middle = centre ?? (a + b) / 2;
  const range = [middle + (a - middle) * factor, middle + (b - middle) * factor];
  if (specOf(el).kind !== 'time') { Plotly.relayout(el, { 'xaxis.range': range }); return; }
  const { time } = specOf(el);
  const [first, last] = [time[0], time[time.length - 1]];
  const clipped = [Math.max(first, range[0]), Math.min(last, range[1])];
  show(el, clipped[0] <= first && clipped[1] >= last ? null : clipped);
}

function reset(el) {
  if (specOf(el).kind === 'time') show(el, null);
  else Plotly.relayout(el, { 'xaxis.autorange': true, 'yaxis.autorange': true });
}

function step(el, by) {
  const at = stops(el);
  if (!at.length) return;
  const [a, b] = viewOf(el);
  const [first, last] = [firstAt(at, a), Math.max(firstAt(at, b + 1e-12) - 1, 0)];
  const from = el.at ?? (by > 0 ? first - 1 : last + 1);
  el.at = Math.min(Math.max(from + by, first), last);
  telling = true;
  Plotly.Fx.hover(el, { xval: at[el.at] }, 'xy');
  telling = false;
  cursor(el, at[el.at]);
  tell(el, at[el.at], el.at);
}

// The values at the cursor in words, for those who do not see it.
function tell(el, t, index) {
  const spec = specOf(el);
  const words = spec.kind === 'time'
    ? spec.rows.map(r => `${r.name} ${r.lines.map(l => `${ROLES[l.role].name} ${short(l.y[index])}`).join(', ')} ${r.unit}`)
    : spec.lines.map(l => `${l.name} ${short(l.y[index])}`);
  el.parentElement.querySelector('.readout').textContent = `${spec.kind === 'time' ? `${short(t)} s` : short(t)}: ${words.join('; ')}`;
}

function pressed(el, event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const far = event.shiftKey ? 10 : 1;
  const centre = el.at === undefined ? null : stops(el)[el.at];
  const actions = {
    ArrowRight: () => step(el, far), ArrowLeft: () => step(el, -far), Home: () => step(el, -Infinity), End: () => step(el, Infinity),
    '+': () => zoom(el, 0.5, centre), '=': () => zoom(el, 0.5, centre), '-': () => zoom(el, 2, centre), 0: () => reset(el),
    Escape: () => { el.at = undefined; Plotly.Fx.unhover(el); cursor(el, null); },
  };
  const action = actions[event.key];
  if (!action || !el.drawn) return;
  event.preventDefault();
  action();
}

for (const el of plots) {
  el.addEventListener('keydown', event => pressed(el, event));
  el.addEventListener('wheel', event => {
    // Without Ctrl (or a pinch, which looks like it) the wheel scrolls the page.
    if (!event.ctrlKey || !['time', 'lines'].includes(specOf(el).kind)) return;
    event.preventDefault();
    const box = el.getBoundingClientRect();
    const { _offset: left, _length: long } = el._fullLayout.xaxis;
    const [a, b] = viewOf(el);
    zoom(el, Math.exp(event.deltaY * 0.004), a + ((b - a) * (event.clientX - box.left - left)) / long);
  }, { passive: false });
  for (const button of el.parentElement.querySelectorAll('.tools button')) {
    button.addEventListener('click', () => {
      const by = Number(button.dataset.zoom);
      if (by) zoom(el, by); else reset(el);
    });
  }
}

// A chart is drawn when it gets a width: at the start, when its section is opened, when the window changes.
const sizes = new ResizeObserver(entries => {
  if (printing) return;
  for (const { target } of entries) {
    if (target.clientWidth && target.clientWidth !== target.lastWidth) {
      target.lastWidth = target.clientWidth;
      draw(target);
    }
  }
});

function redraw() {
  for (const el of plots.filter(p => p.drawn)) draw(el);
}

theme(null);
for (const el of plots) sizes.observe(el);
document.getElementById('theme').addEventListener('click', () => {
  chosen = isDark() ? 'light' : 'dark';
  theme(chosen);
  redraw();
});
systemDark.addEventListener('change', () => { theme(chosen); redraw(); });
addEventListener('beforeprint', () => {
  printing = true;
  root.style.colorScheme = 'light';
  redraw();
});
addEventListener('afterprint', () => {
  printing = false;
  theme(chosen);
  redraw();
});
