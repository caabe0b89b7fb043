//! "Nothing is missing": constants re-tuned without any effect.

use std::array;

use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::run_numbers::constant;
use crate::settings::fit::{self, Fit};
use crate::settings::search::{Retuning, SETTINGS};

const RETUNING: Retuning = SETTINGS.retuning;
const FIT: Fit = fit::SETTINGS.fit;

/// Re-tunes constants, beside the effects of a hypothesis.
pub(crate) fn retune(problem: &Problem<'_>, h: &Hypothesis, start: Fitted) -> Fitted {
    let retuned = problem.refine(h, start, RETUNING.first_steps, Some(1));
    problem.refine(h, retuned, RETUNING.second_steps, Some(0))
}

/// The best fit without any effect, from `origin` and, where no reference showed how this robot's tyres slip, from other tyres
/// too: between a tyre that slips by a share of its speed and a contact that creeps with the slip speed lie bad fits, which
/// no step crosses.
pub(crate) fn without_effect(problem: &Problem<'_>, origin: &Fitted) -> Fitted {
    let none = Hypothesis::default();
    let mut best = retune(problem, &none, origin.clone());
    if problem.has_references {
        return best;
    }
    for tyre in RETUNING.tyres {
        let again = retune(problem, &none, problem.begin(&none, with_tyre(problem, tyre), None));
        if again.cost < best.cost {
            best = again;
        }
    }
    best
}

/// The origin with the tyre whose slip at the peak and rest speed (m/s) are these.
fn with_tyre(problem: &Problem<'_>, [slip_at_peak, rest_speed]: [f64; 2]) -> Point {
    let robot = problem.robot;
    let places = const { [constant("slip_at_peak"), constant("rest_speed")] };
    let ratios = [slip_at_peak / robot.slip_at_peak, rest_speed / robot.rest_speed];
    let mut point = problem.origin();
    let moves: [f64; 2] = array::from_fn(|i| ratios[i].ln() / problem.sigma[places[i]]);
    for (place, sigmas) in places.into_iter().zip(moves) {
        point.theta[place] = sigmas.clamp(-FIT.farthest, FIT.farthest);
    }
    point
}

/// Whether recordings are so far from the robot file, or from what references taught, that a fit from there may not arrive.
pub(crate) fn is_far(origin: &Fitted, retuned: &Fitted) -> bool {
    origin.cost > RETUNING.far * retuned.cost
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use robot_model::Robot;
    use testing::robot;

    #[test]
    fn a_contact_that_creeps_with_the_slip_speed_is_no_mismatch_without_references() {
        // As simulators have it: the slip speed goes with the force, whatever the speed of the wheel.
        let file = robot();
        let truth = Robot { slip_at_peak: 0.1, rest_speed: 3.0, adhesion: 0.6 * file.adhesion, ..file };
        let cuts = [14.0, 18.0].map(|seconds| cut(&driven(&truth, &[], seconds), &cutting()));
        let with = problem(&file, &cuts);
        let without = Problem { has_references: false, constants_are_loose: true, ..problem(&file, &cuts) };
        let best = |problem: &Problem<'_>| {
            let origin = problem.begin(&Hypothesis::default(), problem.origin(), None);
            (origin.cost, without_effect(problem, &origin).cost)
        };

        let (as_it_is, fitted) = best(&without);
        assert!(fitted < 0.1 * as_it_is, "{as_it_is} {fitted}");
        let (_, from_the_file_alone) = best(&with);
        assert!(fitted < 0.5 * from_the_file_alone, "{from_the_file_alone} {fitted}");
    }

    #[test]
    fn the_robot_file_is_far_where_re_tuning_closes_most() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 8.0), &cutting())];
        let p = problem(&robot, &cuts);
        let fitted = p.begin(&Hypothesis::default(), p.origin(), None);
        let costing = |cost: f64| Fitted { cost, ..fitted.clone() };
        assert!(is_far(&costing(900.0), &costing(300.0)));
        assert!(!is_far(&costing(400.0), &costing(300.0)));
    }
}
