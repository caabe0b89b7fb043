//! Prediction from the torques alone.

use nn_basis::dot;
use robot_model::paper::{State, TERMS};

use super::course::Course;
use super::regressor::{Equation8, Regressor, Sight};
use crate::rk4;

/// How far ahead is predicted, s.
pub const HORIZONS: [f64; 3] = [0.1, 0.5, 2.0];
/// Time from one start to the next, s.
pub(super) const BETWEEN_STARTS: f64 = 0.5;

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

/// Squared errors at the horizons, added up over starts.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Errors {
    squares: [f64; HORIZONS.len()],
    count: [usize; HORIZONS.len()],
}

impl Errors {
    /// Intervals that a prediction needs.
    pub(super) fn intervals(course: &Course) -> usize {
        (HORIZONS[HORIZONS.len() - 1] / course.run.step).round() as usize
    }

    /// Adds a prediction from sample `k`. Horizons that span the change of the ground are left out: it is not in the
    /// torques yet, so no model can foresee it.
    pub(super) fn add(&mut self, course: &Course, k: usize, predicted: &[[f64; 2]]) {
        let h = course.run.step;
        let start = k as f64 * h;
        for (i, horizon) in HORIZONS.iter().enumerate() {
            if (start..start + horizon).contains(&course.changes_at) {
                continue;
            }
            let n = (horizon / h).round() as usize;
            let (found, truth) = (&predicted[n - 1], &course.run.states[k + n].speed);
            self.squares[i] += 0.5 * ((found[0] - truth[0]).powi(2) + (found[1] - truth[1]).powi(2));
            self.count[i] += 1;
        }
    }

    /// Root mean squares, rad/s.
    pub(super) fn rms(&self) -> [f64; HORIZONS.len()] {
        std::array::from_fn(|i| (self.squares[i] / self.count[i].max(1) as f64).sqrt())
    }
}
