//! Command to wheel: dead time, gains, limits that hold both sides together, ramps, lag.
//!
//! A skid-steer controller takes forward speed v and turning d, here half of sum and of difference of the commanded
//! wheel speeds (rad/s), limits them and their rates, mixes them to the sides v − d and v + d, and scales the sides where
//! one of them exceeds its limit; the speed control of the wheels follows with a lag. Stock controllers of this kind:
//! `diff_drive_controller` of ros_controllers (limits of v and ω before mixing) and `husky_base` (both sides scaled in
//! proportion), both BSD.

use nalgebra::Matrix2;
use verdict::{ResponseConstant, Scaling};

use crate::run::{Piece, STEP, WINDOW};
use crate::settings::SETTINGS;

/// Integration steps per row.
pub(crate) const SUBSTEPS: usize = SETTINGS.integration.substeps;
/// Length of one, s.
pub(crate) const H: f64 = STEP / SUBSTEPS as f64;

/// What has no size: the order and kind of the controller's parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Law {
    pub(crate) scaling: Scaling,
    /// Sides are scaled after the ramps, else before.
    pub(crate) after_ramp: bool,
    /// Ramps hold each side, else forward speed and turning.
    pub(crate) side_ramps: bool,
    /// Second-order lag, else first.
    pub(crate) second_order: bool,
}

impl Default for Law {
    fn default() -> Self {
        Self { scaling: Scaling::Proportional, after_ramp: true, side_ramps: false, second_order: false }
    }
}

pub(crate) const DEAD_TIME: usize = 0;
pub(crate) const GAIN: [usize; 2] = [1, 2];
pub(crate) const TURN_LIMIT: usize = 3;
pub(crate) const FORWARD_LIMIT: usize = 4;
pub(crate) const WHEEL_LIMIT: usize = 5;
pub(crate) const RAMP: [usize; 2] = [6, 7];
pub(crate) const SIDE_RAMP: usize = 8;
pub(crate) const LAG: usize = 9;
pub(crate) const FREQUENCY: usize = 10;
pub(crate) const DAMPING: usize = 11;
pub(crate) const SIDE_GAIN: usize = 12;
/// From here on: odd powers of each side's own command (placebo only).
pub(crate) const SHAPE: usize = 13;

pub(crate) const POWER: ResponseConstant = ResponseConstant {
    id: "power",
    unit: "-",
    neutral: 0.0,
    bounds: SETTINGS.placebo.power_bounds,
    scale: SETTINGS.placebo.power_scale,
};

/// Wheel speeds from commands alone, every window from its measured start; the controller's own state runs through.
pub(crate) fn simulate(law: Law, x: &[f64], largest: f64, piece: &Piece) -> Vec<[f64; 2]> {
    forecast(law, x, largest, piece, WINDOW)
}

/// Wheel speeds from one start.
pub(crate) fn free_run(law: Law, x: &[f64], piece: &Piece) -> Vec<[f64; 2]> {
    forecast(law, x, 1.0, piece, piece.wheel.len())
}

/// Restarts from the measured wheel speeds every `restart` rows.
fn forecast(law: Law, x: &[f64], largest: f64, piece: &Piece, restart: usize) -> Vec<[f64; 2]> {
    let delay = x[DEAD_TIME] / H;
    let (whole, share) = (delay.floor() as usize, delay.fract());
    let rows = if restart == WINDOW { piece.windows() * WINDOW } else { piece.wheel.len() };
    // The controller takes no notice of when: its set-points are delayed instead of its commands, which a fit can follow,
    // since ramps make them smooth.
    let sets = set_points(law, x, largest, piece, rows);
    let lag = Lag::new(law, x);
    let (mut y, mut rate) = (body(piece.wheel[0]), [0.0; 2]);
    let mut out = Vec::with_capacity(rows);
    for i in 0..rows {
        if i % restart == 0 {
            y = body(piece.wheel[i]);
        }
        out.push([y[0] - y[1], y[0] + y[1]]);
        for j in i * SUBSTEPS + 1..=(i + 1) * SUBSTEPS {
            let (a, b) = (sets[j.saturating_sub(whole)], sets[j.saturating_sub(whole + 1)]);
            let s = [0, 1].map(|k| (1.0 - share) * a[k] + share * b[k]);
            let held = [s[0] - x[SIDE_GAIN] * s[1], s[1] - x[SIDE_GAIN] * s[0]];
            for k in 0..2 {
                (y[k], rate[k]) = lag.step(y[k], rate[k], held[k]);
            }
        }
    }
    out
}

