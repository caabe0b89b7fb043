//! The effects that may be named, those of the catalogue and those of one's own, and what a simulation is given of them.

use std::fmt;

use law::OwnEffect;
use robot_model::effect::MAX_PARAMETERS;
use robot_model::presence::{Disc, Presence};
use robot_model::{Active, Effect, effects};
use verdict::{EffectAt, LawOfFile};

use crate::DiagnosisError;
use crate::hypothesis::Dose;

/// The effects of the catalogue, and after them those of one's own.
#[derive(Clone, Copy, Default)]
pub struct KnownEffects {
    own: &'static [&'static OwnEffect],
    adopted: &'static [&'static OwnEffect],
}

impl fmt::Debug for KnownEffects {
    /// The laws of one's own: what answers depend on beside the catalogue.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("KnownEffects").field("own", &self.own).field("adopted", &self.adopted).finish()
    }
}

impl PartialEq for KnownEffects {
    /// Of the same laws under the same names.
    fn eq(&self, other: &Self) -> bool {
        let told = |of: &Self| format!("{of:?}");
        told(self) == told(other)
    }
}

impl KnownEffects {
    /// The catalogue with these, each of which has a name of its own. The list is kept until the program ends, as its
    /// effects are.
    pub fn with(own: Vec<&'static OwnEffect>) -> Self {
        Self { own: Box::leak(own.into_boxed_slice()), adopted: &[] }
    }

    /// The same with laws that the simulation of every robot is given: they are found by their names, and never weighed.
    #[must_use]
    pub fn adopting(self, adopted: Vec<&'static OwnEffect>) -> Self {
        Self { adopted: Box::leak(adopted.into_boxed_slice()), ..self }
    }

    /// The adopted laws at the numbers of their files.
    pub fn adopted(self) -> Vec<EffectAt> {
        let at = |own: &&'static OwnEffect| {
            let values = own.spec().parameters.iter().map(|p| (p.name.to_owned(), p.probes[0]));
            EffectAt { effect: own.name().to_owned(), values: values.collect(), ..EffectAt::default() }
        };
        self.adopted.iter().map(at).collect()
    }

    /// Those of one's own.
    pub fn own(self) -> &'static [&'static OwnEffect] {
        self.own
    }

    /// All laws of files, those that are weighed and those that are adopted.
    pub fn laws_of_files(self) -> impl Iterator<Item = &'static OwnEffect> {
        self.own.iter().chain(self.adopted).copied()
    }

    /// Refuses them for a kind of robot that no free run of the plant is compared with.
    ///
    /// # Errors
    /// Where there are any, with their names and that kind.
    pub fn refused_for(self, kind: &'static str) -> Result<(), DiagnosisError> {
        let names: Vec<&str> = self.laws_of_files().map(OwnEffect::name).collect();
        if names.is_empty() { Ok(()) } else { Err(DiagnosisError::OwnEffects { names: names.join(", "), kind }) }
    }

    /// The same without those of one's own that have one of these names.
    #[must_use]
    pub fn without(self, names: &[&str]) -> Self {
        if self.own.iter().all(|own| !names.contains(&own.name())) {
            return self;
        }
        let own: Vec<_> = self.own.iter().copied().filter(|own| !names.contains(&own.name())).collect();
        Self { own: Box::leak(own.into_boxed_slice()), ..self }
    }

    /// All of them.
    pub fn all(self) -> impl Iterator<Item = &'static dyn Effect<f64>> {
        effects::catalogue::<f64>().into_iter().chain(self.own.iter().copied().map(OwnEffect::as_effect))
    }

    /// The effect of a name.
    ///
    /// # Errors
    /// When there is none.
    pub fn find(self, id: &str) -> Result<&'static dyn Effect<f64>, DiagnosisError> {
        let adopted = self.adopted.iter().copied().map(OwnEffect::as_effect);
        self.all()
            .chain(adopted)
            .find(|e| e.spec().id == id)
            .ok_or_else(|| DiagnosisError::NoSuchEffect { id: id.to_owned() })
    }

    /// The effect for the plant of a drive.
    ///
    /// # Errors
    /// When the effect or a parameter is not known, or a value is not finite.
    pub fn active(self, at: &EffectAt, drive: &str) -> Result<Active<f64>, DiagnosisError> {
        Ok(Dose { presence: presence_in(at, drive), ..self.dose(at)? }.active())
    }

    /// Effects that the simulation is given, as a robot file states them.
    ///
    /// # Errors
    /// As [`KnownEffects::active`].
    pub fn given(self, effects: &[EffectAt]) -> Result<GivenEffects, DiagnosisError> {
        let is_adopted = |at: &EffectAt| self.adopted.iter().any(|law| law.name() == at.effect);
        let given =
            effects.iter().map(|at| Ok(Given { at: at.clone(), dose: self.dose(at)?, is_adopted: is_adopted(at) }));
        Ok(GivenEffects(given.collect::<Result<_, DiagnosisError>>()?))
    }

    /// The effect at its values, present everywhere and always.
    fn dose(self, at: &EffectAt) -> Result<Dose, DiagnosisError> {
        let effect = self.find(&at.effect)?;
        let parameters = effect.spec().parameters;
        let mut values: Vec<f64> = parameters.iter().take(MAX_PARAMETERS).map(|p| p.neutral).collect();
        for (name, value) in &at.values {
            let index = parameters.iter().position(|p| p.name == name).filter(|_| value.is_finite());
            let index = index.ok_or_else(|| DiagnosisError::NoSuchParameter {
                effect: at.effect.clone(),
                name: name.clone(),
                known: parameters.iter().map(|p| p.name).collect::<Vec<_>>().join(", "),
            })?;
            values[index] = *value;
        }
        Ok(Dose { effect, values, presence: Presence::default() })
    }

    /// Those of one's own for a verdict.
    pub fn told(self) -> Vec<LawOfFile> {
        let of = |own: &&OwnEffect| LawOfFile {
            name: own.name().to_owned(),
            formula: own.law().to_string(),
            seen: own.law().seen().iter().map(|(v, range)| (v.symbol().to_owned(), *range)).collect(),
        };
        self.own.iter().map(of).collect()
    }
}

