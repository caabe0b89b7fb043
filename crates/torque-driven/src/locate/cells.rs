//! Where in speed, turning, slip, heading and on the ground the mismatch shows.

use std::collections::BTreeMap;

use inference::robust::discoveries;

use crate::channel::{Channel, Channels};
use crate::fit::Problem;
use crate::locate::compare::{Block, null_of, probability};
use crate::locate::fault_free::{Energy, FaultFree};
use crate::settings::locate::{Cells, SETTINGS};
use crate::windows::WINDOW;
use verdict::{Cell, Finding};

const CELLS: Cells = SETTINGS.cells;

/// What a cell is a range of, with its unit.
const AXES: [(&str, &str); 5] =
    [("speed", "m/s"), ("turning", "rad/s"), ("slip", "m/s"), ("heading", "rad"), ("place", "m")];

/// Axis and place on it.
type Key = (usize, i32, i32);
type Blocks = BTreeMap<Key, Vec<Block>>;

/// The cells that a window lies in.
fn keys(problem: &Problem<'_>, run: usize, segment: usize, window: usize, edge: f64) -> Vec<Key> {
    let cut = &problem.cuts[run];
    let s = &cut.segments[segment];
    let get = |c: Channel| s.valid[window][c].then(|| s.observed[window][c]);
    let bin = |edges: &[f64], v: f64| {
        edges.windows(2).position(|e| v >= e[0] && v < e[1]).and_then(|i| i32::try_from(i).ok())
    };
    let [left, right] = Channel::WHEELS.map(get);
    let (turn, speed) = (get(Channel::YawRate), get(Channel::ForwardVelocity));
    let mut out = Vec::with_capacity(AXES.len());
    out.extend(speed.and_then(|v| bin(&CELLS.speeds, v.abs())).map(|i| (0, i, 0)));
    out.extend(turn.and_then(|w| bin(&CELLS.turns, w)).map(|i| (1, i, 0)));
    if let (Some(l), Some(r), Some(w), Some(v)) = (left, right, turn, speed) {
        let (radius, half) = (problem.robot.wheel_radius, problem.robot.half_track);
        let slip = (l * radius - v + w * half).abs().max((r * radius - v - w * half).abs());
        out.extend(bin(&CELLS.slips, slip).map(|i| (2, i, 0)));
    }
    // Without a pose neither heading nor place is known.
    if let (Some(_), Some([x, y, yaw])) = (speed, cut.path.get(s.row / cut.rows_per_window.max(1) + window)) {
        let turns = yaw.rem_euclid(std::f64::consts::TAU) / std::f64::consts::TAU;
        let sector = (turns * f64::from(CELLS.sectors)) as i32;
        out.push((3, sector.min(CELLS.sectors - 1), 0));
        out.push((4, (x / edge).floor() as i32, (y / edge).floor() as i32));
    }
    out
}

/// Edge of a cell on the ground: the smallest that keeps the driven ground coarse, m.
fn edge(problem: &Problem<'_>) -> f64 {
    let extent = |i: usize| {
        let path = || problem.cuts.iter().flat_map(|c| &c.path).map(|p| p[i]);
        path().fold(f64::MIN, f64::max) - path().fold(f64::MAX, f64::min)
    };
    let longest = extent(0).max(extent(1));
    CELLS.edges.into_iter().find(|e| longest / e <= CELLS.ground).unwrap_or(CELLS.longest_edge)
}

/// Each segment's mean energy in every cell that it crosses.
fn blocks(problem: &Problem<'_>, energy: &Energy, edge: f64) -> Blocks {
    let mut out = Blocks::new();
    for (r, run) in energy.iter().enumerate() {
        for (s, segment) in run.iter().enumerate() {
            let mut sums: BTreeMap<Key, (f64, usize)> = BTreeMap::new();
            for (w, window) in segment.iter().enumerate() {
                let (n, sum) = window.iter().filter(|e| e.is_finite()).fold((0.0, 0.0), |(n, s), e| (n + 1.0, s + e));
                if n == 0.0 {
                    continue;
                }
                for key in keys(problem, r, s, w, edge) {
                    let slot = sums.entry(key).or_default();
                    slot.0 += sum / n;
                    slot.1 += 1;
                }
            }
            for (key, (sum, windows)) in sums.into_iter().filter(|(_, s)| s.1 >= CELLS.least_windows) {
                out.entry(key).or_default().push(Block { run: r, windows, energy: sum / windows as f64 });
            }
        }
    }
    out
}

fn range((axis, i, j): Key, edge: f64) -> Vec<[f64; 2]> {
    let of = |edges: &[f64]| vec![[edges[i as usize], edges[i as usize + 1]]];
    let cell = |k: i32| [f64::from(k) * edge, f64::from(k + 1) * edge];
    let sector = std::f64::consts::TAU / f64::from(CELLS.sectors);
    match axis {
        0 => of(&CELLS.speeds),
        1 => of(&CELLS.turns),
        2 => of(&CELLS.slips),
        3 => vec![[f64::from(i) * sector, f64::from(i + 1) * sector]],
        _ => vec![cell(i), cell(j)],
    }
}

