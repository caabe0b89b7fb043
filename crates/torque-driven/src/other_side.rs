//! Less of something on one side, or about as much more on the other: what both sides share takes up the difference.

use crate::fit::{Fitted, Problem};
use crate::refits::{best_first, polish, refit_from};
use crate::settings::search::{Finalists, SETTINGS};
use crate::stand_in;
use crate::trial::{self, Trial};
use inference::hypothesis::{Place, Variant};

const FINALISTS: Finalists = SETTINGS.finalists;

/// Adds the best single effect on the other side, where it is a share of one side: a fit that began at the robot file may have come
/// to rest beside either.
pub(crate) fn include(problem: &Problem<'_>, singles: &mut Vec<Trial>) {
    let Some(best) = singles.first().filter(|best| best.hypothesis.parts.len() == 1).cloned() else { return };
    for trial in fits(problem, &best, 0) {
        trial::include(singles, trial);
    }
    best_first(singles);
}

/// Fits of a hypothesis in which one effect, a share of one side, is on the other: from the constants of the fit, and with what scales
/// both sides moved by as much. None where it is no such effect, or not with such a size.
pub(crate) fn fits(problem: &Problem<'_>, of: &Trial, part: usize) -> Vec<Trial> {
    let (variant, onsets) = &of.hypothesis.parts[part];
    let (Place::Side(side), [parameter]) = (variant.place, variant.spec().parameters) else { return Vec::new() };
    let before: usize = of.hypothesis.parts[..part].iter().map(|(v, _)| v.count()).sum();
    let value = of.fitted.point.effects[before];
    let mirrored = -value / (1.0 + value);
    let [least, most] = parameter.bounds;
    if parameter.unit != "-" || !(least..=most).contains(&mirrored) {
        return Vec::new();
    }

    let mut hypothesis = of.hypothesis.clone();
    hypothesis.parts[part] = (Variant { place: Place::Side(1 - side), ..*variant }, onsets.clone());
    let mut effects = of.fitted.point.effects.clone();
    effects[before] = mirrored;
    let mut starts = vec![of.fitted.clone()];
    if let Some(place) = stand_in::of_both_sides(variant) {
        let mut moved = of.fitted.clone();
        moved.point.theta[place] += (1.0 + value).ln() / problem.sigma[place];
        starts.push(moved);
    }
    let fit = |start: Fitted| {
        let trial = refit_from(problem, &hypothesis, &effects, &start);
        polish(problem, &trial, FINALISTS.more_steps)
    };
    starts.into_iter().map(fit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Hypothesis;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use testing::robot;

    #[test]
    fn less_on_the_left_is_tried_where_more_on_the_right_was_found() {
        let robot = robot();
        let blank = problem(&robot, &[]);
        let of = |side: usize| {
            let is_it = |v: &Variant| v.spec().id == "torque_constant_side" && v.place == Place::Side(side);
            blank.variants().into_iter().find(is_it).expect("in the catalogue")
        };
        let doses = [of(0).dose(&[-0.2], None)];
        let cuts = [16.0, 20.0].map(|seconds| cut(&driven(&robot, &doses, seconds), &cutting()));
        let loose = Problem { has_references: false, constants_are_loose: true, ..problem(&robot, &cuts) };
        let right = Hypothesis::single(of(1), Vec::new());
        let origin = loose.begin(&Hypothesis::default(), loose.origin(), None);
        let mut singles = vec![refit_from(&loose, &right, &[0.25], &origin)];
        include(&loose, &mut singles);

        let best = &singles[0];
        assert_eq!(best.hypothesis.variants().map(Variant::label).collect::<Vec<_>>(), [of(0).label()]);
        assert!((best.fitted.point.effects[0] + 0.2).abs() < 0.02, "{:?}", best.fitted.point.effects);
        // A brake of one side is no share: the other side has nothing to give.
        let brake = blank.variants().into_iter().find(|v| v.spec().id == "coulomb_side").expect("in the catalogue");
        let mut singles = vec![refit_from(&loose, &Hypothesis::single(brake, Vec::new()), &[0.3], &origin)];
        include(&loose, &mut singles);
        assert_eq!(singles.len(), 1);
    }
}
