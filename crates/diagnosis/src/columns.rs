//! Columns that contradict each other: exchanged, of the other sign, or in another unit. Told before anything is diagnosed,
//! since a model that is fitted to such columns finds causes that are none.
//!
//! Each check asks what the other channels say that a column must show, and compares by the cosine between both: nothing
//! that robots do turns a column into its negative or into the other side's. Only what is clear is refused.

use std::array::from_fn;

use recordings::{Recording, Signal, parse_unit};
use robot_model::{Chassis, Robot};

use crate::grid::slope;
use crate::settings::{Columns, SETTINGS};
use inference::DiagnosisError;
use inference::robust::{mean, median};

mod motion;
mod sides;

use motion::{Motion, Sides, combined, follows_heading, likeness_of_changes};
use sides::{Compared, Factors, both, named};

const COLUMNS: Columns = SETTINGS.columns;

/// Refuses a recording whose columns are exchanged, have the other sign or another unit than the mapping says.
///
/// # Errors
/// Which columns, what shows it, and what to change.
pub(crate) fn consistent(recording: &Recording, robot: &Robot<f64>) -> Result<(), DiagnosisError> {
    let motion = Motion::of(recording);
    let found = mirrored_pose(recording, robot, &motion)
        .or_else(|| opposed_gyro(recording, robot, &motion))
        .or_else(|| wheels(recording, robot, &motion))
        .or_else(|| commands(recording, robot, &motion))
        .or_else(|| torques(recording, robot, &motion))
        .or_else(|| forces(recording, robot, &motion));
    match found {
        None => Ok(()),
        Some(what) => Err(DiagnosisError::Impossible { recording: recording.name().to_owned(), what }),
    }
}

/// Yaw rate that the wheels give the body if they roll, rad/s.
fn turn_of_wheels(robot: &Robot<f64>, [left, right]: &Sides) -> Vec<f64> {
    let lever = robot.wheel_radius / (2.0 * robot.half_track);
    combined(lever, right, -lever, left)
}

/// A pose whose place turns the other way than its heading.
fn mirrored_pose(recording: &Recording, robot: &Robot<f64>, motion: &Motion) -> Option<String> {
    let [heading, rate] = motion.heading.as_ref()?;
    let [follows, mirrored] = follows_heading(motion.travel.as_ref()?, heading)?;
    if !(mirrored > COLUMNS.alike && follows < COLUMNS.unlike) {
        return None;
    }
    // Who turns as the wheels or the gyro do is right.
    let by_wheels = motion.wheels.as_ref().map(|(speeds, _)| turn_of_wheels(robot, speeds));
    let witness = motion.gyro.as_ref().or(by_wheels.as_ref());
    let heading_is_right =
        witness.and_then(|turn| likeness_of_changes(rate, turn, COLUMNS.turning)).map(|l| l.cosine > 0.0);
    let place = both(recording, [Signal::PoseX, Signal::PoseY]);
    let yaw = named(recording, Signal::PoseYaw);
    let remedy = match heading_is_right {
        Some(true) => format!("exchange {place} in the mapping, or write `sign = -1` for one of them"),
        Some(false) => format!("write `sign = -1` for {yaw} in the mapping"),
        None => format!("exchange {place} in the mapping, or write `sign = -1` for {yaw}"),
    };
    Some(format!(
        "the place of the pose turns to the other side than its heading: the direction of travel follows the heading \
         mirrored ({mirrored:.2} of 1) and not as it is ({follows:.2}); {remedy}"
    ))
}

/// A gyro that turns to the other side than the heading, or than the wheels where there is no heading.
fn opposed_gyro(recording: &Recording, robot: &Robot<f64>, motion: &Motion) -> Option<String> {
    let gyro = motion.gyro.as_ref()?;
    let heading = motion.heading.as_ref().map(|[_, rate]| rate);
    let likeness_to_heading = heading.and_then(|rate| likeness_of_changes(gyro, rate, COLUMNS.turning))?;
    if likeness_to_heading.cosine > -COLUMNS.opposite {
        return None;
    }
    let shows = format!(
        "{} and {} turn to opposite sides (cosine {:.2})",
        named(recording, Signal::GyroZ),
        named(recording, Signal::PoseYaw),
        likeness_to_heading.cosine
    );
    let wheels = motion.wheels.as_ref().map(|(speeds, _)| turn_of_wheels(robot, speeds));
    let gyro_is_right =
        wheels.and_then(|turn| likeness_of_changes(gyro, &turn, COLUMNS.turning)).map(|l| l.cosine > 0.0);
    Some(match gyro_is_right {
        Some(false) => {
            format!("{shows}, and the wheels turn as the pose does: write `sign = -1` for gyro_z in the mapping")
        }
        Some(true) => {
            format!("{shows}, and the wheels turn as the gyro does: write `sign = -1` for pose_yaw in the mapping")
        }
        None => format!("{shows}; write `sign = -1` for the wrong one in the mapping"),
    })
}

