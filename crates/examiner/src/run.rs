//! One closed-loop drive of the true robot and what its recording holds.

use crate::Course;
use crate::drive::{Controller, Driver, Manoeuvre};
use crate::events::Events;
use crate::hidden::Hidden;
use crate::integrate::{STEP, Stepper};
use crate::motor::Motors;
use crate::plant::{ANGLE, Plant, SPEED, VELOCITY, YAW_RATE};
use crate::random::Stream;
use crate::robot::Constants;
use crate::sensors::{Sampler, Sheet, frozen_rows};

/// True motion at a row: pose, body velocity and yaw rate, wheel speeds and angles of the sides.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Motion {
    pub body: [f64; 6],
    pub speed: [f64; 2],
    pub angle: [f64; 2],
}

/// One row of a recording.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Row {
    pub speed: [f64; 2],
    pub angle: [f64; 2],
    pub torque: [f64; 2],
    pub imu: Option<[f64; 3]>,
    pub pose: Option<[f64; 3]>,
}

/// A recorded drive.
#[derive(Debug, Clone)]
pub(crate) struct Run {
    pub kinds: [Manoeuvre; 2],
    pub events: Events,
    pub seen: Vec<Motion>,
    pub rows: Vec<Row>,
}

/// What a drive needs to know.
pub(crate) struct Task<'a> {
    pub seed: u64,
    pub nominal: &'a Constants,
    /// The robot as it is on this run.
    pub robot: &'a Constants,
    pub hidden: &'a Hidden,
    pub events: Events,
    pub sheet: Sheet,
    pub kinds: [Manoeuvre; 2],
    /// A drive that was asked for, instead of these kinds.
    pub course: Option<&'a Course>,
    /// Factor on the gain of the controller.
    pub gain: f64,
    pub row: f64,
    pub rows: usize,
}

/// Drives the robot.
pub(crate) fn record(task: Task<'_>) -> Run {
    let mut s = Stream::new(task.seed, "run", 0);
    let plant = Plant::new(task.robot, task.hidden);
    let mut motors = Motors::new(task.robot, task.hidden, task.row, STEP);
    let drawn = [s.normal(0.2), s.normal(0.2), s.uniform(-3.1, 3.1)];
    let start = task.course.and_then(|c| c.start).unwrap_or(drawn);
    let mut state = plant.settled([start[0], start[1], start[2], 0.0, 0.0, 0.0], [0.0; 2], [0.0; 2]);
    let stream = |name| Stream::new(task.seed, name, 0);
    let mut sampler = Sampler::new(task.sheet, stream("sensors"));
    let mut noise = stream("torque");
    let frozen = [0, 1].map(|side| {
        let mut s = Stream::new(task.seed, "frozen", side as u64);
        frozen_rows(&mut s, task.hidden.frozen[side], task.rows, task.row)
    });
    let mut driver = Driver::new(stream("drive one"), task.nominal, task.kinds[0]);
    let mut controller = Controller::new(task.nominal, start[2], task.gain);
    let steps = (task.row / STEP).round() as usize;
    let mut stepper = Stepper::new(task.hidden, STEP);
    let half = task.rows / 2;
    let mut commands: Vec<[f64; 2]> = Vec::with_capacity(task.rows);
    let mut run = Run {
        kinds: task.kinds,
        events: task.events,
        seen: Vec::with_capacity(task.rows),
        rows: Vec::with_capacity(task.rows),
    };
    let mut counted = [0.0; 2];
    let mut held = [0.0; 2];
    for k in 0..task.rows {
        let t = k as f64 * task.row;
        if k == half {
            let next = Driver::new(stream("drive two"), task.nominal, task.kinds[1]);
            driver = next.after(&driver);
        }
        if k == 0 {
            sampler.sample(1e-9, 0.0, [0.0; 2], start);
        }
        let seen = Motion {
            body: std::array::from_fn(|i| state[i]),
            speed: [state[SPEED + 1], state[SPEED + 3]],
            angle: [state[ANGLE + 1], state[ANGLE + 3]],
        };
        let angle = seen.angle.map(|a| task.sheet.angle(a));
        let speed = [0, 1].map(|i| if k == 0 { 0.0 } else { (angle[i] - counted[i]) / task.row });
        counted = angle;
        let pose = [state[0], state[1], state[2]];
        let drive_time = (if k < half { k } else { k - half }) as f64 * task.row;
        let want = match task.course {
            Some(course) => course.want(t),
            None => driver.want(drive_time, task.row, pose),
        };
        let free = task.course.is_some_and(|c| c.is_free(t));
        let command = controller
            .command(want, state[2], seen.speed, task.row)
            .map(|torque| if free { 0.0 } else { torque })
            .map(|torque| round_to(torque, task.sheet.torque_step));
        commands.push(command);
        let mut row = Row {
            speed,
            angle,
            torque: command.map(|c| round_to(c + noise.normal(task.sheet.torque), task.sheet.torque_step)),
            imu: sampler.imu.take(),
            pose: sampler.pose.take(),
        };
        for side in 0..2 {
            if frozen[side][k] {
                row.speed[side] = 0.0;
                row.angle[side] = held[side];
            }
            held[side] = row.angle[side];
        }
        run.rows.push(row);
        run.seen.push(seen);
        for j in 0..steps {
            let now = t + j as f64 * STEP;
            let torque = motors.step(now, &commands, &run.events);
            let moment = plant.moment(now, torque, &state, &run.events);
            let before = [state[0], state[1], state[2]];
            let rate = shown_rate(task.hidden, state[YAW_RATE]);
            let felt = stepper.step(&plant, &mut state, &moment);
            sampler.sample(now + STEP, rate, felt, before);
        }
    }
    debug_assert!(state[VELOCITY].is_finite());
    run
}

/// Yaw rate as the gyro would show it without noise.
pub(crate) fn shown_rate(hidden: &Hidden, rate: f64) -> f64 {
    rate * (1.0 + hidden.gyro_scale) + hidden.gyro_bias
}

/// The nearest multiple of a step.
fn round_to(x: f64, step: f64) -> f64 {
    (x / step).round() * step
}
