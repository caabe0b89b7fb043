//! Findings as a verdict in sentences.

use std::collections::BTreeMap;

use odometry::{Answer, Estimate, NamedCause};

use crate::diagnose::Findings;
use crate::forecast::LENGTHS;
use crate::left_out::{FOLLOWING, OWN_ROWS, Table};
use crate::settings::SETTINGS;
use catalogue::answer::{NONE, UNKNOWN};
use catalogue::car::ENCODER_SCALE;
use inference::evidence::none_of;
use inference::experiment::Standing;
use inference::robust::NINETY;
use verdict::{Cause, Diagnosis, FreeRun, Retuned, Verdict};

/// The verdict of findings, with the forecasts of drives that were left out.
pub fn diagnosis(findings: &Findings, table: &Table, has_references: bool) -> Diagnosis {
    let mut out = Diagnosis::withheld();
    out.verdict = match findings.answer {
        Answer::Nothing | Answer::Retune => Verdict::NoMismatch,
        Answer::Named => Verdict::Explained,
        Answer::Unknown => Verdict::Unknown,
    };
    out.ranked = ranked(findings);
    let classes = findings.named.iter().filter(|c| !c.alike.is_empty());
    out.indistinguishable =
        classes.map(|c| std::iter::once(c.label.clone()).chain(c.alike.iter().cloned()).collect()).collect();
    let [given, _, best] = findings.shares;
    if out.verdict != Verdict::NoMismatch {
        out.unexplained = Some((best / given.max(f64::MIN_POSITIVE)).powi(2).min(1.0));
    }
    if findings.answer == Answer::Retune {
        out.retuned = findings.retuned.iter().filter(|e| e.is_moved()).map(retuned).collect();
        out.retuned.sort_by(|a, b| b.sigmas.abs().total_cmp(&a.sigmas.abs()));
    }
    out.tuning = findings.constants.iter().map(|e| (e.name.clone(), e.value)).collect::<BTreeMap<_, _>>();
    out.free_runs = free_runs(table);
    let objection = Standing::new(&out.free_runs).and_then(|s| s.objection(None));
    out.sentences = sentences(findings, &out, has_references);
    out.sentences.extend(forecast_sentence(table));
    out.limits = limits(findings, table, has_references);
    if out.verdict == Verdict::Explained {
        out.limits.extend(objection);
    }
    out
}

fn ranked(findings: &Findings) -> Vec<Cause> {
    let mut out: Vec<Cause> = findings.named.iter().map(cause).collect();
    if findings.answer == Answer::Unknown {
        // Candidates that do not account for the drives share what "unknown" leaves.
        for c in &mut out {
            c.probability *= SETTINGS.naming.listed;
        }
    }
    for (label, probability) in &findings.others {
        let probability = probability * if findings.answer == Answer::Unknown { SETTINGS.naming.listed } else { 1.0 };
        if probability >= SETTINGS.naming.listed {
            let id = label.split(' ').next().unwrap_or(label);
            out.push(Cause { name: label.clone(), ..Cause::plain(id, label, probability) });
        }
    }
    let none = match findings.answer {
        Answer::Nothing | Answer::Retune => none_of(findings.others.iter().map(|(_, p)| *p)),
        Answer::Named | Answer::Unknown => none_of(findings.named.iter().map(|c| c.probability)),
    };
    let unknown = f64::from(u8::from(findings.answer == Answer::Unknown)) * (1.0 - SETTINGS.naming.listed);
    out.push(Cause::plain(NONE.id, NONE.name, none));
    out.push(Cause::plain(UNKNOWN.id, UNKNOWN.name, unknown));
    if findings.answer != Answer::Named {
        out.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    }
    if findings.answer == Answer::Unknown {
        out.sort_by_key(|c| c.effect != UNKNOWN.id);
    }
    out
}

fn cause(named: &NamedCause) -> Cause {
    let mut out = Cause::plain(named.spec.id, &named.label, named.probability);
    if let Some(first) = named.estimates.first() {
        let factor = if first.given == 0.0 || first.unit == "rad" { 1.0 } else { first.given };
        // Sizes of factors; the values themselves stand among the parameters.
        out.magnitude = Some(first.value / factor);
        out.sigma = Some(first.half_width / NINETY / factor.abs());
        out.unit = named.spec.unit.into();
    }
    let number =
        |e: &Estimate| verdict::Estimate { value: e.value, sigma: Some(e.half_width / NINETY), at_bound: false };
    out.parameters = named.estimates.iter().map(|e| (e.name.clone(), number(e))).collect();
    if !named.intervals.is_empty() {
        let mut intervals: BTreeMap<String, Vec<[f64; 2]>> = BTreeMap::new();
        for (recording, interval) in &named.intervals {
            intervals.entry(recording.clone()).or_default().push(*interval);
        }
        out.intervals = Some(intervals);
    }
    out
}

