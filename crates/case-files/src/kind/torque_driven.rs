//! Robots whose drives are given torques.

use anyhow::Result;
use diagnosis::long::BUDGET;
use inference::Options;
use recordings::{Recording, Signal};
use robot_file::RobotSpec;
use robot_model::Active;
use torque_driven::HeldOut;
use verdict::Prediction;

use super::{Forecast, Kind};

/// Torques in, wheel speeds and the motion of the body out.
pub(super) struct TorqueDriven;

impl Kind for TorqueDriven {
    fn budget(&self) -> f64 {
        BUDGET
    }

    fn simulate(&self, robot: &RobotSpec, effects: &[Active<f64>], inputs: &Recording) -> Result<Recording> {
        Ok(torque_driven::simulate(&robot.robot, effects, inputs, &Options::default())?)
    }

    fn forecast(&self, robot: &RobotSpec, drive: &Recording, restart: f64) -> Result<Forecast> {
        // Few recordings hold the velocity of the body; those that do are simulated ones.
        let held = match HeldOut::new(drive) {
            Ok(held) => held.restarting_every(restart),
            Err(_) => HeldOut::of_measured(drive, (&robot.robot, robot.pose_sigma), restart)?,
        };
        let prediction = torque_driven::forecast(&robot.robot, &robot.active(&held.name)?, &held, &Options::default());
        let [wheel, yaw] = compare(&prediction, drive, &held);
        let errors = vec![("wheel speed, rad/s".to_owned(), wheel), ("yaw rate, rad/s".to_owned(), yaw)];
        Ok(Forecast { errors, prediction: Some(prediction) })
    }
}

/// Root mean squared errors of wheel speed and yaw rate, without the rows at which the state was given.
fn compare(prediction: &Prediction, drive: &Recording, held: &HeldOut) -> [Option<f64>; 2] {
    let given: Vec<usize> = held.restarts.iter().map(|r| r.row).collect();
    let rms = |signal: Signal, predicted: &dyn Fn(usize) -> f64| -> Option<(f64, f64)> {
        let channel = drive.get(signal)?;
        let mut sum = (0.0, 0.0);
        for (k, t) in held.stamps.iter().enumerate().filter(|(k, _)| given.binary_search(k).is_err()) {
            if let Ok(at) = channel.t_ns().binary_search(t)
                && k < prediction.time.len()
            {
                sum.0 += (channel.values()[at] - predicted(k)).powi(2);
                sum.1 += 1.0;
            }
        }
        (sum.1 > 0.0).then_some(sum)
    };
    let side = |j: usize, signal| rms(signal, &|k| prediction.wheel_speed[k][j]);
    let wheels = side(0, Signal::WheelSpeedLeft).zip(side(1, Signal::WheelSpeedRight));
    [
        wheels.map(|(l, r)| ((l.0 + r.0) / (l.1 + r.1)).sqrt()),
        rms(Signal::GyroZ, &|k| prediction.yaw_rate[k]).map(|(sum, n)| (sum / n).sqrt()),
    ]
}
