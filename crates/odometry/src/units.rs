//! Units that the file does not state: guessed from what wheels and pose say together.

use hierarchical_fit::CaseError;
use std::f64::consts::TAU;

use crate::drive::{Drive, WheelData};
use crate::error::OdometryError;
use crate::kinematics::{Geometry, Kinematics};
use crate::pose_jumps::without_jumps;
use crate::settings::{DriveRules, SETTINGS};
use crate::wheel::WheeledRobot;
use crate::yaw::{turn_while_unseen, unwrap_yaw};

const RULES: DriveRules = SETTINGS.drive;
const DEGREES_OF_A_TURN: f64 = TAU.to_degrees();

/// Sets the units of a drive to metres and radians, where wheels and pose permit one reading only, and tells so.
pub(crate) fn guess(drive: &mut Drive, robot: &WheeledRobot, data: WheelData) -> Result<(), OdometryError> {
    if !(0..drive.pose.len()).any(|k| drive.is_seen(k)) {
        let what = "neither a pose nor a gyro is ever seen; name columns of one of them that hold values".to_owned();
        return Err(OdometryError::Case(CaseError::Drive { drive: drive.name.clone(), what }));
    }
    steering(drive);
    if drive.heading_only {
        drive.take_bias_off();
        turns_in_degrees(drive, robot, ["the gyro", "it is taken to be in degrees per second"]);
        return Ok(());
    }
    // Wheels before yaw: both are measured against each other, and degrees of both would cancel, but not in the way.
    wheels(drive, robot, data);
    unwrap_yaw(drive, DEGREES_OF_A_TURN);
    if !turns_in_degrees(drive, robot, ["yaw", "yaw is taken to be in degrees"]) {
        unwrap_yaw(drive, TAU);
    }
    turn_while_unseen(drive, robot);
    length(drive, robot)?;
    let told = without_jumps(&drive.time, &mut drive.pose).map(|what| format!("recording '{}': {what}", drive.name));
    drive.told.extend(told);
    Ok(())
}

/// Takes a heading that turns by 57.3 times what the wheels say to be in degrees, and whether it does; `what` turns, and how that is
/// told.
fn turns_in_degrees(drive: &mut Drive, robot: &WheeledRobot, [what, taken]: [&str; 2]) -> bool {
    let turned = motions(drive, robot).map(|m| m[2].abs()).sum::<f64>();
    let seen = shown(drive).map(|m| m[2].abs()).sum::<f64>();
    let is_one = turned > RULES.turned && is_near(seen / turned, 1.0_f64.to_degrees(), RULES.degrees_tolerance);
    if is_one {
        drive.pose.iter_mut().for_each(|pose| pose[2] = pose[2].to_radians());
        let reason = format!("{what} turns by {seen:.0} where the wheels turn the robot by {turned:.1} rad");
        tell(drive, &reason, &format!("{taken}; state angle_unit"));
    }
    is_one
}

fn tell(drive: &mut Drive, reason: &str, taken: &str) {
    drive.told.push(format!("recording '{}': {reason}: {taken} in the robot file", drive.name));
}

fn is_near(factor: f64, expected: f64, tolerance: f64) -> bool {
    (factor / expected).ln().abs() < tolerance.ln()
}

/// Takes a steering angle that turns farther than once around for degrees.
fn steering(drive: &mut Drive) {
    let largest = |s: &Vec<f64>| s.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let Some(angle) = drive.steering.as_ref().map(largest).filter(|a| *a > TAU) else { return };
    drive.steering.iter_mut().flatten().for_each(|s| *s = s.to_radians());
    tell(drive, &format!("steering goes to {angle:.0}"), "it is taken to be in degrees; state angle_unit");
}

