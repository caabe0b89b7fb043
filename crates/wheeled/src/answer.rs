//! Findings as a verdict in sentences.

use hierarchical_fit::Wording;
use verdict::{Cause, Diagnosis};

use crate::diagnose::Findings;
use crate::left_out::{LENGTHS, Table};
use crate::settings::SETTINGS;
use catalogue::odometry::{RADIUS_OF_ALL_WHEELS, RADIUS_OF_ONE_WHEEL};
use catalogue::wheeled::GROUND_SLOPE;

/// The verdict of findings, with the forecasts of drives that were left out.
pub fn diagnosis(findings: &Findings, table: &Table, has_references: bool) -> Diagnosis {
    let found = findings.said.found();
    let mut out = found.verdict(table.free_runs());
    out.traces = if table.traces.is_empty() { findings.traces.clone() } else { table.traces.clone() };
    out.next.clone_from(&findings.next);
    let words = Wording {
        agree: "the robot moves as the torques of its motors imply",
        disagree: "The robot moves otherwise than the torques of its motors imply,",
        errors: "errors after a second",
        machine: "robot",
        conditions: "floor and load",
        most: SETTINGS.unexplained.most,
        scales: &[RADIUS_OF_ALL_WHEELS.id, RADIUS_OF_ONE_WHEEL.id],
        has_references,
    };
    out.sentences = found.sentences(&words, &out);
    out.sentences.extend(forecast_sentence(table));
    out.limits.splice(0..0, limits(findings, has_references));
    out.limits.extend(of_a_slope(&out.ranked));
    out
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

/// What pulls like a slope, where one is among the causes: this comparison has no accelerometer, which would feel the tilt.
fn of_a_slope(causes: &[Cause]) -> Option<String> {
    causes.iter().any(|cause| cause.effect == GROUND_SLOPE.id).then(|| {
        "slopes are told from the motion alone: what else pulls in one direction of the floor, whichever way the robot looks, looks like \
         one: a wind from one direction (which shows as drag too), or a long cable"
            .to_owned()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_comes_with_what_pulls_like_one_and_a_drag_does_not() {
        let of = |id: &str| of_a_slope(&[Cause::plain(id, "a cause", 0.9)]);
        assert!(of(GROUND_SLOPE.id).is_some_and(|limit| limit.contains("a wind from one direction")));
        assert_eq!(of("body_drag"), None);
    }
}
