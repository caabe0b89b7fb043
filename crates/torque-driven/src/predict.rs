//! Predicting drives from their inputs alone.

use robot_model::{Active, Plant, Robot, State};
use sim::rollout::{Commanded, Grid, Hold, Restarts, Rollout, each_row};

use verdict::Prediction;

use crate::case::HeldOut;
use crate::motion::GyroError;

/// Runs the plant freely from restart to restart.
pub(crate) fn predict(
    held: &HeldOut,
    robot: &Robot<f64>,
    active: &[Active<f64>],
    gyro: GyroError,
    step: f64,
) -> Prediction {
    let grid = Grid::nearest(held.period, step);
    let plant = Plant::new(robot, active, grid.step());
    let hold = Hold::new(grid, plant.drive().delay);
    let shown = |yaw_rate: f64| yaw_rate * (1.0 + gyro.scale) + gyro.bias;
    let mut out =
        Prediction { name: held.name.clone(), time: Vec::new(), wheel_speed: Vec::new(), yaw_rate: Vec::new() };

    let show = each_row(|row, plant: &Plant<'_, f64>, s: &State<f64>| {
        out.time.push(held.first_time + row as f64 * held.period);
        out.wheel_speed.push(s.wheel_speed);
        let mut readings = plant.readings(s);
        plant.sense(&mut readings);
        out.yaw_rate.push(shown(readings.gyro));
    });
    let restarts = Restarts::new(held.restarts.iter().map(|r| (r.row, r.start(gyro))), held.period);
    let Ok(()) = Rollout::new(&plant, held.torque.len(), grid.substeps).run(
        &mut State::default(),
        &mut Commanded(|row, step| hold.command(&held.torque, row, step)),
        &mut (restarts, show),
    );
    out
}
