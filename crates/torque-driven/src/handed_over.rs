//! Effects that hide in a constant: where re-tuning without any effect moved a constant far beyond what its robot file
//! states, the effect that it may stand for is fitted from that move on.
//!
//! Without references a fit that begins at the robot file's values can stop half-way, with a part of what is missing in the
//! effect and a part in the constant: both directions of descent are the same.

use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::settings::search::{HandedOver, SETTINGS};
use crate::stand_in::StandIn;

const HANDED_OVER: HandedOver = SETTINGS.handed_over;

/// Hypotheses with one effect more than `h`, which was fitted, and the point from which each is to be fitted: the constant
/// that moved is where the robot file has it, and the effect that is added is what it moved by.
pub(crate) fn starts(problem: &Problem<'_>, h: &Hypothesis, fitted: &Fitted) -> Vec<(Hypothesis, Point)> {
    let (sizes, known) = (problem.sizes(), h.ids());
    let mut out = Vec::new();
    for variant in problem.variants() {
        let Some(constant) = StandIn::of(&variant, problem.robot) else { continue };
        let place = constant.place;
        let sigmas = fitted.point.theta[place] - problem.centre[place];
        if sigmas.abs() < HANDED_OVER.least_sigmas || known.contains(&variant.spec().id) {
            continue;
        }

        let free = variant.free(&sizes);
        let size = constant.size(sigmas * problem.sigma[place]);
        // A size of the wrong sign is no such effect: what became less is no friction that was added.
        if free.is_empty() || size < free[0].bounds[0] || size > free[0].bounds[1] {
            continue;
        }
        let mut point = fitted.point.clone();
        point.theta[place] = problem.centre[place];
        point.effects.push(size);
        point.effects.extend(free[1..].iter().map(|f| f.usual));
        let mut longer = h.clone();
        longer.parts.push((variant, Vec::new()));
        out.push((longer, point));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run_numbers::constant;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use testing::robot;

    #[test]
    fn a_constant_far_off_becomes_the_effect_of_its_size_and_one_near_does_not() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 8.0), &cutting())];
        let problem = problem(&robot, &cuts);
        let at = constant("viscous");
        let of = |sigmas: f64| {
            let mut point = problem.origin();
            point.theta[at] += sigmas;
            let none = Hypothesis::default();
            starts(&problem, &none, &problem.begin(&none, point, None))
        };

        assert!(of(0.5).is_empty(), "within its sigma it is a constant");
        let far = of(4.0);
        let ids: Vec<_> = far.iter().flat_map(|(h, _)| h.ids()).collect();
        assert_eq!(ids, ["viscous_friction"]);
        let (_, point) = &far[0];
        assert_eq!(point.theta, problem.origin().theta, "the constant is where the file has it");
        let added = robot.viscous[0] * ((4.0 * problem.sigma[at]).exp() - 1.0);
        approx::assert_relative_eq!(point.effects[0], added, epsilon = 1e-12);
        assert!(of(-4.0).is_empty(), "less friction is no friction that was added");

        // Beside another effect, which keeps its values; what is there already is not added again.
        let with = |id: &str, effects: Vec<f64>| {
            let of_id = |v: &inference::hypothesis::Variant| v.spec().id == id;
            let variant = problem.variants().into_iter().find(of_id).expect("in the catalogue");
            let h = Hypothesis::single(variant, Vec::new());
            let mut point = Point { effects, ..problem.origin() };
            point.theta[at] += 4.0;
            starts(&problem, &h, &problem.begin(&h, point, None))
        };
        let pairs = with("grade", vec![0.01, 0.02]);
        assert_eq!(pairs.iter().flat_map(|(h, _)| h.ids()).collect::<Vec<_>>(), ["grade", "viscous_friction"]);
        assert_eq!(pairs[0].1.effects, [0.01, 0.02, added]);
        assert!(with("viscous_friction", vec![0.05]).is_empty());
    }
}
