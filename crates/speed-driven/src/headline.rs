//! What leads the sentences: the strongest thing that was found.
//!
//! A body that stands; then causes that the loads name; then changes inside recordings; then nothing.

use inference::words::{quantity, revealed_by};
use verdict::{Diagnosis, Loads, Standstill, Verdict};

use crate::found::longest;
use crate::settings::{NAMING, naming::Sentences};
use crate::words::how_it_stands;

const SENTENCES: Sentences = NAMING.sentences;

/// The first sentences; `of_loads` is the verdict of the loads alone.
pub(crate) fn headline(d: &Diagnosis, of_loads: Verdict, loads: &Loads) -> Vec<String> {
    let mut out = standing(&loads.standstills);
    let leads = out.is_empty();
    match of_loads {
        Verdict::Withheld if leads => {
            out.push("These recordings permit no answer: too little steady driving.".to_owned());
        }
        Verdict::Withheld => out.push("What is left is too little steady driving to compare any load.".to_owned()),
        Verdict::NoMismatch if !leads => {
            out.push("What is left shows no mismatch: its loads need no cause that the simulation lacks.".to_owned());
        }
        Verdict::NoMismatch if loads.changes.found.is_empty() && loads.turning_changes.is_empty() => {
            out.push("No mismatch: the loads of steady driving need no cause that the simulation lacks.".to_owned());
        }
        Verdict::NoMismatch => {
            out.push(
                "No mismatch over whole recordings: their loads need no cause that the simulation \
                 lacks. Within recordings the load changes, as listed here."
                    .to_owned(),
            );
        }
        Verdict::Unknown => {
            out.push("The loads differ, but in a way that no effect in the catalogue explains.".to_owned());
        }
        Verdict::Explained => out.extend(named(d)),
    }
    out
}

/// Where the body stands longest, how that is seen, and what to do.
fn standing(all: &[Standstill]) -> Vec<String> {
    let Some(s) = longest(all) else { return Vec::new() };
    let [from, until] = s.interval;
    let more = match all.len() - 1 {
        0 => String::new(),
        1 => ", and once more".to_owned(),
        n => format!(", and {n} times more"),
    };
    vec![
        format!(
            "Standing: in {} from {from:.1} s to {until:.1} s the wheels turn and the body does not{more}.",
            s.recording
        ),
        format!(
            "There {}: it is dug in, or its wheels spin. Nothing else here uses these rows; look at the robot and the \
             ground there before you change the simulation.",
            how_it_stands(s)
        ),
    ]
}

/// The causes that the loads name, and what tells the members of a class apart.
fn named(d: &Diagnosis) -> Vec<String> {
    let name = |id: &str| d.ranked.iter().find(|c| c.effect == id).map_or(id.to_owned(), |c| c.name.clone());
    let measured = |class: &&Vec<String>| class.iter().all(|id| *id != catalogue::speed_driven::STANDING.id);
    let mut out = Vec::new();
    for class in d.indistinguishable.iter().filter(measured) {
        let names: Vec<String> = class.iter().map(|i| name(i)).collect();
        let size = d.ranked.iter().find(|c| Some(&c.effect) == class.first()).map_or(String::new(), quantity);
        let tail =
            if names.len() > 1 { "; these recordings cannot tell them apart".to_owned() } else { format!(", {size}") };
        out.push(format!("Missing: {}{tail}.", names.join(" or ")));
        // The drives that reveal the members split the class; the first ones are enough to begin with.
        let mut drives: Vec<&str> = Vec::new();
        for drive in class.iter().filter_map(|id| revealed_by(id)) {
            if !drives.contains(&drive) && drives.len() < SENTENCES.drives {
                drives.push(drive);
            }
        }
        if class.len() > 1 {
            out.push(format!("To tell them apart, record: {}.", drives.join("; ")));
        }
    }
    out
}
