//! Drives that would tell the remaining answers apart, each as the robot of the answer would drive it.

use hierarchical_fit::Kind;
use hierarchical_fit::menu::{Reach, menu};
use odometry::file::Series;
use odometry::rates::slope;
use robot_model::wheels::{MOST, State};
use verdict::{Advice, Manoeuvre};

use hierarchical_fit::Solved;

use crate::drive::{Drive, Measured, STEP};
use crate::model::Model;
use crate::robot::AnyWheels;
use crate::rows::Shown;
use crate::settings::{NextDrive, SETTINGS};

const RULES: NextDrive = SETTINGS.next_drive;

/// Advises on the next drive of so many seconds.
pub(crate) fn advise(solved: &Solved<Shown<'_>>, length: f64) -> Advice {
    let model = &solved.data.model;
    let robot = model.robot.as_ref();
    let at = Model::at(robot, &model.all, &solved.fit.theta);
    let made: Vec<&Drive> = solved.data.drives.iter().map(|shown| shown.drive).collect();
    let did: Vec<[f64; 2]> = made.iter().flat_map(|drive| twists(&at, robot, drive)).collect();
    let goes_sideways = robot.plant.wheels.iter().flatten().all(|wheel| wheel.roller.is_some());
    let Some(reach) = Reach::of(&did, goes_sideways) else {
        return Advice::withheld(
            "the robot hardly moved in these drives, so that nobody knows how fast it can be driven",
        );
    };

    let has_pose = made.iter().any(|drive| drive.has_pose());
    let has_gyro = made.iter().any(|drive| drive.gyro.is_some());
    let driven = |manoeuvre: Manoeuvre| {
        let measured = driven(&at, robot, &manoeuvre, [has_pose, has_gyro]);
        Drive::new(&manoeuvre.name, robot, &measured, false).ok().map(|drive| (manoeuvre, drive))
    };
    let drives: Vec<(Manoeuvre, Drive)> = menu(reach, length).into_iter().filter_map(driven).collect();
    let shown = drives.iter().map(|(manoeuvre, drive)| (manoeuvre.clone(), Shown::new(drive, robot))).collect();
    solved.advise(shown, read)
}

/// What readings of a kind are, with their unit.
pub(crate) fn read(kind: Kind) -> (String, &'static str) {
    let (seconds, lever) = (SETTINGS.windows.length, SETTINGS.windows.lever);
    match kind {
        Kind::Pose => (format!("the place (or the heading, at a lever of {lever} m) {seconds} s ahead"), "m"),
        Kind::Gyro => ("the yaw rate".to_owned(), "rad/s"),
        Kind::Encoder => ("the speed of the wheels".to_owned(), "m/s"),
    }
}

/// Speed and yaw rate at instants of a drive, by the pose where it was measured, else as wheels and gyro show them.
fn twists(at: &Model<f64>, robot: &AnyWheels, drive: &Drive) -> Vec<[f64; 2]> {
    let every = (RULES.looked / STEP).round() as usize;
    let half = (SETTINGS.grid.smoothing / STEP).round() as usize;
    let of = |k: usize| {
        if drive.has_pose() {
            let rates = slope(&drive.pose, [k.checked_sub(half)?, k + half], k, STEP)?;
            let s = at.of_pose(drive, robot, k, (drive.pose[k], rates));
            return Some([signed(at.plant.velocity_of(&s, [0.0; 2])), s.yaw_rate]);
        }
        let mut s = State::default();
        at.roll_by_wheels(drive, robot, k, &mut s);
        Some([signed(at.plant.velocity_of(&s, [0.0; 2])), s.yaw_rate])
    };
    (half..drive.steps.saturating_sub(half)).step_by(every.max(1)).filter_map(of).collect()
}

/// Speed, m/s, below zero backward.
fn signed([ahead, left]: [f64; 2]) -> f64 {
    ahead.hypot(left).copysign(ahead)
}

