//! An inertial unit that comes loose and tips: its accelerometer shows a slope that no load knows.
//!
//! From an instant on the unit's forward axis points up by another angle `α`, in every heading and whichever way the robot goes. A slope
//! would add `m g r sin α` to the straight load one way and take it off the other way; a unit that has tipped changes nothing.

use inference::robust::{MAD_TO_SIGMA, NINETY, mean, median, median_absolute_deviation};
use robot_model::effects::imu_tilt;
use verdict::{Cause, Tipped};

use crate::directed_pull::Stretch;
use crate::heading::levels_at_rows;
use crate::pieces::Usual;
use crate::plane::stretches;
use crate::run::SpeedRun;
use crate::settings::{CHANGES, MEASURING, changes::Tipping};
use crate::words::recordings;

const TIPPING: Tipping = CHANGES.tipping;

/// Finds units that tip in these recordings and turns what they show upright; `weight` is `m g r`, N m.
pub(crate) fn take_out(runs: &mut [SpeedRun], usual: &Usual, weight: f64) -> Vec<Tipped> {
    let mut out = Vec::new();
    for run in runs {
        if let Some(tipped) = tipped(run, usual, weight) {
            turn_upright(run, &tipped);
            out.push(tipped);
        }
    }
    out
}

fn tipped(run: &SpeedRun, usual: &Usual, weight: f64) -> Option<Tipped> {
    let levels = levels_at_rows(run)?;
    let begin = step(run, &levels)?;
    let (before, after) = levels.split_at(begin);
    let middle = |of: &[f64]| median(of.iter().copied());
    let tilt = middle(after)? - middle(before)?;
    let scatter = |of: &[f64]| median_absolute_deviation(of).map(|deviation| MAD_TO_SIGMA * deviation);
    let noise = scatter(before)?.max(scatter(after)?);
    if tilt.abs() < TIPPING.least || noise > TIPPING.scatter * tilt.abs() {
        return None;
    }

    // Loads of all stretches: of the slopes that the unit shows, or of these less what it tipped by.
    let at = run.time[begin];
    let driven: Vec<Stretch> = stretches(run, usual).into_iter().filter(|s| !s.is_bound && s.tilt.is_some()).collect();
    let load = |s: &Stretch, slope: f64| {
        let load = s.usual + weight * slope.sin();
        if run.magnitude_only { load.abs() } else { load }
    };
    let left = |tilt: f64| {
        let of = |s: &Stretch| {
            let tipped = if s.from < at { 0.0 } else { s.way * tilt };
            (s.load - load(s, s.tilt.unwrap_or(0.0) - tipped)).powi(2)
        };
        driven.iter().map(of).sum::<f64>()
    };
    let after = || driven.iter().filter(|s| s.from >= at);
    let of_slope = mean(after().map(|s| weight * tilt.sin().abs() / s.usual))?;
    if of_slope < TIPPING.least_pull || left(tilt) > TIPPING.left * left(0.0) {
        return None;
    }
    Some(Tipped {
        recording: run.name.clone(),
        interval: [at, *run.time.last()?],
        tilt,
        // Means of the accelerometer overlap; stretches apart from one another do not.
        half: NINETY * noise / (after().count() as f64).sqrt(),
        ratio: mean(after().map(|s| s.load / s.usual))?,
        of_slope,
    })
}

/// The row at which a series of tilts steps: two means leave least of it there.
fn step(run: &SpeedRun, levels: &[f64]) -> Option<usize> {
    let (first, last) = (*run.time.first()?, *run.time.last()?);
    let inner = |i: &usize| run.time[*i] - first >= TIPPING.beside && last - run.time[*i] >= TIPPING.beside;
    let total: f64 = levels.iter().sum();
    let mut sum = 0.0;
    let sums: Vec<f64> = levels
        .iter()
        .map(|level| {
            let before = sum;
            sum += level;
            before
        })
        .collect();
    let n = levels.len() as f64;
    // What the two means take of the variance.
    let gain = |i: usize| {
        let k = i as f64;
        sums[i].powi(2) / k + (total - sums[i]).powi(2) / (n - k)
    };
    (1..levels.len()).filter(inner).max_by(|&a, &b| gain(a).total_cmp(&gain(b)))
}

