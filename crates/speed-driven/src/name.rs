//! Which effects could make the loads differ as they do.

use std::collections::HashSet;

use catalogue::speed_driven::SOFT_GROUND;
use rayon::prelude::*;
use robot_model::effect::Role;
use robot_model::effect::export::Section;
use robot_model::effects::grade;
use verdict::{Loads, Quantity};

use crate::comparison::{Comparison, slope_of_all};
use crate::model::Measured;
use crate::run::SpeedRun;
use crate::settings::NAMING;
use crate::settings::naming::{EffectFits, Priors};
use crate::{grounds, heading};
use inference::hypothesis::{Dose, Free, Place, Variant, variants};

const PRIORS: Priors = NAMING.priors;
const EFFECTS: EffectFits = NAMING.effects;

/// Price of naming an effect, nats.
pub(crate) fn price(v: &Variant) -> f64 {
    let spec = v.spec();
    PRIORS.per_effect + spec.rarity + if catalogue::needs_a_hand(spec.id) { PRIORS.by_hand } else { 0.0 }
}

/// One difference between a recording and the references, on the comparison scale.
#[derive(Debug, Clone)]
pub(crate) struct Difference {
    pub(crate) recording: String,
    pub(crate) here: Measured,
    pub(crate) reference: Measured,
}

impl Difference {
    pub(crate) fn is_track(&self) -> bool {
        self.here.at.quantity == Quantity::EffectiveTrack
    }

    /// Whether it compares the loads of both sides.
    pub(crate) fn is_of_sides(&self) -> bool {
        matches!(self.here.at.quantity, Quantity::Asymmetry | Quantity::SpinAsymmetry)
    }
}

/// One or two effects fitted to the differences, or soft ground.
#[derive(Clone)]
pub(crate) struct Named {
    pub(crate) parts: Vec<Variant>,
    /// Whether its effects are those of soft ground, one cause together.
    pub(crate) is_soft_ground: bool,
    /// Free values of each effect in turn.
    pub(crate) values: Vec<f64>,
    /// What of each effect may change, in the sizes of this robot.
    pub(crate) free: Vec<Vec<Free>>,
    /// One sigma of each free value.
    pub(crate) sigma: Vec<f64>,
    /// Log evidence over "nothing is missing", nats.
    pub(crate) score: f64,
    /// What it explains of the differences before its price, nats.
    pub(crate) gain: f64,
}

impl Named {
    /// Free values and sigmas of one of its effects.
    pub(crate) fn of(&self, part: usize) -> (&[f64], &[f64]) {
        let before: usize = self.parts[..part].iter().map(Variant::count).sum();
        let n = self.parts[part].count();
        (&self.values[before..before + n], &self.sigma[before..before + n])
    }

    pub(crate) fn doses(&self) -> Vec<Dose> {
        doses(&self.parts, &self.values)
    }

    /// Ids of its causes: its effects in the order of the parts, or soft ground.
    pub(crate) fn ids(&self) -> Vec<&'static str> {
        if self.is_soft_ground { vec![SOFT_GROUND.id] } else { self.effects().collect() }
    }

    /// Ids of its effects, also of those that are one cause together.
    pub(crate) fn effects(&self) -> impl Iterator<Item = &'static str> {
        self.parts.iter().map(|v| v.spec().id)
    }

    /// How many causes it names.
    pub(crate) fn causes(&self) -> usize {
        if self.is_soft_ground { 1 } else { self.parts.len() }
    }

    /// Its causes for people.
    pub(crate) fn name(&self) -> String {
        if self.is_soft_ground { SOFT_GROUND.name.to_owned() } else { inference::words::variants(&self.parts) }
    }
}

pub(crate) fn doses(parts: &[Variant], values: &[f64]) -> Vec<Dose> {
    let mut at = 0;
    parts
        .iter()
        .map(|v| {
            let n = v.count();
            at += n;
            v.dose(&values[at - n..at], None)
        })
        .collect()
}

/// The comparison of all hypotheses.
pub(crate) struct Naming {
    /// Best first.
    pub(crate) effects: Vec<Named>,
    /// Evidence of free factors, one per quantity, that no effect ties together.
    pub(crate) unknown: f64,
    /// Wheels of a side that roll as if they had another radius, beside all of these.
    pub(crate) drift: Option<(Variant, f64)>,
}

