//! What an arbitrary input, another number in every window, would have been: linear Gaussian, recording by recording.
//!
//! With `y = Q x + P u + noise` in every segment, `x` the constants and what a recording has to itself, `u` the input in each of
//! the windows that may have one, `u ~ N(0, s²)`: `u` is eliminated segment by segment, then `x` (Schur complements). Weights are those of the fit.

use faer::Mat;
use inference::algebra::{inverse_spd, solve_spd};
use law::Input;
use rayon::prelude::*;
use robot_model::tunable::COUNT as NUISANCES;

use super::acting::Inputs;
use super::operator::{Operator, usual};
use crate::channel::Channel;
use crate::fit::{Fitted, Problem};
use crate::run_numbers::RunNumber;
use crate::simulate::Response;

/// Normal equations of a segment.
struct Segment {
    /// Of the inputs: by input, then window.
    inputs: Mat<f64>,
    /// Inputs with `x`.
    cross: Mat<f64>,
    right: Mat<f64>,
}

/// Normal equations of a recording.
struct Recording {
    /// Of `x`, with its prior.
    own: Mat<f64>,
    right: Mat<f64>,
    segments: Vec<Segment>,
    /// Evidence of no input, nats.
    none: f64,
}

/// Inputs in windows of the segments of every recording, in usual sizes, not yet solved.
pub(crate) struct Series {
    recordings: Vec<Recording>,
    inputs: usize,
    /// Windows of each segment of each recording.
    windows: Vec<Vec<usize>>,
}

/// Which windows may have an input: by recording, segment, and index in it.
pub(crate) type Kept = Vec<Vec<Vec<usize>>>;

/// A series as the recordings have it.
pub(crate) struct Solved {
    /// Log Bayes factor over no input, nats.
    pub(crate) evidence: f64,
    /// What is common to all windows of a recording, `x`.
    own: Vec<Mat<f64>>,
    /// Mean and sigma of each window that may have an input, in the order of [`Kept`], in usual sizes.
    pub(crate) values: Vec<Vec<Vec<[f64; 2]>>>,
}

/// A free run with inputs in the windows of a series.
pub(crate) struct Seen<'a> {
    /// What it shows.
    pub(crate) response: &'a Response,
    /// Its inputs.
    pub(crate) inputs: &'a Inputs,
}

/// What the equations of a series are made of.
pub(crate) struct Ground<'a> {
    pub(crate) problem: &'a Problem<'a>,
    /// A point without any effect.
    pub(crate) base: &'a Fitted,
    pub(crate) operator: &'a Operator,
}

impl Series {
    /// About a free run with inputs, or else without any. `None` where its equations have no solution.
    pub(crate) fn new(ground: &Ground<'_>, inputs: &[Input], seen: Option<&Seen<'_>>) -> Option<Self> {
        let problem = ground.problem;
        let of = |run: usize| recording(ground, inputs, seen, run);
        let recordings = (0..problem.cuts.len()).into_par_iter().map(of).collect::<Option<Vec<_>>>()?;
        let windows = problem.cuts.iter().map(|c| c.segments.iter().map(|s| s.windows).collect()).collect();
        Some(Self { recordings, inputs: inputs.len(), windows })
    }

    /// Every window of every input.
    pub(crate) fn everywhere(&self) -> Kept {
        let all = |windows: &usize| (0..windows * self.inputs).collect();
        self.windows.iter().map(|run| run.iter().map(all).collect()).collect()
    }

    /// Input and window of an index within a segment.
    pub(crate) fn place(&self, run: usize, segment: usize, index: usize) -> (usize, usize) {
        let windows = self.windows[run][segment].max(1);
        (index / windows, index % windows)
    }

    /// With inputs in these windows, of this usual size.
    pub(crate) fn solve(&self, kept: &Kept, size: f64) -> Option<Solved> {
        let all = self.recordings.par_iter().zip(kept).map(|(r, kept)| r.solve(kept, size));
        let all = all.collect::<Option<Vec<_>>>()?;
        let evidence = all.iter().map(|(evidence, ..)| evidence).sum();
        let (own, values) = all.into_iter().map(|(_, own, values)| (own, values)).unzip();
        Some(Solved { evidence, own, values })
    }