/// Takes the tilt off what the unit shows from then on; while it tips its turning says nothing of the body.
fn turn_upright(run: &mut SpeedRun, tipped: &Tipped) {
    let at = tipped.interval[0];
    let lag = run.alignment.as_ref().and_then(|a| median(a.lag.iter().copied())).unwrap_or(0.0);
    let is_tipping = |t: f64| (t - at).abs() <= MEASURING.rows.level_mean;
    let upright = |time: &[f64], levels: &mut [f64], clock: f64| {
        let before = median(time.iter().zip(levels.iter()).filter(|(t, _)| **t - clock < at).map(|(_, level)| *level));
        for (t, level) in time.iter().zip(levels) {
            let t = t - clock;
            *level =
                if is_tipping(t) { before.unwrap_or(0.0) } else { *level - if t > at { tipped.tilt } else { 0.0 } };
        }
    };
    let SpeedRun { time, level, body_rates, .. } = run;
    if let Some(levels) = level {
        upright(time, levels, 0.0);
    }
    let Some(rates) = body_rates else { return };
    if let Some(levels) = &mut rates.level {
        upright(&rates.time, levels, lag);
    }
    let [roll, pitch, yaw] = &mut rates.rate;
    for (k, t) in rates.time.iter().enumerate() {
        if t - lag > at {
            roll[k] -= tipped.tilt * yaw[k];
        }
        if is_tipping(t - lag) {
            pitch[k] = 0.0;
        }
    }
}

/// Its cause.
pub(crate) fn cause(t: &Tipped, probability: f64) -> Cause {
    Cause {
        magnitude: Some(t.tilt),
        sigma: Some(t.half / NINETY),
        unit: imu_tilt::SPEC.parameters[0].unit.into(),
        intervals: Some([(t.recording.clone(), vec![t.interval])].into()),
        ..Cause::plain(imu_tilt::SPEC.id, imu_tilt::SPEC.name, probability)
    }
}

/// What is said of it, and what to do.
pub(crate) fn told(t: &Tipped) -> String {
    format!(
        "Tipped inertial unit: in {} its forward axis points {} by {:.1} ± {:.1}° (90 %) more from {:.1} s on. That is no slope: the \
         straight load stays at {:.2} times the usual one, which a slope of this angle would change by {:.2} times, more uphill and less \
         downhill. Nothing else here uses this tilt; fasten the unit, and change nothing of the simulation for it.",
        recordings(&t.recording),
        if t.tilt > 0.0 { "up" } else { "down" },
        t.tilt.abs().to_degrees(),
        t.half.to_degrees(),
        t.interval[0],
        t.ratio,
        t.of_slope
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Leg, STRAIGHT, WEIGHT, levelled, rounds};

    const USUAL: Usual = Usual { load: [Some(STRAIGHT), None, None], unequal: CHANGES.pieces.alike };

    /// Three rounds on level ground; the unit tips after 50 s.
    fn loose(degrees: f64) -> SpeedRun {
        let mut run = levelled(&rounds(3), 0.0);
        let rates = run.body_rates.as_mut().expect("rates");
        for k in (0..rates.time.len()).filter(|&k| rates.time[k] > 50.0) {
            rates.level.as_mut().expect("an accelerometer")[k] += degrees.to_radians();
            rates.rate[0][k] += degrees.to_radians() * rates.rate[2][k];
        }
        run
    }

    #[test]
    fn a_unit_that_tips_is_told_with_its_angle_and_turned_upright_and_a_slope_is_none() {
        let mut runs = [loose(-7.0)];
        let found = take_out(&mut runs, &USUAL, WEIGHT);
        let [tipped] = &found[..] else { panic!("{found:?}") };
        assert!((tipped.tilt.to_degrees() + 7.0).abs() < 0.3 && (tipped.interval[0] - 50.0).abs() < 1.0, "{found:?}");
        assert!((tipped.ratio - 1.0).abs() < 0.1 && tipped.of_slope > 1.0, "{found:?}");
        let rates = runs[0].body_rates.as_ref().expect("rates");
        let levels = rates.level.as_ref().expect("an accelerometer");
        assert!(levels.iter().all(|level| level.abs() < 1.5_f64.to_radians()));
        assert!(rates.rate[0].iter().all(|rate| rate.abs() < 0.01));

        // Slopes that loads know, onto one and from one, and a tilt that is too small to be told.
        let sloping: Vec<Leg> =
            rounds(3).iter().enumerate().map(|(k, leg)| leg.slope(if k < 5 { 0.0 } else { 4.0 })).collect();
        let from_slope: Vec<Leg> =
            rounds(3).iter().enumerate().map(|(k, leg)| leg.slope(if k < 5 { 4.0 } else { 0.0 })).collect();
        assert_eq!(take_out(&mut [levelled(&sloping, 0.0), levelled(&from_slope, 0.0)], &USUAL, WEIGHT), []);
        assert_eq!(take_out(&mut [loose(-1.0)], &USUAL, WEIGHT), []);
        assert_eq!(take_out(&mut [loose(0.0)], &USUAL, WEIGHT), []);
    }
}