/// Takes wheels that roll by a familiar factor off what the pose moves for degrees, turns or turns per minute.
fn wheels(drive: &mut Drive, robot: &WheeledRobot, data: WheelData) {
    if matches!(data, WheelData::Counts | WheelData::Counter) {
        return;
    }
    let rolled: f64 = motions(drive, robot).map(|m| m[0].hypot(m[1])).sum();
    let way: f64 = shown(drive).map(|m| m[0].hypot(m[1])).sum();
    if way < RULES.way {
        return;
    }
    let minute = 60.0;
    let readings = [
        ("degrees", 1.0_f64.to_radians(), RULES.degrees_tolerance),
        ("turns", TAU, RULES.turns_tolerance),
        ("turns per minute", TAU / minute, RULES.turns_tolerance),
    ];
    let kinds = if data == WheelData::Speed { 3 } else { 2 };
    for (unit, radians, tolerance) in readings.into_iter().take(kinds) {
        if is_near(way / rolled, radians, tolerance) {
            drive.turns.iter_mut().flatten().for_each(|turn| *turn *= radians);
            let unit = match (unit, data) {
                ("degrees", WheelData::Speed) => "degrees per second",
                ("turns", WheelData::Speed) => "turns per second",
                _ => unit,
            };
            tell(
                drive,
                &format!("the wheels roll {rolled:.2} m where the pose moves by {way:.2} m"),
                &format!(
                    "this is a guess that the wheels are in {unit}; convert the columns to radians, or correct the radius"
                ),
            );
            return;
        }
    }
}

/// Motion of the body over stretches, as the wheels have it.
fn motions(drive: &Drive, robot: &WheeledRobot) -> impl Iterator<Item = [f64; 3]> {
    let geometry = Geometry::given(robot);
    let kinematics = Kinematics::new(robot, &geometry);
    let steering = |row: usize| drive.steering.as_ref().map_or(0.0, |s| s[row]);
    let rows: Vec<[f64; 3]> =
        (0..drive.time.len()).map(|row| kinematics.motion(&drive.turns[row], steering(row))).collect();
    let sum =
        |(from, to): (usize, usize)| [0, 1, 2].map(|axis| rows[from + 1..=to].iter().map(|m| m[axis]).sum::<f64>());
    stretches(drive).into_iter().map(sum).collect::<Vec<_>>().into_iter()
}

/// The same as the pose has it.
fn shown(drive: &Drive) -> impl Iterator<Item = [f64; 3]> {
    let moved = |(from, to): (usize, usize)| [0, 1, 2].map(|axis| drive.pose[to][axis] - drive.pose[from][axis]);
    stretches(drive).into_iter().map(moved).collect::<Vec<_>>().into_iter()
}

/// Rows between which noise of the pose is little beside its motion.
fn stretches(drive: &Drive) -> Vec<(usize, usize)> {
    let mut out = Vec::new();
    let mut from: Option<usize> = None;
    for row in (0..drive.time.len()).filter(|&row| drive.is_seen(row)) {
        match from {
            Some(start) if drive.time[row] - drive.time[start] < RULES.stretch => {}
            Some(start) => {
                out.push((start, row));
                from = Some(row);
            }
            None => from = Some(row),
        }
    }
    out
}

