//! Rehearsals of robots whose wheel speeds are given: loads of as much steady driving as was recorded, drawn with an effect and without,
//! and diagnosed.

use inference::Options;
use inference::hypothesis::Sizes;
use speed_driven::{Replicas, SteadyCase};
use verdict::{NotRehearsed, Rehearsal, RehearsedDrives};

use crate::assemble::{Effect, assembled, diagnoses};
use crate::error::RehearsalError;
use crate::hidden::Hidden;
use crate::plan::Plan;
use crate::random::{Purpose, Stream};
use crate::score::Scored;
use crate::settings::SETTINGS;
use crate::words;

/// Why an effect is left out that no load shows.
const NO_LOAD: &str = "it changes no load of steady driving; what shows it is measured apart (instants, clocks, a yaw rate without turning)";

/// A rehearsal that is ready to be run.
pub struct RehearsingLoads {
    plan: Plan,
    replicas: Replicas,
    references: usize,
    effects: Vec<Effect<Hidden>>,
    left_out: Vec<NotRehearsed>,
}

impl RehearsingLoads {
    /// Measures the steady loads of a case. Of the plan neither seconds nor recordings count: whole drives are taken, and all of them.
    ///
    /// # Errors
    /// A plan with which nothing can be rehearsed, names that are no effect's, a case that cannot be diagnosed.
    pub fn new(
        case: &SteadyCase,
        plan: &Plan,
        options: &Options,
        progress: &dyn Fn(&str),
    ) -> Result<Self, RehearsalError> {
        let names: Vec<&str> = options.known.all().map(|effect| effect.spec().id).collect();
        let plan = plan.checked(&names)?;
        let replicas = Replicas::new(case, options, progress)?;
        let references = plan.references.unwrap_or_else(|| replicas.references());
        let sizes = Sizes { robot: Some(*replicas.robot()), ..Sizes::default() };
        let (mut effects, mut left_out) = (Vec::new(), Vec::new());
        for hidden in Hidden::all(options.known, &sizes) {
            let hidden = match hidden {
                Ok(hidden) => hidden,
                Err((spec, why)) => {
                    left_out.push(NotRehearsed { effect: spec.id.into(), why: why.into() });
                    continue;
                }
            };
            let spec = hidden.spec();
            let is_seen = |multiple: &f64| hidden.dose(*multiple, plan.seed, 0).is_some_and(|d| replicas.is_seen(&d));
            let can_be = |multiple: &f64| hidden.dose(*multiple, plan.seed, 0).is_some();
            if plan.sizes.iter().any(can_be) && !plan.sizes.iter().any(is_seen) {
                left_out.push(NotRehearsed { effect: spec.id.into(), why: NO_LOAD.into() });
                continue;
            }
            let interest = hidden.interest();
            effects.push(Effect {
                of: hidden,
                id: spec.id.to_owned(),
                name: spec.name,
                interest,
                unit: inference::words::unit(spec),
                sizes: plan.sizes.iter().copied().filter(can_be).map(|m| (m, m * interest)).collect(),
            });
        }
        effects.retain(|effect| plan.wants(&effect.id));
        left_out.retain(|out| plan.wants(&out.effect));
        Ok(Self { plan, replicas, references, effects, left_out })
    }

    /// How many diagnoses will be made.
    pub fn count(&self) -> usize {
        diagnoses(&self.plan, &self.effects)
    }

    /// Diagnoses all replicas, on as many threads as rayon has; the answer depends on none of them. `listener` is told what was diagnosed,
    /// from any thread.
    pub fn run(&self, listener: &(dyn Fn(&str) + Sync)) -> Rehearsal {
        let Self { plan, replicas, references, .. } = self;
        let answer = |replica: usize, hidden: Option<(&Hidden, f64)>| {
            let scored = self.answer(replica, hidden);
            listener(&words::diagnosed(replica, hidden.map(|(h, m)| (h.spec().id, m)), &scored));
            scored
        };
        let drives = RehearsedDrives {
            seed: plan.seed,
            replicas: plan.replicas,
            fault_free_replicas: plan.fault_free,
            references: *references,
            recordings: replicas.drives().into_iter().collect(),
            noise: Vec::new(),
            wanted_share: SETTINGS.plan.wanted,
        };
        let mut out = assembled(plan, drives, &self.effects, &answer);
        out.left_out.extend(self.left_out.iter().cloned());
        out.limits = words::limits_of_loads(plan, *references);
        out
    }

    /// What is told of a replica.
    fn answer(&self, replica: usize, hidden: Option<(&Hidden, f64)>) -> Scored {
        let mut numbers = Stream::new(self.plan.seed, Purpose::Constants, &[replica]);
        let farthest = SETTINGS.constants.farthest;
        let mut normal = || numbers.normal_within(farthest);
        let dose = match hidden {
            Some((hidden, multiple)) => match hidden.dose(multiple, self.plan.seed, replica) {
                Some(dose) => Some(dose),
                None => return Scored::failed("its size lies beyond what the catalogue calls sensible".to_owned()),
            },
            None => None,
        };
        match self.replicas.answer(dose.as_ref(), self.references, &mut normal) {
            Ok(answer) => Scored::new(&answer, hidden.map(|(hidden, _)| hidden.spec().id)),
            Err(why) => Scored::failed(why.to_string()),
        }
    }
}
