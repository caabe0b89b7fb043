//! A case: what the user knows and what was recorded.

use recordings::{Recording, Signal};
use robot_model::Robot;
use robot_model::tunable::{COUNT as NUISANCES, USUAL_POSE_SIGMA, usual_sigma};

use crate::motion::GyroError;
use crate::run::Run;
use crate::windows::{CutOptions, Segment, cut};
use inference::{DiagnosisError, GivenEffects};

/// A torque-driven case.
#[derive(Debug, Clone)]
pub struct Case {
    /// The user's robot model.
    pub robot: Robot<f64>,
    /// Whether the wheels of a side may have a motor each: the robot file does not say that they are coupled.
    pub may_have_four_motors: bool,
    /// What the simulation is given beside these constants.
    pub effects: GivenEffects,
    /// One sigma of each tunable constant, in the order of [`robot_model::tunable::tunables`].
    pub sigma: [f64; NUISANCES],
    /// Noise of the pose sensor, m.
    pub pose_sigma: f64,
    /// Recordings in which the simulation is right.
    pub references: Vec<Run>,
    /// Logs of the user's simulator on the inputs of references or recordings: what the simulation believes.
    pub simulations: Vec<Run>,
    /// Recordings in which it is not.
    pub recordings: Vec<Run>,
    /// Inputs whose response is to be predicted.
    pub held_out: Vec<HeldOut>,
}

impl Case {
    /// A case of this robot without drives yet, whose constants and pose sensor are as well known as usual
    /// ([`usual_sigma`], [`USUAL_POSE_SIGMA`]).
    pub fn new(robot: Robot<f64>) -> Self {
        Self {
            robot,
            may_have_four_motors: false,
            effects: GivenEffects::default(),
            sigma: usual_sigma(),
            pose_sigma: USUAL_POSE_SIGMA,
            references: Vec::new(),
            simulations: Vec::new(),
            recordings: Vec::new(),
            held_out: Vec::new(),
        }
    }
}

/// Inputs of a drive whose response is held back, with the state at some rows.
#[derive(Debug, Clone)]
pub struct HeldOut {
    /// Name of the drive.
    pub name: String,
    /// Time between rows, s.
    pub period: f64,
    /// Time of the first row, s.
    pub first_time: f64,
    /// Time of each row as it was stamped, ns.
    pub stamps: Vec<i64>,
    /// Torque command of each side, N m.
    pub torque: Vec<[f64; 2]>,
    /// Rows at which the model is set to a known state.
    pub restarts: Vec<Restart>,
}

/// A known state from which the model runs free.
#[derive(Debug, Clone, Copy, Default)]
pub struct Restart {
    /// Row.
    pub row: usize,
    /// Pose (x, y, yaw), m and rad.
    pub pose: [f64; 3],
    /// Velocity of the geometric centre in body axes, m/s.
    pub velocity: [f64; 2],
    /// What the gyro shows, rad/s.
    pub gyro: f64,
    /// Wheel speed of each side, rad/s.
    pub wheel_speed: [f64; 2],
    /// Wheel angle of each side, rad.
    pub wheel_angle: [f64; 2],
}

impl HeldOut {
    /// Reads inputs and restart states from a recording: every row in which all of the state is there is a restart.
    ///
    /// # Errors
    /// When torque is missing or no row holds a state.
    pub fn new(recording: &Recording) -> Result<Self, DiagnosisError> {
        let inputs = Self::inputs(recording)?;
        if inputs.restarts.is_empty() {
            return Err(DiagnosisError::MissingSignal {
                recording: inputs.name,
                what: "state (pose, body velocity, gyro, wheels) in any row",
            });
        }
        Ok(inputs)
    }

    /// The same where no state need be known.
    ///
    /// # Errors
    /// When torque is missing.
    pub fn inputs(recording: &Recording) -> Result<Self, DiagnosisError> {
        let name = recording.name().to_owned();
        let channel = |s: Signal| {
            recording.get(s).ok_or_else(|| DiagnosisError::MissingSignal { recording: name.clone(), what: s.name() })
        };
        let left = channel(Signal::TorqueLeft)?;
        let right = channel(Signal::TorqueRight)?;
        if left.len() < 2 {
            return Err(DiagnosisError::TooShort { recording: name, rows: left.len(), needed: 2 });
        }
        let period_ns = (left.t_ns()[1] - left.t_ns()[0]).max(1);
        let start = left.t_ns()[0];
        let mut torque = vec![[0.0; 2]; left.len()];
        for (j, c) in [left, right].into_iter().enumerate() {
            for (row, v) in torque.iter_mut().zip(c.values()) {
                row[j] = *v;
            }
        }
        let lookup = |s: Signal| -> std::collections::BTreeMap<i64, f64> {
            recording.get(s).map(|c| c.samples().collect()).unwrap_or_default()
        };
        let signals = [
            Signal::PoseX,
            Signal::PoseY,
            Signal::PoseYaw,
            Signal::BodyVx,
            Signal::BodyVy,
            Signal::GyroZ,
            Signal::WheelSpeedLeft,
            Signal::WheelSpeedRight,
            Signal::WheelAngleLeft,
            Signal::WheelAngleRight,
        ]
        .map(lookup);
        let restarts: Vec<Restart> = signals[6]
            .keys()
            .filter_map(|t| {
                let mut v = [0.0; 10];
                for (v, s) in v.iter_mut().zip(&signals) {
                    *v = *s.get(t)?;
                }
                let row = usize::try_from((t - start + period_ns / 2).div_euclid(period_ns)).ok()?;
                Some(Restart {
                    row,
                    pose: [v[0], v[1], v[2]],
                    velocity: [v[3], v[4]],
                    gyro: v[5],
                    wheel_speed: [v[6], v[7]],
                    wheel_angle: [v[8], v[9]],
                })
            })
            .collect();
        let stamps = left.t_ns().to_vec();
        Ok(Self { name, period: period_ns as f64 * 1e-9, first_time: start as f64 * 1e-9, stamps, torque, restarts })
    }

