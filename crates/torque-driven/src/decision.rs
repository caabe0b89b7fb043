//! A decision: hypotheses with their probabilities, beside "nothing is missing" and "not in the catalogue".

use std::collections::{BTreeMap, BTreeSet};

use crate::confirmed::Unconfirmed;
use crate::fit::Problem;
use crate::level::Level;
use crate::settings::decision::SETTINGS;
use crate::stand_in;
use crate::structure::Structure;
use crate::trial::Trial;
use inference::evidence::none_of;
use inference::experiment::Standing;
use inference::words::variants;

/// A hypothesis with its score and probability.
#[derive(Clone)]
pub(crate) struct Scored {
    pub(crate) trial: Trial,
    /// Separate visits that support its disc, if it has one.
    pub(crate) visits: Option<usize>,
    pub(crate) score: f64,
    pub(crate) probability: f64,
}

/// The decision.
#[derive(Clone, Default)]
pub(crate) struct Decision {
    pub(crate) scored: Vec<Scored>,
    pub(crate) none: f64,
    pub(crate) unknown: f64,
    pub(crate) level: Level,
    /// The form of what the best hypothesis leaves, where the noise was learnt from the recordings.
    pub(crate) form: Option<Structure>,
    /// The fit whose only effect is likeliest a constant that moved since the references, where that is likelier than that
    /// nothing moved.
    pub(crate) moved: Option<Trial>,
    /// Effects that are not named since left-out recordings do not need them.
    pub(crate) unconfirmed: Vec<Unconfirmed>,
    /// How forecasts of the wheels of left-out recordings stand with what was named, where they refute it.
    pub(crate) refuted: Option<Standing>,
}

impl Decision {
    /// Whether nothing is likelier to be missing than something.
    pub(crate) fn finds_nothing(&self) -> bool {
        self.none >= self.unknown + self.scored.iter().map(|s| s.probability).sum::<f64>()
    }

    /// Effects of which either side is likely: the recordings do not tell which it is.
    pub(crate) fn on_either_side(&self) -> BTreeSet<&'static str> {
        let mut of_sides: BTreeMap<&str, [f64; 2]> = BTreeMap::new();
        for s in &self.scored {
            for v in s.trial.hypothesis.variants() {
                if let Some(side) = v.side() {
                    of_sides.entry(v.spec().id).or_default()[side] += s.probability;
                }
            }
        }
        let is_open = |[left, right]: [f64; 2]| left.min(right) > SETTINGS.answer.rival * left.max(right);
        of_sides.into_iter().filter(|(_, sides)| is_open(*sides)).map(|(id, _)| id).collect()
    }

    /// Probability that the cause is not in the catalogue by the form of what is left.
    fn by_form(&self) -> f64 {
        self.form.map_or(0.0, Structure::is_no_noise)
    }

    /// Why the cause is taken for one that is not in the catalogue, as a sentence; `what`: the simulation that is judged.
    pub(crate) fn why_unknown(&self, what: &str, has_references: bool) -> Option<String> {
        match self.form {
            _ if self.refuted.is_some() => None,
            Some(form) if self.by_form() > self.level.is_unknown => {
                Some(format!("{what} leaves a mismatch that {}, which noise does not.", form.habit()))
            }
            _ => {
                let usual =
                    if has_references { "in the references" } else { "a tuned simulation of a robot usually is" };
                Some(format!("{what} is off by {:.1} times as much (rms) as {usual}.", self.level.times()))
            }
        }
    }

    /// What refutes the best hypothesis, as a sentence, where something does.
    pub(crate) fn refuted(&self) -> Option<String> {
        let (wheels, best) = self.refuted.zip(self.scored.first())?;
        Some(format!(
            "It looks like {}, but with it the wheel speeds of recordings that were left out of the fit are forecast with {:.1} times the \
             error of the simulation as it is, and {:.1} times that of re-tuned constants: that is not what is missing. A sensor that is \
             late or wrong can look so.",
            variants(best.trial.hypothesis.variants()),
            wheels.over_nominal,
            wheels.over_retuned
        ))
    }

    /// The constant that is likelier moved than that anything is missing, by its place.
    pub(crate) fn moved_constant(&self, problem: &Problem<'_>) -> Option<usize> {
        let moved = self.moved.as_ref().filter(|_| self.finds_nothing())?;
        stand_in::as_constant(problem, moved).map(|(place, ..)| place)
    }

    /// The decision where how much is left is that of another fit.
    pub(crate) fn with_level(self, level: Level) -> Self {
        let unknown = 1.0 - none_of([level.is_unknown, self.by_form()]);
        Self { level, ..self.with_unknown(unknown) }
    }

    /// The decision where forecasts of the wheels of left-out recordings refute what was named: something is missing that makes it look so.
    /// `None` where they do not.
    pub(crate) fn refuted_by(&self, wheels: Option<Standing>) -> Option<Self> {
        let rules = SETTINGS.confirmation;
        let wheels = wheels.filter(|s| s.over_nominal.min(s.over_retuned) > rules.refuted)?;
        Some(Self { refuted: Some(wheels), ..self.clone().with_unknown(1.0 - SETTINGS.answer.listed) })
    }

    fn with_unknown(mut self, unknown: f64) -> Self {
        let factor = (1.0 - unknown) / (1.0 - self.unknown).max(f64::EPSILON);
        self.none *= factor;
        self.scored.iter_mut().for_each(|s| s.probability *= factor);
        Self { unknown, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_forecasts_wheels_worse_than_the_simulation_and_than_re_tuned_constants_is_refuted() {
        let named = Decision { none: 0.1, unknown: 0.2, ..Decision::default() };
        let refuted = |over_nominal: f64, over_retuned: f64| {
            named.refuted_by(Some(Standing { over_nominal, over_retuned, over_placebo: None }))
        };
        // A late IMU that was told as a delay of the torques.
        let answer = refuted(1.7, 2.1).expect("refuted");
        assert!(answer.unknown > 0.9 && answer.none < 0.02 && answer.why_unknown("It", true).is_none());
        // A bias of a gyro leaves wheels as they are.
        assert!(refuted(0.4, 1.0).is_none() && refuted(1.0, 1.3).is_none());
        assert!(named.refuted_by(None).is_none());
    }
}
