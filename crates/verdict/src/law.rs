//! A law for what has no name in the catalogue.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// How much of a law may be claimed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Claim {
    /// A law that fits: place and formula.
    Law,
    /// When and where something acts, for short times; no law in the measured signals predicts it.
    Events,
    /// Where it acts; no law in the measured signals predicts enough of it.
    Place,
    /// Neither.
    Nothing,
}

/// What was found of a cause that has no name in the catalogue.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct UnnamedCause {
    /// How much may be claimed.
    pub claim: Claim,
    /// The best law; of a place alone, what the place was told by.
    pub law: Option<FoundLaw>,
    /// A list of events where no law fits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub events: Option<FoundEvents>,
    /// A place without law or events, told by an arbitrary input there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place: Option<FoundPlace>,
    /// A law that references and recordings have alike: the simulation lacks it in every drive.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub in_every_drive: Option<CommonLaw>,
}

/// A place, or one of those that cannot be told from it.
pub fn one_of(place: &str, alike: &[String]) -> String {
    std::iter::once(place).chain(alike.iter().map(String::as_str)).collect::<Vec<_>>().join(", or ")
}

/// A text as a sentence begins: its first letter large.
pub fn sentence_case(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

impl UnnamedCause {
    /// Whether no reference recordings were given: then the simulation may lack this in every drive of the robot, not in these
    /// recordings alone.
    pub fn is_without_references(&self) -> bool {
        let of_events = self.events.as_ref().map(|e| e.in_references);
        let of_law = self.law.as_ref().map(|l| l.in_references);
        let of_place = self.place.as_ref().map(|p| p.in_references);
        of_events.or(of_law).or(of_place) == Some(None)
    }

    /// What was found instead of a name, in a sentence; `None` where nothing was.
    pub fn sentence(&self) -> Option<String> {
        if let Some(found) = &self.events {
            return Some(format!(
                "What is missing acts for short times, {} events in {:.0} % of the time, as {}.",
                found.events.len(),
                100.0 * found.filled,
                one_of(&found.place, &found.places_alike)
            ));
        }
        if let Some(found) = &self.place {
            return Some(format!(
                "What is missing acts as {}; no law in the measured signals predicts it.",
                one_of(&found.place, &found.places_alike)
            ));
        }
        let law = self.law.as_ref()?;
        let place = one_of(&law.place, &law.places_alike);
        Some(match self.claim {
            Claim::Law => format!("What is missing acts as {place}; a law that fits: {}.", law.formula),
            _ => format!("What is missing acts as {place}."),
        })
    }
}

/// A law with its proof.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FoundLaw {
    /// Where it acts, for people.
    pub place: String,
    /// Places that cannot be told from it.
    pub places_alike: Vec<String>,
    /// The formula with its units, as `law::Law` reads it.
    pub formula: String,
    /// Its factors, one by one.
    pub factors: Vec<String>,
    /// Constants and shape numbers.
    pub numbers: Vec<LawNumber>,
    /// Range in which each variable was seen, by its symbol in the formula.
    pub seen: BTreeMap<String, [f64; 2]>,
    /// Other laws that these recordings cannot tell from it.
    pub alike: Vec<String>,
    /// The best law at another place, and by how much it is worse, nats.
    pub next_place: Option<(String, f64)>,
    /// The nearest name and its gain as a share of the law's.
    pub nearest_name: Option<(String, f64)>,
    /// Fall of the cost below "re-tune only", nats.
    pub gain: f64,
    /// Gain less the price of what it is made of, nats.
    pub score: f64,
    /// Gain in each recording, nats.
    pub gains: BTreeMap<String, f64>,
    /// Share of the excess cost that it leaves.
    pub left: f64,
    /// The same law's coefficient in the references, as a share of that in the recordings; `None` without references.
    pub in_references: Option<f64>,
    /// Free runs on recordings left out of its fit.
    pub free_runs: Vec<LawFreeRun>,
}

