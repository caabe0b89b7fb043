//! What an arbitrary input at a place would have been, window by window, beside what a law may depend on: for whoever looks for
//! a law by other means.

use inference::{DiagnosisError, Options};
use law::{Input, Law, Motion, Place, Variable};
use robot_model::Robot;

use super::arbitrary::{Acts, Instant, wide};
use super::operator::Operator;
use super::series::Ground;
use super::signals::Signals;
use crate::calibrate::problem;
use crate::case::Case;
use crate::diagnose::{Calibrated, cut_all, number};
use crate::fit::{Hypothesis, Problem};
use crate::redundancy::check;
use crate::run::largest_torque;
use crate::settings::law::SETTINGS;
use crate::visit::{VisitNumbers, visits_of};

/// A window of 0.1 s of a recording with what acted in it.
#[derive(Debug, Clone, PartialEq)]
pub struct ResidualWindow {
    /// Name of the recording.
    pub recording: String,
    /// What it acted through; a place of both sides has a window for each.
    pub input: Input,
    /// First row of the window, and the row behind its last.
    pub rows: [usize; 2],
    /// Most probable mean over the window, in the unit of the place.
    pub size: f64,
    /// Its standard deviation, in that unit.
    pub sigma: f64,
    /// Means over the window of what the input sees, in the order of [`Variable::ALL`] and in their units; of the heading, its
    /// direction on average, within ±π.
    pub variables: [f64; Variable::ALL.len()],
    /// Mean position on the ground, m.
    pub position: [f64; 2],
    /// Mean over the window of what a given law does there, in the unit of the place; zero without one. A slope counts as the
    /// force that it is.
    pub law: f64,
}

impl Calibrated {
    /// What an arbitrary input at a place would have been in every window of the recordings of a case, constants and the
    /// recordings' own numbers free beside it; empty where its equations have no solution. `law` is evaluated on the same
    /// windows.
    ///
    /// # Errors
    /// When a recording is too short.
    pub fn residual(
        &self,
        case: &Case,
        options: &Options,
        place: Place,
        law: Option<&Law>,
    ) -> Result<Vec<ResidualWindow>, DiagnosisError> {
        let sensors = check(&case.recordings, &case.references, Some(self.robot.wheel_radius));
        let visits = VisitNumbers::new(&self.visits, &visits_of(&case.recordings));
        let mut cuts = cut_all(&case.recordings, &sensors, case, &self.robot, options)?;
        number(&mut cuts, &visits.recordings);
        let largest = largest_torque(&case.recordings).max(self.largest_torque);
        let calibration = self.calibration.clone().for_visits(&visits);
        let p = problem(&self.robot, case, &cuts, &calibration, largest, options);
        Ok(residual(&p, place, law).unwrap_or_default())
    }
}

/// Every window of a problem, recording by recording; `None` where the equations have no solution.
fn residual(p: &Problem<'_>, place: Place, law: Option<&Law>) -> Option<Vec<ResidualWindow>> {
    let base = p.begin(&Hypothesis::default(), p.origin(), None);
    let inputs: Vec<Input> = Input::ALL.into_iter().filter(|input| place.acts_on(*input)).collect();
    let operator = Operator::of(p, &base, &inputs);
    let wide = wide(p);
    let ground = Ground { problem: &wide, base: &base, operator: &operator };
    let acts = Acts::new(&ground, place, &SETTINGS.events.sizes)?;
    let (_, instants) = acts.throughout(&ground)?;
    let signals = Signals::new(p, &base);
    let of = |i: &Instant| {
        let (cut, input) = (&p.cuts[i.run], acts.inputs[i.input]);
        let parts = signals.window(i.run, i.window);
        let mean = |of: &dyn Fn(&Motion<f64>) -> f64| parts.iter().map(of).sum::<f64>() / parts.len().max(1) as f64;
        let seen = |v: Variable| match v {
            // A mean of angles would jump where they wrap.
            Variable::Heading => mean(&|m| m.heading[1]).atan2(mean(&|m| m.heading[0])),
            _ => mean(&|m| v.seen_by(place, input, m).unwrap_or_default()),
        };
        ResidualWindow {
            recording: cut.name.clone(),
            input,
            rows: [i.window, i.window + 1].map(|w| w * cut.rows_per_window),
            size: i.size,
            sigma: i.sigma,
            variables: Variable::ALL.map(seen),
            position: [mean(&|m| m.position[0]), mean(&|m| m.position[1])],
            law: law.map_or(0.0, |law| mean(&|m| acting(law, m, input, p.robot))),
        }
    };
    Some(instants.iter().map(of).collect())
}

/// What a law does through an input at an instant, its slopes as forces.
fn acting(law: &Law, m: &Motion<f64>, input: Input, robot: &Robot<f64>) -> f64 {
    let action = law.act(m, &[]);
    let ([cos, sin], [x, y]) = (m.heading, action.slope);
    let weight = robot.mass * robot.gravity;
    action.get(input)
        - match input {
            Input::Force(0) => weight * (x * cos + y * sin),
            Input::Force(_) => weight * (y * cos - x * sin),
            _ => 0.0,
        }
}

#[cfg(test)]
mod tests {
    use inference::hypothesis::Place as Present;
    use testing::robot;

    use super::*;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;

    #[test]
    fn a_brake_of_one_side_comes_out_window_by_window_as_the_law_that_it_is() {
        let all = inference::hypothesis::variants(true);
        let brake = all.into_iter().find(|v| v.spec().id == "coulomb_side" && v.place == Present::Side(1));
        let dose = brake.expect("in the catalogue").dose(&[0.6], None);
        let robot = robot();
        let cuts = [12.0, 16.0].map(|seconds| cut(&driven(&robot, std::slice::from_ref(&dose), seconds), &cutting()));
        let p = problem(&robot, &cuts);
        let law: Law = "T_right = -0.6 [N m] * sgn(omega, 0.3)".parse().expect("a law");
        let windows = residual(&p, Place::TorqueRight, Some(&law)).expect("a solution");

        let count: usize = cuts.iter().flat_map(|c| &c.segments).map(|s| s.windows).sum();
        assert_eq!(windows.len(), count);
        let sum = |of: &dyn Fn(&ResidualWindow) -> f64| windows.iter().map(|w| (of(w) / w.sigma).powi(2)).sum::<f64>();
        let left = sum(&|w| w.size - w.law) / sum(&|w| w.size);
        assert!(left < 0.3, "the law leaves {left}");
        let without = residual(&p, Place::TorqueRight, None).expect("a solution");
        assert!(without.iter().zip(&windows).all(|(a, b)| a.law == 0.0 && a.size == b.size));
        for w in &windows {
            // The law is that of the wheel speed that stands beside it, but where a window holds both signs.
            let [omega, ..] = w.variables;
            assert!(omega.abs() < 2.0 || (w.law + 0.6 * omega.signum()).abs() < 0.1, "{w:?}");
        }
    }

    #[test]
    fn a_slope_counts_as_the_force_that_it_is() {
        let robot = robot();
        let law: Law = "slope_x = 0.1 [rad]".parse().expect("a law");
        let m = Motion { heading: [0.6, 0.8], ..Motion::default() };
        let weight = robot.mass * robot.gravity;
        approx::assert_relative_eq!(acting(&law, &m, Input::Force(0), &robot), -0.06 * weight, max_relative = 1e-12);
        approx::assert_relative_eq!(acting(&law, &m, Input::Force(1), &robot), 0.08 * weight, max_relative = 1e-12);
        assert_eq!(acting(&law, &m, Input::Moment, &robot), 0.0);
    }
}
