//! How often a place was driven over with effect: what was met once may as well have been an event in time.

use crate::fit::{Fitted, Problem};
use crate::local::share_inside;
use crate::settings::decision::SETTINGS;
use crate::trial::Trial;
use crate::windows::PARTS;
use inference::hypothesis::Place;

/// Separate visits to the disc of a trial whose segments it explains better than re-tuning; `None` without a disc.
///
/// A visit is an unbroken row of segments of one recording in which a wheel was inside.
pub(crate) fn supporting(problem: &Problem<'_>, retuned: &Fitted, trial: &Trial) -> Option<usize> {
    let mut end = 0;
    let disc = trial.hypothesis.parts.iter().find_map(|(variant, _)| {
        end += variant.count();
        (variant.place == Place::Disc).then(|| {
            let e = &trial.fitted.point.effects[end - 3..end];
            [e[0], e[1], e[2]]
        })
    })?;
    let mut count = 0;
    for (r, cut) in problem.cuts.iter().enumerate() {
        let mut gain = 0.0;
        let mut visits = Vec::new();
        for (s, segment) in cut.segments.iter().enumerate() {
            let inside = (0..PARTS).any(|q| share_inside(segment, q, disc) > 0.0);
            if inside {
                let cost = |f: &Fitted| problem.segment_cost(r, s, problem.q(r, s, &f.response[r][s]));
                gain += cost(retuned) - cost(&trial.fitted);
            } else {
                visits.push(std::mem::take(&mut gain));
            }
        }
        visits.push(gain);
        count += visits.iter().filter(|&&g| g > SETTINGS.visits.support).count();
    }
    Some(count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Hypothesis;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use inference::hypothesis::Dose;
    use inference::hypothesis::variants;
    use robot_model::presence::{Disc, Presence};
    use testing::robot;

    #[test]
    fn visits_are_counted_run_by_run() {
        let robot = robot();
        let variant = variants(true)
            .into_iter()
            .find(|v| v.place == Place::Disc && v.spec().id == "rolling_resistance")
            .expect("rolling resistance may be local");
        let free = driven(&robot, &[], 8.0);
        // A disc on the way, well into the drive.
        let k = (400..free.rows()).find(|&k| free.pose[0][k].is_some()).expect("a pose");
        let (x, y) = (free.pose[0][k].unwrap_or(0.0), free.pose[1][k].unwrap_or(0.0));
        let presence = Presence { disc: Some(Disc { centre: [x, y], radius: 0.5 }), ..Presence::default() };
        let sticky = driven(&robot, &[Dose { effect: variant.effect, values: vec![0.3], presence }], 8.0);
        let h = Hypothesis::single(variant, Vec::new());
        for (runs, wanted) in [(vec![sticky.clone()], 1), (vec![sticky.clone(), sticky], 2)] {
            let cuts: Vec<_> = runs.iter().map(|r| cut(r, &cutting())).collect();
            let problem = problem(&robot, &cuts);
            let retuned = problem.begin(&Hypothesis::default(), problem.origin(), None);
            let point = crate::fit::Point { effects: vec![0.3, x, y, 0.5], ..problem.origin() };
            let fitted = problem.begin(&h, point, None);
            let trial = Trial { hypothesis: h.clone(), fitted };
            assert_eq!(supporting(&problem, &retuned, &trial), Some(wanted));
        }
        let none = Trial {
            hypothesis: Hypothesis::default(),
            fitted: {
                let cuts = [cut(&free, &cutting())];
                problem(&robot, &cuts).begin(&Hypothesis::default(), problem(&robot, &cuts).origin(), None)
            },
        };
        let cuts = [cut(&free, &cutting())];
        assert_eq!(supporting(&problem(&robot, &cuts), &none.fitted, &none), None);
    }
}
