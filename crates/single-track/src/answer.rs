//! Findings as a verdict in sentences.

use crate::settings::SETTINGS;
use hierarchical_fit::Wording;

use crate::diagnose::Findings;
use crate::forecast::{ByLength, LENGTHS};
use crate::left_out::{CORRECTED, FOLLOWING, OWN_ROWS, Table};
use catalogue::car::ENCODER_SCALE;
use verdict::Diagnosis;

/// The verdict of findings, with the forecasts of drives that were left out.
pub fn diagnosis(findings: &Findings, table: &Table, has_references: bool) -> Diagnosis {
    let found = findings.said.found();
    let mut out = found.verdict(table.free_runs());
    out.next.clone_from(&findings.next);
    out.traces = if table.traces.is_empty() { findings.traces.clone() } else { table.traces.clone() };
    let words = Wording {
        agree: "the car moves as throttle and steering imply",
        disagree: "The car moves otherwise than throttle and steering imply,",
        errors: "errors after a second",
        machine: "car",
        conditions: "floor and battery",
        most: SETTINGS.unexplained.columns,
        scales: &[ENCODER_SCALE.id],
        has_references,
    };
    out.sentences = found.sentences(&words, &out);
    out.sentences.extend(forecast_sentence(table));
    out.limits.splice(0..0, limits(findings, table, has_references));
    out
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
    out.extend(better_rival(table));
    if findings.counts[0] == 1 {
        out.push("one drive cannot tell by how much constants differ from drive to drive".to_owned());
    }
    if !has_references {
        out.push("no references were given: the robot file, as sure as it states, stands in their place".to_owned());
    }
    out
}

/// That a classical model forecasts places on drives left out better than the answer does, however that is used.
fn better_rival(table: &Table) -> Option<String> {
    let last = LENGTHS.len() - 1;
    let median = |row: usize| Some((row, table.rows.get(row)?.1[last].medians()?[0]));
    let best = |rows: &mut dyn Iterator<Item = usize>| rows.filter_map(median).min_by(|a, b| a.1.total_cmp(&b.1));
    let (_, own) = best(&mut [CORRECTED, FOLLOWING].into_iter())?;
    let (row, of_rival) = best(&mut (OWN_ROWS..table.rows.len()))?;
    (of_rival < own).then(|| {
        format!(
            "on drives left out a classical model ({}) forecasts places {:.0} s ahead better than the answer does, {:.1} cm off where the \
             answer is {:.1} (medians): do not build on it",
            table.rows[row].0,
            LENGTHS[last],
            100.0 * of_rival,
            100.0 * own
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::forecast::collected;

    #[test]
    fn a_rival_is_named_only_where_it_forecasts_better_than_either_way_of_using_the_answer() {
        let of = |errors: [f64; 7]| {
            let rows =
                errors.into_iter().enumerate().map(|(k, error)| (format!("row {k}"), collected([[[error, 0.0]; 3]])));
            better_rival(&Table { rows: rows.collect(), ..Table::default() })
        };
        assert_eq!(of([1.0, 0.3, 0.2, 0.3, 0.4, 0.3, 0.25]), None, "the answer as it stands");
        assert_eq!(of([1.0, 0.3, 0.4, 0.3, 0.2, 0.3, 0.25]), None, "the answer that follows the past");
        let told = of([1.0, 0.3, 0.4, 0.3, 0.5, 0.45, 0.25]).expect("a better rival");
        assert!(told.contains("(row 6)") && told.contains("25.0 cm") && told.contains("is 40.0"), "{told}");
    }
}
