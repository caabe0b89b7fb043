//! What fault-free driving looks like: each reference run freely with the model calibrated on the
//! other references.

use std::sync::Arc;

use robot_model::tunable::COUNT as NUISANCES;

use crate::calibrate::of_file;
use crate::channel::{Channel, Channels};
use crate::fit::{Columns, Hypothesis, Point, Problem};
use crate::regimes::kernel_mean;
use crate::settings::locate::{FaultFreeDriving, SETTINGS};
use crate::simulate::Response;
use crate::windows::Cut;

const DRIVING: FaultFreeDriving = SETTINGS.fault_free;

/// Squared residuals over their expectation in fault-free driving: run, segment, window, channel;
/// not a number where invalid.
pub(crate) type Energy = Vec<Vec<Vec<Channels<f64>>>>;

/// A reference segment: its run, its kind of driving, ln of each channel's energy.
type Known = (usize, [f64; 3], Channels<f64>);

/// The expectation in fault-free driving, and the references seen with it.
pub(crate) struct FaultFree {
    /// Mean growth of the squared residual with the windows since the restart.
    growth: Vec<Channels<f64>>,
    known: Vec<Known>,
    /// Energy of every reference that was left out of its own calibration and expectation.
    pub(crate) energy: Energy,
}

impl FaultFree {
    /// From the references, with the calibrated constants as their centre.
    pub(crate) fn new(references: &Problem<'_>) -> Self {
        let plain = whitened(references, &left_out(references));
        let mut out = Self { growth: growth(&plain), known: Vec::new(), energy: Vec::new() };
        let grown = out.over_growth(plain);
        for (r, (cut, run)) in references.cuts.iter().zip(&grown).enumerate() {
            out.known.extend(cut.segments.iter().zip(run).map(|(s, e)| (r, s.regime, levels(e))));
        }
        out.energy = out.over_regime(references, grown, references.cuts.len() > 1);
        out
    }

    /// Energy of a response.
    pub(crate) fn energy_of(&self, problem: &Problem<'_>, response: &Response) -> Energy {
        self.over_regime(problem, self.over_growth(whitened(problem, response)), false)
    }

    fn over_growth(&self, mut energy: Energy) -> Energy {
        for segment in energy.iter_mut().flatten() {
            for (w, window) in segment.iter_mut().enumerate() {
                let Some(growth) = self.growth.get(w).or(self.growth.last()) else { continue };
                for c in Channel::ALL {
                    window[c] /= growth[c];
                }
            }
        }
        energy
    }

    /// Divides by what the references show in such driving; with `apart`, by what the other references show.
    fn over_regime(&self, problem: &Problem<'_>, mut energy: Energy, apart: bool) -> Energy {
        for (r, (cut, run)) in problem.cuts.iter().zip(&mut energy).enumerate() {
            for (segment, e) in cut.segments.iter().zip(run) {
                let expected = self.expected(segment.regime, apart.then_some(r));
                for window in e {
                    for c in Channel::ALL {
                        window[c] /= expected[c];
                    }
                }
            }
        }
        energy
    }

    /// Kernel mean of the references' levels in driving of this kind, begun with their overall mean.
    fn expected(&self, regime: [f64; 3], without: Option<usize>) -> Channels<f64> {
        let all = || self.known.iter().filter(|k| Some(k.0) != without);
        Channels::from_fn(|c| {
            let valid = || all().filter(|k| k.2[c].is_finite());
            let (n, sum) = valid().fold((0.0, 0.0), |(n, s), k| (n + 1.0, s + k.2[c]));
            let mean = sum / f64::max(n, 1.0);
            kernel_mean(valid().map(|k| (k.1, k.2[c])), regime, mean).exp()
        })
    }
}

/// ln of a segment's mean energy, channel by channel.
fn levels(segment: &[Channels<f64>]) -> Channels<f64> {
    Channels::from_fn(|c| {
        let valid = segment.iter().map(|w| w[c]).filter(|e| e.is_finite());
        let (n, sum) = valid.fold((0.0, 0.0), |(n, s), e| (n + 1.0, s + e));
        if n > 0.0 { f64::max(sum / n, DRIVING.least_energy).ln() } else { f64::NAN }
    })
}

/// Response of each reference at constants calibrated on the others. A lone reference cannot be left out.
fn left_out(references: &Problem<'_>) -> Response {
    let none = Hypothesis::default();
    let runs = references.cuts.len();
    let base = references.response(&references.origin(), &none);
    if runs < 2 {
        return base;
    }
    let columns = references.nuisance_columns(&references.origin(), &none, &base);
    (0..runs)
        .map(|out| {
            let keep = || (0..runs).filter(|&r| r != out);
            let cuts: Vec<Cut> = keep().map(|r| references.cuts[r].clone()).collect();
            let others = Problem {
                cuts: &cuts,
                regime: keep().map(|r| references.regime[r].clone()).collect(),
                information: of_file(),
                centre: [0.0; NUISANCES],
                ..references.clone()
            };
            let columns = columns.0.iter().map(|c| keep().map(|r| c[r].clone()).collect()).collect();
            let start = Point { theta: references.centre, ..others.origin() };
            let begun = others.begin(&none, start, Some(Arc::new(Columns(columns))));
            let theta = others.refine(&none, begun, DRIVING.steps, None).point.theta;
            references.run_response(out, &Point { theta, ..references.origin() }, &none)
        })
        .collect()
}

/// Squared residual of each window over variance and regime.
fn whitened(problem: &Problem<'_>, response: &Response) -> Energy {
    let of = |r: usize, s: usize| {
        let (segment, regime) = (&problem.cuts[r].segments[s], problem.regime[r][s]);
        (0..segment.windows)
            .map(|w| {
                Channels::from_fn(|c| {
                    let square = (segment.observed[w][c] - response[r][s][w][c]).powi(2);
                    if segment.valid[w][c] { square / (problem.variance[c] * regime) } else { f64::NAN }
                })
            })
            .collect()
    };
    (0..problem.cuts.len()).map(|r| (0..problem.cuts[r].segments.len()).map(|s| of(r, s)).collect()).collect()
}

/// Mean over segments by the windows since the restart, smoothed.
fn growth(energy: &Energy) -> Vec<Channels<f64>> {
    let windows = energy.iter().flatten().map(Vec::len).max().unwrap_or(0);
    let at = |w: usize, c: Channel| {
        let near = w.saturating_sub(DRIVING.smooth)..w + DRIVING.smooth + 1;
        let all = energy.iter().flatten().flat_map(|s| s.iter().take(near.end).skip(near.start));
        let (n, sum) = all.map(|e| e[c]).filter(|e| e.is_finite()).fold((0.0, 0.0), |(n, s), e| (n + 1.0, s + e));
        if n > 0.0 && sum > 0.0 { sum / n } else { 1.0 }
    };
    (0..windows).map(|w| Channels::from_fn(|c| at(w, c))).collect()
}
