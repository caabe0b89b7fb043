//! Structure of what the best hypothesis leaves: harmonics of the wheels' angles, and accelerations that follow each other.
//!
//! Without references the noise is learnt from the recordings, and a cause that is not in the catalogue passes for noise of
//! its size. What it leaves has a form all the same: noise repeats with no angle of a wheel and is forgotten from one window
//! to the next.

use std::f64::consts::PI;

use inference::evidence::{logistic, none_of};
use inference::robust::mean;

use crate::channel::Channel;
use crate::fit::Problem;
use crate::settings::decision::{SETTINGS, Unknown};
use crate::simulate::Response;
use crate::windows::WINDOW;

/// Harmonics of a wheel's turn that noise does not have. The first is left out: effects of the catalogue have it.
const HARMONICS: [u8; 3] = [2, 3, 4];
const UNKNOWN: Unknown = SETTINGS.unknown;

/// What is left, by its form.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Structure {
    /// Power of a signal at the strongest harmonic of a wheel's turn over its power between harmonics.
    pub(crate) harmonic: f64,
    /// Largest correlation of an acceleration with itself one window later.
    pub(crate) correlation: f64,
}

impl Structure {
    /// Probability that a cause which is not in the catalogue left this.
    pub(crate) fn is_no_noise(self) -> f64 {
        1.0 - none_of(self.is_above())
    }

    /// The same by its harmonics and by its correlation alone.
    fn is_above(self) -> [f64; 2] {
        let repeats = UNKNOWN.harmonic_slope * (self.harmonic.max(f64::MIN_POSITIVE) / UNKNOWN.harmonic_centre).ln();
        let follows = UNKNOWN.correlation_slope * (self.correlation - UNKNOWN.correlation_centre);
        [repeats, follows].map(logistic)
    }

    /// What it does that noise does not: the likelier of both.
    pub(crate) fn habit(self) -> &'static str {
        let [repeats, follows] = self.is_above();
        if repeats > follows {
            "repeats two to four times in a turn of a wheel"
        } else {
            "is correlated from one window to the next in an acceleration"
        }
    }

    /// Of a response's residuals.
    pub(crate) fn of(problem: &Problem<'_>, response: &Response) -> Self {
        let mut harmonic = 0.0_f64;
        for side in 0..2 {
            for channel in [Channel::WHEELS[side], Channel::YawRate, Channel::ForwardAcceleration] {
                harmonic = harmonic.max(ratio(problem, response, side, channel).unwrap_or(0.0));
            }
        }
        let of = |channel| correlation(problem, response, channel).unwrap_or(0.0);
        let correlation = of(Channel::ForwardAcceleration).max(of(Channel::LateralAcceleration));
        Self { harmonic, correlation }
    }
}

/// Residuals of a channel in one segment, less their straight line, with the angle of a side's wheels in the middle of each
/// window and their speed.
fn residuals(
    problem: &Problem<'_>,
    response: &Response,
    [run, segment]: [usize; 2],
    side: usize,
    channel: Channel,
) -> Vec<[f64; 3]> {
    let s = &problem.cuts[run].segments[segment];
    let mut angle = s.start.wheel_angle[side];
    let mut out = Vec::with_capacity(s.windows);
    for ((shown, predicted), valid) in s.observed.iter().zip(&response[run][segment]).zip(&s.valid) {
        let speed =
            if valid[Channel::WHEELS[side]] { shown[Channel::WHEELS[side]] } else { predicted[Channel::WHEELS[side]] };
        let middle = angle + 0.5 * speed * WINDOW;
        angle += speed * WINDOW;
        if valid[channel] {
            out.push([shown[channel] - predicted[channel], middle, speed]);
        }
    }
    without_line(&mut out);
    out
}

/// Takes the straight line through values that follow each other off them.
fn without_line(values: &mut [[f64; 3]]) {
    let n = values.len() as f64;
    let middle = 0.5 * (n - 1.0);
    let mean = values.iter().map(|v| v[0]).sum::<f64>() / n.max(1.0);
    let (mut product, mut square) = (0.0, 0.0);
    for (i, v) in values.iter().enumerate() {
        let from_middle = i as f64 - middle;
        product += from_middle * v[0];
        square += from_middle * from_middle;
    }
    let slope = if square > 0.0 { product / square } else { 0.0 };
    for (i, v) in values.iter_mut().enumerate() {
        v[0] -= mean + slope * (i as f64 - middle);
    }
}