/// Tells a pose in millimetres by its way against that of the wheels.
fn length(drive: &mut Drive, robot: &WheeledRobot) -> Result<(), OdometryError> {
    let seen: Vec<[f64; 3]> = (0..drive.pose.len()).filter(|&k| drive.is_seen(k)).map(|k| drive.pose[k]).collect();
    let Some(start) = seen.first() else { return Ok(()) };
    let measured = robot.measured();
    let way = |row: &Vec<f64>| {
        row.iter().zip(&measured).map(|(t, &w)| (t * robot.wheels[w].radius).abs()).fold(0.0, f64::max)
    };
    let rolled: f64 = drive.turns.iter().map(way).sum();
    let reach = seen.iter().map(|p| (p[0] - start[0]).hypot(p[1] - start[1])).fold(0.0, f64::max);
    let wheels_reach = rolled.max(RULES.way);
    if reach < RULES.unit * wheels_reach {
        return Ok(());
    }
    let factor = reach / wheels_reach;
    // A reach is at most the way: a pose in millimetres has up to a thousand times the way in metres.
    if factor <= RULES.unit_tolerance * RULES.milli && RULES.milli <= RULES.unit_tolerance * RULES.unit * factor {
        for pose in &mut drive.pose {
            pose[0] /= RULES.milli;
            pose[1] /= RULES.milli;
        }
        drive.told.push(format!(
            "recording '{}': the pose moves by {reach:.0} where the wheels roll {rolled:.2} m: it is taken to be in \
             millimetres; state it in the robot file, under [columns]: length_unit = \"mm\"",
            drive.name
        ));
        return Ok(());
    }
    let what = format!(
        "the pose moves by {reach:.0} where the wheels roll {rolled:.2} m; state its unit in the robot file, under [columns]: length_unit, or correct \
         the radius or counts_per_turn"
    );
    Err(OdometryError::Case(CaseError::Drive { drive: drive.name.clone(), what }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const RATE: [f64; 2] = [1.0, 2.0];

    /// A differential drive on a circle: wheels at 1 and 2 rad/s for 40 s.
    fn circle(data: WheelData, wheel: impl Fn(f64) -> f64, yaw: impl Fn(f64) -> f64) -> Drive {
        let robot = WheeledRobot::differential(0.05, 0.3);
        let time: Vec<f64> = (0..800).map(|k| 0.05 * f64::from(k)).collect();
        let (speed, turning) = (0.05 * 1.5, 0.05 / 0.3);
        let wheels = RATE.map(|rate| time.iter().map(|t| wheel(rate * t)).collect::<Vec<f64>>());
        let speeds = RATE.map(|rate| vec![wheel(rate); 800]);
        let pose = time.iter().map(|t| {
            let a = turning * t;
            [speed / turning * a.sin(), speed / turning * (1.0 - a.cos()), yaw(a)]
        });
        let columns = if data == WheelData::Speed { speeds } else { wheels };
        Drive::new("a", &robot, time.clone(), (data, &columns), None, pose.collect()).expect("a drive")
    }

    fn wrapped(angle: f64, turn: f64) -> f64 {
        angle - turn * (angle / turn).round()
    }

    fn assert_same(found: &Drive, said: &str) {
        let plain = circle(WheelData::Angle, |a| a, |a| a);
        assert!(plain.told.is_empty(), "{:?}", plain.told);
        assert!(found.told.iter().any(|t| t.contains(said)), "{:?}", found.told);
        for (a, b) in found.turns.iter().flatten().zip(plain.turns.iter().flatten()) {
            approx::assert_relative_eq!(*a, *b, epsilon = 1e-9);
        }
        for (a, b) in found.pose.iter().flatten().zip(plain.pose.iter().flatten()) {
            approx::assert_relative_eq!(*a, *b, epsilon = 1e-9);
        }
    }

    #[test]
    fn yaw_in_degrees_is_told_whether_it_wraps_around_or_not() {
        assert_same(&circle(WheelData::Angle, |a| a, f64::to_degrees), "yaw is taken to be in degrees");
        let yaw = |a: f64| wrapped(a.to_degrees(), 360.0);
        assert_same(&circle(WheelData::Angle, |a| a, yaw), "yaw is taken to be in degrees");
        let radians = circle(WheelData::Angle, |a| a, |a| wrapped(a, TAU));
        assert!(radians.told.is_empty(), "{:?}", radians.told);
    }

    #[test]
    fn wheels_in_degrees_turns_or_turns_per_minute_are_guessed_with_the_reason() {
        let degrees = circle(WheelData::Angle, f64::to_degrees, |a| a);
        assert_same(&degrees, "the wheels are in degrees;");
        assert!(degrees.told[0].contains("the wheels roll 16") && degrees.told[0].contains("the pose moves by 2."));
        assert_same(&circle(WheelData::Angle, |a| a / TAU, |a| a), "the wheels are in turns;");
        assert_same(&circle(WheelData::Speed, f64::to_degrees, |a| a), "in degrees per second;");
        assert_same(&circle(WheelData::Speed, |a| a * 60.0 / TAU, |a| a), "in turns per minute;");
        // A gear of five is a cause and no unit.
        assert!(circle(WheelData::Angle, |a| a / 5.0, |a| a).told.is_empty());
    }

    #[test]
    fn joint_angles_that_wrap_around_are_unwrapped() {
        assert_same(&circle(WheelData::Angle, |a| wrapped(a, TAU), |a| a), "the angle of wheel 'left' wraps around");
        let degrees = circle(WheelData::Angle, |a| wrapped(a.to_degrees(), 360.0), |a| a);
        assert_same(&degrees, "wraps around at 360");
    }
}
