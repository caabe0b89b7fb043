//! Counts diagnoses of simulated cases: how often each cause was found at each size, and how often nothing was hidden and an alarm given.

use rayon::prelude::*;
use verdict::{NotRehearsed, REHEARSAL_FORMAT, Rehearsal, RehearsedDrives, RehearsedEffect, RehearsedSize};

use crate::plan::Plan;
use crate::rehearse::{BEYOND, in_order};
use crate::score::{Scored, count, found_from, look_alikes, share_found};
use crate::settings::SETTINGS;

/// A cause that is hidden in several sizes.
pub(crate) struct Effect<T> {
    pub(crate) of: T,
    pub(crate) id: String,
    pub(crate) name: &'static str,
    /// Its size of interest, in `unit`.
    pub(crate) interest: f64,
    pub(crate) unit: &'static str,
    /// Its sizes, in sizes of interest and in `unit`; none where already the smallest is not sensible.
    pub(crate) sizes: Vec<(f64, f64)>,
}

/// What is hidden in a replica: so many sizes of interest of a cause, or nothing.
pub(crate) type Hidden<'a, T> = Option<(&'a T, f64)>;

/// How many diagnoses a plan asks for.
pub(crate) fn diagnoses<T>(plan: &Plan, effects: &[Effect<T>]) -> usize {
    plan.fault_free + plan.replicas * effects.iter().map(|effect| effect.sizes.len()).sum::<usize>()
}

/// Hides each cause at each of its sizes in as many replicas as the plan asks for, and counts the answers. `answer` diagnoses a replica, by
/// its number and by what is hidden in it.
pub(crate) fn assembled<T: Sync>(
    plan: &Plan,
    drives: RehearsedDrives,
    effects: &[Effect<T>],
    answer: &(dyn Fn(usize, Hidden<'_, T>) -> Scored + Sync),
) -> Rehearsal {
    let all = |hidden: Hidden<'_, T>, replicas: usize| {
        let scored: Vec<Scored> = (0..replicas).into_par_iter().map(|replica| answer(replica, hidden)).collect();
        count(&scored)
    };
    let sizes_of = |effect: &Effect<T>| -> Vec<RehearsedSize> {
        let one = |&(multiple, size): &(f64, f64)| {
            let answers = all(Some((&effect.of, multiple)), plan.replicas);
            RehearsedSize { multiple, size, found: share_found(&answers), answers, driven: 1.0 }
        };
        effect.sizes.iter().map(one).collect()
    };
    let rehearsed = |effect: &Effect<T>| {
        let sizes = sizes_of(effect);
        RehearsedEffect {
            effect: effect.id.clone(),
            name: effect.name.to_owned(),
            interest: effect.interest,
            unit: effect.unit.into(),
            found: found_from(&sizes, SETTINGS.plan.wanted),
            look_alikes: look_alikes(&sizes),
            sizes,
        }
    };
    let (can_be, beyond): (Vec<_>, Vec<_>) = effects.iter().partition(|effect| !effect.sizes.is_empty());
    let left_out = |effect: &Effect<T>| NotRehearsed { effect: effect.id.clone(), why: BEYOND.into() };
    Rehearsal {
        format: REHEARSAL_FORMAT,
        drives,
        fault_free: all(None, plan.fault_free),
        effects: in_order(can_be.into_iter().map(rehearsed).collect()),
        left_out: beyond.into_iter().map(left_out).collect(),
        shortened: Vec::new(),
        limits: Vec::new(),
    }
}
