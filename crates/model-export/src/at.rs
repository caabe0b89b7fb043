//! An effect at values, as the translations read it.

use inference::{DiagnosisError, KnownEffects};
use robot_model::effect::export::{Engine, Way, When};
use robot_model::effect::{EffectSpec, MAX_PARAMETERS, Values};
use robot_model::{Active, Effect, Presence};
use verdict::{EffectAt, Side};

use crate::number::number;

/// An effect at values in the order of its specification.
pub(crate) struct At<'a> {
    of: &'a EffectAt,
    effect: &'static dyn Effect<f64>,
    values: Values<f64>,
}

impl<'a> At<'a> {
    /// Looks the effect up.
    pub(crate) fn new(of: &'a EffectAt, known: KnownEffects) -> Result<Self, DiagnosisError> {
        // Refuses what is not known.
        known.active(of, "")?;
        let effect = known.find(&of.effect)?;
        let mut values = [0.0; MAX_PARAMETERS];
        for (value, p) in values.iter_mut().zip(effect.spec().parameters) {
            *value = of.values.get(p.name).copied().unwrap_or(p.neutral);
        }
        Ok(Self { of, effect, values })
    }

    pub(crate) fn spec(&self) -> &'static EffectSpec {
        self.effect.spec()
    }

    /// How an engine gets the effect at these values.
    pub(crate) fn way(&self, engine: Engine) -> Way {
        let export = &self.spec().export;
        let holds = |when| match when {
            When::AtPlace => self.of.place.is_some(),
            When::Negative => self.values.iter().any(|value| *value < 0.0),
        };
        let mut exceptions = export.exceptions.iter();
        let exception = exceptions.find(|e| e.engine.is_none_or(|of| of == engine) && holds(e.when));
        match (exception, export.way(engine)) {
            (Some(exception), Way::Held(_)) => Way::Added(exception.why),
            (_, way) => way,
        }
    }

    /// The effect on the sides that have it, always and at any place.
    pub(crate) fn active(&self) -> Active<f64> {
        let side = self.of.side.map(|side| side as usize);
        Active::new(self.effect, &self.values, Presence { side, ..Presence::default() })
    }

    pub(crate) fn law(&self) -> &'static dyn Effect<f64> {
        self.effect
    }

    pub(crate) fn values(&self) -> &Values<f64> {
        &self.values
    }

    /// Which sides have it.
    pub(crate) fn sides(&self) -> [bool; 2] {
        [self.of.side != Some(Side::Right), self.of.side != Some(Side::Left)]
    }

    /// Indices of these sides, as a Python tuple.
    pub(crate) fn sides_text(&self) -> &'static str {
        match self.of.side {
            None => "(0, 1)",
            Some(Side::Left) => "(0,)",
            Some(Side::Right) => "(1,)",
        }
    }

    pub(crate) fn side_name(&self) -> Option<&'static str> {
        self.of.side.map(|s| if s == Side::Left { "left" } else { "right" })
    }

    /// The disc that it is limited to: x, y, radius, m.
    pub(crate) fn place(&self) -> Option<[f64; 3]> {
        self.of.place
    }

    /// Where it began at an instant: when in each recording.
    pub(crate) fn began(&self) -> String {
        let began = self.of.from.iter().map(|(drive, t)| format!("at {} s in {drive}", number(*t)));
        began.chain(self.of.absent.iter().map(|drive| format!("not in {drive}"))).collect::<Vec<_>>().join(", ")
    }
}
