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
    pub(crate) fn why_unknown(&self, what: &str, has_references: bool) -> String {
        match self.form {
            Some(form) if self.by_form() > self.level.is_unknown => {
                format!("{what} leaves a mismatch that {}, which noise does not.", form.habit())
            }
            _ => {
                let usual =
                    if has_references { "in the references" } else { "a tuned simulation of a robot usually is" };
                format!("{what} is off by {:.1} times as much (rms) as {usual}.", self.level.times())
            }
        }
    }

    /// The constant that is likelier moved than that anything is missing, by its place.
    pub(crate) fn moved_constant(&self, problem: &Problem<'_>) -> Option<usize> {
        let moved = self.moved.as_ref().filter(|_| self.finds_nothing())?;
        stand_in::as_constant(problem, moved).map(|(place, ..)| place)
    }

    /// The decision where how much is left is that of another fit.
    pub(crate) fn with_level(mut self, level: Level) -> Self {
        let unknown = 1.0 - none_of([level.is_unknown, self.by_form()]);
        let factor = (1.0 - unknown) / (1.0 - self.unknown).max(f64::EPSILON);
        self.none *= factor;
        self.scored.iter_mut().for_each(|s| s.probability *= factor);
        Self { unknown, level, ..self }
    }
}
