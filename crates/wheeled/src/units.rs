//! Units and signs of gyro, wheels and pose, checked against each other: a column in another unit than the robot file says would be
//! taken for a robot of other size and weight.

use std::f64::consts::{FRAC_PI_2, TAU};

use inference::robust::median;
use robot_model::wheels::Wheel;

use crate::drive::{Drive, STEP};
use crate::robot::AnyWheels;
use crate::settings::{SETTINGS, Units};

const RULES: Units = SETTINGS.units;

/// What is wrong with a unit or a sign, and what to do; `None` where all agree or nothing tells.
pub(crate) fn mistaken(drive: &Drive, robot: &AnyWheels, is_speed: bool) -> Option<String> {
    let largest = drive.steering.iter().flat_map(|s| (0..drive.steps).map(|k| s.mean(STEP * k as f64).abs()));
    let largest = largest.fold(0.0, f64::max);
    if largest > TAU {
        return Some(format!(
            "a steering angle goes to {largest:.0} rad: it seems to be in degrees; write angle_unit = \"deg\" under [columns], or \
             angle_per_unit under its [[joint]]"
        ));
    }
    let degrees = 1.0_f64.to_degrees();
    let turning = [
        (degrees, "the gyro is in degrees per second; write gyro_unit = \"deg/s\" under [columns]"),
        (1.0 / degrees, "yaw is in degrees; write angle_unit = \"deg\" under [columns]"),
        (-1.0, "yaw, or the gyro, is positive to the right; change the sign of its column"),
    ];
    if let Some((factor, what)) = unit(median(turns(drive)), &turning) {
        return Some(format!(
            "by the gyro the robot turns {factor:.3} times as fast as by the pose: it seems that {what}"
        ));
    }
    let speeds = [
        (degrees, "speeds are in degrees per second; write speed_unit = \"deg/s\" under [columns]"),
        (60.0 / TAU, "speeds are in turns per minute; write speed_unit = \"rpm\" under [columns]"),
        (1.0 / TAU, "speeds are in turns per second; write speed_unit = \"turn/s\" under [columns]"),
    ];
    let angles = [
        (degrees, "angles of wheels are in degrees; write angle_unit = \"deg\" under [columns]"),
        (1.0 / TAU, "angles of wheels are in turns; convert their columns to rad"),
    ];
    let both = [
        (
            1.0 / degrees,
            "wheels are in rad where the robot file says degrees; correct speed_unit or angle_unit under [columns]",
        ),
        (1.0 / 1e3, "x and y are in millimetres; convert their columns to m"),
        (1.0 / 100.0, "x and y are in centimetres; convert their columns to m"),
        (-1.0, "wheels turn the other way; write direction_deg = 180 for them, or change the sign of their columns"),
    ];
    let of_wheels: Vec<_> = if is_speed { &speeds[..] } else { &angles[..] }.iter().chain(&both).copied().collect();
    let (factor, what) = unit(median(rolls(drive, robot)), &of_wheels)?;
    Some(format!("by its wheels the robot drives {factor:.4} times as far as by the pose: it seems that {what}"))
}