fn retuned(e: &Estimate) -> Retuned {
    Retuned {
        constant: e.name.clone(),
        unit: if e.unit == "1" { "-".to_owned() } else { e.unit.to_owned() },
        from: e.given,
        to: e.value,
        half_width: e.half_width,
        sigmas: e.sigmas,
    }
}

fn free_runs(table: &Table) -> Vec<FreeRun> {
    let mut out = Vec::new();
    for (drive, errors) in &table.by_drive {
        for (k, length) in LENGTHS.iter().enumerate() {
            for (axis, quantity, unit) in [(0, "position", "m"), (1, "heading", "rad")] {
                let of = |row: usize| errors.get(row).and_then(|e| e[k].medians()).map(|m| m[axis]);
                let [Some(nominal), Some(retuned), Some(corrected)] = [of(0), of(1), of(2)] else { continue };
                out.push(FreeRun {
                    recording: drive.clone(),
                    quantity: format!("{quantity} after {length} s from throttle and steering alone, median, {unit}"),
                    nominal,
                    retuned,
                    corrected,
                    placebo: of(3),
                });
            }
        }
    }
    out
}

/// "0.0842 ± 0.0003 m", with two digits of the interval.
fn number(e: &Estimate) -> String {
    let unit = if e.unit == "1" { String::new() } else { format!(" {}", e.unit) };
    let digits = (1 - e.half_width.abs().max(1e-6).log10().floor() as i32).clamp(0, 6) as usize;
    format!("{:.digits$} ± {:.digits$}{unit} (90 %)", e.value, e.half_width)
}

fn sentences(findings: &Findings, out: &Diagnosis, has_references: bool) -> Vec<String> {
    let stated = if has_references { "the references" } else { "the robot file" };
    let mut text = Vec::new();
    let [given, tuned, best] = findings.shares.map(|s| 100.0 * s);
    match findings.answer {
        Answer::Nothing => text.push(format!(
            "Nothing is missing: the car moves as throttle and steering imply, as well as {stated} is known (errors after a \
             second are {given:.1} % of the motion, {tuned:.1} % with the drive train fitted)."
        )),
        Answer::Retune => {
            text.push(format!(
                "Re-tune: the car moves as throttle and steering imply once constants are set within what {stated} leaves open \
                 (errors after a second fall from {given:.1} to {tuned:.1} % of the motion)."
            ));
            text.extend(out.retuned.iter().map(|r| format!("{}.", r.sentence())));
        }
        Answer::Named => {
            let labels: Vec<&str> = findings.named.iter().map(|c| c.spec.name).collect();
            text.push(format!(
                "The car moves otherwise than throttle and steering imply, by more than {stated} leaves open: {} (errors after a \
                 second fall from {given:.1} over {tuned:.1} re-tuned to {best:.1} % of the motion).",
                labels.join("; ")
            ));
        }
        Answer::Unknown if findings.is_scattered => text.push(format!(
            "Unknown: the drives of this car differ from each other by {:.0} times what is usual or more, so that no cause that all \
             of them share can be trusted (errors after a second are {given:.1} % of the motion, {best:.1} % with the best answer). \
             Diagnose drives of one day, floor and battery by themselves; candidates follow.",
            findings.scatter
        )),
        Answer::Unknown => text.push(format!(
            "Something is missing that none of the causes accounts for: errors after a second are {given:.1} % of the motion, and \
             {best:.1} % remain with the best answer."
        )),
    }
    for named in &findings.named {
        let values = named.estimates.iter().map(|e| {
            let from = if e.given == 0.0 { String::new() } else { format!(", given as {:.4}", e.given) };
            format!("{} {}{from}", e.name, number(e))
        });
        let alike = if named.alike.is_empty() {
            String::new()
        } else {
            format!("; these drives cannot tell it from {}", named.alike.join(", "))
        };
        let familiar = familiar(named);
        text.push(format!("{}: {}{familiar}{alike}.", named.label, values.collect::<Vec<_>>().join("; ")));
    }
    text
}

/// Tells a factor on all radii that is a familiar one.
fn familiar(named: &NamedCause) -> String {
    let Some(first) = named.estimates.first().filter(|_| named.spec.id == ENCODER_SCALE.id) else {
        return String::new();
    };
    let factor = first.value / first.given;
    let near = SETTINGS.naming.factors.iter().find(|f| (factor / **f).ln().abs() < SETTINGS.naming.familiar);
    near.map_or_else(String::new, |near| {
        format!(
            ", which is the factor {near:.2}: look at counts per turn (edges that are counted), gear, or diameter for radius"
        )
    })
}

fn forecast_sentence(table: &Table) -> Option<String> {
    let last = LENGTHS.len() - 1;
    let median = |row: &(String, crate::forecast::ByLength)| Some((row.0.clone(), row.1[last].medians()?[0]));
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
            findings.counts[0], findings.counts[1], findings.counts[2], findings.scatter
        ),
    ];
    out.extend(findings.told.iter().cloned());
    let unstated: Vec<&str> = findings.unstated.clone();
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
