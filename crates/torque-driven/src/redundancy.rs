//! Sensor faults that show without any force law: two sensors that tell the same thing differ.
//!
//! Every check measures a number in each run, pools the recordings robustly and takes off what the references show:
//! the same robot without the fault. Only the check of the gyro's own zero and gain needs no reference.

use std::collections::BTreeMap;

use robot_model::effect::Redundancy;
use robot_model::{EffectSpec, effects};

use crate::motion::GyroError;
use crate::run::Run;
use verdict::{EffectAt, Side};

mod acceleration;
mod angle;
mod clocks;
mod correct;
mod gyro;
mod pool;
mod wheels;

/// A sensor fault found by redundancy.
#[derive(Debug, Clone)]
pub(crate) struct Fault {
    pub(crate) spec: &'static EffectSpec,
    /// Which of its parameters it is.
    pub(crate) parameter: usize,
    /// In its unit, with sign.
    pub(crate) magnitude: f64,
    /// One sigma of it.
    pub(crate) sigma: f64,
    pub(crate) side: Option<usize>,
}

impl Fault {
    /// The effect that shows it.
    pub(crate) fn effect(&self) -> EffectAt {
        EffectAt {
            effect: self.spec.id.to_owned(),
            values: BTreeMap::from([(self.spec.parameters[self.parameter].name.to_owned(), self.magnitude)]),
            side: self.side.map(Side::of),
            ..EffectAt::default()
        }
    }
}

/// What all checks found.
#[derive(Debug, Clone, Default)]
pub(crate) struct Redundant {
    pub(crate) faults: Vec<Fault>,
    /// Correction of the gyro to apply before anything else.
    pub(crate) gyro: GyroError,
}

/// The effect that a redundancy shows; of several that look the same in it, the commonest.
fn spec(kind: Redundancy) -> Option<&'static EffectSpec> {
    let all = effects::catalogue::<f64>();
    let alike = all.iter().map(|e| e.spec()).filter(|c| c.redundancy == kind);
    alike.min_by(|a, b| a.rarity.total_cmp(&b.rarity))
}

/// Runs every force-free check of `runs`; without `references` only what needs none.
pub(crate) fn check(runs: &[Run], references: &[Run]) -> Redundant {
    let mut out = Redundant::default();
    gyro::check(runs, references, &mut out);
    angle::frozen(runs, references, &mut out.faults);
    let own = gyro::errors(references);
    angle::jumps(runs, references, &mut out.faults);
    wheels::check(runs, references, &mut out.faults);
    acceleration::check([runs, references], [out.gyro, own], &mut out.faults);
    clocks::check(runs, references, &mut out.faults);
    out
}
