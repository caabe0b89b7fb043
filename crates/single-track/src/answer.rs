//! Findings as a verdict in sentences.

use crate::settings::SETTINGS;
use hierarchical_fit::telling::Found;
use hierarchical_fit::{Answer, beyond_references};

use crate::diagnose::Findings;
use crate::forecast::{ByLength, LENGTHS};
use crate::left_out::{FOLLOWING, OWN_ROWS, Table};
use catalogue::car::ENCODER_SCALE;
use verdict::Diagnosis;

/// The verdict of findings, with the forecasts of drives that were left out.
pub fn diagnosis(findings: &Findings, table: &Table, has_references: bool) -> Diagnosis {
    let found = findings.said.found();
    let mut out = found.verdict(table.free_runs());
    out.next.clone_from(&findings.next);
    out.traces = if table.traces.is_empty() { findings.traces.clone() } else { table.traces.clone() };
    out.sentences = sentences(findings, &found, &out, has_references);
    out.sentences.extend(found.doubted());
    out.sentences.extend(found.causes(&[ENCODER_SCALE.id], &out.free_runs));
    out.sentences.extend(found.perhaps());
    out.sentences.extend(forecast_sentence(table));
    out.limits.splice(0..0, limits(findings, table, has_references));
    out
}

fn sentences(findings: &Findings, found: &Found<'_>, out: &Diagnosis, has_references: bool) -> Vec<String> {
    let [stated, is_known, leaves] = if has_references {
        ["the references", "are known", "leave"]
    } else {
        ["the robot file", "is known", "leaves"]
    };
    let mut text: Vec<String> = found.undecided().into_iter().collect();
    let [given, tuned, best] = findings.said.shares.map(|s| 100.0 * s);
    let nothing = found.nothing();
    match findings.said.answer {
        Answer::Nothing => text.push(format!(
            "{nothing}: the car moves as throttle and steering imply, as well as {stated} {is_known} (errors after a \
             second are {given:.1} % of the motion, {tuned:.1} % with the drive train fitted)."
        )),
        Answer::Retune => {
            text.push(format!(
                "Re-tune: the car moves as throttle and steering imply once constants are set within what {stated} {leaves} open \
                 (errors after a second go from {given:.1} to {tuned:.1} % of the motion)."
            ));
            text.extend(out.retuned.iter().map(|r| format!("{}.", r.sentence())));
        }
        Answer::Named => {
            text.push(format!(
                "The car moves otherwise than throttle and steering imply, by more than {stated} {leaves} open: {} (errors after a \
                 second go from {given:.1} over {tuned:.1} re-tuned to {best:.1} % of the motion).",
                found.names()
            ));
        }
        Answer::Unknown if findings.said.is_scattered => text.push(format!(
            "Unknown: the drives of this car differ from each other by {:.0} times what is usual or more, so that no cause that all \
             of them share can be trusted (errors after a second are {given:.1} % of the motion, {best:.1} % with the best answer). \
             Diagnose drives of one day, floor and battery by themselves; candidates follow.",
            findings.said.scatter
        )),
        Answer::Unknown if findings.said.is_refuted => text.push(format!(
            "Something is missing that these causes do not account for: with them drives that were left out of the fit are forecast worse \
             than as stated (errors after a second are {given:.1} % of the motion, {tuned:.1} % re-tuned). Candidates \
             follow."
        )),
        Answer::Unknown => text.push(format!(
            "Something is missing that none of the causes accounts for: errors after a second are {given:.1} % of the motion, and \
             {best:.1} % remain with the best answer.{}{}",
            beyond_references(findings.said.shares[2], findings.said.left_of_references).unwrap_or_default(),
            if findings.said.shares[2] > SETTINGS.unexplained.most {
                " No robot that drives is off by so much: check the order, the signs and the units of the columns first."
            } else {
                ""
            }
        )),
    }
    text
}

fn forecast_sentence(table: &Table) -> Option<String> {
    let last = LENGTHS.len() - 1;
    let median = |row: &(String, ByLength)| Some((row.0.clone(), row.1[last].medians()?[0]));
    let shown: Vec<(String, f64)> = table.rows.iter().filter_map(median).collect();
    if shown.is_empty() {
        return None;
    }
    let rows = shown.iter().map(|(name, p)| format!("{name} {:.1} cm", 100.0 * p));
    Some(format!(
        "Place {:.0} s ahead from throttle and steering alone on what was left out of the fit, {} drives in turn (medians): {}.",
        LENGTHS[last],
        table.drives,
        rows.collect::<Vec<_>>().join(", ")
    ))
}

fn limits(findings: &Findings, table: &Table, has_references: bool) -> Vec<String> {
    let mut out = vec![
        "a wrong scale of the pose and wrong lengths of the car look the same: lengths are those of the pose"
            .to_owned(),
        format!(
            "{} drives, {} with a pose, {} windows; constants are taken to differ between drives by {:.2} times the usual \
             scatter",
            findings.counts[0], findings.counts[1], findings.counts[2], findings.said.scatter
        ),
    ];
    out.extend(findings.told.iter().cloned());
    let [unstated, hardly_seen] = &findings.unweighed;
    if !hardly_seen.is_empty() {
        out.push(format!(
            "{}: stated, and no better known by drives: if it is wrong, another cause is told for it",
            hardly_seen.join(", ")
        ));
    }
    if !unstated.is_empty() {
        out.push(format!(
            "nothing is stated of {}; these were fitted, and nothing can be wrong with them: state them in the robot file with \
             their sigma",
            unstated.join(", ")
        ));
    }
    let median = |row: usize| table.rows.get(row).and_then(|r| r.1[LENGTHS.len() - 1].medians()).map(|m| m[0]);
    let rival = (OWN_ROWS..table.rows.len()).filter_map(median).fold(f64::INFINITY, f64::min);
    if median(FOLLOWING).is_some_and(|own| own > rival) {
        out.push(
            "a classical model forecasts drives left out better than the answer does: do not build on it".to_owned(),
        );
    }
    if findings.counts[0] == 1 {
        out.push("one drive cannot tell by how much constants differ from drive to drive".to_owned());
    }
    if !has_references {
        out.push("no references were given: the robot file, as sure as it states, stands in their place".to_owned());
    }
    out
}