/// Forward speed and turning that the controller sets, after each substep; the first as the wheels were found.
fn set_points(law: Law, x: &[f64], largest: f64, piece: &Piece, rows: usize) -> Vec<[f64; 2]> {
    let mut set = body(piece.wheel[0]);
    let mut out = Vec::with_capacity(rows * SUBSTEPS + 1);
    out.push(set);
    for (row, command) in piece.command[..rows].iter().enumerate() {
        let aim = |command: [f64; 2]| {
            let target = demand(x, command, largest);
            if law.after_ramp { target } else { law.scaling.hold(target, x[WHEEL_LIMIT]) }
        };
        let all_along = aim(*command);
        for k in row * SUBSTEPS..(row + 1) * SUBSTEPS {
            let target = piece.within.as_ref().map_or(all_along, |means| aim(means[k]));
            set = ramp(law, x, set, target);
            out.push(if law.after_ramp { law.scaling.hold(set, x[WHEEL_LIMIT]) } else { set });
        }
    }
    out
}

/// Forward speed and turning of two sides.
pub(crate) fn body([l, r]: [f64; 2]) -> [f64; 2] {
    [0.5 * (l + r), 0.5 * (r - l)]
}

/// Forward speed and turning that are asked for, within their own limits.
fn demand(x: &[f64], asked: [f64; 2], largest: f64) -> [f64; 2] {
    let asked = if x.len() > SHAPE { asked.map(|c| shaped(&x[SHAPE..], c / largest) * largest) } else { asked };
    let [v, d] = body(asked);
    let cut = |v: f64, limit: f64| v.clamp(-limit, limit);
    [cut(x[GAIN[0]] * v, x[FORWARD_LIMIT]), cut(x[GAIN[1]] * d, x[TURN_LIMIT])]
}

/// c₁ u + c₂ u³ + …
fn shaped(c: &[f64], u: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * u * u + c) * u
}

fn ramp(law: Law, x: &[f64], set: [f64; 2], target: [f64; 2]) -> [f64; 2] {
    let toward = |from: f64, to: f64, rate: f64| from + (to - from).clamp(-rate * H, rate * H);
    if law.side_ramps {
        let sides = |b: [f64; 2]| [b[0] - b[1], b[0] + b[1]];
        let (from, to) = (sides(set), sides(target));
        body([0, 1].map(|s| toward(from[s], to[s], x[SIDE_RAMP])))
    } else {
        [0, 1].map(|s| toward(set[s], target[s], x[RAMP[s]]))
    }
}

/// Speed control of the wheels over one step, exact for a set-point that holds.
enum Lag {
    First(f64),
    Second(Matrix2<f64>),
}

impl Lag {
    fn new(law: Law, x: &[f64]) -> Self {
        if law.second_order && x[FREQUENCY].is_finite() {
            let (w, z) = (x[FREQUENCY], x[DAMPING]);
            return Self::Second(exponential(Matrix2::new(0.0, 1.0, -w * w, -2.0 * z * w) * H));
        }
        let lag = if law.second_order { 0.0 } else { x[LAG] };
        Self::First(if lag > 0.0 { (-H / lag).exp() } else { 0.0 })
    }

    fn step(&self, y: f64, rate: f64, set: f64) -> (f64, f64) {
        match self {
            Self::First(keep) => (set + keep * (y - set), 0.0),
            Self::Second(m) => {
                let e = y - set;
                (set + m[(0, 0)] * e + m[(0, 1)] * rate, m[(1, 0)] * e + m[(1, 1)] * rate)
            }
        }
    }
}

