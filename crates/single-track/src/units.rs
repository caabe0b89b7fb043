//! Units and signs of gyro, encoder and pose, checked against each other: a column in another unit than the robot file says
//! would be taken for a sensor without any use, and nothing would be named.

use std::f64::consts::TAU;

use inference::robust::{mean, median};

use crate::car::Car;
use crate::drive::Columns;
use crate::settings::{SETTINGS, Units};

const RULES: Units = SETTINGS.units;

/// What is wrong with a unit or a sign, and what to do; `None` where all agree or nothing tells.
pub(crate) fn mistaken(table: &Columns) -> Option<String> {
    let turning = ratio(table, &table.gyro, turned, RULES.turning);
    let moving = ratio(table, &table.encoder, moved, RULES.moving);
    let is_near = |found: Option<f64>, factor: f64| found.is_some_and(|f| (f / factor).ln().abs() < RULES.near.ln());

    let degrees = 1.0_f64.to_degrees();
    let of_turning = [
        (degrees, "the gyro is in degrees per second; convert its column to rad/s"),
        (1.0 / degrees, "yaw is in degrees; convert its column to rad"),
    ];
    let of_moving = [
        (60.0 * 60.0 / 1e3, "the encoder's speed is in km/h; convert its column to m/s"),
        (1e3, "the encoder's speed is in mm/s; convert its column to m/s"),
        (100.0, "the encoder's speed is in cm/s; convert its column to m/s"),
        (1.0 / 1e3, "x and y are in millimetres; convert their columns to m"),
        (1.0 / 100.0, "x and y are in centimetres; convert their columns to m"),
    ];
    let unit = |found: Option<f64>, all: &[(f64, &'static str)]| {
        all.iter().find(|(factor, _)| is_near(found, *factor)).map(|(_, what)| (found.unwrap_or(1.0), *what))
    };
    if let Some((factor, what)) = unit(turning, &of_turning) {
        return Some(format!(
            "by the gyro the car turns {factor:.3} times as fast as by the pose: it seems that {what}"
        ));
    }
    if let Some((factor, what)) = unit(moving, &of_moving) {
        return Some(format!(
            "by the encoder the car drives {factor:.4} times as fast as by the pose: it seems that {what}"
        ));
    }
    is_near(turning.map(|f| -f), 1.0).then(|| {
        "the gyro and the pose turn opposite ways: yaw, or the gyro, is positive to the right; change the sign of its column"
            .to_owned()
    })
}

/// What is wrong with a sign or a unit by the way in which the car answers its steering, and what to do: over stretches of forward driving
/// `ψ̇ L / (v tan δ)`, 1 of a car without slip.
pub(crate) fn mistaken_by_steering(table: &Columns, car: &Car) -> Option<String> {
    let by_pose = !table.pose.is_empty();
    let mut found = Vec::new();
    let mut from = 0;
    for until in 1..table.time.len() {
        let seconds = table.time[until] - table.time[from];
        if seconds < RULES.stretch {
            continue;
        }
        found.extend(answered(table, car, by_pose, from..until).filter(|_| seconds < 2.0 * RULES.stretch));
        from = until;
    }
    if found.len() < RULES.stretches {
        return None;
    }

    let opposite = found.iter().filter(|ratio| **ratio < 0.0).count() as f64;
    if opposite > RULES.one_sided * found.len() as f64 {
        return Some(
            "the car turns to the right where its steering command is positive, and to the left where it is negative: change the \
             sign of the steering column, or of yaw and gyro if these are positive to the right"
                .to_owned(),
        );
    }
    let ratio = median(found)?;
    let [least, most] = RULES.steered_factors;
    let [way, turning] = if by_pose { ["x and y are", "yaw"] } else { ["the encoder's speed is", "the gyro"] };
    if (0.0..least).contains(&ratio) {
        return Some(format!(
            "by its steering and its wheelbase the car would turn {:.0} times as far on the way that it drives: it seems that {way} \
             not in metres; convert the columns (mm: divide by 1000, cm: by 100)",
            1.0 / ratio
        ));
    }
    (ratio > most).then(|| {
        format!(
            "the car turns {ratio:.0} times as far as its steering and its wheelbase say: it seems that {turning} is in degrees; convert \
             its column to radians"
        )
    })
}

/// Turning over that of the steering in a stretch of rows; `None` where it drives backward, hardly steers or hardly moves, or where nothing
/// was seen.
fn answered(table: &Columns, car: &Car, by_pose: bool, rows: std::ops::Range<usize>) -> Option<f64> {
    let seconds = table.time[rows.end] - table.time[rows.start];
    let of = |column: &[f64]| mean(column.get(rows.clone())?.iter().copied().filter(|x| x.is_finite()));
    let is_forward = table.throttle[rows.clone()].iter().all(|u| *u > RULES.forward);
    let angle = car.full_steering.value * of(&table.steering)?;
    let pose = || &table.pose[rows.start..=rows.end];
    let (way, turned) = if by_pose {
        (moved(pose())?, turned(pose())?)
    } else {
        (of(&table.encoder)? * seconds, of(&table.gyro)? * seconds)
    };
    let expected = way * angle.tan() / car.wheelbase.value;
    let is_told = is_forward && angle.abs() > RULES.steered && way > RULES.moving * seconds;
    (is_told && expected != 0.0).then(|| turned / expected)
}

/// Median of what a channel shows over what the pose does in the same time, over stretches in which the pose does `least` and
/// more per second; `None` without enough of them, and where it is another from stretch to stretch: a unit is the same everywhere, wheels
/// that spin are not.
fn ratio(table: &Columns, channel: &[f64], done: fn(&[[f64; 3]]) -> Option<f64>, least: f64) -> Option<f64> {
    if channel.is_empty() || table.pose.is_empty() {
        return None;
    }
    let mut found = Vec::new();
    let mut from = 0;
    for until in 1..table.time.len() {
        let seconds = table.time[until] - table.time[from];
        if seconds < RULES.stretch {
            continue;
        }
        let shown = mean(channel[from..until].iter().copied().filter(|x| x.is_finite()));
        if let (Some(shown), Some(done)) = (shown, done(&table.pose[from..=until]))
            && seconds < 2.0 * RULES.stretch
            && (done / seconds).abs() > least
        {
            found.push(shown * seconds / done);
        }
        from = until;
    }
    let factor = median(found.iter().copied()).filter(|_| found.len() >= RULES.stretches)?;
    let is_steady = |ratio: &&f64| (1.0 / RULES.steady..RULES.steady).contains(&(*ratio / factor));
    (2 * found.iter().filter(is_steady).count() > found.len()).then_some(factor)
}

/// How far the body turns over rows of the pose; `None` where yaw wraps around or was not seen.
fn turned(pose: &[[f64; 3]]) -> Option<f64> {
    let steps = || pose.windows(2).map(|w| w[1][2] - w[0][2]);
    // In degrees a step of half a turn is no wrap, and in radians none is as large.
    let is_seen = steps().all(|step| step.is_finite() && step.abs() < RULES.wrap * TAU);
    is_seen.then(|| steps().sum())
}

/// How far its point moves in a straight line.
fn moved(pose: &[[f64; 3]]) -> Option<f64> {
    let (first, last) = (pose.first()?, pose.last()?);
    Some((last[0] - first[0]).hypot(last[1] - first[1])).filter(|way| way.is_finite())
}
