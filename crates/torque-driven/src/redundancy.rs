//! Sensor faults that show without any force law: two sensors that tell the same thing differ.
//!
//! Every check measures a number in each run, pools the recordings robustly and takes off what the references show:
//! the same robot without the fault. Only the checks of the gyro's own zero and gain, and of its clock against that of the pose, need no
//! reference.

use std::collections::BTreeMap;
use std::iter;

use robot_model::effect::Redundancy;
use robot_model::{Effect, EffectSpec, effects};

use crate::motion::GyroError;
use crate::run::Run;
use crate::settings::redundancy::{Faults, SETTINGS};
use inference::evidence::logistic;
use inference::words::named;
use pool::Measured;
use verdict::{Cause, EffectAt, Estimate, Side};

mod acceleration;
mod angle;
mod clocks;
mod correct;
mod gyro;
mod pool;
mod wheels;

const FAULTS: Faults = SETTINGS.faults;

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
    /// That it is there at all.
    pub(crate) probability: f64,
}

impl Fault {
    /// Name: with its side, and with its number where the effect has several.
    pub(crate) fn name(&self) -> String {
        let name = named(self.spec.name, self.side);
        let is_one = self.spec.strengths().count() == 1;
        if is_one { name } else { format!("{name}: {}", self.spec.parameters[self.parameter].name) }
    }

    /// A fault of an effect's parameter that was measured so.
    fn new((spec, parameter): (&'static EffectSpec, usize), measured: Measured, side: Option<usize>) -> Self {
        let Measured { value: magnitude, sigma } = measured;
        Self { spec, parameter, magnitude, sigma, side, probability: probability(measured, spec) }
    }

    /// Other effects that show in the same redundancy: these recordings cannot tell them from it.
    pub(crate) fn alike(&self) -> impl Iterator<Item = &'static EffectSpec> {
        let (kind, id) = (self.spec.redundancy, self.spec.id);
        effects::catalogue::<f64>().into_iter().map(Effect::spec).filter(move |s| s.redundancy == kind && s.id != id)
    }

    /// It as a cause, then those that would show alike, each with its share by how rare it is.
    pub(crate) fn causes(&self) -> impl Iterator<Item = Cause> {
        let share = |rarity: f64| (-rarity).exp();
        let all = share(self.spec.rarity) + self.alike().map(|s| share(s.rarity)).sum::<f64>();
        let probability = self.probability;
        let of = move |rarity: f64| probability * share(rarity) / all;
        let parameter = self.spec.parameters[self.parameter].name.to_owned();
        let estimate = Estimate { value: self.magnitude, sigma: Some(self.sigma), at_bound: false };
        let first = Cause {
            magnitude: Some(self.magnitude),
            sigma: Some(self.sigma),
            unit: inference::words::unit(self.spec).into(),
            parameters: BTreeMap::from([(parameter, estimate)]),
            side: self.side.map(|s| inference::words::side(s).into()),
            ..Cause::plain(self.spec.id, &self.name(), of(self.spec.rarity))
        };
        iter::once(first).chain(self.alike().map(move |s| Cause::plain(s.id, s.name, of(s.rarity))))
    }

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

/// Probability of a number that was measured beside that of none: the ratio of evidences of a normal distribution whose
/// sizes are some that matter, times what is known of such faults beforehand.
///
/// `ln B = ½ ln(σ²/(σ² + s²)) + ½ z² s²/(σ² + s²)` with `z = value/σ`.
fn probability(measured: Measured, spec: &EffectSpec) -> f64 {
    let squared = measured.sigma.max(f64::MIN_POSITIVE).powi(2);
    let usual = (FAULTS.usual * spec.interest).powi(2);
    let z2 = measured.value.powi(2) / squared;
    let shrunk = usual / (squared + usual);
    let evidence = 0.5 * ((1.0 - shrunk).ln() + z2 * shrunk);
    logistic(evidence - FAULTS.price - spec.rarity).min(FAULTS.surest)
}

/// The effect that a redundancy shows; of several that look the same in it, the commonest.
fn spec(kind: Redundancy) -> Option<&'static EffectSpec> {
    let all = effects::catalogue::<f64>();
    let alike = all.iter().map(|e| e.spec()).filter(|c| c.redundancy == kind);
    alike.min_by(|a, b| a.rarity.total_cmp(&b.rarity))
}

/// Runs every force-free check of `runs`. Without `references` only what needs none, and, where the wheels' radius is given, m, what is far
/// beyond the usual of any robot.
pub(crate) fn check(runs: &[Run], references: &[Run], radius: Option<f64>) -> Redundant {
    let mut out = Redundant::default();
    gyro::check(runs, references, &mut out);
    angle::frozen(runs, references, &mut out.faults);
    let own = gyro::errors(references);
    angle::jumps(runs, references, &mut out.faults);
    wheels::check(runs, references, radius, &mut out.faults);
    acceleration::check([runs, references], [out.gyro, own], radius.is_some(), &mut out.faults);
    clocks::check(runs, references, &mut out.faults);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(kind: Redundancy, value: f64, sigma: f64) -> Fault {
        let spec = spec(kind).expect("an effect");
        Fault::new((spec, 0), Measured { value: value * spec.interest, sigma: sigma * spec.interest }, None)
    }

    #[test]
    fn a_fault_is_as_likely_as_its_evidence() {
        let p = |value, sigma| of(Redundancy::GyroGain, value, sigma).probability;
        assert_eq!(p(10.0, 0.1), FAULTS.surest);
        assert!(p(1.0, 1.0) < 0.05, "one sigma is no fault: {}", p(1.0, 1.0));
        let doubtful = p(1.05, 0.3);
        assert!(p(1.0, 1.0) < doubtful && doubtful < p(1.05, 0.25) && p(1.05, 0.25) < FAULTS.surest, "{doubtful}");
        assert!(p(-10.0, 0.1) == FAULTS.surest, "of either sign");
    }

    #[test]
    fn faults_that_show_alike_share_a_probability_by_how_rare_they_are() {
        let fault = of(Redundancy::AccelOffset, 10.0, 0.1);
        let causes: Vec<Cause> = fault.causes().collect();
        let ids: Vec<&str> = causes.iter().map(|c| c.effect.as_str()).collect();
        assert_eq!(ids, ["accelerometer_bias", "imu_tilt"]);
        let [bias, tilt] = [causes[0].probability, causes[1].probability];
        approx::assert_relative_eq!(bias + tilt, fault.probability, epsilon = 1e-12);
        approx::assert_relative_eq!((bias / tilt).ln(), 3.0, epsilon = 1e-9);
        assert_eq!(of(Redundancy::GyroGain, 10.0, 0.1).causes().count(), 1);
    }
}