    /// The windows that earn an input of this usual size, one after another while the best is worth more than `price`, with `x`
    /// as solved.
    pub(crate) fn greedy(&self, solved: &Solved, size: f64, price: f64) -> Option<Kept> {
        let of_recording = |(r, x): (&Recording, &Mat<f64>)| {
            r.segments.iter().map(|s| s.greedy(x, size.powi(-2), price)).collect::<Option<Vec<_>>>()
        };
        self.recordings.iter().zip(&solved.own).map(of_recording).collect()
    }
}

impl Segment {
    fn greedy(&self, x: &Mat<f64>, precision: f64, price: f64) -> Option<Vec<usize>> {
        let right = &self.right - &self.cross * x;
        let n = right.nrows();
        let mut kept: Vec<usize> = Vec::new();
        while kept.len() < n {
            let k = kept.len();
            let own = Mat::from_fn(k, k, |i, j| self.inputs[(kept[i], kept[j])] + if i == j { precision } else { 0.0 });
            let sides =
                Mat::from_fn(k, n + 1, |i, j| if j == n { right[(kept[i], 0)] } else { self.inputs[(kept[i], j)] });
            let solved = if k == 0 { Mat::zeros(0, n + 1) } else { solve_spd(&own, &sides)?.0 };
            let gain = |j: usize| {
                let through = |column: usize| (0..k).map(|i| sides[(i, j)] * solved[(i, column)]).sum::<f64>();
                let stiff = (self.inputs[(j, j)] - through(j)).max(0.0) + precision;
                let pull = right[(j, 0)] - through(n);
                0.5 * (pull * pull / stiff - (stiff / precision).ln())
            };
            let open = (0..n).filter(|j| !kept.contains(j));
            let best = open.map(|j| (gain(j), j)).max_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, j)) = best.filter(|(gain, _)| *gain > price) else { break };
            kept.push(j);
        }
        kept.sort_unstable();
        Some(kept)
    }
}

/// A recording as it was solved: evidence, `x`, and the inputs by segment.
type OfRecording = (f64, Mat<f64>, Vec<Vec<[f64; 2]>>);

impl Recording {
    fn solve(&self, kept: &[Vec<usize>], size: f64) -> Option<OfRecording> {
        let (n, precision) = (self.own.nrows(), size.powi(-2));
        let (mut own, mut right) = (self.own.clone(), self.right.clone());
        let mut evidence = -self.none;
        let mut solved = Vec::with_capacity(kept.len());
        for (segment, kept) in self.segments.iter().zip(kept) {
            let k = kept.len();
            if k == 0 {
                solved.push(None);
                continue;
            }
            let inputs =
                Mat::from_fn(k, k, |i, j| segment.inputs[(kept[i], kept[j])] + if i == j { precision } else { 0.0 });
            // Of x, of the residual, and the inverse, at once.
            let sides = Mat::from_fn(k, n + 1 + k, |i, j| match j.checked_sub(n) {
                None => segment.cross[(kept[i], j)],
                Some(0) => segment.right[(kept[i], 0)],
                Some(j) => f64::from(i + 1 == j),
            });
            let (x, log_determinant) = solve_spd(&inputs, &sides)?;
            let cross = sides.subcols(0, n);
            own -= cross.transpose() * x.subcols(0, n);
            right -= cross.transpose() * x.subcols(n, 1);
            let pulled: f64 = (0..k).map(|i| segment.right[(kept[i], 0)] * x[(i, n)]).sum();
            evidence += 0.5 * (pulled - log_determinant + k as f64 * precision.ln());
            solved.push(Some(x));
        }
        let (mean, log_determinant) = solve_spd(&own, &right)?;
        let pulled: f64 = (0..n).map(|i| right[(i, 0)] * mean[(i, 0)]).sum();
        evidence += 0.5 * (pulled - log_determinant);

        let covariance = inverse_spd(&own)?;
        let of_segment = |x: &Option<Mat<f64>>| {
            let Some(x) = x else { return Vec::new() };
            let cross = x.subcols(0, n);
            let (moved, spread) = (cross * &mean, cross * &covariance);
            let value = |i: usize| {
                let shared: f64 = (0..n).map(|j| spread[(i, j)] * x[(i, j)]).sum();
                [x[(i, n)] - moved[(i, 0)], (x[(i, n + 1 + i)] + shared).max(0.0).sqrt()]
            };
            (0..x.nrows()).map(value).collect()
        };
        let values = solved.iter().map(of_segment).collect();
        Some((evidence, mean, values))
    }
}

