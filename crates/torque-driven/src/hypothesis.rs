//! Effects that are missing together, with the onsets of those that begin at an instant.

use std::collections::BTreeSet;

use crate::unnamed::Acting;
use inference::hypothesis::{Dose, Free, Onsets, Sizes, Variant};

/// An onset before the beginning: there throughout, s.
pub(crate) const THROUGHOUT: f64 = -1.0;

/// Effects that a fit includes, with the onsets of those that have one.
#[derive(Clone, Default)]
pub(crate) struct Hypothesis {
    pub(crate) parts: Vec<(Variant, Onsets)>,
    /// What acts beside the catalogue's effects; its numbers come last.
    pub(crate) acting: Option<Acting>,
}

impl Hypothesis {
    pub(crate) fn single(variant: Variant, onsets: Onsets) -> Self {
        Self { parts: vec![(variant, onsets)], acting: None }
    }

    /// Its effects, in order.
    pub(crate) fn ids(&self) -> Vec<&'static str> {
        self.parts.iter().map(|(v, _)| v.spec().id).collect()
    }

    /// Its effects with where they are present.
    pub(crate) fn variants(&self) -> impl Iterator<Item = &Variant> {
        self.parts.iter().map(|(variant, _)| variant)
    }

    /// Of several effects each one alone, with its values.
    pub(crate) fn each_alone(&self, effects: &[f64]) -> Vec<(Self, Vec<f64>)> {
        let mut rest = effects;
        let alone = |part: &(Variant, Onsets)| {
            let (own, others) = rest.split_at(part.0.count());
            rest = others;
            (Self { parts: vec![part.clone()], acting: None }, own.to_vec())
        };
        if self.parts.len() > 1 { self.parts.iter().map(alone).collect() } else { Vec::new() }
    }

    /// Whether its effects are those of another hypothesis, whichever was found first.
    pub(crate) fn is_of_the_effects_of(&self, other: &Self) -> bool {
        let labels = |h: &Self| h.variants().map(Variant::label).collect::<BTreeSet<String>>();
        labels(self) == labels(other)
    }

    /// The values that this hypothesis' effects have in it, in the order of a hypothesis that holds some of them; `None` where
    /// that one holds another.
    pub(crate) fn values_of(&self, member: &Self, effects: &[f64]) -> Option<Vec<f64>> {
        let mut rest = effects;
        let mut own = Vec::with_capacity(self.parts.len());
        for (variant, _) in &self.parts {
            let (values, others) = rest.split_at(variant.count());
            rest = others;
            own.push((variant.label(), values));
        }
        let of = |v: &Variant| own.iter().find(|(label, _)| *label == v.label()).map(|(_, values)| *values);
        member.variants().map(of).collect::<Option<Vec<_>>>().map(|found| found.concat())
    }

    pub(crate) fn free(&self, sizes: &Sizes) -> Vec<Free> {
        let acting = self.acting.iter().flat_map(Acting::free);
        self.parts.iter().flat_map(|(v, _)| v.free(sizes)).chain(acting).collect()
    }

    /// The same for a drive that follows: what began at an instant in most recordings is there throughout, what did so in no
    /// more than half of them is absent.
    pub(crate) fn lasting(&self) -> Self {
        let from_now_on = |onsets: &Onsets| {
            let began = onsets.iter().flatten().count();
            onsets.iter().map(|_| (2 * began > onsets.len()).then_some(THROUGHOUT)).collect()
        };
        let parts = self.parts.iter().map(|(variant, onsets)| (*variant, from_now_on(onsets))).collect();
        Self { parts, acting: self.acting.clone() }
    }

    /// What acts beside the catalogue's effects, at free values `e` of the whole hypothesis.
    pub(crate) fn acting_at(&self, e: &[f64]) -> Option<Acting> {
        let before: usize = self.parts.iter().map(|(v, _)| v.count()).sum();
        self.acting.as_ref().map(|a| a.at(e.get(before..).unwrap_or_default()))
    }

    pub(crate) fn doses(&self, e: &[f64], run: usize) -> Vec<Dose> {
        let mut at = 0;
        self.parts
            .iter()
            .map(|(v, onsets)| {
                let n = v.count();
                let dose = v.dose(&e[at..at + n], onsets.get(run).copied().flatten());
                at += n;
                dose
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{Hypothesis, THROUGHOUT};
    use inference::hypothesis::{Place, variants};

    #[test]
    fn what_began_in_most_recordings_is_there_lasting() {
        let variant = variants(true).into_iter().find(|v| v.place == Place::Onset).expect("some begin at an instant");
        let later = |onsets: Vec<Option<f64>>| Hypothesis::single(variant, onsets).lasting().parts[0].1.clone();
        assert_eq!(later(vec![Some(3.0), None, Some(2.0)]), [Some(THROUGHOUT); 3]);
        assert_eq!(later(vec![Some(3.0), None]), [None; 2]);
        assert_eq!(later(vec![Some(3.0)]), [Some(THROUGHOUT)]);
        assert!(later(Vec::new()).is_empty(), "what has no onset is there anyway");
    }
}
