//! The plant in steady driving: what loads it predicts, and its calibration on the references' loads.

use faer::Mat;
use inference::least_squares::{Constant, Residuals, Settings};
use inference::robust::{mean, rms};
use robot_model::effect::LoadTerm;
use robot_model::tunable::COUNT as NUISANCES;
use robot_model::{Active, Plant, Robot, State};
use verdict::{Load, Quantity};

use crate::drift;
use crate::run::SpeedRun;
use crate::settings::NAMING;
use crate::settings::naming::{Calibration, SteadyPlant};
use inference::hypothesis::Dose;
use robot_model::tunable::tuned;

const PLANT: SteadyPlant = NAMING.plant;
const CALIBRATION: Calibration = NAMING.calibration;

/// Where and how a load is driven.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Operating {
    pub(crate) quantity: Quantity,
    /// Speeds at the tyres of the inner and the outer side, m/s.
    pub(crate) speed: [f64; 2],
    /// Share of it in which the right side is the outer one.
    pub(crate) right_outer: f64,
}

impl Operating {
    /// Of a load.
    pub(crate) fn of(load: &Load) -> Self {
        Self { quantity: load.quantity, speed: load.speed, right_outer: load.right_outer }
    }
}

/// Means of a steady drive over all headings that matter: torque of each side, yaw rate.
fn steady(robot: &Robot<f64>, doses: &[Dose], speed: [f64; 2]) -> ([f64; 2], f64) {
    let active: Vec<Active<f64>> = doses.iter().map(Dose::active).collect();
    let plant = Plant::new(robot, &active, PLANT.step);
    let wheel = speed.map(|v| v / robot.wheel_radius);
    let turning = (speed[1] - speed[0]).abs() > 1e-6;
    // A slope pulls differently around a turn; a straight drive keeps its heading, and nothing else asks for it.
    let slopes = doses.iter().any(|dose| dose.effect.spec().load_term == Some(LoadTerm::Slope));
    let headings = if turning && slopes { PLANT.headings } else { 1 };
    let yaw = (speed[1] - speed[0]) / (2.0 * robot.turning_lever());
    let mut s = State { yaw_rate: yaw, ..State::default() };
    plant.set_velocity(&mut s, [0.5 * (speed[0] + speed[1]), 0.0]);
    let (mut torque, mut turned) = ([0.0; 2], 0.0);
    for k in 0..headings {
        let (sin, cos) = (std::f64::consts::TAU * k as f64 / headings as f64).sin_cos();
        s.heading = [cos, sin];
        plant.settle_at_speed(&mut s, wheel);
        torque[0] += s.needed[0].abs() / headings as f64;
        torque[1] += s.needed[1].abs() / headings as f64;
        turned += s.yaw_rate / headings as f64;
    }
    (torque, turned)
}

/// The load that a robot shows, on the scale on which loads are compared (logarithm, or itself for a difference): of turns to
/// both sides their mean, each weighed by its share.
pub(crate) fn predicted(robot: &Robot<f64>, doses: &[Dose], at: Operating) -> f64 {
    let ([inner, outer], right_outer) = (at.speed, at.right_outer);
    let to_the_left = || shown(robot, doses, at.quantity, [inner, outer]);
    let to_the_right = || shown(robot, doses, at.quantity, [outer, inner]);
    let value = if inner == outer || right_outer >= 1.0 {
        to_the_left()
    } else if right_outer <= 0.0 {
        to_the_right()
    } else {
        right_outer * to_the_left() + (1.0 - right_outer) * to_the_right()
    };
    if at.quantity.is_difference() { value } else { value.abs().max(1e-6).ln() }
}

/// The load itself at speeds of the left and the right side.
fn shown(robot: &Robot<f64>, doses: &[Dose], quantity: Quantity, [l, r]: [f64; 2]) -> f64 {
    let (torque, yaw) = steady(robot, doses, [l, r]);
    let outer = if l.abs() > r.abs() { torque[0] } else { torque[1] };
    match quantity {
        Quantity::StraightLoad => torque[0] + torque[1],
        Quantity::Asymmetry | Quantity::SpinAsymmetry => (torque[1] - torque[0]) / (torque[0] + torque[1]).max(1e-9),
        Quantity::ArcSum => outer,
        Quantity::TurningLoad => {
            let v = 0.5 * (l + r);
            let (straight, _) = steady(robot, doses, [v, v]);
            outer - 0.5 * (straight[0] + straight[1])
        }
        Quantity::SpinSum => 0.5 * (torque[0] + torque[1]),
        Quantity::EffectiveTrack => (r - l) / if yaw.abs() > 1e-6 { yaw } else { 1e-6 },
        Quantity::Drift => drift::of_doses(doses),
    }
}

/// A measured load with where it was driven, on the comparison scale.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Measured {
    pub(crate) at: Operating,
    pub(crate) value: f64,
    pub(crate) error: f64,
}

/// Constants of the robot that the loads determine, and how well.
#[derive(Clone)]
pub(crate) struct Tuned {
    pub(crate) theta: [f64; NUISANCES],
    pub(crate) covariance: Mat<f64>,
}

