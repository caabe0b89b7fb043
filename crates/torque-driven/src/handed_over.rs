//! Effects that hide in a constant: where re-tuning without any effect moved a constant far beyond what its robot file
//! states, the effect that it may stand for is fitted from that move on.
//!
//! Without references a fit that begins at the robot file's values can stop half-way, with a part of what is missing in the
//! effect and a part in the constant: both directions of descent are the same.

use crate::candidate::sizes_tried;
use crate::fit::{Fitted, Hypothesis, Point, Problem};
use crate::settings::fit::{self, Fit};
use crate::settings::search::{HandedOver, SETTINGS};
use crate::stand_in::StandIn;
use crate::trial::Trial;

const HANDED_OVER: HandedOver = SETTINGS.handed_over;
const FIT: Fit = fit::SETTINGS.fit;

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

/// The same where a constant is as far from the robot file as it may go: what is missing is no constant's then, and those that moved
/// went together. All of them are where the file has them again, and the effect has the size whose free run costs least.
pub(crate) fn starts_beyond_stops(problem: &Problem<'_>, h: &Hypothesis, fitted: &Fitted) -> Vec<(Hypothesis, Point)> {
    let theta = &fitted.point.theta;
    if theta.iter().all(|x| x.abs() < FIT.farthest) {
        return Vec::new();
    }
    let with_size = |(longer, point): (Hypothesis, Point)| {
        let size = longer.parts.last().and_then(|(variant, _)| variant.free(&problem.sizes()).into_iter().next())?;
        let at = fitted.point.effects.len();
        let of_size = |value: f64| {
            let mut point = point.clone();
            for (own, centre) in point.theta.iter_mut().zip(problem.centre) {
                if (*own - centre).abs() > HANDED_OVER.least_sigmas {
                    *own = centre;
                }
            }
            point.effects[at] = value;
            point
        };
        let points = sizes_tried(&size).map(of_size);
        let cost = |point: &Point| problem.begin(&longer, point.clone(), Some(fitted.columns.clone())).cost;
        let best = points.map(|point| (cost(&point), point)).min_by(|a, b| a.0.total_cmp(&b.0));
        best.map(|(_, point)| (longer, point))
    };
    starts(problem, h, fitted).into_iter().filter_map(with_size).collect()
}

/// Where a fit of `member` begins that holds some of the effects of `whole`, whose values are `effects`: at the constants of the
/// whole, each effect that it lacks put into the constant that may stand for it.
///
/// A constant and the effect that it stands for may have moved against each other on the way; together they are the one or the other.
pub(crate) fn taken_back(problem: &Problem<'_>, whole: &Trial, member: &Hypothesis, effects: Vec<f64>) -> Point {
    let mut point = Point { effects, ..whole.fitted.point.clone() };
    if !problem.constants_are_loose {
        return point;
    }
    let mut rest = whole.fitted.point.effects.as_slice();
    for variant in whole.hypothesis.variants() {
        let (own, others) = rest.split_at(variant.count());
        rest = others;
        let is_kept = member.variants().any(|kept| kept.label() == variant.label());
        let constant = StandIn::of(variant, problem.robot).filter(|_| !is_kept);
        let move_of = |constant: StandIn| Some((constant.place, constant.moved(*own.first()?)?));
        if let Some((place, moved)) = constant.and_then(move_of) {
            let sigmas = point.theta[place] + moved / problem.sigma[place];
            point.theta[place] = sigmas.clamp(-FIT.farthest, FIT.farthest);
        }
    }
    point
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
    #[test]
    fn an_effect_that_is_left_out_goes_into_its_constant_where_constants_are_loose() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 8.0), &cutting())];
        let held = problem(&robot, &cuts);
        let loose = Problem { constants_are_loose: true, ..problem(&robot, &cuts) };
        let of = |id: &str| held.variants().into_iter().find(|v| v.spec().id == id).expect("in the catalogue");
        let at = constant("lateral_factor");

        // The constant went up, and the effect down by as much.
        let parts = ["quadratic_drag", "turning_resistance"].map(|id| (of(id), Vec::new())).to_vec();
        let whole = Hypothesis { parts, acting: None };
        let mut point = Point { effects: vec![3.0, -0.25], ..loose.origin() };
        point.theta[at] = 0.3 / loose.sigma[at];
        let whole = Trial { fitted: loose.begin(&whole, point, None), hypothesis: whole };
        let drag = Hypothesis::single(of("quadratic_drag"), Vec::new());
        let start = |problem: &Problem<'_>| taken_back(problem, &whole, &drag, vec![3.0]);

        let kept = start(&loose);
        assert_eq!(kept.effects, [3.0]);
        approx::assert_relative_eq!(kept.theta[at], (0.3 + 0.75_f64.ln()) / loose.sigma[at], epsilon = 1e-12);
        // The motion is the same, and the constant is nearer to the robot file.
        let taken = loose.begin(&drag, kept, None);
        assert!(taken.cost < whole.fitted.cost, "{} {}", taken.cost, whole.fitted.cost);
        assert_eq!(start(&held).theta, whole.fitted.point.theta);
    }
}
