//! A law of the sides' torques from the set speeds alone, and what wrong laws of the same freedom reach.
//!
//! Torque of a side `τ = S/2 (1 ± a) sgn v ± T x`, plus on the right. The scrub winds up with the distance:
//! `dx/ds = (tanh(κ/κ₀) − x)/d`, `κ` the difference over the larger of the speeds, `s` the way of the faster side; the
//! drive follows its set speeds with a lag. Unsigned currents show what drives and nothing of what brakes.

use inference::least_squares::{Constant, Loss, Residuals, Settings};
use inference::robust::rms;
use robot_model::effect::LoadTerm;

use crate::run::SpeedRun;
use crate::settings::FORECASTING;
use crate::settings::forecasting::{Bounds, LawFit, Torques};

const LAW: Torques = FORECASTING.law;
const FIT: LawFit = FORECASTING.fit;

/// Free constants of every law.
pub(crate) const CONSTANTS: usize = 6;
type Constants = [f64; CONSTANTS];

/// What may stand in the place of the turning term, with as many constants.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Law {
    /// Scrub that winds up: couple, curvature, distance.
    Turning,
    /// Loads grow with the speed: viscous, quadratic, inertia.
    Speed,
    /// Loads drift with time: linear, quadratic, and a lag.
    Drift,
    /// A constant pull and loads that differ forward and backward.
    Pull,
}

impl Law {
    /// Laws that are wrong for a robot that turns.
    pub(crate) const PLACEBOS: [Self; 3] = [Self::Speed, Self::Drift, Self::Pull];

    /// Id of the effect it stands for.
    pub(crate) fn effect(self) -> &'static str {
        catalogue::of_load_term(match self {
            Self::Turning => LoadTerm::Turning,
            Self::Speed => LoadTerm::Speed,
            Self::Drift => LoadTerm::Drift,
            Self::Pull => LoadTerm::Pull,
        })
    }
}

/// Where the fit begins, its lower and its upper bounds: straight load, scrub couple (N m), curvature, distance (m),
/// asymmetry, lag (s).
fn bounds(law: Law, usual: f64) -> [Constants; 3] {
    let Bounds { straight, couple, curvature, distance, placebo, asymmetry, lag } = FORECASTING.constants;
    std::array::from_fn(|k| {
        let [a1, a2, a3] = match law {
            Law::Turning => [couple[k] * usual, curvature[k], distance[k]],
            _ => [placebo[k] * usual; 3],
        };
        [straight[k] * usual, a1, a2, a3, asymmetry[k], lag[k]]
    })
}

/// What the sensor shows of a torque.
fn shown(torque: f64, speed: f64, magnitude_only: bool) -> f64 {
    if !magnitude_only {
        return torque;
    }
    let drives = if speed.abs() > LAW.rest { torque * speed.signum() } else { torque.abs() };
    // Soft at zero, so that a fit sees from which side it comes.
    drives.max(0.0) + LAW.soft * (-(drives / LAW.soft).abs()).exp().ln_1p()
}

/// Torques of both sides that a law gives from the set speeds, row by row.
pub(crate) fn torques(law: Law, constants: &Constants, run: &SpeedRun) -> Vec<[f64; 2]> {
    let [straight, a1, a2, a3, asymmetry, lag] = *constants;
    let Some(&first) = run.time.first() else { return Vec::new() };
    let length = (run.time[run.time.len() - 1] - first).max(1e-9);

    let mut speed = [run.speed[0][0], run.speed[1][0]];
    let (mut wound, mut before, mut then) = (0.0, speed, first);
    let mut out = Vec::with_capacity(run.time.len());
    for (i, &now) in run.time.iter().enumerate() {
        let dt = now - then;
        let follow = 1.0 - (-dt / lag).exp();
        for (j, v) in speed.iter_mut().enumerate() {
            *v += follow * (run.speed[j][i] - *v);
        }

        // Scrub winds up with the way of the faster side.
        let [l, r] = speed;
        let fastest = l.abs().max(r.abs());
        if law == Law::Turning {
            let scrub = ((r - l) / fastest.max(LAW.least_speed) / a2).tanh();
            wound += (1.0 - (-fastest * dt / a3).exp()) * (scrub - wound);
        }

        let mut row = [0.0; 2];
        for (j, side) in [(0, -1.0), (1, 1.0)] {
            let v = speed[j];
            let rolling = (v / LAW.least_speed).tanh() * 0.5 * straight * (1.0 + side * asymmetry);
            let rest = match law {
                Law::Turning => side * a1 * wound,
                Law::Speed => {
                    let rate = if dt > 0.0 { (v - before[j]) / dt } else { 0.0 };
                    a1 * v + a2 * v * v.abs() + a3 * rate
                }
                Law::Drift => {
                    let x = (now - first) / length;
                    (v / LAW.least_speed).tanh() * (a1 * x + a2 * x * x + a3 * (-LAW.decay * x).exp())
                }
                Law::Pull => a1 + a2 * side + if v > 0.0 { a3 } else { 0.0 },
            };
            row[j] = shown(rolling + rest, v, run.magnitude_only);
        }
        (before, then) = (speed, now);
        out.push(row);
    }
    out
}

/// Fits a law to the rows before `until` (soft-L1 loss, within bounds); where it starts if it has no torque there.
pub(crate) fn fit(law: Law, run: &SpeedRun, until: usize, straight: f64) -> Constants {
    let [start, low, high] = bounds(law, straight);
    let constant = |k: usize| {
        let constant = Constant::new(start[k], high[k] - low[k]).within(low[k], high[k]);
        Constant { difference: FIT.shift, ridge: FIT.ridge, ..constant }
    };
    let misfit = |x: &[f64]| -> Vec<f64> {
        let rows = torques(law, &std::array::from_fn(|k| x[k]), run);
        let moves = (0..until).filter(|&i| !run.standing[i]);
        moves.flat_map(|i| [0, 1].map(|j| rows[i][j] - recorded(run, i, j))).collect()
    };
    let settings = Settings { iterations: FIT.steps, first_damping: FIT.damping, ..Settings::default() };

    let residuals = Residuals::new((0..CONSTANTS).map(constant).collect(), misfit).with_loss(Loss::SoftL1(FIT.far_off));
    residuals.fit(&settings).map_or(start, |fitted| std::array::from_fn(|k| fitted.values[k]))
}

/// What was recorded of a side's torque at a row: a magnitude where only that is known, N m.
fn recorded(run: &SpeedRun, i: usize, side: usize) -> f64 {
    let torque = run.torque[side][i];
    if run.magnitude_only { torque.abs() } else { torque }
}

/// Root mean squared error of forecast torques over the rows from `from` at which the body moves, N m.
pub(crate) fn error(rows: &[[f64; 2]], run: &SpeedRun, from: usize) -> f64 {
    let moves = (from..run.time.len()).filter(|&i| !run.standing[i]);
    rms(moves.flat_map(|i| [0, 1].map(|j| rows[i][j] - recorded(run, i, j)))).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::Law;

    #[test]
    fn every_law_stands_for_an_effect_of_the_catalogue() {
        for law in Law::PLACEBOS.into_iter().chain([Law::Turning]) {
            assert!(catalogue::find(law.effect()).is_some_and(|entry| entry.effect.is_some()), "{law:?}");
        }
    }
}
