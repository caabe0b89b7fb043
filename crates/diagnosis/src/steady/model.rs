//! The plant in steady driving: what loads it predicts, and its calibration on the references' loads.

use faer::Mat;
use robot_model::tunable::COUNT as NUISANCES;
use robot_model::{Active, Plant, Robot, State};

use crate::fit::tuned;
use crate::linalg::solve_spd;
use crate::simulate::Dose;
use crate::steady::extract::Quantity;
use crate::steady::run::SpeedRun;

/// Integration step, s.
const STEP: f64 = 2e-3;
/// Time to settle, s.
const SETTLE: f64 = 2.0;
/// A straight drive is averaged over this long, s; a turn over one full turn, at most this long.
const STRAIGHT_MEAN: f64 = 0.2;
const LONGEST_TURN: f64 = 60.0;
/// Gauss–Newton steps of the calibration and the size of finite steps, in sigmas.
const STEPS: usize = 6;
const SHIFT: f64 = 0.2;

/// Where and how a load is driven.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Operating {
    pub(crate) quantity: Quantity,
    /// Speeds at the tyres, left and right, m/s.
    pub(crate) speed: [f64; 2],
}

/// Means of a steady drive: torque of each side, yaw rate.
fn steady(robot: &Robot<f64>, doses: &[Dose], speed: [f64; 2]) -> ([f64; 2], f64) {
    let active: Vec<Active<f64>> = doses.iter().map(Dose::active).collect();
    let plant = Plant::new(robot, &active, STEP);
    let wheel = speed.map(|v| v / robot.wheel_radius);
    let mut s = State { wheel_speed: wheel, front_speed: wheel, ..State::default() };
    plant.set_velocity(&mut s, [0.5 * (speed[0] + speed[1]), 0.0]);
    for _ in 0..(SETTLE / STEP) as usize {
        plant.step_at_speed(&mut s, wheel, [0.0; 2]);
    }
    // The pull of a slope differs around a turn: average over all headings.
    let turning = s.yaw_rate.abs() > 0.01;
    let time = if turning { (std::f64::consts::TAU / s.yaw_rate.abs()).min(LONGEST_TURN) } else { STRAIGHT_MEAN };
    let n = (time / STEP).ceil();
    let (mut torque, mut yaw) = ([0.0; 2], 0.0);
    for _ in 0..n as usize {
        plant.step_at_speed(&mut s, wheel, [0.0; 2]);
        torque[0] += s.needed[0].abs() / n;
        torque[1] += s.needed[1].abs() / n;
        yaw += s.yaw_rate / n;
    }
    (torque, yaw)
}

/// The load that a robot shows, on the scale on which loads are compared (logarithm, or itself for a difference).
pub(crate) fn predicted(robot: &Robot<f64>, doses: &[Dose], at: Operating) -> f64 {
    let [l, r] = at.speed;
    let (torque, yaw) = steady(robot, doses, at.speed);
    let outer = if l.abs() > r.abs() { torque[0] } else { torque[1] };
    let value = match at.quantity {
        Quantity::StraightLoad => torque[0] + torque[1],
        Quantity::Asymmetry => return (torque[1] - torque[0]) / (torque[0] + torque[1]).max(1e-9),
        Quantity::ArcSum => outer,
        Quantity::TurningLoad => {
            let v = 0.5 * (l + r);
            let (straight, _) = steady(robot, doses, [v, v]);
            outer - 0.5 * (straight[0] + straight[1])
        }
        Quantity::SpinSum => 0.5 * (torque[0] + torque[1]),
        Quantity::EffectiveTrack => (r - l) / if yaw.abs() > 1e-6 { yaw } else { 1e-6 },
    };
    value.abs().max(1e-6).ln()
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
            t[k] += SHIFT;
            let r = tuned(robot, sigma, &t);
            at.iter().zip(&base).map(|(o, b)| (predicted(&r, &[], *o) - b) / SHIFT).collect()
        })
        .collect();
    Mat::from_fn(at.len(), NUISANCES, |i, k| columns[k][i])
}

