//! Hypotheses that were fitted in free run.

use crate::fit::{Fitted, Hypothesis};
use inference::hypothesis::Variant;

/// A hypothesis that was fitted in free run.
#[derive(Clone)]
pub(crate) struct Trial {
    pub(crate) hypothesis: Hypothesis,
    pub(crate) fitted: Fitted,
}

/// All that the search found.
pub(crate) struct SearchResult {
    /// Cost of the simulation before anything is re-tuned, nats.
    pub(crate) as_it_is: f64,
    pub(crate) retuned: Fitted,
    pub(crate) singles: Vec<Trial>,
    /// Two or three effects together.
    pub(crate) several: Vec<Trial>,
    /// Best evidence of the screens per effect id, for the report.
    pub(crate) screened: Vec<(String, f64)>,
}

/// Adds a fit to others; of two fits of one hypothesis the better stays.
pub(crate) fn include(list: &mut Vec<Trial>, trial: Trial) {
    let labels = |t: &Trial| t.hypothesis.variants().map(Variant::label).collect::<Vec<_>>();
    match list.iter_mut().find(|t| labels(t) == labels(&trial)) {
        Some(known) if known.fitted.cost <= trial.fitted.cost => {}
        Some(known) => *known = trial,
        None => list.push(trial),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{cutting, driven, problem};
    use crate::windows::cut;
    use testing::robot;

    #[test]
    fn of_two_fits_of_one_hypothesis_the_better_stays_and_each_effect_can_stand_alone() {
        let robot = robot();
        let cuts = [cut(&driven(&robot, &[], 8.0), &cutting())];
        let p = problem(&robot, &cuts);
        let retuned = p.begin(&Hypothesis::default(), p.origin(), None);
        let of = |id: &str| p.variants().into_iter().find(|v| v.spec().id == id).expect("in the catalogue");
        let trial = |parts: &[&str], cost: f64| {
            let parts = parts.iter().map(|id| (of(id), Vec::new())).collect();
            Trial { hypothesis: Hypothesis { parts, acting: None }, fitted: Fitted { cost, ..retuned.clone() } }
        };
        let mut found = vec![trial(&["payload"], 5.0)];
        include(&mut found, trial(&["payload"], 7.0));
        assert_eq!((found.len(), found[0].fitted.cost), (1, 5.0));
        include(&mut found, trial(&["payload"], 3.0));
        assert_eq!((found.len(), found[0].fitted.cost), (1, 3.0));
        include(&mut found, trial(&["viscous_friction"], 9.0));
        include(&mut found, trial(&["payload", "viscous_friction"], 2.0));
        assert_eq!(found.len(), 3);

        let pair = &found[2].hypothesis;
        let alone = pair.each_alone(&[2.0, 0.1]);
        let ids: Vec<Vec<&str>> = alone.iter().map(|(h, _)| h.ids()).collect();
        assert_eq!(ids, [["payload"], ["viscous_friction"]]);
        assert_eq!([&*alone[0].1, &*alone[1].1], [&[2.0][..], &[0.1]]);
        assert!(found[0].hypothesis.each_alone(&[2.0]).is_empty());
        assert_eq!(pair.values_of(&alone[1].0, &[2.0, 0.1]), Some(vec![0.1]));
        let swapped = Hypothesis { parts: pair.parts.iter().rev().cloned().collect(), acting: None };
        assert_eq!(pair.values_of(&swapped, &[2.0, 0.1]), Some(vec![0.1, 2.0]));
        assert_eq!(alone[0].0.values_of(&swapped, &[2.0]), None);
    }
}