/// Where something acts of which no more is known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FoundPlace {
    /// The place, for people.
    pub place: String,
    /// Places that cannot be told from it.
    pub places_alike: Vec<String>,
    /// The next place that can, and by how much it is worse, nats.
    pub next_place: Option<(String, f64)>,
    /// How strong what acts there is, rms over all windows of 0.1 s.
    pub size: f64,
    /// Unit of the size.
    pub unit: String,
    /// Share of the excess cost that free runs leave with the input that explains most.
    pub left: f64,
    /// Its mean square in the references, over that of the recordings; `None` without references.
    #[serde(default)]
    pub in_references: Option<f64>,
}

/// Short times in which something acts on the robot that no law in the measured signals predicts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FoundEvents {
    /// Where they act, for people.
    pub place: String,
    /// Places that cannot be told from it.
    pub places_alike: Vec<String>,
    /// The events, by recording and time.
    pub events: Vec<Event>,
    /// What they have in common, the clearest first.
    pub shared: Vec<Shared>,
    /// Of torques: what they act against.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub opposed: Option<Opposed>,
    /// Share of the windows in which one is.
    pub filled: f64,
    /// The same share of the references, over that of the recordings; `None` without references.
    #[serde(default)]
    pub in_references: Option<f64>,
    /// Share of the excess cost that free runs with them leave.
    pub left: f64,
    /// Evidence of them less what choosing their windows costs, nats.
    pub score: f64,
}

/// One event.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// Its recording.
    pub recording: String,
    /// When it begins, s; windows of 0.1 s.
    pub from: f64,
    /// When it ends, s.
    pub until: f64,
    /// What acts, and on which side.
    pub input: String,
    /// How strongly, on average, against the simulation.
    pub size: f64,
    /// Half width of the size's 90 % interval.
    pub half: f64,
    /// Unit of the size.
    pub unit: String,
}

/// What torques at events act against.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Opposed {
    /// Share of the windows with an event in which it acts against the torque that was commanded.
    pub torque: f64,
    /// Share of them in which it acts against the wheel's motion.
    pub motion: f64,
    /// By which share of the commanded torque it makes the torque smaller, median.
    pub of_torque: f64,
    /// What does so, where nearly all act against the same.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub like: Option<String>,
}

/// A variable whose amount is other at events than elsewhere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Shared {
    /// The variable, for people.
    pub variable: String,
    /// Its unit.
    pub unit: String,
    /// Whether it is larger at events.
    pub above: bool,
    /// The amount above, or below, which most events begin.
    pub bound: f64,
    /// Share of the events that do.
    pub of_events: f64,
    /// Share of all other windows that do.
    pub elsewhere: f64,
}

/// A number of a law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LawNumber {
    /// The constant, or the factor whose shape it is.
    pub of: String,
    /// Its value.
    pub value: f64,
    /// Half width of its 90 % interval; `None` where the recordings do not determine it.
    pub half: Option<f64>,
    /// Its unit.
    pub unit: String,
}

/// A law that references and recordings have alike.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CommonLaw {
    /// Where it acts, for people.
    pub place: String,
    /// The formula with its units.
    pub formula: String,
    /// Its coefficient in the references, as a share of that in the recordings.
    pub in_references: f64,
    /// Range in which each of its variables was seen, in the variable's unit; older verdicts have none.
    #[serde(default)]
    pub seen: BTreeMap<String, [f64; 2]>,
}

/// Free-run errors of a recording that was not used for the fit, rms.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LawFreeRun {
    /// Name of the recording that was left out.
    pub recording: String,
    /// What is compared, with its unit.
    pub quantity: String,
    /// The calibrated model as it is.
    pub nominal: f64,
    /// Re-tuned without any effect.
    pub retuned: f64,
    /// Corrected by the best name; `None` where no name is likely at all.
    pub named: Option<f64>,
    /// Corrected by the law.
    pub law: f64,
    /// Corrected by the same law shifted in time, the best of several such copies: the placebo.
    pub shifted: f64,
}

/// A law of a file under whose name a verdict may name a cause.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LawOfFile {
    /// The name of its effect.
    pub name: String,
    /// The formula with its units, at the numbers of the file, as `law::Law` reads it.
    pub formula: String,
    /// Range in which each variable was seen, by its symbol in the formula; beyond, it is held at its end.
    pub seen: BTreeMap<String, [f64; 2]>,
}

