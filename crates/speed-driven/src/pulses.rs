//! Straight driving at a constant commanded speed whose load rises and falls again and again: a hose or a trailer that jerks, a hand, a
//! wheel that is out of round.
//!
//! Measured speeds follow such a load, so that no row counts as steady and the loads of steady driving do not contain it. Of each
//! stretch at one commanded speed, less its mean and trend, that frequency `f` is found at which `a cos 2πft + b sin 2πft` takes the
//! largest share of the variance (the periodogram of A. Schuster, *Terrestrial Magnetism* 3, 1898).

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use catalogue::answer::UNKNOWN;
use inference::robust::{MAD_TO_SIGMA, NINETY, mean, mean_with_error, median, median_absolute_deviation};
use robot_model::effect::EffectSpec;
use robot_model::effects::{constant_pull, drivetrain_ripple, wheel_eccentricity};
use verdict::{Cause, Pulsing, Rhythm};

use crate::pieces::{Usual, class, pieces};
use crate::run::SpeedRun;
use crate::settings::{CHANGES, MEASURING, changes::Pulses};
use crate::words::recordings;

const PULSES: Pulses = CHANGES.pulses;

/// A stretch of straight driving at one commanded speed.
struct Stretch {
    interval: [f64; 2],
    seconds: f64,
    /// m/s, forward positive.
    speed: f64,
    /// Mean straight load in the direction of travel, N m, and the root mean square about it.
    load: f64,
    swing: f64,
    /// Times, s, and what the mean and the trend leave of the load then, N m.
    rest: [Vec<f64>; 2],
    /// Rate of the rows, Hz.
    rate: f64,
}

/// A stretch whose load rises and falls, and how often, Hz.
struct Pulse {
    of: Stretch,
    frequency: f64,
}

/// Recordings whose straight load pulses more than that of the references does; `radius` of the wheels in m, and by which share torques
/// may be off.
pub(crate) fn pulsing(
    references: &[SpeedRun],
    recordings: &[SpeedRun],
    usual: &Usual,
    (radius, scale_sigma): (f64, f64),
) -> Vec<Pulsing> {
    let calm = median(references.iter().flat_map(stretches).map(|s| s.swing));
    let (Some(calm), Some(any)) = (calm, usual.any()) else { return Vec::new() };
    let is_large = |s: &Stretch| s.swing >= PULSES.clear * calm && s.swing >= PULSES.least_share * any;
    let pulse = |of: Stretch| {
        let (frequency, share) = is_large(&of).then(|| strongest(&of)).flatten()?;
        (share >= PULSES.share).then_some(Pulse { of, frequency })
    };
    let told = |run: &SpeedRun| {
        let pulses: Vec<Pulse> = stretches(run).into_iter().filter_map(pulse).collect();
        let found: Vec<&Stretch> = pulses.iter().map(|p| &p.of).collect();
        let seconds: f64 = found.iter().map(|s| s.seconds).sum();
        let (first, last) = (found.first()?, found.last()?);
        let over = |s: &Stretch| s.load / usual.load[class(s.speed.abs())].unwrap_or(any);
        let towards = |way: f64| found.iter().copied().filter(move |s| s.speed * way > 0.0);
        // By how much more than usual the robot takes, N: a pull is that one way, and as much less the other.
        let more = |way: f64| -> Vec<f64> { towards(way).map(|s| s.load * (1.0 - 1.0 / over(s)) / radius).collect() };
        let [ahead, back] = [1.0, -1.0].map(|way| mean_with_error(&more(way)));
        let is_pull = !run.magnitude_only && [1.0, -1.0].iter().all(|way| towards(*way).next().is_some());
        let pull = is_pull.then_some(0.5 * (ahead.0 - back.0));
        let half = pull.map(|pull| NINETY * (scale_sigma * pull).hypot(0.5 * ahead.1.hypot(back.1)));
        (seconds >= PULSES.least).then(|| Pulsing {
            recording: run.name.clone(),
            interval: [first.interval[0], last.interval[1]],
            seconds,
            swing: [mean(found.iter().map(|s| s.swing)).unwrap_or(0.0), calm],
            frequency: mean(pulses.iter().map(|p| p.frequency)).unwrap_or(0.0),
            rhythm: rhythm(&pulses, radius),
            ratio: [1.0, -1.0].map(|way| mean(towards(way).map(over))),
            pull,
            half,
        })
    };
    recordings.iter().filter_map(told).collect()
}