/// What else to do where not all recordings are so.
pub(crate) const OF_THEIR_OWN: &str = " (where other recordings are right as they are, in an entry of its own whose pattern \
                                       fits the names of these)";

/// What to do about columns of speeds in another unit.
const UNITS_OF_SPEED: &str = "write the unit of these columns in the mapping (1 rad/s is 9.549 rpm, 57.30 deg/s and 0.1592 \
                              rev/s), or the factor that makes a speed of the ground one of the wheel";

/// Wheels that turn the other way than the body moves, or in another unit.
fn wheels(recording: &Recording, robot: &Robot<f64>, motion: &Motion) -> Option<String> {
    let (speeds, signals) = motion.wheels.as_ref()?;
    let turn = motion.gyro.as_ref().or_else(|| motion.heading.as_ref().map(|[_, rate]| rate))?;
    let r = robot.wheel_radius;
    if let Some(forward) = motion.forward() {
        let expected = [-1.0, 1.0].map(|side| combined(1.0 / r, &forward, side * robot.half_track / r, turn));
        let (by, least) = ("the motion of the pose", COLUMNS.moving / r);
        let (shown, expected) = (speeds, &expected);
        let (units, factors) = (UNITS_OF_SPEED, Factors::of_speeds(robot));
        return Compared { recording, signals: *signals, shown, expected, by, least, units, factors }.contradiction();
    }
    // Without a pose the difference of the sides must turn the body, and not their sum.
    let lever = r / (2.0 * robot.half_track);
    let by_difference = likeness_of_changes(&turn_of_wheels(robot, speeds), turn, COLUMNS.turning)?;
    let by_sum = likeness_of_changes(&combined(lever, &speeds[0], lever, &speeds[1]), turn, COLUMNS.turning)?;
    let shown_by = if motion.gyro.is_some() { Signal::GyroZ } else { Signal::PoseYaw };
    let gyro = named(recording, shown_by);
    if by_difference.cosine < -COLUMNS.opposite {
        return Some(format!(
            "{} turn the body to the other side than {gyro} shows (cosine {:.2}): exchange left and right in the \
             mapping, or write `sign = -1` for {shown_by}, or for both wheels if the robot drove backward",
            both(recording, *signals),
            by_difference.cosine
        ));
    }
    if by_sum.cosine.abs() > COLUMNS.alike
        && by_difference.cosine.abs() < COLUMNS.unlike
        && by_sum.ratio < COLUMNS.turned
    {
        let side = usize::from(by_sum.cosine < 0.0);
        return Some(format!(
            "the sum of {} goes with the turning that {gyro} shows (cosine {:.2}), and their difference does not \
             ({:.2}): write `sign = -1` for {} in the mapping",
            both(recording, *signals),
            by_sum.cosine,
            by_difference.cosine,
            named(recording, signals[side])
        ));
    }
    (by_difference.cosine > COLUMNS.opposite && by_difference.ratio > COLUMNS.turned_unit).then(|| {
        format!(
            "{} turn the body at {:.1} times the rate that {gyro} shows: {UNITS_OF_SPEED}",
            both(recording, *signals),
            by_difference.ratio
        )
    })
}

/// Set speeds that the wheels do not follow as they are mapped.
fn commands(recording: &Recording, robot: &Robot<f64>, motion: &Motion) -> Option<String> {
    let (expected, wheels) = motion.wheels.as_ref()?;
    let shown = motion.commands.as_ref()?;
    let signals = [Signal::CommandSpeedLeft, Signal::CommandSpeedRight];
    if *wheels == signals {
        return None;
    }
    let (by, least) = ("the wheels' measured speeds", COLUMNS.turning);
    let (units, factors) = (UNITS_OF_SPEED, Factors::of_speeds(robot));
    Compared { recording, signals, shown, expected, by, least, units, factors }.contradiction()
}

