//! Findings as a verdict in sentences.

use crate::findings::Findings;
use crate::forecast::LENGTHS;
use crate::left_out::Table;
use crate::settings::SETTINGS;
use catalogue::odometry::{RADIUS_OF_ALL_WHEELS, RADIUS_OF_ONE_WHEEL, WHEEL_DISTANCE};
use hierarchical_fit::telling::{Found, Unaccounted};
use hierarchical_fit::{NamedCause, Wording};

use crate::findings::is_nothing_that_slips;
use verdict::Diagnosis;

/// The verdict of findings, with the forecasts of sessions that were left out.
pub fn diagnosis(findings: &Findings, table: &Table, has_references: bool) -> Diagnosis {
    let found = Found {
        answer: findings.answer,
        named: &findings.named,
        others: &findings.others,
        constants: &findings.constants,
        retuned: &findings.retuned,
        rival: findings.rival.as_deref(),
        shares: findings.shares,
        beside_references: findings.left_of_references.map(|usual| [findings.shares[2], usual]),
        beside_usual: Some([findings.shares[2], SETTINGS.unexplained.doubted])
            .filter(|_| !has_references && findings.measured.pose),
        unconfirmed: findings.unconfirmed.as_ref(),
        unknown: if is_nothing_that_slips(&findings.named) {
            Unaccounted::SlipsBelowZero
        } else {
            Unaccounted::Left { of_references: findings.left_of_references }
        },
    };
    let mut out = found.verdict(table.free_runs());
    out.traces = if table.traces.is_empty() { findings.traces.clone() } else { table.traces.clone() };
    out.next.clone_from(&findings.next);
    let pose = if findings.measured.pose { "pose" } else { "gyro" };
    let words = Wording {
        agree: &format!("wheels and {pose} agree"),
        disagree: &format!("Wheels and {pose} disagree"),
        errors: "errors of windows",
        machine: "robot",
        conditions: "floor and load",
        most: SETTINGS.unexplained.most,
        scales: &[RADIUS_OF_ALL_WHEELS.id, RADIUS_OF_ONE_WHEEL.id],
        has_references,
    };
    out.sentences = found.sentences(&words, &out);
    out.sentences.extend(findings.told.iter().map(|t| format!("{t}.")));
    out.sentences.extend(forecast_sentence(table));
    out.limits.splice(0..0, limits(findings, has_references));
    out
}

fn forecast_sentence(table: &Table) -> Option<String> {
    let medians: Vec<(&String, [Option<f64>; 2])> =
        table.rows.iter().filter_map(|(name, e)| Some((name, e[LENGTHS.len() - 1].medians()?))).collect();
    if medians.is_empty() {
        return None;
    }
    let places = |p: Option<f64>| p.map_or_else(String::new, |p| format!("{:.1} cm and ", 100.0 * p));
    let rows = medians.iter().map(|(name, [p, h])| format!("{name} {}{:.1} mrad", places(*p), 1e3 * h.unwrap_or(0.0)));
    let pose = if medians.iter().any(|(_, [p, _])| p.is_some()) { "Pose" } else { "Heading" };
    Some(format!(
        "{pose} {:.0} s ahead from counts alone on what was left out of the fit, {} in turn (medians): {}.",
        LENGTHS[LENGTHS.len() - 1],
        table.sessions,
        rows.collect::<Vec<_>>().join(", ")
    ))
}

fn limits(findings: &Findings, has_references: bool) -> Vec<String> {
    let mut out = Vec::new();
    if findings.measured.pose {
        out.push(
            "a wrong radius of all wheels and a wrong scale of the pose look the same: lengths are those of the pose"
                .to_owned(),
        );
    }
    if findings.measured.heading {
        out.push(
            "a gyro shows how the body turns and not how far it goes: radii of all wheels, track and scale of the gyro look the same \
             there, and slip that loses way is not looked for; where one drive has a pose, lengths are known for all"
                .to_owned(),
        );
    }
    out.push(format!(
        "{} sessions, {} drives, {} windows; constants are taken to differ between sessions by {:.2} times the usual \
             scatter, and intervals hold for a new session's mean only",
        findings.counts[0], findings.counts[1], findings.counts[2], findings.scatter
    ));
    if findings.counts[0] == 1 {
        out.push("one session cannot tell by how much constants differ from session to session".to_owned());
    }
    if findings.named.iter().any(|cause| cause.onset.is_some()) {
        out.push(
            "forecasts of left-out drives take the size of a cause that begins or ends from the other drives, and its instant from the \
             left-out drive itself"
                .to_owned(),
        );
    }
    let is_wider = |cause: &NamedCause| {
        cause.spec.id == WHEEL_DISTANCE.id && cause.estimates.first().is_some_and(|e| e.value > e.given)
    };
    if findings.named.iter().any(is_wider) {
        out.push(
            "wheels farther apart than stated, and wheels that scrub in every turn so that the same share of turning is lost, look the \
             same: measure the distance of the wheels before it is corrected"
                .to_owned(),
        );
    }
    let is_smaller = |cause: &NamedCause| {
        cause.spec.id == RADIUS_OF_ALL_WHEELS.id && cause.estimates.first().is_some_and(|e| e.value < e.given)
    };
    if findings.named.iter().any(is_smaller) {
        out.push(
            "smaller radii of all wheels, more counts a turn, and driven wheels that always slip by the same share (a brake that drags, \
             a heavy load) look the same: see whether all wheels turn freely before numbers are corrected"
                .to_owned(),
        );
    }
    if !has_references {
        out.push("no references were given: the robot file, as sure as it states, stands in their place".to_owned());
    }
    out
}
