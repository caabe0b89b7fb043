//! Responses that may still be true.

use verdict::{Contender, Element, Scaling};

use crate::controller::Law;
use crate::element_words::element;
use crate::ground::TurnSlip;
use crate::identified::Identified;
use crate::identify::{Base, Identify, OfDrive, OfGround};
use crate::name::causes_of;
use crate::search::{Evidence, Model, Part, Trial, attempt, evidence};
use crate::settings::{Rivals as Settings, SETTINGS};
use crate::windows::Windows;

const RIVALS: Settings = SETTINGS.rivals;

/// A response that may be true.
pub(super) struct Rival {
    pub(super) contender: Contender,
    pub(super) drive: Trial<Law>,
    pub(super) ground: Trial<TurnSlip>,
}

/// What was found in a part, as it is now, with what it was fitted to.
struct Now<'a, L> {
    windows: &'a Windows,
    base: &'a Model<L>,
    found: Trial<L>,
}

impl<'a, L: Copy + PartialEq + Send + Sync + std::fmt::Debug> Now<'a, L> {
    /// Since it began, where it began inside recordings: beyond what held before.
    fn new<I: Identify<Law = L>>(of: &I, windows: &'a Windows, base: &'a Model<L>, found: &'a Trial<L>) -> Self {
        match &found.began {
            None => Self { windows, base, found: found.clone() },
            Some(began) => {
                let (windows, base) = (&began.windows[1], &began.before.model);
                let found = attempt(&of.part(windows), base, found.model.law, &found.elements, Some(found));
                Self { windows, base, found }
            }
        }
    }

    /// The same with an element less, or one more.
    fn changed<I: Identify<Law = L>>(&self, of: &I, e: Element) -> Trial<L> {
        let mut elements = self.found.elements.clone();
        if self.found.elements.contains(&e) {
            elements.retain(|own| *own != e);
        } else {
            elements.push(e);
        }
        attempt(&of.part(self.windows), self.base, self.found.model.law, &elements, Some(&self.found))
    }
}

/// The response that was found and those beside it, the most probable first.
///
/// A rival's odds against what was found are those of the element in which they differ; between two ways to hold the
/// sides at a wheel's limit, those of left-out windows.
pub(super) fn rivals(windows: &Windows, base: &Base, found: &Identified, nominal: [f64; 2]) -> Vec<Rival> {
    let of_ground = OfGround { nominal };
    let drive = Now::new(&OfDrive, windows, &base.drive, &found.drive);
    let ground = Now::new(&of_ground, windows, &base.ground, &found.ground);

    let plain = drive.found.elements.is_empty() && ground.found.elements.is_empty();
    let stem = if plain { "the response as simulated" } else { "the response as found" };
    let mut out = vec![(0.0, stem.to_owned(), drive.found.clone(), ground.found.clone())];
    for (e, v) in &found.evidence {
        let is_there = drive.found.elements.contains(e) || ground.found.elements.contains(e);
        let log_odds = if is_there { -v.score } else { v.score };
        if log_odds < RIVALS.least.ln() {
            continue;
        }

        let name = format!("the same {} {}", if is_there { "without" } else { "with" }, element(*e));
        let is_of_drive = !OfDrive.part(windows).free(drive.found.model.law, *e).is_empty();
        out.push(if is_of_drive {
            (log_odds, name, drive.changed(&OfDrive, *e), ground.found.clone())
        } else {
            (log_odds, name, drive.found.clone(), ground.changed(&of_ground, *e))
        });
    }
    out.extend(otherwise_held(&drive).map(|(log_odds, held, trial)| {
        (log_odds, format!("the same, but at a wheel's limit {held}"), trial, ground.found.clone())
    }));

    // Together they are as probable as one.
    out.sort_by(|a, b| b.0.total_cmp(&a.0));
    out.truncate(RIVALS.most);
    let sum: f64 = out.iter().map(|(log_odds, ..)| log_odds.exp()).sum();
    let rival = |(log_odds, name, drive, ground): (f64, String, Trial<Law>, Trial<TurnSlip>)| {
        let effects = causes_of(&[&drive.elements[..], &ground.elements].concat()).map(str::to_owned).collect();
        Rival { contender: Contender { effects, name, probability: log_odds.exp() / sum }, drive, ground }
    };
    out.into_iter().map(rival).collect()
}

/// Other ways to hold the sides at a wheel's limit that forecast about as well, with their log odds.
fn otherwise_held<'a>(drive: &'a Now<'_, Law>) -> impl Iterator<Item = (f64, &'static str, Trial<Law>)> + 'a {
    let law = drive.found.model.law;
    let limited = drive.found.elements.contains(&Element::WheelLimit);
    let others = Scaling::ALL.into_iter().filter(move |scaling| limited && *scaling != law.scaling);
    others.filter_map(move |scaling| {
        let law = Law { scaling, ..law };
        let part = OfDrive.part(drive.windows);
        let trial = attempt(&part, drive.base, law, &drive.found.elements, Some(&drive.found));
        let Evidence { score, .. } = evidence(drive.windows, &trial.loss, &drive.found.loss);
        // Both have as many constants: neither pays for an element.
        let log_odds = -(score + SETTINGS.evidence.prior).max(0.0);
        (log_odds >= RIVALS.least.ln()).then_some((log_odds, scaling.words(), trial))
    })
}