/// The reading of a ratio, if it is that of two units.
fn unit(found: Option<f64>, all: &[(f64, &'static str)]) -> Option<(f64, &'static str)> {
    let found = found?;
    let is_near = |factor: f64| found / factor > 0.0 && (found / factor).ln().abs() < RULES.near.ln();
    all.iter().find(|(factor, _)| is_near(*factor)).map(|(_, what)| (found, *what))
}

/// First and last step of stretches in which everything was seen.
fn stretches(drive: &Drive) -> impl Iterator<Item = [usize; 2]> + '_ {
    let length = (RULES.stretch / STEP).round() as usize;
    let seen = |k: usize| drive.pose.get(k).is_some_and(|p| p.iter().all(|x| x.is_finite()));
    let ends = (0..drive.steps / length).map(move |k| [k * length, (k + 1) * length]);
    ends.filter(move |[from, until]| seen(*from) && seen(*until) && drive.is_whole(*from, *until))
}

/// Turns by the gyro over those by the pose; none where too few stretches tell.
fn turns(drive: &Drive) -> Vec<f64> {
    let Some(gyro) = &drive.gyro else { return Vec::new() };
    let of = |[from, until]: [usize; 2]| {
        let by_pose = drive.pose[until][2] - drive.pose[from][2];
        let by_gyro = gyro.sum(STEP * until as f64) - gyro.sum(STEP * from as f64);
        (by_pose.abs() > RULES.turning * RULES.stretch).then_some(by_gyro / by_pose)
    };
    enough(stretches(drive).filter_map(of).collect())
}

/// Ways by wheels that are not steered over those by the pose; none where too few stretches tell.
fn rolls(drive: &Drive, robot: &AnyWheels) -> Vec<f64> {
    let mut out = Vec::new();
    for (turning, &k) in drive.wheels.iter().zip(&robot.measured) {
        let Some(wheel) = robot.plant.wheels[k].filter(|w| w.joint.is_none()) else { continue };
        for [from, until] in stretches(drive) {
            let way = way(drive, robot, &wheel, [from, until]);
            let rolled = wheel.radius * (turning.sum(STEP * until as f64) - turning.sum(STEP * from as f64));
            if way.abs() > RULES.moving * RULES.stretch {
                out.push(rolled / way);
            }
        }
    }
    enough(out)
}

fn enough(ratios: Vec<f64>) -> Vec<f64> {
    if ratios.len() < RULES.stretches { Vec::new() } else { ratios }
}

/// How far a wheel rolls by the pose: along its direction, or as its rollers leave it no other way, m.
fn way(drive: &Drive, robot: &AnyWheels, wheel: &Wheel<f64>, [from, until]: [usize; 2]) -> f64 {
    let [a, b] = [drive.pose[from], drive.pose[until]];
    let turned = b[2] - a[2];
    let [x, y, mounted] = robot.point;
    let (sin, cos) = (a[2] + 0.5 * turned - mounted).sin_cos();
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    // Of the wheel's contact, in the robot.
    let [px, py] = [wheel.place[0] - x, wheel.place[1] - y];
    let moved = [cos * dx + sin * dy - py * turned, cos * dy - sin * dx + px * turned];
    let along = |angle: f64| moved[0] * angle.cos() + moved[1] * angle.sin();
    match wheel.roller {
        // The axle of a roller takes along what the wheel's turning and the body's motion have in common.
        Some(roller) => -along(wheel.direction + FRAC_PI_2 + roller) / roller.sin(),
        None => along(wheel.direction),
    }
}

#[cfg(test)]
mod tests {
    use odometry::file::Series;

    use crate::drive::{Drive, Measured};
    use crate::file::{BUILT_IN, RobotFile};

    /// A car with rear wheels of 0.1 m, 0.4 m apart, that weaves: yaw, gyro, speeds and place times these factors.
    fn weaving([yaw, gyro, speeds, place]: [f64; 4]) -> Result<Drive, String> {
        let robot = RobotFile::parse("car", BUILT_IN[1].1).expect("a robot").robot;
        let mut pose = [0.0_f64; 3];
        let mut of = Measured {
            torque: vec![Series::default()],
            steering: vec![Series::default()],
            is_speed: true,
            ..Measured::default()
        };
        of.wheels = vec![Series::default(); 2];
        for k in 0..2000_u32 {
            let t = 0.01 * f64::from(k);
            let (speed, rate) = (0.8 + 0.3 * t.sin(), 0.6 * (0.7 * t).sin());
            let add = |series: &mut Series, value: f64| {
                series.time.push(t);
                series.value.push(value);
            };
            add(&mut of.torque[0], 1.0);
            add(&mut of.steering[0], 0.1);
            add(&mut of.gyro, gyro * rate);
            for (wheel, side) in of.wheels.iter_mut().zip([-1.0, 1.0]) {
                add(wheel, speeds * (speed + 0.2 * side * rate) / 0.1);
            }
            for (series, (value, factor)) in of.pose.iter_mut().zip(pose.iter().zip([place, place, yaw])) {
                add(series, value * factor);
            }
            pose =
                [pose[0] + 0.01 * speed * pose[2].cos(), pose[1] + 0.01 * speed * pose[2].sin(), pose[2] + 0.01 * rate];
        }
        Drive::new("a", &robot, &of, false).map_err(|e| e.to_string())
    }

    #[test]
    fn a_column_in_another_unit_or_the_other_way_round_is_told_with_the_line_that_mends_it() {
        assert!(weaving([1.0; 4]).is_ok());
        let degrees = 1.0_f64.to_degrees();
        for (factors, told) in [
            ([1.0, degrees, 1.0, 1.0], "gyro_unit = \"deg/s\""),
            ([degrees, 1.0, 1.0, 1.0], "yaw is in degrees; write angle_unit"),
            ([1.0, -1.0, 1.0, 1.0], "positive to the right"),
            ([1.0, 1.0, degrees, 1.0], "speed_unit = \"deg/s\""),
            ([1.0, 1.0, 9.549, 1.0], "speed_unit = \"rpm\""),
            ([1.0, 1.0, 1.0 / std::f64::consts::TAU, 1.0], "speed_unit = \"turn/s\""),
            ([1.0, 1.0, 1.0 / degrees, 1.0], "where the robot file says degrees"),
            ([1.0, 1.0, 1.0, 1e3], "x and y are in millimetres"),
            ([1.0, 1.0, -1.0, 1.0], "direction_deg = 180"),
        ] {
            let refused = weaving(factors).expect_err(told);
            assert!(refused.contains(told), "{refused}");
        }
    }

    #[test]
    fn a_wheel_whose_rollers_take_it_along_sideways_rolls_as_far_as_they_say() {
        let robot = RobotFile::parse("mecanum", BUILT_IN[3].1).expect("a robot").robot;
        let mut of = Measured::default();
        of.pose = [0.0, 0.5, 0.0].map(|rate| Series {
            time: (0..200).map(|k| 0.02 * f64::from(k)).collect(),
            value: (0..200).map(|k| 0.02 * f64::from(k) * rate).collect(),
        });
        of.torque = vec![of.pose[0].clone(); robot.motors.len()];
        let drive = Drive::new("a", &robot, &of, false).expect("a drive");
        // To the left: wheels of one diagonal forward, of the other backward.
        let ways: Vec<f64> =
            robot.plant.wheels.iter().flatten().map(|w| super::way(&drive, &robot, w, [0, 50]).signum()).collect();
        let of_x = |k: usize| {
            let w = robot.plant.wheels[k].expect("a wheel");
            if w.place[0] * w.place[1] > 0.0 { -1.0 } else { 1.0 }
        };
        assert_eq!(ways, (0..4).map(of_x).collect::<Vec<f64>>());
    }
}
