//! Angles of casters over a drive: a caster that is dragged the other way takes its time to turn around, so that where it points at the
//! start of a window is what the body did before.

use robot_model::wheels::{MOST_CASTERS, State};

use crate::drive::{Drive, STEP};
use crate::model::Model;
use crate::robot::AnyWheels;
use crate::settings::{Grid, SETTINGS};

const RULES: Grid = SETTINGS.grid;

/// Angle of each caster at the beginning of each step, rad; none of a robot without casters. Each follows from how its pivot moved
/// until then, by the pose or, where none was seen, by wheels and gyro; before the robot moves, it stands as after a drive ahead.
pub(crate) fn angles(drive: &Drive, robot: &AnyWheels) -> Vec<[f64; MOST_CASTERS]> {
    if robot.plant.casters.iter().flatten().next().is_none() {
        return Vec::new();
    }
    let model: Model<f64> = Model::at(robot, &[], &[]);
    let mut s = State::default();
    model.plant.set_velocity(&mut s, [1.0, 0.0]);
    let mut out = Vec::with_capacity(drive.steps);
    for step in 0..drive.steps {
        out.push(s.caster);
        let kept = s.caster;
        if !move_by_pose(&model, drive, step, &mut s) && drive.is_whole(step.saturating_sub(1), step + 1) {
            model.roll_by_wheels(drive, robot, step, &mut s);
        }
        s.caster = kept;
        model.plant.swing_casters(&mut s, STEP);
    }
    out
}

/// Moves the body as its pose did shortly before a step; whether it was seen there.
fn move_by_pose(model: &Model<f64>, drive: &Drive, step: usize, s: &mut State<f64>) -> bool {
    let past = (RULES.smoothing / STEP).round() as usize;
    let [Some(from), Some(to)] = [step.checked_sub(past), Some(step)].map(|k| drive.pose.get(k?).copied()) else {
        return false;
    };
    let seconds = STEP * past as f64;
    let rates = [0, 1, 2].map(|axis| (to[axis] - from[axis]) / seconds);
    if rates.iter().any(|rate| !rate.is_finite()) {
        return false;
    }
    let origin = model.of_origin(0.5 * (from[2] + to[2]), rates);
    model.plant.move_body(s, origin, rates[2]);
    true
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use odometry::file::Series;

    use crate::drive::{Drive, Measured};
    use crate::file::{BUILT_IN, RobotFile};
    use crate::model::Model;

    #[test]
    fn a_caster_turns_around_where_the_robot_turns_back_and_not_at_once() {
        let (_, text) = BUILT_IN[0];
        let text = format!("{text}\n[[caster]]\nplace = [-0.4, 0.05]\ntrail = 0.05\n");
        let robot = RobotFile::parse("robot.toml", &text).expect("a robot").robot;
        // 2 s ahead, then back, at half a metre per second.
        let time: Vec<f64> = (0..400).map(|k| 0.01 * f64::from(k)).collect();
        let series =
            |of: &dyn Fn(f64) -> f64| Series { time: time.clone(), value: time.iter().map(|t| of(*t)).collect() };
        let way = |t: f64| 1.0 - 0.5 * (t - 2.0).abs();
        let none = || series(&|_| 0.0);
        let mut of = Measured { torque: vec![none()], steering: vec![none()], ..Measured::default() };
        of.pose = [series(&|t| way(t) * 0.3_f64.cos()), series(&|t| way(t) * 0.3_f64.sin()), series(&|_| 0.3)];
        // Not dragged along a straight line for ever: a touch sideways, else it would stand the wrong way round.
        of.pose[1].value.iter_mut().zip(&time).for_each(|(y, t)| *y += 0.01 * t);
        let drive = Drive::new("a", &robot, &of, true).expect("a drive");
        let at = |seconds: f64| drive.casters[(seconds / 0.02) as usize][0];
        assert!(at(1.9).abs() < 0.05, "{}", at(1.9));
        assert!(at(2.15).abs() < 1.0, "still turning: {}", at(2.15));
        assert!((at(3.9).abs() - PI).abs() < 0.1, "{}", at(3.9));

        // Windows begin there.
        let (model, step) = (Model::<f64>::at(&robot, &[], &[]), 107);
        let begun = model.of_pose(&drive, &robot, step, (drive.pose[step], [-0.48, -0.15, 0.0]));
        assert_eq!(begun.caster[0], drive.casters[step][0]);
    }
}