/// Mismatch of every cell with enough driving, those that stand out from the references marked.
pub(crate) fn cells(
    problem: &Problem<'_>,
    references: &Problem<'_>,
    energy: &Energy,
    fault_free: &FaultFree,
) -> Vec<Cell> {
    let edge = edge(problem);
    let (own, known) = (blocks(problem, energy, edge), blocks(references, &fault_free.energy, edge));
    let window = problem.cuts.first().map_or(WINDOW, |c| c.rows_per_window as f64 * c.period);
    let nulls: Vec<_> =
        (0..AXES.len()).map(|axis| null_of(known.iter().filter(|(k, _)| k.0 == axis).flat_map(|(_, b)| b))).collect();

    let mut out = Vec::new();
    for (&key, blocks) in &own {
        let Some(null) = &nulls[key.0] else { continue };
        let windows: usize = blocks.iter().map(|b| b.windows).sum();
        let seconds = windows as f64 * window;
        if seconds < CELLS.least_seconds {
            continue;
        }
        let (by, unit) = AXES[key.0];
        out.push(Cell {
            by: by.into(),
            unit: unit.into(),
            range: range(key, edge),
            seconds,
            ratio: blocks.iter().map(|b| b.energy * b.windows as f64).sum::<f64>() / windows as f64,
            p: probability(blocks, known.get(&key).map_or(&[], Vec::as_slice), null),
            significant: false,
        });
    }

    let p: Vec<f64> = out.iter().map(|c| c.p).collect();
    for (cell, significant) in out.iter_mut().zip(discoveries(&p, SETTINGS.levels.discoveries)) {
        cell.significant = significant;
    }
    out
}

/// Mean energy of a channel in every segment.
fn channel_blocks(energy: &Energy, c: Channel) -> Vec<Block> {
    let block = |run: usize, segment: &Vec<Channels<f64>>| {
        let valid = || segment.iter().map(|w| w[c]).filter(|e| e.is_finite());
        let windows = valid().count();
        (windows >= CELLS.least_windows).then(|| Block { run, windows, energy: valid().sum::<f64>() / windows as f64 })
    };
    energy.iter().enumerate().flat_map(|(r, run)| run.iter().filter_map(move |s| block(r, s))).collect()
}

/// Probability of each channel's level on fault-free drives; `None` where there is nothing to compare.
pub(crate) fn channel_probabilities(energy: &Energy, fault_free: &FaultFree) -> Channels<Option<f64>> {
    Channels::from_fn(|c| {
        let known = channel_blocks(&fault_free.energy, c);
        let own = channel_blocks(energy, c);
        null_of(known.iter()).filter(|_| !own.is_empty()).map(|null| probability(&own, &known, &null))
    })
}

/// Mean squared residual over the references' for each signal, and the stretch in which it is largest.
pub(crate) fn findings(problem: &Problem<'_>, energy: &Energy, probabilities: &Channels<Option<f64>>) -> Vec<Finding> {
    let of = |c: Channel| finding(problem, energy, c, probabilities[c]);
    let mut out: Vec<Finding> = Channel::ALL.into_iter().filter_map(of).collect();
    let p: Vec<f64> = out.iter().map(|f| f.p).collect();
    for (finding, significant) in out.iter_mut().zip(discoveries(&p, SETTINGS.levels.discoveries)) {
        finding.significant = significant;
    }
    out.sort_by(|a, b| b.ratio.total_cmp(&a.ratio));
    out
}

fn finding(problem: &Problem<'_>, energy: &Energy, c: Channel, p: Option<f64>) -> Option<Finding> {
    let (mut sum, mut n) = (0.0, 0.0);
    let mut worst = (0.0, 0, 0);
    for (r, run) in energy.iter().enumerate() {
        for (s, segment) in run.iter().enumerate() {
            let valid = || segment.iter().map(|w| w[c]).filter(|e| e.is_finite());
            let (q, m) = (valid().sum::<f64>(), valid().count() as f64);
            sum += q;
            n += m;
            if m > 0.0 && q / m > worst.0 {
                worst = (q / m, r, s);
            }
        }
    }
    if n == 0.0 {
        return None;
    }
    let cut = &problem.cuts[worst.1];
    let segment = &cut.segments[worst.2];
    let from = cut.time(segment.row as f64);
    let length = (segment.windows * cut.rows_per_window) as f64 * cut.period;
    Some(Finding {
        signal: c.name().to_owned(),
        side: c.side().map(|side| inference::words::side(side).into()),
        ratio: sum / n,
        recording: cut.name.clone(),
        interval: [from, from + length],
        p: p.unwrap_or(1.0),
        significant: false,
    })
}
