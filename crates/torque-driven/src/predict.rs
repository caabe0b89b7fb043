//! Predicting drives from their inputs alone.

use robot_model::{Active, Plant, Robot, State};

use verdict::Prediction;

use crate::case::HeldOut;
use crate::hold::Hold;
use crate::motion::GyroError;

/// Runs the plant freely from restart to restart.
pub(crate) fn predict(
    held: &HeldOut,
    robot: &Robot<f64>,
    active: &[Active<f64>],
    gyro: GyroError,
    step: f64,
) -> Prediction {
    let substeps = (held.period / step).round().max(1.0) as usize;
    let h = held.period / substeps as f64;
    let plant = Plant::new(robot, active, h);
    let hold = Hold::new(held.period, substeps, plant.drive().delay);
    let shown = |yaw_rate: f64| yaw_rate * (1.0 + gyro.scale) + gyro.bias;
    let mut s = State::default();
    let mut next = held.restarts.iter().peekable();
    let mut out =
        Prediction { name: held.name.clone(), time: Vec::new(), wheel_speed: Vec::new(), yaw_rate: Vec::new() };
    for k in 0..held.torque.len() {
        if let Some(r) = next.next_if(|r| r.row == k) {
            s.time = k as f64 * held.period;
            r.set(&plant, &mut s, gyro);
        }
        out.time.push(held.first_time + k as f64 * held.period);
        out.wheel_speed.push(s.wheel_speed);
        let mut readings = plant.readings(&s);
        plant.sense(&mut readings);
        out.yaw_rate.push(shown(readings.gyro));
        for i in 0..substeps {
            plant.step(&mut s, hold.command(&held.torque, k, i));
        }
    }
    out
}
