//! What the contenders make of what they see.

use nn_basis::{Basis, Constant, SigmoidLayer, dot};
use robot_model::paper::{PaperRobot, SideSignals, State, TERMS, terms};

use super::course::Course;
use crate::{SIGNALS, Signals, rk4};

/// An interval as a contender sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight<'a> {
    /// Mean measured wheel speeds, rad/s.
    pub(super) speed: [f64; 2],
    /// Torques held, N m.
    pub(super) torque: [f64; 2],
    /// Motion of the body in the middle of the interval, for those that may see it; its wheels turn as they really did.
    pub(super) body: &'a State<f64>,
}

/// Where a prediction starts.
pub(super) struct Start<'a> {
    pub(super) course: &'a Course,
    /// Pole a of the identifier, 1/s.
    pub(super) pole: f64,
    /// Sample.
    pub(super) k: usize,
    /// Estimated wheel speeds there, rad/s.
    pub(super) speed: [f64; 2],
}

/// Runs `ẋ = −a x + Wᵀφ(x, u) + known` with fixed weights, both outputs together: wheel speeds after each interval.
pub(super) fn of_speeds<R: Regressor<N> + ?Sized, const N: usize>(
    regressor: &R,
    weight: &[[f64; N]; 2],
    start: &Start,
    intervals: usize,
) -> Vec<[f64; 2]> {
    let Start { course, pole, k, mut speed } = *start;
    let h = course.run.step;
    (k..k + intervals)
        .map(|k| {
            let sight = Sight { speed, torque: course.run.torques[k], body: &course.run.states[k] };
            let rate = [0, 1].map(|i| {
                let g = dot(&weight[i], &regressor.phi(i, &sight)) + regressor.known(i, pole, &sight);
                g - pole * speed[i]
            });
            for i in 0..2 {
                speed[i] += h * rate[i];
            }
            speed
        })
        .collect()
}

/// Runs Eq. 8 with fixed weights, the body carried along by known mass, geometry and adhesion from its state at the start.
pub(super) fn of_equation_8(
    regressor: &Equation8,
    weight: &[[f64; TERMS]; 2],
    start: &Start,
    intervals: usize,
) -> Vec<[f64; 2]> {
    let Start { course, k, speed, .. } = *start;
    let mut numbers = State { speed, ..course.run.states[k] }.to_array();
    let h = course.run.step / regressor.substeps as f64;
    (k..k + intervals)
        .map(|k| {
            let torque = course.run.torques[k];
            for _ in 0..regressor.substeps {
                numbers = rk4(&numbers, h, |n| {
                    let state = State::from_array(*n);
                    let (rate, out) = regressor.robot.evaluate(&state, torque);
                    let psi = regressor.terms(&state, out.acceleration, torque);
                    State { speed: [0, 1].map(|i| dot(&weight[i], &psi[i])), ..rate }.to_array()
                });
            }
            State::from_array(numbers).speed
        })
        .collect()
}

/// A regressor of both outputs.
pub(super) trait Regressor<const N: usize> {
    /// φ of an output.
    fn phi(&self, output: usize, sight: &Sight) -> [f64; N];

    /// What is known of the right-hand side besides, rad/s².
    fn known(&self, _output: usize, _pole: f64, _sight: &Sight) -> f64 {
        0.0
    }

    /// Predicted wheel speeds after each interval from the start on, with fixed weights and the torques that were held.
    fn ahead(&self, weight: &[[f64; N]; 2], start: &Start, intervals: usize) -> Vec<[f64; 2]> {
        of_speeds(self, weight, start, intervals)
    }
}

/// Signals of an output in the order of [`crate::Input`]; angles are not shown.
fn signals(output: usize, sight: &Sight) -> Signals {
    let (x, u, other) = (&sight.speed, &sight.torque, 1 - output);
    [0.0, 0.0, x[output], x[other], u[output], u[other]]
}

/// A basis per output over speeds and torques: the paper's network.
pub(super) struct Network<const N: usize>(pub(super) [SigmoidLayer<f64, SIGNALS, N>; 2]);

impl<const N: usize> Regressor<N> for Network<N> {
    fn phi(&self, output: usize, sight: &Sight) -> [f64; N] {
        self.0[output].regressor(&signals(output, sight))
    }
}

impl<const N: usize> Regressor<N> for Constant<f64, N> {
    fn phi(&self, output: usize, sight: &Sight) -> [f64; N] {
        self.regressor(&signals(output, sight))
    }
}

/// No regressor at all: only `G = a x`, that is `ẋ = 0`, is known.
pub(super) struct Nothing;

impl Regressor<1> for Nothing {
    fn phi(&self, _: usize, _: &Sight) -> [f64; 1] {
        [0.0]
    }

    fn known(&self, output: usize, pole: f64, sight: &Sight) -> f64 {
        pole * sight.speed[output]
    }
}

/// The terms of Eq. 8, from the slip of measured wheels and the measured motion of the body. `a x` is known.
pub(super) struct Equation8 {
    pub(super) robot: PaperRobot<f64>,
    pub(super) torque_scale: f64,
    /// Runge-Kutta steps per sample of a prediction.
    pub(super) substeps: usize,
}

impl Equation8 {
    /// The terms for a state of the robot.
    pub(super) fn terms(&self, state: &State<f64>, acceleration: [f64; 2], torque: [f64; 2]) -> [[f64; TERMS]; 2] {
        let slip = self.robot.slip(state);
        [0, 1].map(|side| {
            let signals =
                SideSignals { speed: state.speed[side], slip: slip[2 + side][0], acceleration, torque: torque[side] };
            terms(side, &signals, self.robot.constants(), self.torque_scale)
        })
    }
}

impl Regressor<TERMS> for Equation8 {
    fn phi(&self, output: usize, sight: &Sight) -> [f64; TERMS] {
        // An accelerometer at R shows the specific force of the contacts.
        let acceleration = self.robot.evaluate(sight.body, sight.torque).1.acceleration;
        let seen = State { speed: sight.speed, ..*sight.body };
        self.terms(&seen, acceleration, sight.torque)[output]
    }

    fn known(&self, output: usize, pole: f64, sight: &Sight) -> f64 {
        pole * sight.speed[output]
    }

    fn ahead(&self, weight: &[[f64; TERMS]; 2], start: &Start, intervals: usize) -> Vec<[f64; 2]> {
        of_equation_8(self, weight, start, intervals)
    }
}
