//! What a rehearsal says in sentences.

use torque_driven::{Case, Run};
use verdict::RehearsedEffect;

use crate::plan::Plan;
use crate::replica::Template;
use crate::score::{Kind, Scored};
use crate::settings::SETTINGS;

/// An answer in a few words.
fn answer(kind: Kind, others: &[&str]) -> String {
    let others = others.join(", ");
    match kind {
        Kind::First if others.is_empty() => "named".to_owned(),
        Kind::First => format!("named, and {others}"),
        Kind::InSet => format!("in one answer with {others}"),
        Kind::Unknown => "unknown".to_owned(),
        Kind::Nothing => "nothing is missing".to_owned(),
        Kind::Wrong => format!("named {others}"),
        Kind::Withheld => "no answer".to_owned(),
    }
}

/// A line about a replica for whoever waits: what was hidden, so many sizes of interest of it, and what was answered.
pub(crate) fn diagnosed(replica: usize, hidden: Option<(&str, f64)>, scored: &Scored) -> String {
    let what = hidden.map_or_else(|| "nothing hidden".to_owned(), |(id, multiple)| format!("{id} {multiple} x"));
    let others: Vec<&str> = scored.others.iter().map(String::as_str).collect();
    format!("replica {}, {what}: {}", replica + 1, answer(scored.kind, &others))
}

/// What was shortened or left away.
pub(crate) fn shortened(
    case: &Case,
    real: &[&Run],
    plan: &Plan,
    [recordings, references]: [&[Template]; 2],
) -> Vec<String> {
    let mut out = Vec::new();
    if recordings.len() < case.recordings.len() {
        let (some, all) = (recordings.len(), case.recordings.len());
        out.push(format!("the first {some} of {all} recordings are driven again; --drives takes more"));
    }
    if plan.references.is_none() && references.len() < real.len() {
        let (some, all) = (references.len(), real.len());
        out.push(format!("the first {some} of {all} references are driven again"));
    }
    let own = |templates: &[Template], runs: &[&Run]| {
        templates.iter().zip(runs).any(|(template, run)| template.run.rows() < run.rows())
    };
    let all: Vec<&Run> = case.recordings.iter().collect();
    if own(recordings, &all) || (plan.references.is_none() && own(references, real)) {
        out.push(format!("of each drive the first {} s are driven again; --seconds takes more", plan.seconds));
    }
    out
}

/// What limits an answer by the equations of a fit.
pub(crate) fn limits_of_fit(plan: &Plan, references: usize) -> Vec<String> {
    let mut out = vec![
        "nothing is simulated: a replica obeys the equations of the fit to these recordings, in which a cause changes what is \
         measured in proportion to its size; nothing is called unknown here, and on a real robot less is found"
            .to_owned(),
        "the size of interest of a cause is one sigma of the sizes that it usually has; where it can have either sign, either \
         is drawn"
            .to_owned(),
        format!(
            "constants are drawn within {} sigmas of the robot file, and differ from drive to drive as the fit found",
            SETTINGS.constants.farthest
        ),
        ALONE.to_owned(),
        format!("each size has {} replicas, a reference the inputs of a recording: read the intervals, not the shares", plan.replicas),
    ];
    if references == 0 {
        out.push(NO_REFERENCE.to_owned());
    }
    out
}

/// What limits an answer about responses to commands.
pub(crate) fn limits_of_response(plan: &Plan, references: usize) -> Vec<String> {
    let mut out = vec![
        "what is hidden is one constant of the very response by which it is looked for; wheels and body err from it as these \
         recordings do from the best response to them, later by some time and with either sign: on a real robot less is found than here"
            .to_owned(),
        format!(
            "radius and track are drawn within {} sigmas of the robot file, and stay the same in all drives of a replica",
            SETTINGS.constants.farthest
        ),
        ALONE.to_owned(),
        format!("each size has {} replicas: read the intervals, not the shares", plan.replicas),
    ];
    if references == 0 {
        out.push(
            "there is no reference: the simulation is that wheels do what is commanded; --references 3 tells what three would be worth"
                .to_owned(),
        );
    }
    out
}

/// What limits an answer about steady loads.
pub(crate) fn limits_of_loads(plan: &Plan, references: usize) -> Vec<String> {
    let mut out = vec![
        "replicas are loads of as much steady driving as was recorded, not rows: what changes inside a drive (ground, standing, clocks) is \
         not drawn, and what is hidden obeys the very laws by which it is looked for: on a real robot less is found than here"
            .to_owned(),
        format!(
            "constants are drawn within {} sigmas of what is known of them, each load within its standard error and what drives of one \
             robot differ by; each day's drive train is colder or warmer",
            SETTINGS.constants.farthest
        ),
        ALONE.to_owned(),
        format!("each size has {} replicas: read the intervals, not the shares", plan.replicas),
    ];
    if references == 0 {
        out.push(NO_REFERENCE.to_owned());
    }
    out
}

/// What is not drawn.
const ALONE: &str = "a cause is hidden alone and throughout; instants and pairs are not drawn";

/// What limits an answer without references.
const NO_REFERENCE: &str =
    "there is no reference: the robot file stands in its place; --references 3 tells what three would be worth";

/// What limits the answer.
pub(crate) fn limits(effects: &[RehearsedEffect], plan: &Plan, references: usize) -> Vec<String> {
    let mut out = vec![
        "what is hidden obeys the very laws by which it is looked for, and nothing else of the robot differs in form: on a \
         real robot less is found than here"
            .to_owned(),
        format!(
            "constants are drawn within {} sigmas of the robot file and differ from drive to drive by {} of a sigma: a file \
             that states them too surely makes a rehearsal too good",
            SETTINGS.constants.farthest, SETTINGS.constants.between_drives
        ),
        "torques are replayed as they were recorded, from rest on level ground: a controller would have pushed harder against \
         a large effect"
            .to_owned(),
        "an effect is hidden alone, throughout, on the whole robot or on one side; places, instants and pairs are not drawn, \
         nor are constant errors of sensors"
            .to_owned(),
        format!(
            "each size has {} replica{}: read the intervals, not the shares",
            plan.replicas,
            if plan.replicas == 1 { "" } else { "s" }
        ),
    ];
    if references == 0 {
        out.push(NO_REFERENCE.to_owned());
    }
    let slowed = |effect: &&RehearsedEffect| effect.sizes.last().is_some_and(|s| s.driven < SETTINGS.seen.slowed);
    let names: Vec<&str> = effects.iter().filter(slowed).map(|effect| effect.effect.as_str()).collect();
    if !names.is_empty() {
        out.push(format!(
            "at their largest size these leave the robot less than {:.0} % of the recorded way on the same torques: {}",
            100.0 * SETTINGS.seen.slowed,
            names.join(", ")
        ));
    }
    out
}