/// What the frequency of these stretches goes with.
fn rhythm(pulses: &[Pulse], radius: f64) -> Rhythm {
    let scatter_of = |values: &[f64]| {
        let middle = median(values.iter().copied())?;
        Some((middle, MAD_TO_SIGMA * median_absolute_deviation(values)? / middle))
    };
    let of = |value: &dyn Fn(&Pulse) -> f64| scatter_of(&pulses.iter().map(value).collect::<Vec<f64>>());
    let speeds = || pulses.iter().map(|p| p.of.speed.abs());
    let is_unlike = speeds().fold(0.0, f64::max) >= PULSES.speeds * speeds().fold(f64::MAX, f64::min);
    let of_wheel = of(&|p| p.frequency * TAU * radius / p.of.speed.abs());
    match (of(&|p| p.frequency), of_wheel) {
        (Some((_, by_time)), Some((turns, by_turn))) if is_unlike && by_time.min(by_turn) <= PULSES.alike => {
            if by_turn < by_time { Rhythm::Wheel(turns) } else { Rhythm::Time }
        }
        _ => Rhythm::Unknown,
    }
}

/// The likely causes of a pulsing load: a pull where it is one way, wheels where it goes with their turning.
pub(crate) fn causes(p: &Pulsing, probability: f64) -> Vec<Cause> {
    let intervals = BTreeMap::from([(p.recording.clone(), vec![p.interval])]);
    let known = |spec: &EffectSpec, of: f64| Cause {
        intervals: Some(intervals.clone()),
        ..Cause::plain(spec.id, spec.name, probability / of)
    };
    match (p.rhythm, p.pull) {
        (Rhythm::Wheel(_), _) => [&wheel_eccentricity::SPEC, &drivetrain_ripple::SPEC].map(|s| known(s, 2.0)).into(),
        (_, Some(pull)) if p.half.is_some_and(|half| pull.abs() > half) => vec![Cause {
            magnitude: Some(pull),
            sigma: p.half.map(|half| half / NINETY),
            unit: constant_pull::SPEC.parameters[0].unit.into(),
            ..known(&constant_pull::SPEC, 1.0)
        }],
        _ => {
            let unlisted = Cause::plain(UNKNOWN.id, UNKNOWN.name, probability);
            vec![Cause { intervals: Some(intervals), ..unlisted }]
        }
    }
}

/// What is said of it, and what to do.
pub(crate) fn told(p: &Pulsing) -> String {
    let [from, until] = p.interval;
    let [here, usual] = p.swing;
    let rhythm = match p.rhythm {
        Rhythm::Time => {
            "at every speed alike, so that no wheel does it: something pulls or pushes the robot again and again"
                .to_owned()
        }
        Rhythm::Wheel(turns) => {
            format!(
                "which is {turns:.1} times per turn of a wheel at every speed: a wheel out of round, or a drive train with a ripple"
            )
        }
        Rhythm::Unknown => {
            "the speeds are too much alike to tell whether that goes with the turning of the wheels: drive at twice \
            the speed"
                .to_owned()
        }
    };
    let is_pull = |pull: &f64| p.half.is_some_and(|half| pull.abs() > half);
    let mean = match (p.ratio, p.pull.filter(is_pull)) {
        ([Some(ahead), Some(back)], Some(pull)) => format!(
            " On the average the straight load is {ahead:.2} times the usual one forward and {back:.2} times backward: a pull of {:.0} ± {:.0} N \
             (90 %) towards the {}.",
            pull.abs(),
            p.half.unwrap_or(0.0),
            if pull > 0.0 { "rear" } else { "front" }
        ),
        ([Some(ratio), None] | [None, Some(ratio)], _) => format!(
            " On the average the straight load is {ratio:.2} times the usual one, one way only: drive the other way, too, to tell a pull from \
             ground."
        ),
        _ => String::new(),
    };
    format!(
        "Pulsing load: in {} from {from:.1} s to {until:.1} s the straight load rises and falls {:.2} times a second by {here:.2} N m (rms; \
         {usual:.2} on the references), {rhythm}.{mean}",
        recordings(&p.recording),
        p.frequency
    )
}