/// When, where and on which side an effect is present in a drive.
fn presence_in(at: &EffectAt, drive: &str) -> Presence<f64> {
    let mut presence = Presence { side: at.side.map(|s| s as usize), ..Presence::default() };
    if let Some([x, y, radius]) = at.place {
        presence.disc = Some(Disc { centre: [x, y], radius });
    }
    if let Some(from) = at.from.get(drive) {
        presence.from = *from;
    } else if at.absent.iter().any(|name| name == drive) {
        presence.from = f64::MAX;
    }
    presence
}

/// Effects that the simulation is given beside the constants of its robot: they are part of every hypothesis, and never an
/// answer.
#[derive(Clone, Default)]
pub struct GivenEffects(Vec<Given>);

/// One of them.
#[derive(Clone)]
struct Given {
    at: EffectAt,
    dose: Dose,
    /// Whether it is there because the user's own simulator lacks it.
    is_adopted: bool,
}

impl GivenEffects {
    /// The effects in a drive of this name.
    pub fn doses(&self, drive: &str) -> Vec<Dose> {
        self.0.iter().map(|given| given.in_drive(drive)).collect()
    }

    /// The effects in a log of the user's own simulator, which lacks what is adopted.
    pub fn doses_of_simulator(&self, log: &str) -> Vec<Dose> {
        self.0.iter().filter(|given| !given.is_adopted).map(|given| given.in_drive(log)).collect()
    }

    /// Their names.
    pub fn names(&self) -> Vec<&str> {
        self.0.iter().map(|given| given.at.effect.as_str()).collect()
    }
}

impl Given {
    fn in_drive(&self, drive: &str) -> Dose {
        Dose { presence: presence_in(&self.at, drive), ..self.dose.clone() }
    }
}

impl fmt::Debug for GivenEffects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.0.iter().map(|given| &given.at)).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known(names: &[&str]) -> KnownEffects {
        let law: law::Law = "T_right = -0.5 [N m] * sgn(omega, 0.3)".parse().expect("a law");
        KnownEffects::with(names.iter().map(|name| OwnEffect::new(name, law.clone()).expect("an effect")).collect())
    }

    #[test]
    fn effects_of_ones_own_follow_those_of_the_catalogue_and_are_found_by_name() {
        let known = known(&["a", "b"]);
        let ids: Vec<&str> = known.all().map(|e| e.spec().id).collect();
        assert_eq!(ids.len(), effects::COUNT + 2);
        assert!(ids.ends_with(&["a", "b"]));
        assert!(known.find("a").is_ok() && known.find("payload").is_ok());
        assert!(matches!(KnownEffects::default().find("a"), Err(DiagnosisError::NoSuchEffect { .. })));
        assert_eq!(known.without(&["a"]).own().iter().map(|e| e.name()).collect::<Vec<_>>(), ["b"]);
        assert_eq!((known, known.without(&["c"])), (self::known(&["a", "b"]), known));
        assert!(format!("{known:?}").contains("a: T_right = -0.5 [N m] * sgn(omega, 0.3)"));
    }

    #[test]
    fn its_numbers_are_set_by_name_and_others_are_refused() {
        let known = known(&["a"]);
        let at = |name: &str| EffectAt {
            effect: "a".to_owned(),
            values: [(name.to_owned(), -0.7)].into(),
            ..EffectAt::default()
        };
        assert!(known.active(&at("constant"), "drive").is_ok());
        assert!(matches!(known.active(&at("Tb"), "drive"), Err(DiagnosisError::NoSuchParameter { .. })));
    }
    #[test]
    fn what_a_simulation_is_given_is_present_in_the_drives_that_it_says_and_an_adopted_law_in_no_log_of_a_simulator() {
        let none = KnownEffects::default();
        let adopting = none.adopting(known(&["flaw"]).own().to_vec());
        assert_eq!(adopting.all().count(), none.all().count(), "an adopted law is not weighed");
        assert!(adopting.find("flaw").is_ok());

        let payload = EffectAt {
            effect: "payload".to_owned(),
            values: [("mass".to_owned(), 3.0)].into(),
            from: [("late".to_owned(), 4.0)].into(),
            absent: vec!["before".to_owned()],
            ..EffectAt::default()
        };
        let [flaw] = &adopting.adopted()[..] else { panic!("one law") };
        assert_eq!(flaw.values["constant"], -0.5);
        let given = adopting.given(&[payload, flaw.clone()]).expect("known");
        let from = |drive: &str| given.doses(drive)[0].presence.from;
        assert!(from("late") == 4.0 && from("before") == f64::MAX && from("other") <= 0.0);
        let names = |doses: Vec<Dose>| doses.iter().map(|dose| dose.effect.spec().id).collect::<Vec<_>>();
        assert_eq!(names(given.doses("late")), ["payload", "flaw"]);
        assert_eq!(names(given.doses_of_simulator("late")), ["payload"]);
        assert!(none.given(&adopting.adopted()).is_err(), "nobody knows it");
        assert!(adopting.refused_for("car").is_err() && none.refused_for("car").is_ok());
    }
}