impl Naming {
    /// The best of each set of effects, best first: left and right are one cause.
    pub(crate) fn causes(&self) -> Vec<&Named> {
        let mut seen = HashSet::new();
        let is_new = |e: &&Named| {
            let mut ids = e.ids();
            ids.sort_unstable();
            seen.insert(ids)
        };
        self.effects.iter().filter(is_new).collect()
    }
}

/// Which causes are open.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Open {
    /// Nobody touched the robot: only what needs no hand on it.
    pub(crate) same_robot: bool,
    /// All straight driving is at one place in one heading, so that one slope may be under all of it.
    pub(crate) one_slope: bool,
    /// It begins and ends while the robot drives: only what the ground does.
    pub(crate) of_ground: bool,
}

impl Open {
    /// What these recordings leave open, by the differences of their loads; `weight` is `m g r`, N m.
    pub(crate) fn of(runs: &[SpeedRun], loads: &Loads, differences: &[Difference], weight: f64) -> Self {
        let compared = differences.iter().map(|d| (d.here.at.quantity, &d.recording));
        // Ground that begins inside a drive and changes its turns, too, is one cause, and no slope that comes with another.
        let turns_change = loads.on_grounds && grounds::turn_otherwise(&loads.grounds);
        let is_off = |slope: f64| runs.iter().any(|run| heading::stays_off_slope(run, slope));
        let one_slope = !turns_change
            && heading::may_be_one_slope(compared, runs)
            && !slope_of_all(differences, weight).is_some_and(is_off);
        Self { same_robot: false, one_slope, of_ground: false }
    }

    /// The same where nobody touched the robot, if so.
    pub(crate) fn same_robot(self, same_robot: bool) -> Self {
        Self { same_robot, ..self }
    }
}

/// Weighs every effect that can be present everywhere, every pair with one of the best, and soft ground against the
/// differences.
pub(crate) fn name(comparison: &Comparison, open: Open) -> Option<Naming> {
    let candidates: Vec<Variant> = variants(true)
        .into_iter()
        .filter(|v| v.place == Place::Whole || (matches!(v.place, Place::Side(_)) && comparison.drift.is_none()))
        // Shapes speak of how an effect comes and goes; steady loads cannot tell them.
        .filter(|v| v.spec().parameters.iter().all(|p| p.role != Role::Shape))
        .filter(|v| open.one_slope || v.spec().id != grade::SPEC.id)
        .filter(|v| !open.of_ground || v.spec().export.section == Section::Ground)
        .filter(|v| !open.same_robot || !catalogue::needs_a_hand(v.spec().id))
        .collect();
    let mut singles: Vec<Named> = candidates.par_iter().filter_map(|v| comparison.fit(&[*v], None)).collect();
    best_first(&mut singles);
    let able: Vec<Variant> = singles.iter().map(|s| s.parts[0]).collect();
    let mut firsts: Vec<&Named> = Vec::new();
    for s in &singles {
        if firsts.len() < EFFECTS.firsts && !firsts.iter().any(|f| f.ids() == s.ids()) {
            firsts.push(s);
        }
    }
    let tasks: Vec<(&Named, Variant)> = firsts
        .iter()
        .flat_map(|f| able.iter().filter(|v| v.spec().id != f.parts[0].spec().id).map(|v| (*f, *v)))
        .collect();
    let pairs: Vec<Named> =
        tasks.par_iter().filter_map(|(f, v)| comparison.fit(&[f.parts[0], *v], Some(&f.values))).collect();
    let mut effects = singles.clone();
    effects.extend(pairs);
    effects.extend(comparison.soft_ground());
    best_first(&mut effects);
    let unknown = comparison.unknown(effects.first())?;
    let side = usize::from(comparison.by_side[1] < comparison.by_side[0]);
    let drift = comparison.drift.and_then(|drift| drift.part(side));
    Some(Naming { effects, unknown, drift })
}

fn best_first(list: &mut [Named]) {
    list.sort_by(|a, b| b.score.total_cmp(&a.score));
}
