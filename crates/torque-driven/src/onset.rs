//! Moving the onsets of an effect that begins at an instant.

use crate::fit::Problem;
use crate::settings::decision::{self, Prices};
use crate::settings::search::{ExactOnsets, SETTINGS};
use crate::trial::Trial;
use inference::hypothesis::Place;

const ONSETS: ExactOnsets = SETTINGS.exact_onsets;
const PRICES: Prices = decision::SETTINGS.prices;

/// Moves every onset to where the cost is least: long steps about the start, then short ones.
pub(crate) fn scan(problem: &Problem<'_>, trial: &mut Trial) {
    for part in 0..trial.hypothesis.parts.len() {
        if !trial.hypothesis.parts[part].0.begins() {
            continue;
        }
        for run in 0..problem.cuts.len() {
            let cut = &problem.cuts[run];
            for step in ONSETS.steps {
                let Some(now) = trial.hypothesis.parts[part].1[run] else { continue };
                let mut least = problem.misfit_of_run(run, &trial.fitted.response[run]);
                for k in (-ONSETS.reach..=ONSETS.reach).filter(|&k| k != 0) {
                    let mut h = trial.hypothesis.clone();
                    h.parts[part].1[run] = Some((now + step * f64::from(k)).clamp(cut.from, cut.end()));
                    let response = problem.run_response(run, &trial.fitted.point, &h);
                    let cost = problem.misfit_of_run(run, &response);
                    if cost < least {
                        trial.fitted.cost += cost - least;
                        trial.fitted.response[run] = response;
                        trial.hypothesis = h;
                        least = cost;
                    }
                }
            }
        }
    }
}

/// Takes an effect of one side for one that is there throughout, where that costs no more than an instant has to gain to be told.
pub(crate) fn settle(problem: &Problem<'_>, trial: &mut Trial) {
    for part in 0..trial.hypothesis.parts.len() {
        let Place::OnsetOfSide(side) = trial.hypothesis.parts[part].0.place else { continue };
        let mut h = trial.hypothesis.clone();
        h.parts[part].0.place = Place::Side(side);
        h.parts[part].1.clear();
        let fitted = problem.begin(&h, trial.fitted.point.clone(), Some(trial.fitted.columns.clone()));
        if fitted.cost < trial.fitted.cost + PRICES.onset {
            *trial = Trial { hypothesis: h, fitted };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::{Hypothesis, Point};
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use testing::robot;

    #[test]
    fn a_brake_that_was_there_from_the_beginning_has_no_instant_and_one_that_began_keeps_it() {
        let robot = robot();
        let of = |place: Place| {
            inference::hypothesis::variants(true)
                .into_iter()
                .find(|v| v.spec().id == "coulomb_side" && v.place == place)
        };
        let begins = of(Place::OnsetOfSide(0)).expect("in the catalogue");
        let settled = |from: f64| {
            let cuts = [cut(&driven(&robot, &[begins.dose(&[0.5], Some(from))], 16.0), &cutting())];
            let p = problem(&robot, &cuts);
            let hypothesis = Hypothesis::single(begins, vec![Some(from)]);
            let point = Point { effects: vec![0.5], ..p.origin() };
            let fitted = p.begin(&hypothesis, point, None);
            let mut trial = Trial { hypothesis, fitted };
            settle(&p, &mut trial);
            trial.hypothesis.parts[0].0.place
        };
        assert_eq!([settled(0.0), settled(8.0)], [Place::Side(0), Place::OnsetOfSide(0)]);
    }
}
