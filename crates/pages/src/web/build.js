'use strict';
// From what a chart says (the JSON beside it) to what plotly.js draws.
const ROLES = {
  recorded: { name: 'recorded', colour: 'recorded', width: 2.6 },
  before: { name: 'simulated as it is', colour: 'before', width: 1.6 },
  retuned: { name: 're-tuned only', colour: 'retuned', width: 1.2, dash: 'dot' },
  after: { name: 'corrected', colour: 'after', width: 1.6 },
  placebo: { name: 'placebo: best other effect', colour: 'placebo', width: 1.2 },
};
const SERIES = 7;
const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "DejaVu Sans", sans-serif';

function base(height) {
  return {
    height, paper_bgcolor: 'rgba(0,0,0,0)', plot_bgcolor: 'rgba(0,0,0,0)',
    font: { family: FONT, size: 12.5, color: colour('ink') },
    margin: { l: 52, r: 10, t: 8, b: 44 },
    hoverlabel: { bgcolor: colour('paper'), bordercolor: colour('soft'), font: { family: FONT, size: 12.5, color: colour('ink') } },
    legend: { orientation: 'h', x: 0, xanchor: 'left', y: 1, yanchor: 'bottom', font: { size: 12.5 }, itemclick: 'toggle', bgcolor: 'rgba(0,0,0,0)' },
    dragmode: coarse.matches ? false : 'zoom', uirevision: 'kept',
  };
}

const coarse = matchMedia('(pointer: coarse)');

function axis(title, more) {
  return {
    title: { text: title, standoff: 8, font: { size: 12.5, color: colour('soft') } },
    tickfont: { color: colour('soft') }, gridcolor: colour('grid'), linecolor: colour('line'), zeroline: false,
    automargin: true, ...more,
  };
}

// The scale of mismatch is logarithmic, and its ends are the same on all pages: as usual, a thousand times that.
function mismatchScale() {
  return {
    cmin: 0, cmax: 3, colorscale: [0, 1, 2, 3].map(i => [i / 3, colour(`mismatch-${i}`)]),
    colorbar: {
      orientation: 'h', x: 0, xanchor: 'left', y: 1.02, yanchor: 'bottom', len: 0.6, thickness: 9, outlinewidth: 0,
      tickvals: [0, 1, 2, 3], ticktext: ['as usual', '10 ×', '100 ×', '1000 ×'], tickfont: { size: 11.5, color: colour('soft') },
    },
  };
}

const logarithm = v => (v === null ? null : Math.log10(Math.max(v, 1)));
const times = v => `${Number(v.toPrecision(3))} ×`;

