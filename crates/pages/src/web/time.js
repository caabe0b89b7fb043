'use strict';
// Time plots: rows above one another over one axis, thinned to what a screen shows and again on every zoom.

// First index whose time is not below t.
function firstAt(time, t) {
  let [a, b] = [0, time.length];
  while (a < b) {
    const m = (a + b) >> 1;
    if (time[m] < t) a = m + 1; else b = m;
  }
  return a;
}

// Of each group of points the least and the greatest, at the group's first and last time: lines of one plot so keep
// one axis, and no peak is lost.
function thinned(time, y, [from, until], width, breaks) {
  const size = Math.max(1, Math.ceil((until - from) / Math.max(width, 300)));
  const out = { x: [], y: [] };
  const add = (x, v) => { out.x.push(x); out.y.push(v); };
  for (let i = from; i < until; i += size) {
    const last = Math.min(i + size, until) - 1;
    if (breaks.has(i, last) && out.x.length) add((time[i] + time[Math.max(i - 1, 0)]) / 2, null);
    if (size === 1) { add(time[i], y[i]); continue; }
    let low = null; let high = null;
    for (let k = i; k <= last; k++) {
      if (y[k] === null) continue;
      if (low === null || y[k] < y[low]) low = k;
      if (high === null || y[k] > y[high]) high = k;
    }
    if (low === null) { add(time[i], null); add(time[last], null); continue; }
    add(time[i], y[Math.min(low, high)]);
    add(time[last], y[Math.max(low, high)]);
  }
  return out;
}

// Whether a line is broken before one of some points.
class Breaks {
  constructor(indices) { this.sorted = [...new Set(indices)].sort((a, b) => a - b); }
  has(from, until) {
    const at = firstAt(this.sorted, from);
    return at < this.sorted.length && this.sorted[at] <= until;
  }
}

const ROW = 118;
const ROW_ON_PAPER = 92;
const ROW_ALONE = 250;
const ROW_GAP = 34;

// A strip below the row, and a shade where it tells something: a row that is shaded throughout is hard to read.
function marked([a, b], y, [from, until]) {
  const box = { type: 'rect', xref: 'x', x0: a, x1: b, line: { width: 0 }, layer: 'below' };
  const strip = { ...box, yref: `${y} domain`, ysizemode: 'pixel', yanchor: 0, y0: 0, y1: 4, fillcolor: colour('before') };
  const shade = { ...box, yref: `${y} domain`, y0: 0, y1: 1, fillcolor: colour('band') };
  return b - a < 0.9 * (until - from) ? [shade, strip] : [strip];
}

BUILD.time = function (spec, view, width) {
  const { time, rows } = spec;
  const [from, until] = view ?? [time[0], time[time.length - 1]];
  const range = [Math.max(0, firstAt(time, from) - 1), Math.min(time.length, firstAt(time, until) + 2)];
  const gaps = new Breaks(spec.gaps);
  const starts = new Breaks([...spec.gaps, ...spec.restarts]);
  const alone = rows.length === 1;
  const row = alone ? ROW_ALONE : printing ? ROW_ON_PAPER : ROW;
  const height = rows.length * row + (rows.length - 1) * ROW_GAP;
  const top = i => 1 - (i * (row + ROW_GAP)) / height;
  const layout = base(height + 92);
  layout.margin.t = 50;
  layout.hovermode = 'x';
  layout.hoversubplots = 'axis';
  layout.shapes = [];
  layout.annotations = [];
  layout.legend.y = 1 + 20 / height;
  const data = [];
  const named = new Set();
  rows.forEach((signal, i) => {
    const y = i === 0 ? 'y' : `y${i + 1}`;
    const domain = [Math.max(0, top(i) - row / height), top(i)];
    layout[i === 0 ? 'yaxis' : `yaxis${i + 1}`] = axis('', { domain, fixedrange: true, nticks: 5 });
    layout.annotations.push({
      text: alone ? escaped(signal.unit) : `<b>${escaped(signal.name)}</b>, ${escaped(signal.unit)}`, showarrow: false, x: 0, xref: 'paper', xanchor: 'left', y: top(i), yref: 'paper',
      yanchor: 'bottom', font: { size: 12.5, color: colour('ink') },
    });
    for (const line of signal.lines) {
      const role = ROLES[line.role];
      const own = line.role === 'recorded' ? gaps : starts;
      data.push({
        type: 'scatter', mode: 'lines', ...thinned(time, line.y, range, width, own), connectgaps: false, xaxis: 'x', yaxis: y,
        name: role.name, legendgroup: line.role, showlegend: !named.has(line.role),
        line: { color: colour(role.colour), width: role.width, dash: role.dash ?? 'solid' },
        hoverinfo: 'none',
      });
      named.add(line.role);
    }
    for (const span of signal.spans) layout.shapes.push(...marked(span, y, [time[0], time[time.length - 1]]));
  });
  layout.xaxis = axis('time, s', { anchor: rows.length === 1 ? 'y' : `y${rows.length}`, range: [from, until], ...spikes() });
  return { data, layout };
};

// The values at an instant, each beside the name of its signal; `null` takes them away.
function values(el, t) {
  const spec = specOf(el);
  el.cursor = t;
  el.values ??= el.parentElement.appendChild(document.createElement('div'));
  el.values.className = 'values';
  el.values.setAttribute('aria-hidden', 'true');
  el.values.replaceChildren();
  if (t === null) return;
  const index = nearest(spec.time, t);
  const { _offset: left, _length: long, range } = el._fullLayout.xaxis;
  if (spec.time[index] < range[0] || spec.time[index] > range[1]) return;
  const at = el.values.appendChild(document.createElement('span'));
  at.className = 'at';
  at.textContent = `${Number(spec.time[index].toPrecision(6))} s`;
  at.style.left = `${el.offsetLeft + left + (long * (spec.time[index] - range[0])) / (range[1] - range[0])}px`;
  at.style.top = `${el.offsetTop + el._fullLayout.height - el._fullLayout.margin.b + 4}px`;
  spec.rows.forEach((signal, i) => {
    const line = el.values.appendChild(document.createElement('span'));
    line.className = 'row';
    line.style.top = `${el.offsetTop + el._fullLayout[i === 0 ? 'yaxis' : `yaxis${i + 1}`]._offset - 19}px`;
    for (const { role, y } of signal.lines) {
      const value = line.appendChild(document.createElement('b'));
      value.textContent = short(y[index]);
      value.className = role;
      value.style.color = `var(--${ROLES[role].colour})`;
    }
  });
}

function nearest(time, t) {
  const next = Math.min(firstAt(time, t), time.length - 1);
  return next > 0 && t - time[next - 1] < time[next] - t ? next - 1 : next;
}

function short(v) {
  return v === null || v === undefined ? 'gap' : String(Number(v.toPrecision(4)));
}
