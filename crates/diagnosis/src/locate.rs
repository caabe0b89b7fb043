//! Where the mismatch shows: signal, time, speed and turning.

use crate::fit::Problem;
use crate::simulate::Response;
use crate::verdict::{Cell, Finding};
use crate::windows::{CHANNEL_NAMES, CHANNELS};

/// Borders of the cells: |forward velocity| in m/s, yaw rate in rad/s.
const SPEEDS: [f64; 5] = [0.0, 0.1, 0.4, 0.8, 5.0];
const TURNS: [f64; 6] = [-10.0, -0.5, -0.1, 0.1, 0.5, 10.0];
/// Least driving in a cell that is reported, s.
const LEAST_SECONDS: f64 = 1.0;

/// Mean squared residual over the reference's for each signal, and the stretch in which it is largest.
pub(crate) fn findings(problem: &Problem<'_>, response: &Response) -> Vec<Finding> {
    let mut out: Vec<Finding> = (0..CHANNELS)
        .filter_map(|c| {
            let (mut sum, mut n) = (0.0, 0.0);
            let mut worst = (0.0, 0, 0);
            for (r, cut) in problem.cuts.iter().enumerate() {
                for (s, segment) in cut.segments.iter().enumerate() {
                    let (mut q, mut m) = (0.0, 0.0);
                    for i in (c..segment.observed.len()).step_by(CHANNELS).filter(|&i| segment.valid[i]) {
                        q += (segment.observed[i] - response[r][s][i]).powi(2) / problem.variance[c];
                        m += 1.0;
                    }
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
            let from = segment.row as f64 * cut.period;
            let length = (segment.windows * cut.rows_per_window) as f64 * cut.period;
            Some(Finding {
                signal: CHANNEL_NAMES[c].to_owned(),
                ratio: sum / n,
                recording: cut.name.clone(),
                interval: [from, from + length],
            })
        })
        .collect();
    out.sort_by(|a, b| b.ratio.total_cmp(&a.ratio));
    out
}

/// Mismatch of the wheel speeds and the yaw rate by speed and turning.
pub(crate) fn cells(problem: &Problem<'_>, response: &Response) -> Vec<Cell> {
    let mut sum = [[(0.0, 0.0); TURNS.len() - 1]; SPEEDS.len() - 1];
    let mut window = 0.1;
    for (r, cut) in problem.cuts.iter().enumerate() {
        window = cut.rows_per_window as f64 * cut.period;
        for (s, segment) in cut.segments.iter().enumerate() {
            for w in 0..segment.windows {
                let at = |c: usize| w * CHANNELS + c;
                let speed = if segment.valid[at(3)] { segment.observed[at(3)].abs() } else { continue };
                let turn = if segment.valid[at(2)] { segment.observed[at(2)] } else { continue };
                let place = |edges: &[f64], v: f64| edges.windows(2).position(|e| v >= e[0] && v < e[1]);
                let (Some(i), Some(j)) = (place(&SPEEDS, speed), place(&TURNS, turn)) else { continue };
                let mut q = 0.0;
                for c in 0..3 {
                    q += (segment.observed[at(c)] - response[r][s][at(c)]).powi(2) / problem.variance[c] / 3.0;
                }
                sum[i][j].0 += q;
                sum[i][j].1 += 1.0;
            }
        }
    }
    let mut out = Vec::new();
    for (i, row) in sum.iter().enumerate() {
        for (j, &(q, n)) in row.iter().enumerate() {
            let seconds = n * window;
            if seconds >= LEAST_SECONDS {
                out.push(Cell {
                    speed: [SPEEDS[i], SPEEDS[i + 1]],
                    turning: [TURNS[j], TURNS[j + 1]],
                    seconds,
                    ratio: q / n,
                });
            }
        }
    }
    out
}

/// Root mean squared residual of the wheel speeds and of the yaw rate of one run.
pub(crate) fn rms(problem: &Problem<'_>, response: &Response, run: usize) -> [f64; 2] {
    let mut sum = [(0.0, 0.0); 2];
    for (s, segment) in problem.cuts[run].segments.iter().enumerate() {
        for (i, (o, p)) in segment.observed.iter().zip(&response[run][s]).enumerate().filter(|(i, _)| segment.valid[*i])
        {
            let slot = match i % CHANNELS {
                0 | 1 => &mut sum[0],
                2 => &mut sum[1],
                _ => continue,
            };
            slot.0 += (o - p).powi(2);
            slot.1 += 1.0;
        }
    }
    sum.map(|(q, n): (f64, f64)| (q / n.max(1.0)).sqrt())
}