    /// The same of a recording without a velocity of the body: from states that poses, gyro and wheels show together, smoothed as for a
    /// diagnosis, every `seconds`.
    ///
    /// # Errors
    /// When torque is missing, or the recording is too short or shows too little.
    pub fn of_measured(
        recording: &Recording,
        (robot, pose_sigma): (&Robot<f64>, f64),
        seconds: f64,
    ) -> Result<Self, DiagnosisError> {
        let run = Run::new(recording)?;
        let cutting = CutOptions {
            segment: seconds,
            pose_sigma,
            gyro: GyroError::default(),
            wheel_radius: robot.wheel_radius,
            contacts: robot.contacts(),
        };
        let segments = cut(&run, &cutting).segments;
        let inputs = Self::inputs(recording)?;
        let restart = |segment: &Segment| {
            let since = run.from + segment.row as f64 * run.period - inputs.first_time;
            let row = (since / inputs.period).round().max(0.0) as usize;
            let start = segment.start;
            Restart {
                row,
                pose: [start.position[0], start.position[1], start.yaw],
                velocity: start.velocity,
                gyro: start.yaw_rate,
                wheel_speed: start.wheel_speed,
                wheel_angle: start.wheel_angle,
            }
        };
        let restarts: Vec<Restart> = segments.iter().map(restart).collect();
        if restarts.is_empty() {
            let needed = (2.0 * seconds / inputs.period) as usize;
            return Err(DiagnosisError::TooShort { recording: inputs.name, rows: inputs.torque.len(), needed });
        }
        Ok(Self { restarts, ..inputs })
    }

    /// The same with restarts at least `seconds` apart: of a recording that holds the whole state in every row.
    #[must_use]
    pub fn restarting_every(mut self, seconds: f64) -> Self {
        let apart = ((seconds / self.period).round() as usize).max(1);
        let mut next = 0;
        self.restarts.retain(|r| {
            let keep = r.row >= next;
            if keep {
                next = r.row + apart;
            }
            keep
        });
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use testing::{recording, samples};

    fn torques() -> Vec<(Signal, Vec<(f64, f64)>)> {
        vec![(Signal::TorqueLeft, samples(500, |t| t)), (Signal::TorqueRight, samples(500, |t| 2.0 * t))]
    }

    #[test]
    fn rows_with_a_whole_state_are_restarts() {
        let mut c = torques();
        let state = [
            Signal::PoseX,
            Signal::PoseY,
            Signal::PoseYaw,
            Signal::BodyVx,
            Signal::BodyVy,
            Signal::GyroZ,
            Signal::WheelSpeedLeft,
            Signal::WheelSpeedRight,
            Signal::WheelAngleLeft,
            Signal::WheelAngleRight,
        ];
        c.extend(state.iter().zip(1..).map(|(s, i)| (*s, vec![(0.0, f64::from(i)), (2.0, 10.0 * f64::from(i))])));
        // A row in which only some of the state is there is none.
        c[2].1.push((4.0, 0.0));
        let held = HeldOut::new(&recording(&c)).expect("inputs");
        assert_eq!((held.torque.len(), held.period, held.first_time), (500, 0.01, 0.0));
        approx::assert_relative_eq!(held.torque[100][1], 2.0);
        assert_eq!(held.restarts.iter().map(|r| r.row).collect::<Vec<_>>(), [0, 200]);
        let r = held.restarts[1];
        assert_eq!((r.pose, r.velocity, r.gyro), ([10.0, 20.0, 30.0], [40.0, 50.0], 60.0));
        assert_eq!((r.wheel_speed, r.wheel_angle), ([70.0, 80.0], [90.0, 100.0]));
    }

    #[test]
    fn inputs_without_a_state_or_a_torque_are_refused() {
        let e = HeldOut::new(&recording(&torques())).expect_err("no state");
        assert!(e.to_string().contains("in any row"), "{e}");
        let e = HeldOut::new(&recording(&torques()[..1])).expect_err("no torque");
        assert!(e.to_string().contains("torque_right"), "{e}");
        let short: Vec<_> = torques().into_iter().map(|(s, c)| (s, c[..1].to_vec())).collect();
        assert!(matches!(HeldOut::new(&recording(&short)), Err(DiagnosisError::TooShort { rows: 1, .. })));
    }
}