/// What would be recorded of a drive: motors follow the speeds at which their wheels roll where the body moves as wanted.
fn driven(at: &Model<f64>, robot: &AnyWheels, m: &Manoeuvre, [has_pose, has_gyro]: [bool; 2]) -> Measured {
    let steps = (m.length() / STEP).round() as usize;
    let time: Vec<f64> = (0..steps).map(|k| STEP * k as f64).collect();
    let of = |value: Vec<f64>| Series { time: time.clone(), value };
    let gains = gains(robot);
    let (mut s, mut torques, mut angles, mut turned, mut poses) =
        (State::default(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for k in 0..steps {
        let [ahead, left, turning] = m.wanted_twist(STEP * k as f64);
        let steering = steering(robot, [ahead, left, turning], s.steering);
        let mut wanted = State { steering: s.steering, ..s };
        at.plant.move_body(&mut wanted, [ahead, left], turning);
        at.plant.roll_wheels(&mut wanted);
        let torque = torques_for(robot, &gains, &wanted.wheel_speed, &s.wheel_speed);

        let [x, y, heading] = at.tracked(&s);
        poses.push([x, y, heading + at.direction]);
        turned.push((s.wheel_angle, s.yaw_rate));
        torques.push(torque);
        angles.push(steering);
        for _ in 0..SETTINGS.grid.substeps {
            at.plant.step(&mut s, &torque, &steering);
        }
    }
    let column = |all: &[[f64; MOST]], k: usize| of(all.iter().map(|row| row[k]).collect());
    let pose = |axis: usize| of(poses.iter().map(|p| p[axis]).collect());
    let [scale, bias] = at.gyro;
    Measured {
        torque: (0..robot.motors.len()).map(|k| column(&torques, k)).collect(),
        steering: (0..robot.joints.len()).map(|k| column(&angles, k)).collect(),
        wheels: robot.measured.iter().map(|&k| of(turned.iter().map(|(angle, _)| angle[k]).collect())).collect(),
        is_speed: false,
        gyro: if has_gyro {
            of(turned.iter().map(|(_, rate)| scale * rate + bias).collect())
        } else {
            Series::default()
        },
        pose: if has_pose { [0, 1, 2].map(pose) } else { Default::default() },
    }
}

/// Torque per error of a motor's speed, N m s/rad: what it turns, with its share of the robot's mass, follows within [`RULES`]' time.
fn gains(robot: &AnyWheels) -> Vec<f64> {
    let motors = robot.motors.len();
    let wheels = |motor: usize| robot.plant.wheels.iter().flatten().filter(move |w| w.motor == Some(motor));
    let of = |motor: usize| {
        let inertia: f64 = wheels(motor).map(|w| w.inertia).sum();
        let radius = wheels(motor).map(|w| w.radius).fold(0.0, f64::max);
        let own = robot.plant.motors[motor].map_or(0.0, |m| m.inertia);
        (own + inertia + robot.plant.mass * radius * radius / motors as f64) / RULES.follows
    };
    (0..motors).map(of).collect()
}

/// Torque of each motor towards the mean speed at which its wheels should turn.
fn torques_for(robot: &AnyWheels, gains: &[f64], wanted: &[f64; MOST], now: &[f64; MOST]) -> [f64; MOST] {
    let mut out = [0.0; MOST];
    for (motor, gain) in gains.iter().enumerate() {
        let own = (0..MOST).filter(|&k| robot.plant.wheels[k].is_some_and(|w| w.motor == Some(motor)));
        out[motor] = gain * inference::robust::mean(own.map(|k| wanted[k] - now[k])).unwrap_or(0.0);
    }
    out
}

/// Angles at which steered wheels roll where the body moves so; as they are where it stands.
fn steering(robot: &AnyWheels, [ahead, left, turning]: [f64; 3], now: [f64; MOST]) -> [f64; MOST] {
    let mut out = now;
    for (joint, angle) in out.iter_mut().enumerate() {
        let Some(own) = robot.plant.joints[joint] else { continue };
        let direction =
            robot.plant.wheels.iter().flatten().find(|w| w.joint == Some(joint)).map_or(0.0, |w| w.direction);
        let [x, y] = own.place;
        let along = [ahead - turning * y, left + turning * x];
        if along[0].hypot(along[1]) > RULES.stands {
            // A wheel rolls backward as well as forward.
            let turned = (2.0 * (along[1].atan2(along[0]) - direction)).sin_cos();
            *angle = 0.5 * turned.0.atan2(turned.1);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::constants::constants;
    use crate::file::{BUILT_IN, RobotFile};
    use crate::rows::Constants;

    #[test]
    fn built_in_robots_drive_what_the_menu_asks_for_as_far_as_their_wheels_go() {
        for (name, text) in BUILT_IN {
            let robot = RobotFile::parse(name, text).expect("a robot").robot;
            let model = Constants { all: constants(&robot, true, true), robot: Arc::new(robot) };
            let robot = model.robot.as_ref();
            let at = Model::at(robot, &model.all, &vec![0.0; model.all.len()]);
            let goes_sideways = robot.plant.wheels.iter().flatten().all(|wheel| wheel.roller.is_some());
            let reach = Reach { speed: 0.6, turning: 0.3, curvature: 0.4, spins: false, backs: true, goes_sideways };
            for m in menu(reach, 12.0) {
                let measured = driven(&at, robot, &m, [true; 2]);
                let drive = Drive::new(&m.name, robot, &measured, false).unwrap_or_else(|e| panic!("{name}: {e}"));
                let (mut off, mut asked) = (0.0, 0.0);
                for k in (10..drive.steps - 10).step_by(5) {
                    let rates = slope(&drive.pose, [k - 5, k + 5], k, STEP).expect("a pose");
                    let [ahead, left] = at.of_origin(drive.pose[k][2], rates);
                    let [v, w, turning] = m.wanted_twist(STEP * k as f64);
                    off += (ahead - v).powi(2) + (left - w).powi(2);
                    asked += v * v + w * w + turning * turning;
                }
                assert!(off < 0.2 * asked, "{name}, {}: {off} of {asked}", m.name);
            }
        }
    }

    #[test]
    fn windows_begin_at_the_velocity_that_wheels_show_where_the_pose_is_noisy_and_at_its_own_where_it_is_not() {
        let (name, text) = BUILT_IN.iter().find(|b| b.0 == "torque-omni-3").expect("built in");
        let mut robot = RobotFile::parse(name, text).expect("a robot").robot;
        // On a slope, which pulls another way as the robot turns.
        robot.plant.ground.slope = [-0.4, 0.3];
        let all = constants(&robot, true, true);
        let at = Model::at(&robot, &all, &vec![0.0; all.len()]);
        let reach = Reach { speed: 0.6, turning: 0.3, curvature: 0.4, spins: true, backs: true, goes_sideways: true };
        let m = menu(reach, 12.0).into_iter().find(|m| m.name == "slalom").expect("on the menu");
        let whole = driven(&at, &robot, &m, [true; 2]);
        let drive = |sigma: f64| {
            let mut of = whole.clone();
            for (axis, series) in of.pose[..2].iter_mut().enumerate() {
                // Of unit variance, and in no order.
                let drawn = |k: usize| ((k + 1000 * axis) as f64 * 12.9898).sin() * 43758.5453;
                let off = |k: usize| sigma * 12.0_f64.sqrt() * (drawn(k).rem_euclid(1.0) - 0.5);
                series.value.iter_mut().enumerate().for_each(|(k, value)| *value += off(k));
            }
            for series in &mut of.pose {
                series.value = series.value.iter().step_by(2).copied().collect();
                series.time = series.time.iter().step_by(2).copied().collect();
            }
            Drive::new("a", &robot, &of, false).expect("a drive")
        };
        let exact = drive(0.0);
        let begun = |drive: &Drive, k: usize| {
            let rates = slope(&drive.pose, [k - 5, k + 5], k, STEP).expect("a pose");
            let of_pose = at.of_origin(drive.pose[k][2], rates);
            let s = at.of_pose(drive, &robot, k, (drive.pose[k], rates));
            [of_pose, at.plant.velocity_of(&s, [0.0; 2])]
        };
        let off = |drive: &Drive| {
            let each = (60..drive.steps - 60).step_by(7).map(|k| {
                let [_, right] = begun(&exact, k);
                begun(drive, k).map(|[x, y]| (x - right[0]).hypot(y - right[1]))
            });
            let each: Vec<[f64; 2]> = each.collect();
            [0, 1].map(|i| inference::robust::rms(each.iter().map(|e| e[i])).expect("windows"))
        };
        let [by_pose, with_wheels] = off(&drive(0.003));
        assert!(by_pose > 0.01 && with_wheels < 0.6 * by_pose, "{by_pose} m/s by the pose, {with_wheels} with wheels");
        let [of_pose, _] = off(&exact);
        assert!(of_pose < 5e-3, "wheels move the start by {of_pose} m/s where the pose is good");
    }
}
