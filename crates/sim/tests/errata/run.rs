//! The run that the tests share, and the few lines of algebra they need.

use std::ops::Range;
use std::sync::LazyLock;

use identifier::{Certificate, Identifier, Midpoint, Step};
use nalgebra::{SMatrix, SVector};
use nn_basis::{Activation, Basis, SigmoidLayer};
use robot_model::paper::PaperRobot;
use sim::{Experiment, Purpose, Recipe, RobotSet, Stream, Trajectory, UNITS};

/// Inputs of the network: own speed, other speed, own torque, other torque.
pub(crate) const INPUTS: usize = 4;
/// a of A = −a I, 1/s.
pub(crate) const POLE: f64 = 8.0;
/// γ.
pub(crate) const GAIN: f64 = 500.0;
/// Sample at which the rolling resistance rises.
pub(crate) const RISE: usize = 12_000;
/// Seed of all draws.
pub(crate) const SEED: u64 = 2014;

/// The experiment of the frozen recipe.
pub(crate) static EXPERIMENT: LazyLock<Experiment> =
    LazyLock::new(|| Experiment::new(&Recipe::default(), RobotSet::B).expect("the default recipe runs"));

/// What the robot does in it.
pub(crate) fn trajectory() -> &'static Trajectory {
    EXPERIMENT.trajectory()
}

/// The robot on its ground before and after 12 s.
pub(crate) fn robots() -> [PaperRobot<f64>; 2] {
    let before = PaperRobot::new(&trajectory().parameters).expect("valid");
    [before, before.with_rolling_resistance(trajectory().parameters.rolling_resistance + 0.3).expect("valid")]
}

/// First layers, U(−1, 1), of wheels 3 and 4 over I inputs of the given sizes.
pub(crate) fn layers<const I: usize>(draw: u64, scale: [f64; I]) -> [SigmoidLayer<f64, I, UNITS>; 2] {
    let mut stream = Stream::new(SEED, Purpose::IdentifierLayer, draw);
    let mut layer = || {
        let threshold = std::array::from_fn(|_| stream.uniform(-1.0, 1.0));
        let weight = std::array::from_fn(|_| std::array::from_fn(|_| stream.uniform(-1.0, 1.0)));
        SigmoidLayer::new(threshold, weight, scale, Activation::Logistic).expect("finite")
    };
    [layer(), layer()]
}

/// Sizes of the inputs own speed, other speed, own torque, other torque.
pub(crate) fn scale() -> [f64; INPUTS] {
    let p = &trajectory().parameters;
    let (speed, torque) =
        (1.4 * trajectory().speed / p.wheel_radius, 0.5 * p.adhesion * p.mass * p.gravity * p.wheel_radius);
    [speed, speed, torque, torque]
}

/// Mean speed of a wheel over the interval `k`, rad/s.
pub(crate) fn mean_speed(side: usize, k: usize) -> f64 {
    0.5 * (trajectory().states[k].speed[side] + trajectory().states[k + 1].speed[side])
}

/// Regressor of the interval `k` for the wheel of a side.
pub(crate) fn regressor<B: Basis<f64, INPUTS, UNITS>>(basis: &B, side: usize, k: usize) -> [f64; UNITS] {
    let (other, torque) = (1 - side, trajectory().torques[k]);
    basis.regressor(&[mean_speed(side, k), mean_speed(other, k), torque[side], torque[other]])
}

/// Mean acceleration of a wheel over the interval `k`, rad/s².
pub(crate) fn acceleration(side: usize, k: usize) -> f64 {
    (trajectory().states[k + 1].speed[side] - trajectory().states[k].speed[side]) / trajectory().step
}

/// What the network should represent over the interval `k`: `g = ẋ + a x`, rad/s².
pub(crate) fn target(side: usize, k: usize) -> f64 {
    acceleration(side, k) + POLE * mean_speed(side, k)
}

/// Weights that minimise `Σ (g − Wᵀφ)² + penalty ‖W‖²` over the intervals `range`.
pub(crate) fn fit<B: Basis<f64, INPUTS, UNITS>>(
    basis: &B,
    side: usize,
    range: Range<usize>,
    penalty: f64,
) -> [f64; UNITS] {
    let mut normal = SMatrix::<f64, UNITS, UNITS>::identity() * penalty;
    let mut moment = SVector::<f64, UNITS>::zeros();
    for k in range {
        let phi = SVector::from(regressor(basis, side, k));
        normal += phi * phi.transpose();
        moment += phi * target(side, k);
    }
    normal.cholesky().expect("positive definite").solve(&moment).into()
}

/// The weights of the best certificate over the intervals `range`: those that make `(2/a) L₀ + (1/a²) Σ h ε²` least.
pub(crate) fn best<B: Basis<f64, INPUTS, UNITS>>(basis: &B, side: usize, range: Range<usize>) -> [f64; UNITS] {
    fit(basis, side, range, POLE / (GAIN * trajectory().step))
}

/// All intervals of the run.
pub(crate) fn whole() -> Range<usize> {
    0..trajectory().torques.len()
}

/// Approximation error `g − Wᵀφ` over the interval `k`, rad/s².
pub(crate) fn epsilon<B: Basis<f64, INPUTS, UNITS>>(basis: &B, side: usize, weight: &[f64; UNITS], k: usize) -> f64 {
    target(side, k) - nn_basis::dot(weight, &regressor(basis, side, k))
}

/// An identifier with zero weights, as in the paper.
pub(crate) fn identifier() -> Identifier<f64, UNITS> {
    Identifier::new(POLE, Midpoint::new(GAIN).expect("positive"), 0.0).expect("valid")
}

/// Follows the wheel of a side over the whole run.
pub(crate) fn follow<B: Basis<f64, INPUTS, UNITS>>(basis: &B, side: usize) -> Vec<Step<f64, UNITS>> {
    let (run, mut identifier) = (trajectory(), identifier());
    (0..run.torques.len())
        .map(|k| {
            let (now, next) = (run.states[k].speed[side], run.states[k + 1].speed[side]);
            identifier.step(now, next, &regressor(basis, side, k), run.step)
        })
        .collect()
}

/// The certificates of a run against one comparison.
pub(crate) fn certificates(steps: &[Step<f64, UNITS>], weight: &[f64; UNITS]) -> Vec<Certificate<f64>> {
    let identifier = identifier();
    steps.iter().map(|s| identifier.certificate(s, weight)).collect()
}

/// Root of the mean square.
pub(crate) fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_u32), |(sum, count), v| (sum + v * v, count + 1));
    (sum / f64::from(count)).sqrt()
}

/// Largest absolute value.
pub(crate) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |m, v| m.max(v.abs()))
}
