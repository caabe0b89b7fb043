//! The answer of a speed-driven case in sentences.

use verdict::{Diagnosis, Loads, Ratio, Verdict};

use crate::compare::reported;
use crate::headline::headline;
use crate::pieces::GRADE;
use crate::words::{
    change, hidden, load, other_ground, recordings, side_change, standstill, tentative, turning, turning_change,
};

/// The answer of a speed-driven case in sentences; `of_loads` is the verdict of the loads alone.
pub(crate) fn sentences(d: &Diagnosis, of_loads: Verdict, loads: &Loads, set_points: bool) -> Vec<String> {
    let theirs = if loads.references.is_empty() { "that of the robot file" } else { "that of the references" };
    let mut out = headline(d, of_loads, loads, theirs);
    // One that leads has been said.
    let said = |r: &&Ratio| {
        let of = format!("in {} the {} is", recordings(&r.recording), r.quantity.name());
        !out.iter().any(|s| s.contains(&of))
    };
    let more: Vec<String> = reported(loads).filter(said).map(|r| load(r, theirs)).collect();
    out.extend(more);

    if loads.standstills.len() > 1 {
        out.extend(loads.standstills.iter().map(standstill));
    }
    let sides = loads.side_changes.iter().map(side_change);
    let grounds = sides.chain(loads.grounds.iter().map(|g| other_ground(g, theirs)));
    // What shows a ground is told with it.
    let of_ground = |recording: &str, interval| loads.grounds.iter().any(|g| g.holds(recording, interval));
    let straight = loads.changes.found.iter().filter(|c| c.causes == [GRADE] || !of_ground(&c.recording, c.interval));
    let turns = loads.turning_changes.iter().filter(|c| !of_ground(&c.recording, c.interval));
    let changes = straight.map(change).chain(turns.map(turning_change));
    let more: Vec<String> = grounds.chain(changes).filter(|c| !out.iter().any(|said| said.ends_with(c))).collect();
    out.extend(more);
    out.extend(tentative(&loads.changes.tentative));
    out.extend(hidden(&loads.changes.hidden));
    out.extend(turning(&loads.turning));
    if set_points && !loads.ratios.is_empty() {
        out.push("All speeds here are set-points, not measured speeds.".to_owned());
    }
    out
}
