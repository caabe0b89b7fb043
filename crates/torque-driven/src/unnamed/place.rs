//! Where something acts of which neither a law nor instants can be told: an arbitrary input there explains most of the mismatch.

use inference::robust;
use verdict::FoundPlace;

use super::acting::Inputs;
use super::arbitrary::{Acts, Instant, Standing, given};
use super::gate::References;
use super::series::{Ground, Seen, Series};
use crate::fit::Fitted;
use crate::judged::Judged;
use crate::settings::decision;
use crate::settings::law::{Events, SETTINGS};

const EVENTS: Events = SETTINGS.events;

/// The place; `None` where none explains most of the mismatch, or references show as much there. `all`: places, the likeliest
/// first.
pub(super) fn find(
    judged: &Judged<'_>,
    ground: &Ground<'_>,
    all: &[Acts],
    retuned: &Fitted,
    references: Option<&References<'_>>,
) -> Option<FoundPlace> {
    let (best, others) = all.split_first()?;
    let (inputs, _) = best.throughout(ground)?;
    let standing = Standing::new(judged, retuned, &inputs);
    let score = best.evidence / standing.misfit;
    // Of a robot that lacks nothing an arbitrary input explains the little that there is.
    let is_mismatch = standing.gain > decision::SETTINGS.unknown.least_mismatch;
    if !is_mismatch || score < SETTINGS.gates.score || standing.left > SETTINGS.gates.left_of_place_alone {
        return None;
    }
    let strength = |of: &Inputs| robust::rms(of.iter().flat_map(|(_, runs)| runs.iter().flatten().copied()));
    let own = strength(&inputs).filter(|s| *s > 0.0)?;
    let in_references = match references {
        Some(references) => {
            let elsewhere = references.at(best, |ground, acts| strength(&acts.throughout(ground)?.0))?;
            Some((elsewhere / own).powi(2))
        }
        None => None,
    };
    let alike = standing.alike(best, others);
    let next = others.iter().find(|o| !alike.iter().any(|name| name == o.place.name()));
    let is_elsewhere = in_references.is_some_and(|share| share >= SETTINGS.gates.in_references);
    (!is_elsewhere).then(|| FoundPlace {
        place: best.place.name().to_owned(),
        next_place: next.map(|o| (o.place.name().to_owned(), (best.evidence - o.evidence) / standing.misfit)),
        places_alike: alike,
        size: own,
        unit: best.place.unit().to_string(),
        left: standing.left,
        in_references,
    })
}

impl Acts {
    /// The most probable input of every window, about free runs with it while their cost falls; and the same window by window
    /// with its sigma.
    pub(super) fn throughout(&self, ground: &Ground<'_>) -> Option<(Inputs, Vec<Instant>)> {
        let everywhere = self.series.everywhere();
        let p = ground.problem;
        let with = |instants: Vec<Instant>| {
            let inputs = self.inputs_at(p, &instants);
            let response = given(p, ground.base, &inputs);
            (p.misfit(&response), inputs, response, instants)
        };
        let mut best = with(self.instants(ground, &everywhere, &self.solved, 1.0));
        for _ in 1..EVENTS.rounds {
            let seen = Seen { response: &best.2, inputs: &best.1 };
            let solved = Series::new(ground, &self.inputs, Some(&seen))?.solve(&everywhere, self.size)?;
            let next = with(self.instants(ground, &everywhere, &solved, 1.0));
            if next.0 >= best.0 {
                break;
            }
            best = next;
        }
        Some((best.1, best.3))
    }
}
