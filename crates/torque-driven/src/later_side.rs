//! What begins at an instant, on one side.
//!
//! Without references an effect of one side that begins at an instant is no candidate of the screen: about constants that may be far
//! off, two of them explain what has no name. Such a one is looked for alone: where an effect of both sides that begins was found, its instants are those of
//! something, and one side may be what begins there.

use inference::hypothesis::{Place, Variant, variants_of};

use crate::fit::{Fitted, Hypothesis, Problem};
use crate::refits::{begin, best_first, better, polish, refit_from};
use crate::screen::screen;
use crate::settings::search::{Finalists, SETTINGS};
use crate::trial::{self, Trial};

const FINALISTS: Finalists = SETTINGS.finalists;

/// Adds effects of one side that begin, where the best single effect begins or is of one side and the screen had none of them: at its
/// instants, or at those that a screen about its constants finds.
pub(crate) fn include(problem: &Problem<'_>, origin: &Fitted, singles: &mut Vec<Trial>) {
    let Some(best) = singles.first().filter(|best| !problem.has_references && best.hypothesis.parts.len() == 1) else {
        return;
    };
    let (variant, onsets) = best.hypothesis.parts[0].clone();
    let starts: Vec<(Hypothesis, Vec<Vec<f64>>)> = match variant.place {
        Place::Onset => {
            of_one_side(problem).map(|v| (Hypothesis::single(v, onsets.clone()), usual(problem, &v))).collect()
        }
        Place::Side(side) => about(problem, &best.fitted, side),
        _ => return,
    };

    let best = best.fitted.clone();
    let fitted = |(h, starts): &(Hypothesis, Vec<Vec<f64>>)| {
        let of = |start: &Vec<f64>| better(refit_from(problem, h, start, origin), refit_from(problem, h, start, &best));
        starts.iter().map(of).reduce(better)
    };
    let mut found: Vec<Trial> = starts.iter().filter_map(fitted).collect();
    best_first(&mut found);
    for (k, trial) in found.into_iter().enumerate() {
        trial::include(singles, if k == 0 { polish(problem, &trial, FINALISTS.more_steps) } else { trial });
    }
    best_first(singles);
}

/// Whether a form of an effect is no member of several: two that begin, one of them on one side, explain what has no name where only the
/// robot file says what is usual.
pub(crate) fn is_alone(problem: &Problem<'_>, variant: &Variant) -> bool {
    !problem.has_references && matches!(variant.place, Place::OnsetOfSide(_))
}

/// Usual values of an effect, with either sign where it may have both.
fn usual(problem: &Problem<'_>, variant: &Variant) -> Vec<Vec<f64>> {
    let free = variant.free(&problem.sizes());
    let signs: &[f64] = if variant.spec().signed { &[1.0, -1.0] } else { &[1.0] };
    signs.iter().map(|sign| free.iter().map(|f| (sign * f.usual).clamp(f.bounds[0], f.bounds[1])).collect()).collect()
}

/// Effects of a side with the instants and values that a screen about the constants of a fit gives them.
fn about(problem: &Problem<'_>, fitted: &Fitted, side: usize) -> Vec<(Hypothesis, Vec<Vec<f64>>)> {
    let none = Hypothesis::default();
    let base = begin(problem, &none, &fitted.point, &[], fitted);
    let forms: Vec<Variant> = of_one_side(problem).filter(|v| v.side() == Some(side)).collect();
    let begins = screen(problem, &base, &forms, &none).into_iter();
    begins.map(|c| (Hypothesis::single(c.variant, c.onsets), vec![c.start])).collect()
}

/// Forms of effects that begin on one side.
fn of_one_side(problem: &Problem<'_>) -> impl Iterator<Item = Variant> {
    let all = variants_of(problem.known, problem.robot.chassis, true).into_iter();
    let (without, same_robot) = (problem.without, problem.same_robot);
    all.filter(move |v| {
        matches!(v.place, Place::OnsetOfSide(_))
            && without != Some(v.spec().id)
            && !(same_robot && catalogue::needs_a_hand(v.spec().id))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use testing::robot;

    /// The best single effect about drives with a brake on the left from 8 s on, after such a one was found.
    fn best_after(id: &str, place: Place, instants: &[f64], has_references: bool) -> (String, f64) {
        let robot = robot();
        let blank = problem(&robot, &[]);
        let of = |id: &str, place: Place| {
            let is_it = |v: &Variant| v.spec().id == id && v.place == place;
            blank.variants().into_iter().find(is_it).expect("in the catalogue")
        };
        let brake = of("coulomb_side", Place::OnsetOfSide(0));
        let cuts =
            [16.0, 18.0].map(|seconds| cut(&driven(&robot, &[brake.dose(&[0.5], Some(8.0))], seconds), &cutting()));
        let p = Problem { has_references, constants_are_loose: !has_references, ..problem(&robot, &cuts) };
        let origin = p.begin(&Hypothesis::default(), p.origin(), None);
        let h = Hypothesis::single(of(id, place), instants.iter().map(|t| Some(*t)).collect());
        let mut singles = vec![refit_from(&p, &h, &[0.02], &origin)];
        include(&p, &origin, &mut singles);
        let best = &singles[0];
        (best.hypothesis.parts[0].0.label(), best.fitted.point.effects[0])
    }

    #[test]
    fn without_references_what_began_on_both_sides_or_is_on_one_may_be_what_began_on_one() {
        for (id, place, instants) in
            [("rolling_resistance", Place::Onset, &[8.0, 8.0][..]), ("coulomb_side", Place::Side(0), &[])]
        {
            let (label, size) = best_after(id, place, instants, false);
            assert_eq!(label, "coulomb_side (left, from an instant)", "after {id}");
            assert!((size - 0.5).abs() < 0.05, "{size}");
        }
        let (label, _) = best_after("rolling_resistance", Place::Onset, &[8.0, 8.0], true);
        assert!(label.starts_with("rolling_resistance"), "references let the screen see it: {label}");
    }
}
