//! Findings as a verdict in sentences.

use hierarchical_fit::telling::Found;
use hierarchical_fit::{Answer, beyond_references};
use verdict::Diagnosis;

use crate::diagnose::Findings;
use crate::left_out::{LENGTHS, Table};
use crate::settings::SETTINGS;
use catalogue::odometry::{RADIUS_OF_ALL_WHEELS, RADIUS_OF_ONE_WHEEL};

/// The verdict of findings, with the forecasts of drives that were left out.
pub fn diagnosis(findings: &Findings, table: &Table, has_references: bool) -> Diagnosis {
    let found = findings.said.found();
    let mut out = found.verdict(table.free_runs());
    out.traces = if table.traces.is_empty() { findings.traces.clone() } else { table.traces.clone() };
    out.next.clone_from(&findings.next);
    out.sentences = found.undecided().into_iter().collect();
    out.sentences.push(headline(findings, &found, has_references));
    if findings.said.answer == Answer::Retune {
        out.sentences.extend(out.retuned.iter().map(|r| format!("{}.", r.sentence())));
    }
    out.sentences.extend(found.doubted());
    out.sentences.extend(found.causes(&[RADIUS_OF_ALL_WHEELS.id, RADIUS_OF_ONE_WHEEL.id], &out.free_runs));
    out.sentences.extend(found.perhaps());
    out.sentences.extend(forecast_sentence(table));
    out.limits.splice(0..0, limits(findings, has_references));
    out
}

fn headline(findings: &Findings, found: &Found<'_>, has_references: bool) -> String {
    let [stated, is_known, leaves] = if has_references {
        ["the references", "are known", "leave"]
    } else {
        ["the robot file", "is known", "leaves"]
    };
    let [given, tuned, best] = findings.said.shares.map(|s| 100.0 * s);
    let nothing = found.nothing();
    match findings.said.answer {
        Answer::Nothing => format!(
            "{nothing}: the robot moves as the torques of its motors imply, as well as {stated} {is_known} (errors after a \
             second are {given:.1} % of the motion, {tuned:.1} % re-tuned)."
        ),
        Answer::Retune => format!(
            "Re-tune: the robot moves as the torques of its motors imply once constants are set within what {stated} {leaves} open \
             (errors after a second go from {given:.1} to {tuned:.1} % of the motion)."
        ),
        Answer::Named => format!(
            "The robot moves otherwise than the torques of its motors imply, by more than {stated} {leaves} open: {} (errors after \
             a second go from {given:.1} over {tuned:.1} re-tuned to {best:.1} % of the motion).",
            found.names()
        ),
        Answer::Unknown if findings.said.is_scattered => format!(
            "Unknown: the drives of this robot differ from each other by {:.0} times what is usual or more, so that no cause that \
             all of them share can be trusted (errors after a second are {given:.1} % of the motion, {best:.1} % with the best \
             answer). Diagnose drives of one day, floor and load by themselves; candidates follow.",
            findings.said.scatter
        ),
        Answer::Unknown if findings.said.is_refuted => format!(
            "Something is missing that these causes do not account for: with them drives that were left out of the fit are forecast worse \
             than as stated (errors after a second are {given:.1} % of the motion, {tuned:.1} % re-tuned). Candidates \
             follow."
        ),
        Answer::Unknown => format!(
            "Something is missing that none of the causes accounts for: errors after a second are {given:.1} % of the motion, and \
             {best:.1} % remain with the best answer.{}{}",
            beyond_references(findings.said.shares[2], findings.said.left_of_references).unwrap_or_default(),
            if findings.said.shares[2] > SETTINGS.unexplained.most {
                " No robot that drives is off by so much: check the order, the signs and the units of the columns first."
            } else {
                ""
            }
        ),
    }
}

fn forecast_sentence(table: &Table) -> Option<String> {
    let last = LENGTHS.len() - 1;
    let shown: Vec<String> = table
        .rows
        .iter()
        .filter_map(|(name, medians)| Some(format!("{name} {:.1} cm", 100.0 * medians[last]?[0])))
        .collect();
    (!shown.is_empty()).then(|| {
        format!(
            "Place {:.0} s ahead from torques alone on what was left out of the fit, {} drives in turn (medians): {}.",
            LENGTHS[last],
            table.by_drive.len(),
            shown.join(", ")
        )
    })
}

fn limits(findings: &Findings, has_references: bool) -> Vec<String> {
    let [drives, with_pose, windows] = findings.counts;
    let mut out = vec![format!(
        "{drives} drives, {with_pose} with a pose, {windows} windows of {} s; constants are taken to differ between drives by \
         {:.2} times the usual scatter",
        SETTINGS.windows.length, findings.said.scatter
    )];
    if with_pose == 0 {
        out.push(
            "no pose was recorded: lengths, slip and slopes are hardly seen, and wrong radii look like wrong inertia"
                .to_owned(),
        );
    }
    out.extend(findings.told.iter().cloned());
    if drives == 1 {
        out.push("one drive cannot tell by how much constants differ from drive to drive".to_owned());
    }
    if !has_references {
        out.push("no references were given: the robot file, as sure as it states, stands in their place".to_owned());
    }
    out
}
