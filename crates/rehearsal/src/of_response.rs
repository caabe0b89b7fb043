//! Rehearsals of robots whose response to commands is fitted: the same commands, driven by a response of which one constant is changed,
//! and diagnosed as recordings are.

use command_driven::{Hideable, Replicas, ResponseCase, diagnose_response};
use inference::Options;
use verdict::{NotRehearsed, Rehearsal, RehearsedDrives, SensorNoise};

use crate::assemble::{Effect, Hidden, assembled, diagnoses};
use crate::error::RehearsalError;
use crate::plan::Plan;
use crate::random::{Purpose, Stream};
use crate::rehearse::UNSEEN;
use crate::score::Scored;
use crate::settings::SETTINGS;
use crate::words;

/// A rehearsal that is ready to be run.
pub struct RehearsingResponse {
    plan: Plan,
    replicas: Replicas,
    references: usize,
    effects: Vec<Effect<Hideable>>,
    left_out: Vec<NotRehearsed>,
}

impl RehearsingResponse {
    /// Takes the commands of a case and what the best response leaves of its recordings. Of the plan neither seconds nor recordings
    /// count: whole drives are taken, and all of them.
    ///
    /// # Errors
    /// A plan with which nothing can be rehearsed, names that are no cause's, a case that cannot be diagnosed.
    pub fn new(case: &ResponseCase, plan: &Plan, progress: &dyn Fn(&str)) -> Result<Self, RehearsalError> {
        let plan = plan.checked(&catalogue::command_driven::ALL.map(|spec| spec.id))?;
        let replicas = Replicas::new(case, progress)?;
        let references = plan.references.unwrap_or_else(|| replicas.references());
        let (mut effects, mut left_out) = (Vec::new(), Vec::new());
        for hideable in replicas.hideable.iter().filter(|h| plan.wants(h.spec.id)) {
            if !hideable.is_seen {
                left_out.push(NotRehearsed { effect: hideable.spec.id.to_owned(), why: UNSEEN.into() });
                continue;
            }
            let can_be = |multiple: &f64| {
                let signs = if hideable.is_signed { [1.0, -1.0].as_slice() } else { &[1.0] };
                let mut zero = || 0.0;
                signs.iter().all(|sign| replicas.replica(Some((hideable, sign * multiple)), 0, &mut zero).is_some())
            };
            effects.push(Effect {
                of: *hideable,
                id: hideable.spec.id.to_owned(),
                name: hideable.spec.name,
                interest: hideable.interest,
                unit: hideable.spec.unit,
                sizes: plan.sizes.iter().copied().filter(can_be).map(|m| (m, m * hideable.interest)).collect(),
            });
        }
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
        let answer = |replica: usize, hidden: Hidden<'_, Hideable>| {
            let scored = self.answer(replica, hidden);
            listener(&words::diagnosed(replica, hidden.map(|(h, m)| (h.spec.id, m)), &scored));
            scored
        };
        let noise = |channel: &str, sigma: f64| SensorNoise {
            channel: channel.to_owned().into(),
            sigma,
            unit: "rad/s".into(),
            rate: 1.0 / command_driven::STEP,
            source: "what the best response leaves of the recordings".into(),
        };
        let [of_wheels, of_body] = replicas.left;
        let drives = RehearsedDrives {
            seed: plan.seed,
            replicas: plan.replicas,
            fault_free_replicas: plan.fault_free,
            references: *references,
            recordings: replicas.drives().into_iter().collect(),
            noise: vec![noise("wheel_speed", of_wheels), noise("yaw_rate", of_body)],
            wanted_share: SETTINGS.plan.wanted,
        };
        let mut out = assembled(plan, drives, &self.effects, &answer);
        out.left_out.extend(self.left_out.iter().cloned());
        out.limits = words::limits_of_response(plan, *references);
        out
    }

    /// What is told of a replica.
    fn answer(&self, replica: usize, hidden: Hidden<'_, Hideable>) -> Scored {
        let mut numbers = Stream::new(self.plan.seed, Purpose::Constants, &[replica]);
        let mut direction = Stream::new(self.plan.seed, Purpose::Direction, &[replica]);
        let hidden = hidden.map(|(hideable, multiple)| {
            let sign = if hideable.is_signed { direction.normal().signum() } else { 1.0 };
            (hideable, sign * multiple)
        });
        let farthest = SETTINGS.constants.farthest;
        let mut normal = || numbers.normal_within(farthest);
        let Some(case) = self.replicas.replica(hidden, self.references, &mut normal) else {
            return Scored::failed("a constant of the response lies beyond what is sensible".to_owned());
        };
        match diagnose_response(&case, &Options::default(), &|_| ()) {
            Ok(answer) => Scored::new(&answer, hidden.map(|(hideable, _)| hideable.spec.id)),
            Err(why) => Scored::failed(why.to_string()),
        }
    }
}