/// Normal equations of one recording.
fn recording(ground: &Ground<'_>, inputs: &[Input], seen: Option<&Seen<'_>>, run: usize) -> Option<Recording> {
    let &Ground { problem, base, operator } = ground;
    let n = NUISANCES + RunNumber::ALL.len();
    let mut own = Mat::zeros(n, n);
    for i in 0..NUISANCES {
        for j in 0..NUISANCES {
            own[(i, j)] = problem.information[(i, j)];
        }
    }
    (NUISANCES..n).for_each(|i| own[(i, i)] = 1.0);
    let mut right = Mat::zeros(n, 1);
    let root = problem.variance.map(|v| 1.0 / v.sqrt());
    let units: Vec<f64> = inputs.iter().map(|input| usual(problem, *input)).collect();

    let mut segments = Vec::new();
    for (s, segment) in problem.cuts[run].segments.iter().enumerate() {
        let simulated = &seen.map_or(&base.response, |seen| seen.response)[run][s];
        // What the inputs of that free run do, by the responses that the equations hold.
        let done = seen.map(|seen| operator.segment(seen.inputs, run, s));
        let done = |w: usize, channel: Channel| done.as_ref().map_or(0.0, |y| y[w][channel]);
        let weight = problem.weight(run, s, problem.q(run, s, simulated)).sqrt();
        let rows: Vec<(usize, Channel)> = (0..segment.windows)
            .flat_map(|w| Channel::ALL.map(|channel| (w, channel)))
            .filter(|&(w, channel)| segment.valid[w][channel])
            .collect();
        let column = |value: &dyn Fn(usize, Channel) -> f64| -> Vec<f64> {
            rows.iter().map(|&(w, channel)| value(w, channel) * root[channel] * weight).collect()
        };
        let mut x: Vec<Vec<f64>> =
            base.columns.0.iter().map(|theta| column(&|w, channel| theta[run][s][w][channel])).collect();
        for number in RunNumber::ALL {
            x.push(match number {
                RunNumber::Constant { place, .. } => {
                    let scale = problem.run_scale(number);
                    x[place].iter().map(|v| v * scale).collect()
                }
                RunNumber::Offset { channel: shifted, sigma } => {
                    column(&|_, channel| if channel == shifted { sigma } else { 0.0 })
                }
            });
        }
        let mut p: Vec<Vec<f64>> = Vec::new();
        for (input, unit) in inputs.iter().zip(&units) {
            let pulses = operator.pulses(*input)?;
            let of = |j: usize| column(&|w, channel| unit * pulses[j][run][s][w][channel]);
            p.extend((0..segment.windows).map(of));
        }
        let residual =
            vec![column(&|w, channel| segment.observed[w][channel] - simulated[w][channel] + done(w, channel))];

        let matrix = |all: &[Vec<f64>]| Mat::from_fn(rows.len(), all.len(), |i, j| all[j][i]);
        let (x, p, residual) = (matrix(&x), matrix(&p), matrix(&residual));
        own += x.transpose() * &x;
        right += x.transpose() * &residual;
        segments.push(Segment {
            inputs: p.transpose() * &p,
            cross: p.transpose() * &x,
            right: p.transpose() * &residual,
        });
    }
    let (mean, log_determinant) = solve_spd(&own, &right)?;
    let pulled: f64 = (0..n).map(|i| right[(i, 0)] * mean[(i, 0)]).sum();
    Some(Recording { own, right, segments, none: 0.5 * (pulled - log_determinant) })
}