/// By how much wheels answer a step otherwise under two laws, s: ∫ |h₁ − h₂| dt of their answers to a step of one, means of two rows;
/// by their dead times and lags, or by their lags alone.
pub(crate) fn answers_apart(laws: [(Law, &[f64]); 2], with_dead_time: bool) -> f64 {
    let answer = |(law, x): (Law, &[f64])| -> Vec<f64> {
        let lag = Lag::new(law, x);
        let waits = if with_dead_time { (x[DEAD_TIME] / H).round() as usize } else { 0 };
        let (mut y, mut rate) = (0.0, 0.0);
        let answered = std::iter::repeat_with(|| {
            (y, rate) = lag.step(y, rate, 1.0);
            y
        });
        std::iter::repeat_n(0.0, waits).chain(answered).take((SETTINGS.answer.answered / H) as usize).collect()
    };
    let [a, b] = laws.map(answer);
    // What rings from row to row nobody has seen.
    let rows = 2 * SUBSTEPS;
    let apart: Vec<f64> = std::iter::repeat_n(0.0, rows - 1).chain(a.iter().zip(&b).map(|(a, b)| a - b)).collect();
    apart.windows(rows).map(|d| (d.iter().sum::<f64>() / rows as f64).abs() * H).sum()
}

/// exp(A) by halving and squaring: the library's own needs an allocator that its features here leave out.
fn exponential(a: Matrix2<f64>) -> Matrix2<f64> {
    let squarings = SETTINGS.integration.squarings;
    let a = a * 0.5_f64.powi(squarings);
    let one = Matrix2::identity();
    let mut out = one + a * (one + a * 0.5 * (one + a / 3.0 * (one + a * 0.25)));
    for _ in 0..squarings {
        out *= out;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_way_of_scaling_keeps_what_it_says() {
        // Sides 2 and 10, limit 6.
        let asked = [6.0, 4.0];
        assert_eq!(Scaling::EachSide.hold(asked, 6.0), [4.0, 2.0]);
        let [v, d] = Scaling::Proportional.hold(asked, 6.0);
        approx::assert_relative_eq!(v / d, 1.5, epsilon = 1e-12);
        approx::assert_relative_eq!(v + d, 6.0, epsilon = 1e-12);
        assert_eq!(Scaling::TurnFirst.hold(asked, 6.0), [2.0, 4.0]);
        assert_eq!(Scaling::ForwardFirst.hold(asked, 6.0), [6.0, 0.0]);
        for s in Scaling::ALL {
            assert_eq!(s.hold([1.0, 2.0], 6.0), [1.0, 2.0]);
            assert_eq!(s.hold([1.0, 2.0], f64::INFINITY), [1.0, 2.0]);
        }
    }

    #[test]
    fn a_longer_dead_time_before_a_shorter_lag_is_hardly_another_answer() {
        let with = |dead_time: f64, lag: f64| {
            let mut x: Vec<f64> = verdict::DRIVE_CONSTANTS.iter().map(|c| c.neutral).collect();
            (x[DEAD_TIME], x[LAG]) = (dead_time, lag);
            x
        };
        let apart = |a: &[f64], b: &[f64], whole: bool| answers_apart([a, b].map(|x| (Law::default(), x)), whole);
        let (plain, slow, late) = (with(0.0, 0.1), with(0.0, 0.3), with(0.05, 0.06));
        approx::assert_relative_eq!(apart(&plain, &slow, true), 0.2, max_relative = 0.02);
        assert_eq!(apart(&plain, &plain, true), 0.0);
        let mut rings = with(0.0, 0.0);
        (rings[FREQUENCY], rings[DAMPING]) = (51.0, 0.12);
        let second = Law { second_order: true, ..Law::default() };
        assert!(answers_apart([(second, &rings), (Law::default(), &with(0.0, 0.0))], true) < 0.04);
        assert!(apart(&plain, &late, true) < 0.035 && apart(&plain, &late, false) > 0.035);
    }

    #[test]
    fn a_second_order_lag_settles_on_the_set_point_and_overshoots_when_light() {
        let mut x: Vec<f64> = verdict::DRIVE_CONSTANTS.iter().map(|c| c.neutral).collect();
        (x[FREQUENCY], x[DAMPING]) = (10.0, 0.5);
        let lag = Lag::new(Law { second_order: true, ..Law::default() }, &x);
        let (mut y, mut v, mut top) = (0.0, 0.0, 0.0_f64);
        for _ in 0..200 {
            (y, v) = lag.step(y, v, 1.0);
            top = top.max(y);
        }
        approx::assert_relative_eq!(y, 1.0, epsilon = 1e-6);
        // exp(−π ζ / √(1 − ζ²)) = 0.163
        approx::assert_relative_eq!(top, 1.163, epsilon = 0.01);
    }
}