/// Stretches at one commanded speed, with what their loads do; none where only measured speeds are known.
fn stretches(run: &SpeedRun) -> Vec<Stretch> {
    let Some(set) = run.commanded.as_ref().or(run.set_points.then_some(&run.speed)) else { return Vec::new() };
    let near = MEASURING.straight.difference;
    let is_straight = |i: usize| {
        (set[0][i] - set[1][i]).abs() <= near
            && set[0][i].abs().min(set[1][i].abs()) >= MEASURING.straight.least_speed
            && !run.standing[i]
    };
    let is_settled = |i: &usize| {
        let first = run.time.partition_point(|t| *t < run.time[*i] - PULSES.settled);
        let one = |k: usize| is_straight(k) && (0..2).all(|j| (set[j][k] - set[j][*i]).abs() <= near);
        run.time[*i] - run.time[0] >= PULSES.settled && (first..=*i).all(one)
    };
    let rows = pieces(&run.time, (0..run.time.len()).filter(is_settled), PULSES.settled / 2.0);
    let most = (PULSES.longest / run.period()) as usize;
    rows.iter().flat_map(|rows| rows.chunks(most.max(1))).filter_map(|rows| of_rows(run, set, rows)).collect()
}

fn of_rows(run: &SpeedRun, set: &[Vec<f64>; 2], rows: &[usize]) -> Option<Stretch> {
    let interval = [run.time[*rows.first()?], run.time[*rows.last()?]];
    let seconds = interval[1] - interval[0];
    if seconds < PULSES.stretch {
        return None;
    }
    let speed = set[0][rows[rows.len() / 2]];
    let of_row = |&i: &usize| {
        let torque = [run.torque[0][i], run.torque[1][i]];
        if run.magnitude_only { torque[0].abs() + torque[1].abs() } else { (torque[0] + torque[1]) * speed.signum() }
    };
    let time: Vec<f64> = rows.iter().map(|&i| run.time[i] - interval[0]).collect();
    let loads: Vec<f64> = rows.iter().map(of_row).collect();
    let (load, rest) = without_trend(&time, &loads)?;
    let swing = mean(rest.iter().map(|x| x * x))?.sqrt();
    Some(Stretch { interval, seconds, speed, load, swing, rest: [time, rest], rate: 1.0 / run.period() })
}

/// Mean of a series, and what it leaves with its trend.
fn without_trend(time: &[f64], series: &[f64]) -> Option<(f64, Vec<f64>)> {
    let (middle, level) = (mean(time.iter().copied())?, mean(series.iter().copied())?);
    let pairs = || time.iter().zip(series).map(|(t, x)| (t - middle, x - level));
    let trend = pairs().map(|(t, x)| t * x).sum::<f64>() / pairs().map(|(t, _)| t * t).sum::<f64>();
    Some((level, pairs().map(|(t, x)| x - trend * t).collect()))
}

/// The frequency up to a quarter of the rows' rate that takes the largest share of the variance, Hz, and that share.
fn strongest(s: &Stretch) -> Option<(f64, f64)> {
    let [time, rest] = &s.rest;
    let [low, high] = PULSES.band;
    let power: f64 = rest.iter().map(|x| x * x).sum();
    let step = PULSES.step / s.seconds;
    let tried = (0..=((high.min(PULSES.highest * s.rate) - low) / step) as usize).map(|k| low + step * k as f64);
    let share = |f: f64| {
        let sum = |of: fn(f64) -> f64| time.iter().zip(rest).map(|(t, x)| of(TAU * f * t) * x).sum::<f64>();
        2.0 * (sum(f64::cos).powi(2) + sum(f64::sin).powi(2)) / (rest.len() as f64 * power)
    };
    tried.map(|f| (f, share(f))).max_by(|a, b| a.1.total_cmp(&b.1))
}

#[cfg(test)]
mod tests {
    use std::slice;