/// Tunes the robot to measured loads, with the robot file's sigmas as prior.
pub(crate) fn tune(robot: &Robot<f64>, sigma: &[f64; NUISANCES], data: &[Measured]) -> Option<Tuned> {
    let at: Vec<Operating> = data.iter().map(|d| d.at).collect();
    let mut theta = [0.0; NUISANCES];
    let mut covariance = Mat::identity(NUISANCES, NUISANCES);
    for _ in 0..STEPS {
        let j = sensitivity(robot, sigma, &theta, &at);
        let r = tuned(robot, sigma, &theta);
        let w: Vec<f64> = data.iter().map(|d| d.error.powi(-2)).collect();
        let residual: Vec<f64> = data.iter().map(|d| d.value - predicted(&r, &[], d.at)).collect();
        let m = Mat::from_fn(NUISANCES, NUISANCES, |a, b| {
            f64::from(a == b) + (0..data.len()).map(|i| w[i] * j[(i, a)] * j[(i, b)]).sum::<f64>()
        });
        let g = Mat::from_fn(NUISANCES, 1, |a, _| {
            (0..data.len()).map(|i| w[i] * j[(i, a)] * residual[i]).sum::<f64>() - theta[a]
        });
        let (step, _) = solve_spd(&m, &g)?;
        for (k, t) in theta.iter_mut().enumerate() {
            *t = (*t + step[(k, 0)].clamp(-1.0, 1.0)).clamp(-4.0, 4.0);
        }
        covariance = solve_spd(&m, &Mat::identity(NUISANCES, NUISANCES))?.0;
    }
    Some(Tuned { theta, covariance })
}

/// Root mean squared error of the torques that a robot predicts from a recording's speeds alone, N m.
///
/// What lies in the dead band on both accounts counts as right: only a bound is known.
pub(crate) fn forecast(run: &SpeedRun, robot: &Robot<f64>, doses: &[Dose]) -> f64 {
    let active: Vec<Active<f64>> = doses.iter().map(Dose::active).collect();
    let plant = Plant::new(robot, &active, STEP);
    let radius = robot.wheel_radius;
    let wheel = |i: usize| [run.speed[0][i] / radius, run.speed[1][i] / radius];
    let mut s = State { wheel_speed: wheel(0), front_speed: wheel(0), ..State::default() };
    plant.set_velocity(&mut s, [0.5 * (run.speed[0][0] + run.speed[1][0]), 0.0]);
    let (mut sum, mut n) = (0.0, 0.0);
    for i in 1..run.time.len() {
        let span = run.time[i] - run.time[i - 1];
        if span > 1.0 {
            // A gap: begin anew behind it.
            s = State { wheel_speed: wheel(i), front_speed: wheel(i), ..State::default() };
            plant.set_velocity(&mut s, [0.5 * (run.speed[0][i] + run.speed[1][i]), 0.0]);
            continue;
        }
        let steps = (span / STEP).ceil().max(1.0) as usize;
        let (from, to) = (wheel(i - 1), wheel(i));
        let rate = [(to[0] - from[0]) / span, (to[1] - from[1]) / span];
        let mut mean = [0.0; 2];
        for k in 0..steps {
            let f = (k as f64 + 1.0) / steps as f64;
            plant.step_at_speed(&mut s, [from[0] + f * (to[0] - from[0]), from[1] + f * (to[1] - from[1])], rate);
            mean[0] += s.needed[0] / steps as f64;
            mean[1] += s.needed[1] / steps as f64;
        }
        for (j, m) in mean.into_iter().enumerate() {
            let read = |x: f64| if run.magnitude_only { x.abs().max(run.dead_band) } else { x };
            sum += (read(run.torque[j][i]) - read(m)).powi(2);
            n += 1.0;
        }
    }
    (sum / f64::max(n, 1.0)).sqrt()
}
