//! What is to be rehearsed.

use inference::KnownEffects;
use inference::hypothesis::Sizes;
use recordings::suggest;
use verdict::NotRehearsed;

use crate::error::RehearsalError;
use crate::hidden::Hidden;
use crate::settings::{Planned, PlannedOfFit, PlannedOfLoads, PlannedOfResponse, SETTINGS};

const PLAN: Planned = SETTINGS.plan;

/// What is to be rehearsed. The default takes minutes.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Sizes that are simulated, in sizes of interest.
    pub sizes: Vec<f64>,
    /// Ids of the effects; all where none is given.
    pub effects: Vec<String>,
    /// References of a replica, on the inputs of the recordings; as many as the case has, on their
    /// own inputs, if not given.
    pub references: Option<usize>,
    /// Replicas of each size.
    pub replicas: usize,
    /// Replicas in which nothing is hidden; at least as many as of each size are simulated.
    pub fault_free: usize,
    /// Seed of all that is drawn.
    pub seed: u64,
    /// Beginning of each recording and reference that is driven again, s.
    pub seconds: f64,
    /// Recordings that are driven again, at most.
    pub recordings: usize,
}

impl Default for Plan {
    fn default() -> Self {
        Self {
            sizes: PLAN.sizes.to_vec(),
            effects: Vec::new(),
            references: None,
            replicas: PLAN.replicas,
            fault_free: PLAN.fault_free,
            seed: 1,
            seconds: PLAN.seconds,
            recordings: PLAN.recordings,
        }
    }
}

impl Plan {
    /// The plan for robots whose constants are fitted to whole drives: nothing is simulated, and more can be drawn.
    pub fn of_fit() -> Self {
        let PlannedOfFit { sizes, replicas, fault_free } = SETTINGS.plan_of_fit;
        Self { sizes: sizes.to_vec(), replicas, fault_free, ..Self::default() }
    }

    /// The plan for robots that are given commands: whole drives are diagnosed.
    pub fn of_response() -> Self {
        let PlannedOfResponse { sizes, replicas, fault_free } = SETTINGS.plan_of_response;
        Self { sizes: sizes.to_vec(), replicas, fault_free, ..Self::default() }
    }

    /// The plan for robots that are given wheel speeds: nothing is simulated row by row, and whole drives are taken.
    pub fn of_loads() -> Self {
        let PlannedOfLoads { sizes, replicas, fault_free } = SETTINGS.plan_of_loads;
        Self { sizes: sizes.to_vec(), replicas, fault_free, ..Self::default() }
    }

    /// The same with sizes that rise, each once. `known`: names that effects can have.
    ///
    /// # Errors
    /// Numbers with which nothing can be simulated, and names that are no effect's.
    pub fn checked(&self, known: &[&str]) -> Result<Self, RehearsalError> {
        if let Some(size) = self.sizes.iter().find(|size| !(size.is_finite() && **size > 0.0)) {
            return Err(RehearsalError::Size { size: *size });
        }
        if self.sizes.is_empty() {
            return Err(RehearsalError::NoSize);
        }
        if self.replicas == 0 {
            return Err(RehearsalError::NoReplica);
        }
        let replicas = self.replicas.max(self.fault_free);
        if replicas > PLAN.most {
            return Err(RehearsalError::TooMany { replicas, most: PLAN.most });
        }
        if self.seconds.is_nan() || self.seconds <= 0.0 {
            return Err(RehearsalError::Length { seconds: self.seconds });
        }
        if let Some(name) = self.effects.iter().find(|name| !known.contains(&name.as_str())) {
            let hint = suggest::hint(name, known);
            return Err(RehearsalError::UnknownEffect { name: name.clone(), hint });
        }

        let mut sizes = self.sizes.clone();
        sizes.sort_unstable_by(f64::total_cmp);
        sizes.dedup();
        Ok(Self { sizes, fault_free: self.fault_free.max(self.replicas), ..self.clone() })
    }

    /// Whether an effect was asked for.
    pub(crate) fn wants(&self, id: &str) -> bool {
        self.effects.is_empty() || self.effects.iter().any(|wanted| wanted == id)
    }

    /// The effects that were asked for and can be hidden, and those that cannot, with the reason.
    pub(crate) fn effects(&self, known: KnownEffects, sizes: &Sizes) -> (Vec<Hidden>, Vec<NotRehearsed>) {
        let (mut hidden, mut left_out) = (Vec::new(), Vec::new());
        for effect in Hidden::all(known, sizes) {
            match effect {
                Ok(effect) if self.wants(effect.spec().id) => hidden.push(effect),
                Err((spec, why)) if self.wants(spec.id) => {
                    left_out.push(NotRehearsed { effect: spec.id.to_owned(), why: why.into() });
                }
                _ => {}
            }
        }
        (hidden, left_out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(change: impl FnOnce(&mut Plan)) -> String {
        let mut plan = Plan::default();
        change(&mut plan);
        let refused = plan.checked(&["payload", "grade"]).expect_err("refused");
        assert!(refused.is_of_plan());
        refused.to_string()
    }

    #[test]
    fn plans_with_which_nothing_can_be_simulated_are_refused() {
        assert!(refused(|plan| plan.sizes = vec![1.0, -2.0]).contains("-2 is no size"));
        assert!(refused(|plan| plan.sizes = vec![f64::NAN]).contains("larger than zero"));
        assert!(refused(|plan| plan.sizes.clear()).contains("at least one"));
        assert!(refused(|plan| plan.replicas = 0).contains("1 or more"));
        assert!(refused(|plan| plan.fault_free = 1_000_000).contains("1000 or fewer"));
        assert!(refused(|plan| plan.seconds = 0.0).contains("more than zero"));
        assert!(refused(|plan| plan.effects = vec!["paylod".to_owned()]).contains("payload"));
    }

    #[test]
    fn sizes_rise_and_stand_once() {
        let plan = Plan { sizes: vec![2.0, 0.5, 2.0], replicas: 40, ..Plan::default() };
        let plan = plan.checked(&[]).expect("a plan");
        assert_eq!((plan.sizes, plan.fault_free), (vec![0.5, 2.0], 40));
    }

    #[test]
    fn only_what_was_asked_for_is_hidden_or_left_out() {
        let plan = Plan { effects: vec!["payload".to_owned(), "clock_drift".to_owned()], ..Plan::default() };
        let (hidden, left_out) = plan.effects(KnownEffects::default(), &Sizes::default());
        assert_eq!(hidden.iter().map(|h| h.spec().id).collect::<Vec<_>>(), ["payload"]);
        assert_eq!(left_out.iter().map(|l| l.effect.as_str()).collect::<Vec<_>>(), ["clock_drift"]);
    }
}