/// Torques that do not drive the wheels of their side.
fn torques(recording: &Recording, robot: &Robot<f64>, motion: &Motion) -> Option<String> {
    let (speeds, _) = motion.wheels.as_ref()?;
    let shown = motion.torques.as_ref()?;
    let signals = [Signal::TorqueLeft, Signal::TorqueRight];
    // An encoder of another scale makes turns of straight driving; a gyro does not.
    let turn = motion.gyro.clone().unwrap_or_else(|| turn_of_wheels(robot, speeds));
    let expected = &torque_of_motion(robot, speeds, &turn);
    let (by, least) = ("the torque that the robot of the file needs for the motion of its wheels", dry_friction(robot));
    let units = "write the factor that makes it N m at the wheels in the mapping (1 N m is 0.1020 kgf m; a torque at the \
                 motor times the gear ratio is one at the wheels)";
    let factors = Factors::Beyond(COLUMNS.over_limit * robot.drive.limit);
    Compared { recording, signals, shown, expected, by, least, units, factors }.contradiction()
}

/// Dry friction of a side's drive, N m: with less torque nothing drives.
fn dry_friction(robot: &Robot<f64>) -> f64 {
    f64::midpoint(robot.coulomb[0], robot.coulomb[1])
}

/// Torque of each side that moves the robot as its wheels and its body turn, if they roll: inertia, friction of drive and rolling, and
/// the scrub of wheels that are pushed aside in a turn, N m. Rough: cosines are all that is asked of it.
fn torque_of_motion(robot: &Robot<f64>, speeds: &Sides, turn: &[f64]) -> Sides {
    let r = robot.wheel_radius;
    let rates: Sides = from_fn(|side| slope(&speeds[side], COLUMNS.step));
    let (along, about) = (robot.mass * r * r / 4.0, robot.yaw_inertia * (r / robot.half_track).powi(2) / 4.0);
    let of_wheels = robot.side_inertia();
    let weight = robot.mass * robot.gravity;
    let scrub = match robot.chassis {
        Chassis::SkidSteer | Chassis::FourMotors => {
            robot.adhesion * robot.lateral_factor * weight * robot.half_wheelbase * r / (2.0 * robot.half_track)
        }
        Chassis::Differential => 0.0,
    };
    from_fn(|side| {
        let (own, other) = (&rates[side], &rates[1 - side]);
        let aside = if side == 0 { -scrub } else { scrub };
        let friction = robot.coulomb[side] + robot.rolling_resistance * weight * r / 2.0;
        (0..turn.len())
            .map(|k| {
                let speed = speeds[side][k];
                (along + about + of_wheels) * own[k]
                    + (along - about) * other[k]
                    + friction * (speed / SETTINGS.grid.at_rest).tanh()
                    + robot.viscous[side] * speed
                    + aside * (turn[k] / COLUMNS.turning).tanh()
            })
            .collect()
    })
}

/// Accelerometers whose axes are exchanged, of the other sign or in another unit: what turns pushes outward.
fn forces(recording: &Recording, robot: &Robot<f64>, motion: &Motion) -> Option<String> {
    let (speeds, _) = motion.wheels.as_ref()?;
    let turn = motion.gyro.as_ref()?;
    let shown = motion.force.as_ref()?;
    let forward = combined(robot.wheel_radius / 2.0, &speeds[0], robot.wheel_radius / 2.0, &speeds[1]);
    let aside: Vec<f64> = forward.iter().zip(turn).map(|(v, w)| v * w).collect();
    let [along, left] = [0, 1].map(|axis| likeness_of_changes(&shown[axis], &aside, COLUMNS.pushed));
    let [x, y] = [Signal::AccelX, Signal::AccelY].map(|signal| named(recording, signal));
    let hidden = || {
        let share = only_along(shown, &aside)?;
        Some(format!(
            "{x}, averaged over a second, shows {share:.2} times the push of turns, by the speed of the wheels times the yaw \
             rate, and {y} less than half of it; {}",
            turned_by_a_right_angle(share)
        ))
    };
    let (Some(along), Some(left)) = (along, left) else { return hidden() };
    let speeding_up = likeness_of_changes(&shown[0], &slope(&forward, COLUMNS.step), COLUMNS.pushed);
    let turned = speeding_up.is_some_and(|l| l.cosine < -COLUMNS.unlike);
    let (shows, remedy) = if left.cosine < -COLUMNS.alike {
        let also = if turned { " and for accel_x" } else { "" };
        (format!("{y} pushes inward in turns"), format!("write `sign = -1` for it{also} in the mapping"))
    } else if along.cosine.abs() > COLUMNS.alike && left.cosine.abs() < COLUMNS.unlike {
        (format!("{x} shows the push of turns, and {y} does not"), turned_by_a_right_angle(along.cosine))
    } else if left.cosine > COLUMNS.alike && is_in_g(recording, left.ratio) {
        let remedy = "it may be in g: if so, write `unit = \"g\"` for all accelerations in the mapping";
        (format!("{y} shows {:.3} times the push of turns", left.ratio), remedy.to_owned())
    } else {
        return hidden();
    };
    Some(format!(
        "{shows}, by the speed of the wheels times the yaw rate (cosine {:.2} for accel_x, {:.2} for accel_y); {remedy}",
        along.cosine, left.cosine
    ))
}