impl FoundLaw {
    /// Error of a quantity with the law over that with re-tuned constants, over all recordings that were left out; `None`
    /// where none was.
    pub fn error_over_retuned(&self, quantity: &str) -> Option<f64> {
        let rows = || self.free_runs.iter().filter(|r| r.quantity == quantity);
        let of = |read: fn(&LawFreeRun) -> f64| rows().map(|r| read(r).powi(2)).sum::<f64>();
        let retuned = of(|r| r.retuned);
        (retuned > 0.0).then(|| (of(|r| r.law) / retuned).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn left_out(quantity: &str, retuned: f64, law: f64) -> LawFreeRun {
        let (recording, quantity) = ("a".to_owned(), quantity.to_owned());
        LawFreeRun { recording, quantity, nominal: 100.0, retuned, named: Some(50.0), law, shifted: 70.0 }
    }

    #[test]
    fn a_sentence_says_where_and_how_often_something_acts() {
        let nothing =
            UnnamedCause { claim: Claim::Nothing, law: None, events: None, place: None, in_every_drive: None };
        assert_eq!(nothing.sentence(), None);
        let event = Event {
            recording: "run_1".to_owned(),
            from: 1.0,
            until: 1.3,
            input: "torque, right".to_owned(),
            size: -2.0,
            half: 0.5,
            unit: "N m".to_owned(),
        };
        let events = FoundEvents {
            place: "torque on the right side".to_owned(),
            places_alike: vec!["yaw moment on the body".to_owned()],
            events: vec![event.clone(), event],
            shared: Vec::new(),
            opposed: None,
            filled: 0.119,
            in_references: Some(0.0),
            left: 0.2,
            score: 900.0,
        };
        let with_events = UnnamedCause { claim: Claim::Events, events: Some(events), ..nothing.clone() };
        assert_eq!(
            with_events.sentence().as_deref(),
            Some(
                "What is missing acts for short times, 2 events in 12 % of the time, as torque on the right side, or yaw \
                 moment on the body."
            )
        );
        let place = FoundPlace {
            place: "grip of all wheels".to_owned(),
            places_alike: Vec::new(),
            next_place: None,
            size: 0.2,
            unit: "1".to_owned(),
            left: 0.3,
            in_references: Some(0.1),
        };
        let with_place = UnnamedCause { claim: Claim::Place, place: Some(place), ..nothing };
        let sentence = with_place.sentence().expect("a place");
        assert!(sentence.starts_with("What is missing acts as grip of all wheels;"), "{sentence}");
        assert!(!with_place.is_without_references());
        let place = with_place.place.clone().map(|place| FoundPlace { in_references: None, ..place });
        assert!(UnnamedCause { place, ..with_place }.is_without_references());
    }

    #[test]
    fn a_law_is_weighed_by_the_mean_squares_of_its_errors_over_all_recordings_left_out() {
        let law = FoundLaw {
            place: "left drive".to_owned(),
            places_alike: Vec::new(),
            formula: "c".to_owned(),
            factors: Vec::new(),
            numbers: Vec::new(),
            seen: BTreeMap::new(),
            alike: Vec::new(),
            next_place: None,
            nearest_name: None,
            gain: 20.0,
            score: 12.0,
            gains: BTreeMap::new(),
            left: 0.1,
            in_references: None,
            free_runs: vec![
                left_out("yaw rate, rad/s", 6.0, 3.0),
                left_out("forward speed, m/s", 2.0, 3.0),
                left_out("yaw rate, rad/s", 8.0, 4.0),
                left_out("wheel speed, rad/s", 0.0, 1.0),
            ],
        };
        // Of right triangles: 3, 4, 5 over 6, 8, 10.
        assert_eq!(law.error_over_retuned("yaw rate, rad/s"), Some(0.5));
        assert_eq!(law.error_over_retuned("forward speed, m/s"), Some(1.5));
        assert_eq!(law.error_over_retuned("wheel speed, rad/s"), None, "over nothing");
        assert_eq!(law.error_over_retuned("position, m"), None, "not left out");
    }
}
