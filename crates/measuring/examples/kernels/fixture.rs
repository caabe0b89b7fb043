//! The robot, network and drive that the kernels run with.

use controller::{Gains, Loop, LoopPath, PathReference, Profile, Tracking};
use nn_basis::{Activation, SigmoidLayer};
use robot_model::paper::{Belt, PaperRobot, Parameters, State, Tyre, Variant};
use robot_model::{Scalar, real};

/// How the plant advances.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Scheme {
    Explicit,
    Implicit,
}

/// Lanes of the kernels that run many robots.
pub(crate) const LANES: usize = 8;
/// Pairs of torques that are repeated.
pub(crate) const TORQUES: usize = 4000;

/// A robot of 20 kg whose slip is regularised so that steps of 1 ms are stable.
pub(crate) const PARAMETERS: Parameters = Parameters {
    mass: 20.0,
    yaw_inertia: 0.9,
    wheel_radius: 0.0965,
    wheelbase: 0.35,
    track: 0.43,
    com_height: 0.12,
    com_to_front_axle: 0.175,
    wheel_inertia: 0.03,
    coulomb_torque: 0.15,
    adhesion: 0.6,
    slip_at_peak: 0.2,
    rolling_resistance: 0.02,
    gravity: 9.81,
    slip_floor: 0.15,
    sign_width: 0.3,
};

/// Viscous friction of a side, N m s: taken off the torque, since the paper's robot has none.
pub(crate) const VISCOUS: f64 = 0.12;

pub(crate) fn robot<T: Scalar>(mass: f64) -> PaperRobot<T> {
    let variant = Variant { belt: Belt::SideSum, tyre: Tyre::Uncoupled };
    PaperRobot::with_variant(&Parameters { mass, ..PARAMETERS }, variant).expect("a robot")
}

/// Torques at 100 Hz: drives, turns, spins, stops.
pub(crate) fn torques() -> Vec<[f64; 2]> {
    (0..TORQUES)
        .map(|k| {
            let t = k as f64 * 0.01;
            let straight = 2.2 + 1.2 * (0.7 * t).sin();
            let turn = if (1.1 * t).sin() > -0.3 { 2.6 * (0.31 * t + 0.4).sin() } else { 0.0 };
            [straight - turn, straight + turn]
        })
        .collect()
}

/// One step of 1 ms.
#[inline(always)]
pub(crate) fn advance<T: Scalar>(robot: &PaperRobot<T>, s: &mut State<T>, torque: [f64; 2], scheme: Scheme) {
    let held = [0, 1].map(|i| real::<T>(torque[i]) - real::<T>(VISCOUS) * s.speed[i]);
    match scheme {
        Scheme::Explicit => robot.step_rk4(s, held, real(1e-3)),
        Scheme::Implicit => robot.step_implicit(s, held, real(1e-3)),
    }
}

/// A layer of fixed weights between −1 and 1.
pub(crate) fn layer<T: Scalar, const I: usize, const N: usize>(phase: f64, scale: [f64; I]) -> SigmoidLayer<T, I, N> {
    let number = |j: usize, i: usize| real(f64::sin(phase + 7.0 * j as f64 + 3.3 * i as f64));
    let threshold = std::array::from_fn(|j| number(j, 0));
    let weight = std::array::from_fn(|j| std::array::from_fn(|i| number(j, i + 1)));
    SigmoidLayer::new(threshold, weight, scale.map(real), Activation::Logistic).expect("finite")
}

/// The loop with its tracking controller.
pub(crate) fn tracking<T: Scalar>() -> Tracking<T, SigmoidLayer<T, 4, 8>, 8> {
    let path = Loop { profile: Profile::Smoothstep, ..Loop::default() };
    let gains = Gains::for_robot(&PARAMETERS, 100.0);
    let reference = PathReference::new(LoopPath::new(&path).expect("a loop"));
    Tracking::new(&gains, layer(2.0, [5.0; 4]), reference).expect("gains")
}