const BUILD = {
  lines(spec) {
    const marked = new Set();
    const data = spec.lines.map((line, i) => {
      const role = ROLES[line.role];
      const c = colour(role ? role.colour : `series-${i % SERIES}`);
      marked.add(line.name);
      return {
        type: 'scatter', mode: line.intervals.length ? 'markers' : 'lines', name: escaped(line.name), x: spec.x[line.x], y: line.y, connectgaps: false,
        error_y: {
          type: 'data', symmetric: false, visible: line.intervals.length > 0, color: c, thickness: 1.4, width: 4,
          array: line.intervals.map((v, k) => v[1] - line.y[k]), arrayminus: line.intervals.map((v, k) => line.y[k] - v[0]),
        },
        marker: { color: c, size: 9 }, line: { color: c, width: 1.6, dash: line.dashed ? 'dash' : 'solid' },
      };
    });
    const layout = base(spec.equal ? 400 : 320);
    layout.hovermode = spec.equal ? 'closest' : 'x unified';
    layout.showlegend = marked.size > 1;
    layout.margin.t = 30;
    layout.xaxis = axis(spec.equal ? '' : escaped(spec.x_label), spec.equal ? {} : spikes());
    layout.yaxis = axis(spec.equal ? '' : escaped(spec.y_label), spec.equal ? { scaleanchor: 'x' } : {});
    layout.annotations = spec.equal ? corners(escaped(spec.x_label), escaped(spec.y_label)) : [];
    layout.annotations.push(... spec.marks.map(([x, y, text]) => ({ x, y, text: escaped(text), arrowsize: 0.6, arrowcolor: colour('soft') })));
    return { data, layout };
  },

  bars(spec) {
    const bars = spec.bars.map(b => ({ ...b, role: ROLES[b.role] }));
    const dots = spec.recordings.length < 2 ? [] : bars.map(b => ({
      type: 'scatter', mode: 'markers', x: b.each, y: b.each.map(() => b.role.name), showlegend: false,
      text: spec.recordings.map(escaped), hovertemplate: `%{text}: %{x:.4~g} ${escaped(spec.unit)}<extra></extra>`,
      marker: { color: colour('paper'), size: 6, line: { color: colour('ink'), width: 1.1 } },
    }));
    const most = Math.max(...bars.flatMap(b => [b.value, ...b.each]));
    const data = [{
      type: 'bar', orientation: 'h', x: bars.map(b => b.value), y: bars.map(b => b.role.name), showlegend: false, width: 0.62,
      marker: { color: bars.map(b => colour(b.role.colour)) }, hovertemplate: `mean: %{x:.4~g} ${escaped(spec.unit)}<extra></extra>`,
    }, ...dots];
    const layout = base(58 + 40 * bars.length);
    layout.margin.r = 64;
    layout.hovermode = 'closest';
    layout.dragmode = false;
    layout.xaxis = axis(escaped(spec.unit), { rangemode: 'tozero', fixedrange: true, nticks: 5, range: [0, 1.04 * most] });
    layout.yaxis = axis('', { autorange: 'reversed', fixedrange: true, tickfont: { color: colour('ink') }, ticklabelstandoff: 6 });
    layout.annotations = bars.map(b => ({
      x: 1, xref: 'paper', xanchor: 'left', xshift: 8, y: b.role.name, text: Number(b.value.toPrecision(3)).toString(),
      showarrow: false, font: { size: 13, color: colour('ink') },
    }));
    return { data, layout };
  },

  intervals(spec, view, width) {
    // Where there is no room beside the values, their names stand above them.
    const narrow = width < 560;
    const y = spec.rows.map((_, i) => i);
    const data = [{
      type: 'scatter', mode: 'markers', x: spec.rows.map(r => r.value), y, showlegend: false,
      error_x: {
        type: 'data', symmetric: false, array: spec.rows.map(r => r.high - r.value), arrayminus: spec.rows.map(r => r.value - r.low),
        color: colour('before'), thickness: 1.8, width: 4,
      },
      marker: { color: spec.rows.map(r => colour(r.stands_out ? 'before' : 'placebo')), size: 9 },
      text: spec.rows.map(r => escaped(`${r.name}: ${r.value} [${r.low}, ${r.high}]`)), hovertemplate: '%{text}<extra></extra>',
    }];
    const layout = base(70 + (narrow ? 44 : 27) * spec.rows.length);
    layout.hovermode = 'closest';
    layout.dragmode = false;
    if (narrow) layout.margin.l = 10;
    layout.xaxis = axis(escaped(spec.x), { fixedrange: true });
    layout.yaxis = axis('', {
      autorange: false, range: [spec.rows.length - 0.5, narrow ? -0.8 : -0.5], fixedrange: true, tickvals: y, showgrid: !narrow,
      ticktext: spec.rows.map(r => escaped(r.name)), showticklabels: !narrow, tickfont: { color: colour('ink') }, ticklabelstandoff: 6,
    });
    layout.annotations = !narrow ? [] : spec.rows.map((r, i) => ({
      text: escaped(r.name), x: 0, xref: 'paper', xanchor: 'left', y: i, yanchor: 'bottom', yshift: 5, showarrow: false, bgcolor: colour('paper'),
      font: { size: 12.5, color: colour('ink') },
    }));
    layout.shapes = [{ type: 'line', xref: 'x', x0: spec.neutral, x1: spec.neutral, yref: 'paper', y0: 0, y1: 1, line: { color: colour('soft'), width: 1, dash: 'dash' } }];
    return { data, layout };
  },

  timeline(spec) {
    // A little room between recordings.
    let at = -1;
    const heights = spec.lanes.map((l, i) => (at += i > 0 && l.recording !== spec.lanes[i - 1].recording ? 1.6 : 1));
    const name = (l, i) => (i === 0 || l.recording !== spec.lanes[i - 1].recording ? `<b>${escaped(l.recording)}</b>   ` : '') + escaped(l.signal);
    const bars = spec.lanes.flatMap((l, i) => l.spans.map(s => ({ ...s, lane: heights[i] })));
    const bar = (list, c, width, hover) => ({
      type: 'bar', orientation: 'h', base: list.map(b => b.from), x: list.map(b => b.until - b.from), y: list.map(b => b.lane), width,
      showlegend: false, marker: { color: c, line: { width: 0 } }, ...hover,
    });
    const whole = spec.lanes.map((l, i) => ({ from: 0, until: l.length, lane: heights[i] }));
    const data = [
      bar(whole, colour('grid'), 0.42, { hoverinfo: 'skip' }),
      bar(bars, bars.map(b => colour(b.role)), 0.42, { text: bars.map(b => escaped(b.text)), textposition: 'none', hovertemplate: '%{text}<extra></extra>' }),
    ];
    const layout = base(60 + 19 * (at + 1));
    layout.barmode = 'overlay';
    layout.hovermode = 'closest';
    layout.xaxis = axis('time, s', { rangemode: 'tozero' });
    layout.yaxis = axis('', {
      range: [at + 0.7, -0.7], autorange: false, fixedrange: true, tickvals: heights, ticktext: spec.lanes.map(name),
      tickfont: { color: colour('ink'), size: 12 }, showgrid: false, ticklabelstandoff: 6,
    });
    return { data, layout };
  },

  map(spec) {
    const scale = mismatchScale();
    const at = (list, row, column) => list[row * (spec.x_edges.length - 1) + column];
    const grid = f => spec.y_edges.slice(1).map((_, r) => spec.x_edges.slice(1).map((_, c) => f(r, c)));
    const z = grid((r, c) => logarithm(at(spec.values, r, c)));
    const text = grid((r, c) => {
      const v = at(spec.values, r, c);
      if (v === null) return '';
      const range = (edges, i) => `${Number(edges[i].toPrecision(3))} to ${Number(edges[i + 1].toPrecision(3))}`;
      return `${escaped(spec.x)}: ${range(spec.x_edges, c)}<br>${escaped(spec.y)}: ${range(spec.y_edges, r)}<br>` +
        `mismatch ${times(v)} the usual, ${Number(at(spec.seconds, r, c).toPrecision(3))} s`;
    });
    const data = [{
      type: 'heatmap', x: spec.x_edges, y: spec.y_edges, z, text, hovertemplate: '%{text}<extra></extra>', hoverongaps: false,
      zmin: scale.cmin, zmax: scale.cmax, colorscale: scale.colorscale, colorbar: scale.colorbar, xgap: 2, ygap: 2,
    }];
    const layout = base(400);
    layout.margin.t = 40;
    layout.xaxis = axis(escaped(spec.x), { fixedrange: true });
    layout.yaxis = axis(escaped(spec.y), { fixedrange: true });
    layout.dragmode = false;
    return { data, layout };
  },

  path(spec) {
    const scale = mismatchScale();
    const data = spec.runs.map((run, i) => ({
      type: 'scatter', mode: 'markers', x: run.path.map(p => p[0]), y: run.path.map(p => p[1]),
      showlegend: false, text: run.path.map((p, k) => `${escaped(run.name)}, ${Number(run.time[k].toPrecision(4))} s` +
        (run.value[k] === null ? '' : `<br>mismatch ${times(run.value[k])} the usual`)),
      hovertemplate: '%{text}<extra></extra>',
      marker: {
        size: 5, color: run.value.map(v => logarithm(v) ?? 0), cmin: scale.cmin, cmax: scale.cmax, colorscale: scale.colorscale,
        showscale: i === 0, colorbar: scale.colorbar,
      },
    }));
    data.push({
      type: 'scatter', mode: 'markers', x: [], y: [], showlegend: false, hoverinfo: 'skip',
      marker: { size: 15, color: 'rgba(0,0,0,0)', line: { color: colour('ink'), width: 2.5 } },
    });
    const layout = base(440);
    layout.margin.t = 40;
    layout.hovermode = 'closest';
    layout.xaxis = axis('');
    layout.yaxis = axis('', { scaleanchor: 'x' });
    layout.annotations = corners('x, m', 'y, m');
    layout.shapes = spec.discs.map(([x, y, r]) => ({
      type: 'circle', xref: 'x', yref: 'y', x0: x - r, x1: x + r, y0: y - r, y1: y + r, layer: 'below',
      line: { color: colour('ink'), width: 1.5, dash: 'dash' }, fillcolor: colour('band'),
    }));
    return { data, layout };
  },
};

// Names of axes inside the plot: with equal scales plotly.js finds no good place for them outside.
function corners(x, y) {
  const corner = { xref: 'paper', yref: 'paper', showarrow: false, font: { size: 12.5, color: colour('soft') } };
  return [{ ...corner, text: x, x: 1, xanchor: 'right', y: 0, yanchor: 'bottom' }, { ...corner, text: y, x: 0, xanchor: 'left', y: 1, yanchor: 'top' }];
}

function spikes() {
  return { showspikes: true, spikemode: 'across', spikesnap: 'data', spikecolor: colour('soft'), spikethickness: 1, spikedash: 'solid' };
}

// plotly.js reads a little markup in texts: names must not be any.
function escaped(text) {
  return String(text).replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;');
}