/// Derivatives of each prediction by θ (in sigmas).
pub(crate) fn sensitivity(
    robot: &Robot<f64>,
    sigma: &[f64; NUISANCES],
    theta: &[f64; NUISANCES],
    at: &[Operating],
) -> Mat<f64> {
    let base: Vec<f64> = at.iter().map(|o| predicted(&tuned(robot, sigma, theta), &[], *o)).collect();
    let columns: Vec<Vec<f64>> = (0..NUISANCES)
        .map(|k| {
            let mut t = *theta;
            t[k] += CALIBRATION.shift;
            let r = tuned(robot, sigma, &t);
            at.iter().zip(&base).map(|(o, b)| (predicted(&r, &[], *o) - b) / CALIBRATION.shift).collect()
        })
        .collect();
    Mat::from_fn(at.len(), NUISANCES, |i, k| columns[k][i])
}

/// Tunes the robot to measured loads, with the robot file's sigmas as prior.
pub(crate) fn tune(robot: &Robot<f64>, sigma: &[f64; NUISANCES], data: &[Measured]) -> Option<Tuned> {
    let misfit = |x: &[f64]| -> Vec<f64> {
        let theta = std::array::from_fn(|k| x[k]);
        let r = tuned(robot, sigma, &theta);
        data.iter().map(|d| (predicted(&r, &[], d.at) - d.value) / d.error).collect()
    };
    let tunable = Constant {
        longest: CALIBRATION.longest,
        difference: CALIBRATION.shift,
        ..Constant::new(0.0, 1.0).within(-CALIBRATION.farthest, CALIBRATION.farthest).known(0.0, 1.0)
    };
    let settings = Settings { iterations: CALIBRATION.steps, ..Settings::gauss_newton() };

    let fitted = Residuals::new(vec![tunable; NUISANCES], misfit).fit(&settings).ok()?;
    Some(Tuned { theta: std::array::from_fn(|k| fitted.values[k]), covariance: fitted.covariance? })
}

/// What a robot's sensors would show row by row, by its speeds alone: in steady motion plus inertia.
#[derive(Debug, Clone)]
pub(crate) struct Rows {
    /// Torque of each side, N m; `None` where it would show something unknown.
    pub(crate) torque: [Vec<Option<f64>>; 2],
    /// Yaw rate, rad/s.
    pub(crate) yaw_rate: Vec<Option<f64>>,
}

impl Rows {
    /// Errors of the torques, N m, where both are known.
    pub(crate) fn residuals(&self, run: &SpeedRun) -> Vec<f64> {
        (0..run.time.len()).flat_map(|i| self.errors(run, i)).collect()
    }

    /// Root mean squared error of the torques, N m.
    pub(crate) fn rms(&self, run: &SpeedRun) -> f64 {
        rms(self.residuals(run)).unwrap_or(0.0)
    }

    /// Mean squared error of the torques of a row, (N m)².
    pub(crate) fn square(&self, run: &SpeedRun, i: usize) -> Option<f64> {
        mean(self.errors(run, i).map(|error| error * error))
    }

    /// What lies in the dead band on both accounts counts as right; a body that stands has none.
    fn errors<'a>(&'a self, run: &'a SpeedRun, i: usize) -> impl Iterator<Item = f64> + 'a {
        (0..2).filter(move |_| !run.standing[i]).filter_map(move |j| {
            let shown = self.torque[j][i]?;
            let measured = run.torque[j][i];
            let measured = if run.magnitude_only { measured.abs().max(run.dead_band) } else { measured };
            Some(measured - shown)
        })
    }
}

/// What a robot's sensors would show in a recording.
///
/// Of currents without sign, a side that brakes reads nothing (the drive feeds back), and at low speed something unknown,
/// which is left out.
pub(crate) fn predicted_rows(run: &SpeedRun, robot: &Robot<f64>, doses: &[Dose]) -> Rows {
    let active: Vec<Active<f64>> = doses.iter().map(Dose::active).collect();
    let plant = Plant::new(robot, &active, PLANT.step);
    let radius = robot.wheel_radius;
    let inertia = robot.side_inertia();
    let rows = run.time.len();

    let mut out = Rows { torque: [vec![None; rows], vec![None; rows]], yaw_rate: vec![None; rows] };
    let mut s = State::default();
    for i in 1..rows {
        let span = run.time[i] - run.time[i - 1];
        let speed = [run.speed[0][i], run.speed[1][i]];
        // The body follows its wheels within a tenth of a second: rows are longer than that.
        s.yaw_rate = (speed[1] - speed[0]) / (2.0 * robot.turning_lever());
        plant.set_velocity(&mut s, [0.5 * (speed[0] + speed[1]), 0.0]);
        plant.settle_at_speed(&mut s, speed.map(|v| v / radius));
        out.yaw_rate[i] = Some(s.yaw_rate).filter(|w| w.is_finite());

        // Steady motion, then what speeding up takes.
        let forward = 0.5 * (speed[0] + speed[1] - run.speed[0][i - 1] - run.speed[1][i - 1]) / span;
        let mean = [0, 1].map(|j| {
            let own = (speed[j] - run.speed[j][i - 1]) / radius / span;
            s.needed[j] + inertia * own + 0.5 * robot.mass * forward * radius
        });

        for (j, m) in mean.into_iter().enumerate() {
            let brakes = m * speed[j] < 0.0;
            if run.magnitude_only && brakes && speed[j].abs() < PLANT.braking_reads {
                continue;
            }
            out.torque[j][i] = Some(if !run.magnitude_only {
                m
            } else if brakes {
                run.dead_band
            } else {
                m.abs().max(run.dead_band)
            });
        }
    }
    out
}