/// What to do where the forward axis shows this share of the push of turns, and the other one none.
fn turned_by_a_right_angle(share: f64) -> String {
    let sign = if share < 0.0 {
        ", with `sign = -1` for accel_y, and gyro_x and gyro_y likewise"
    } else {
        ", and where the sensor was turned, and not only its columns, with `sign = -1` for accel_x, and gyro_x and gyro_y likewise"
    };
    format!("the sensor is mounted turned by a right angle: exchange the two in the mapping{sign}{OF_THEIR_OWN}")
}

/// The share of the push of turns that the forward axis shows, where its means show it clearly and those of the other axis clearly do
/// not: vibration, which hides it from row to row, is none of a mean.
fn only_along(shown: &Sides, aside: &[f64]) -> Option<f64> {
    let [along, left] = [&shown[0], &shown[1]].map(|axis| share_of(axis, aside));
    let ([along, error], [left, left_error]) = (along?, left?);
    let (least, most) = (COLUMNS.little, 1.0 / COLUMNS.little);
    let is_along = along.abs() - COLUMNS.clear * error > 0.0 && (least..most).contains(&along.abs());
    (is_along && left.abs() + COLUMNS.clear_of_little * left_error < least).then_some(along)
}

/// The share of what is expected that a signal shows, and its error, by the line of least squares through their means; nothing where
/// what is expected hardly changes.
fn share_of(shown: &[f64], expected: &[f64]) -> Option<[f64; 2]> {
    let rows = (COLUMNS.mean / COLUMNS.step).round() as usize;
    let means = |values: &[f64]| -> Vec<f64> {
        values.chunks_exact(rows).map(|chunk| mean(chunk.iter().copied()).unwrap_or(f64::NAN)).collect()
    };
    let pairs: Vec<[f64; 2]> = means(expected).into_iter().zip(means(shown)).map(|(a, b)| [a, b]).collect();
    let pairs: Vec<[f64; 2]> = pairs.into_iter().filter(|[a, b]| a.is_finite() && b.is_finite()).collect();
    let [x, y] = [0, 1].map(|k| mean(pairs.iter().map(|pair| pair[k])));
    let (x, y) = (x?, y?);
    let sums = pairs.iter().map(|[a, b]| [(a - x).powi(2), (a - x) * (b - y), (b - y).powi(2)]);
    let [square, product, of_shown] = sums.fold([0.0; 3], |s, d| [s[0] + d[0], s[1] + d[1], s[2] + d[2]]);
    if pairs.len() < COLUMNS.rows || square < pairs.len() as f64 * COLUMNS.pushed.powi(2) {
        return None;
    }
    let share = product / square;
    let left = (of_shown - share * product).max(0.0) / (pairs.len() - 2) as f64;
    Some([share, (left / square).sqrt()])
}

/// Whether a specific force that is too small by this ratio is in units of gravity: an upward accelerometer does not show otherwise.
fn is_in_g(recording: &Recording, ratio: f64) -> bool {
    let Some(g) = parse_unit("g").map(|unit| unit.factor) else { return false };
    let up = recording.get(Signal::AccelZ).and_then(|channel| median(channel.values().iter().copied()));
    up.is_none_or(|up| up < g / COLUMNS.unit) && (ratio * g).ln().abs() < COLUMNS.near.ln()
}

#[cfg(test)]
mod tests;