fn segments<'a>(problem: &'a Problem<'_>) -> impl Iterator<Item = [usize; 2]> + 'a {
    problem.cuts.iter().enumerate().flat_map(|(r, cut)| (0..cut.segments.len()).map(move |s| [r, s]))
}

/// Power of a channel's residuals at the strongest harmonic of a side's wheels over the mean power between harmonics.
fn ratio(problem: &Problem<'_>, response: &Response, side: usize, channel: Channel) -> Option<f64> {
    let values: Vec<[f64; 3]> =
        segments(problem).flat_map(|at| residuals(problem, response, at, side, channel)).collect();
    strongest(&values)
}

/// The same of values, each with an angle and its speed; `None` where too few turn at a speed that shows harmonics.
fn strongest(values: &[[f64; 3]]) -> Option<f64> {
    // A faster wheel turns too far in a window to show the highest order.
    let highest = UNKNOWN.between.into_iter().fold(0.0, f64::max);
    let speeds = UNKNOWN.least_turning..PI / (highest * WINDOW);
    let turning: Vec<&[f64; 3]> = values.iter().filter(|v| speeds.contains(&v[2].abs())).collect();
    let power = |order: f64| {
        let (mut c, mut s) = (0.0, 0.0);
        for v in &turning {
            let (sin, cos) = (order * v[1]).sin_cos();
            c += v[0] * cos;
            s += v[0] * sin;
        }
        c * c + s * s
    };
    let between = mean(UNKNOWN.between.map(power)).filter(|p| *p > 0.0)?;
    let strongest = HARMONICS.map(|n| power(f64::from(n))).into_iter().fold(0.0, f64::max);
    (turning.len() >= UNKNOWN.least_windows).then(|| strongest / between)
}

/// Correlation of a channel's residuals with those one window later.
fn correlation(problem: &Problem<'_>, response: &Response, channel: Channel) -> Option<f64> {
    let (mut product, mut square) = (0.0, 0.0);
    for at in segments(problem) {
        let values = residuals(problem, response, at, 0, channel);
        product += values.windows(2).map(|w| w[0][0] * w[1][0]).sum::<f64>();
        square += values.iter().map(|v| v[0] * v[0]).sum::<f64>();
    }
    (square > 0.0).then(|| product / square)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Hypothesis;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use testing::robot;

    /// Structure of what the plant leaves of its own drive when `added` is added to the lateral acceleration that is shown.
    fn of(added: impl Fn(f64) -> f64) -> Structure {
        let robot = robot();
        let mut run = driven(&robot, &[], 40.0);
        for k in 0..run.rows() {
            run.accel[1][k] = run.accel[1][k].map(|x| x + added(k as f64 * run.period));
        }
        let cuts = [cut(&run, &cutting())];
        let problem = problem(&robot, &cuts);
        Structure::of(&problem, &problem.response(&problem.origin(), &Hypothesis::default()))
    }

    /// Numbers without a pattern, from −1 to 1.
    fn noise(t: f64) -> f64 {
        ((12.9898 * t).sin() * 43_758.545).fract()
    }

    #[test]
    fn what_repeats_with_the_wheel_or_follows_itself_is_no_noise_and_noise_is() {
        let plain = of(|t| 0.5 * noise(t));
        assert!(plain.is_no_noise() < 0.05, "{plain:?}");
        let shaken = of(|t| 0.5 * noise(t) + 0.5 * (5.0 * t).sin());
        assert!(shaken.correlation > 0.6 && shaken.is_no_noise() > 0.9, "{shaken:?}");
        assert!(shaken.habit().starts_with("is correlated"), "{shaken:?}");

        let turned = |speed: f64, cogging: f64| {
            let value = |k: i32| {
                let t = f64::from(k) * WINDOW;
                [0.05 * noise(t) + cogging * (3.0 * speed * t).cos(), speed * t, speed]
            };
            strongest(&(0..400).map(value).collect::<Vec<_>>())
        };
        let of_harmonic = |harmonic| Structure { harmonic, correlation: 0.0 }.is_no_noise();
        assert!(turned(2.9, 0.0).is_some_and(|ratio| of_harmonic(ratio) < 0.05), "{:?}", turned(2.9, 0.0));
        assert!(turned(2.9, 0.05).is_some_and(|ratio| of_harmonic(ratio) > 0.9), "{:?}", turned(2.9, 0.05));
        assert!(Structure { harmonic: 90.0, correlation: 0.0 }.habit().starts_with("repeats"));
        assert_eq!(turned(20.0, 0.05), None, "in a window the wheel turns farther than a harmonic is long");
    }
}