    use super::*;
    use crate::pieces::Usual;
    use crate::testing::{Leg, STRAIGHT, drive};

    const RADIUS: f64 = 0.1651;
    const USUAL: Usual = Usual { load: [Some(STRAIGHT), None, None], unequal: CHANGES.pieces.alike };

    /// Forward, a turn, then backward at another speed, with what is added to each side's torque along the body, N m.
    fn pulled(by: impl Fn(f64, f64) -> f64) -> SpeedRun {
        let back = Leg { speed: [-0.16; 2], ..Leg::straight(30.0) };
        let mut run = drive(&[Leg::straight(30.0), Leg::turn(5.0), back], false);
        run.magnitude_only = false;
        for i in 0..run.time.len() {
            let (way, speed) = (run.forward(i).signum(), run.forward(i).abs());
            for side in &mut run.torque {
                side[i] = 0.5 * STRAIGHT * way + 0.1 * [1.0, -1.0, 0.5][i % 3] + by(run.time[i], speed);
            }
        }
        run
    }

    #[test]
    fn a_pull_that_pulses_is_told_with_its_force_and_frequency_and_a_steady_one_is_not() {
        let calm = [pulled(|_, _| 0.0)];
        let hose = pulled(|t, _| if t > 10.0 { 0.5 * 6.0 * (1.0 + (TAU * 0.9 * t).sin()) } else { 0.0 });
        let found = pulsing(&calm, slice::from_ref(&hose), &USUAL, (RADIUS, 0.05));
        let [pulsing] = &found[..] else { panic!("{found:?}") };
        assert!((pulsing.frequency - 0.9).abs() < 0.06, "{found:?}");
        assert_eq!(pulsing.rhythm, Rhythm::Time);
        let pull = pulsing.pull.expect("both directions");
        assert!((pull - 6.0 / RADIUS).abs() < 0.2 * 6.0 / RADIUS, "{found:?}");
        assert!(pulsing.ratio[0].is_some_and(|r| r > 1.3) && pulsing.ratio[1].is_some_and(|r| r < 0.7), "{found:?}");

        let steady = pulled(|_, _| 3.0);
        assert_eq!(super::pulsing(&calm, &[steady], &USUAL, (RADIUS, 0.05)), []);
        // As references have it, it is how this robot drives; and without what is commanded nobody knows what is constant.
        assert_eq!(super::pulsing(slice::from_ref(&hose), slice::from_ref(&hose), &USUAL, (RADIUS, 0.05)), []);
        assert_eq!(super::pulsing(&calm, &[SpeedRun { set_points: false, ..hose }], &USUAL, (RADIUS, 0.05)), []);
    }

    #[test]
    fn what_goes_with_the_speed_is_told_per_turn_of_a_wheel_and_noise_has_no_frequency() {
        let calm = [pulled(|_, _| 0.0)];
        // Four rises per turn of a wheel.
        let wheel = pulled(|t, speed| 3.0 * (4.0 * speed / RADIUS * t).sin());
        let found = pulsing(&calm, &[wheel], &USUAL, (RADIUS, 0.05));
        assert!(matches!(found[0].rhythm, Rhythm::Wheel(turns) if (turns - 4.0).abs() < 0.3), "{found:?}");
        let ids: Vec<String> = causes(&found[0], 0.9).into_iter().map(|c| c.effect).collect();
        assert_eq!(ids, ["wheel_eccentricity", "drivetrain_ripple"]);

        // As much one way as the other: no pull.
        let shaken = pulled(|t, _| 3.0 * (TAU * 0.9 * t).sin());
        let ids: Vec<String> = pulsing(&calm, &[shaken], &USUAL, (RADIUS, 0.05))
            .iter()
            .flat_map(|p| causes(p, 0.9))
            .map(|c| c.effect)
            .collect();
        assert_eq!(ids, [UNKNOWN.id]);

        let rough = pulled(|t, _| 3.0 * ((37.0 * t).sin() + (23.7 * t * t).sin() + (7.1 * t * t).cos()));
        assert_eq!(pulsing(&calm, &[rough], &USUAL, (RADIUS, 0.05)), []);
    }
}
