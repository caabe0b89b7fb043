//! `cargo xtask odometry`: wheel counts and motion capture of four kinds of robots; sessions are left out in turn and forecast
//! from counts alone by every calibration.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use catalogue::odometry::LOST_COUNTS;
use clap::Args as ClapArgs;
use odometry::{Answer, Case, Findings, LENGTHS, Table, diagnose, left_out};
use rayon::prelude::*;

use crate::document::{Section, number, to_text, toned};
use crate::output::{self, Asked, Figure};
use pages::page::{Cell, Tone};

/// The open data beside the project.
const OPEN: &str = "../shared/data/optiodom-open";
/// Folder of a kind of robot in the data, and the built-in robot that it is.
const KINDS: [(&str, &str); 4] =
    [("diff", "differential"), ("tricycle", "tricycle"), ("omni3", "omni-3"), ("omni4", "mecanum-4")];
/// Rows of a table that are our own, beside the classical ones.
const OURS: usize = 4;
/// Row of the corrected forecasts.
const CORRECTED: usize = 2;
const MARKS: [&str; 2] = ["<!-- figures of cargo xtask odometry -->\n", "<!-- end of the figures -->\n"];

/// Arguments of `cargo xtask odometry`.
#[derive(Debug, ClapArgs)]
pub(crate) struct Args {
    /// Folder of the data, with a folder of tables for each kind of robot [default: ../shared/data/optiodom-open].
    #[arg(long, value_name = "DIR")]
    data: Option<PathBuf>,
    /// Only these kinds: diff, tricycle, omni3, omni4.
    #[arg(long, value_delimiter = ',', value_name = "KIND")]
    only: Vec<String>,
    /// Also write the figures into docs/odometry.md.
    #[arg(long)]
    docs: bool,
}

/// What was found for a kind of robot.
struct Examined {
    kind: &'static str,
    drives: usize,
    findings: Findings,
    table: Table,
}

/// Runs the command; true if all that is asked is met, or the data are not there.
pub(crate) fn run(args: &Args) -> Result<bool> {
    let data = args.data.clone().unwrap_or_else(|| output::beside(OPEN));
    if args.data.is_none() && !data.is_dir() {
        println!("SKIPPED: there is no data in {OPEN}; name a folder with --data");
        return Ok(true);
    }
    let chosen: Vec<(&'static str, &'static str)> =
        KINDS.into_iter().filter(|(kind, _)| args.only.is_empty() || args.only.iter().any(|o| o == kind)).collect();
    ensure!(!chosen.is_empty(), "no kind of this name; there are diff, tricycle, omni3 and omni4");

    let examined: Vec<Examined> =
        chosen.into_par_iter().map(|(kind, robot)| examine(&data, kind, robot)).collect::<Result<_>>()?;
    let sections = sections(&examined);
    let figures: Vec<Figure> = examined.iter().filter_map(gain).collect();
    let text = to_text(&sections);
    print!("{text}");
    for figure in &figures {
        println!("{}: {:.2} (asked {})", figure.name, figure.value, figure.target.as_deref().unwrap_or("nothing"));
    }
    let folder = output::folder("odometry")?;
    output::write(&folder, "summary.json", &serde_json::to_string_pretty(&figures)?)?;
    output::write(&folder, "tables.txt", &text)?;
    if args.docs {
        let page = harness::document::to_markdown("Figures", "", &sections);
        output::into_docs("odometry.md", MARKS, &output::below_title(&page)?)?;
    }
    Ok(figures.iter().all(|f| f.pass != Some(false)))
}

fn examine(data: &Path, kind: &'static str, robot: &str) -> Result<Examined> {
    let read = case_files::odometry::read(None, Some(robot), [&[], &[data.join(kind)], &[]])?;
    let case: Case = read.with_context(|| format!("'{robot}' is no built-in robot of kind odometry"))?.case;
    let findings = diagnose(&case, &|_| {})?;
    let table = left_out(&case, &findings, &|_| {})?;
    Ok(Examined { kind, drives: case.recordings.len(), findings: findings.after(&table), table })
}

/// Median position error 30 s ahead of the best classical calibration over that of the corrected simulation.
fn gain(examined: &Examined) -> Option<Figure> {
    let last = LENGTHS.len() - 1;
    let position = |row: &(String, [odometry::Errors; 3])| row.1[last].medians().and_then(|m| m[0]);
    let ours = examined.table.rows.get(CORRECTED).and_then(position)?;
    let best = examined.table.rows[OURS..].iter().filter_map(position).fold(f64::INFINITY, f64::min);
    let name = format!("{}: best classical calibration over corrected, position after 30 s", examined.kind);
    best.is_finite().then(|| Figure::free(name, best / ours, "1").asked(Asked::AtLeast(1.0)))
}

fn sections(examined: &[Examined]) -> Vec<Section> {
    let mut out = Vec::new();
    let lengths = LENGTHS.iter().flat_map(|l| [format!("position {l:.0} s, mm"), format!("heading {l:.0} s, mrad")]);
    let header: Vec<String> = std::iter::once("calibration".to_owned()).chain(lengths).collect();
    for e in examined {
        let note = format!(
            "{} drives, {} sessions, each left out in turn with fit and naming anew. Medians over forecasts that begin every \
             second.",
            e.drives, e.table.sessions
        );
        let mut section = Section {
            title: format!("{}: pose from counts alone", e.kind),
            note,
            header: header.clone(),
            rows: Vec::new(),
        };
        for (k, (name, errors)) in e.table.rows.iter().enumerate() {
            let medians: Vec<_> = errors.iter().map(odometry::Errors::medians).collect();
            if medians.iter().all(Option::is_none) {
                continue;
            }
            let cells = medians.iter().flat_map(|m| [0, 1].map(|axis| m.and_then(|m| m[axis]).map(|m| 1e3 * m)));
            let tone = if k == CORRECTED { Tone::Good } else { Tone::Plain };
            section
                .rows
                .push(std::iter::once(toned(name.clone(), tone)).chain(cells.map(|c| Cell::from(number(c)))).collect());
        }
        out.push(section);

        let mut causes = Section::new(
            &format!("{}: what was named", e.kind),
            &format!(
                "Answer: {}. Named with all sessions, with 90 % intervals; how many folds named it.",
                word(e.findings.answer)
            ),
            &["cause", "probability", "constant", "stated", "found", "±", "folds"],
        );
        for cause in &e.findings.named {
            let by = e.table.named.iter().filter(|n| n.contains(&cause.label)).count();
            // Lost counts are looked for with all drives alone.
            let folds = if cause.spec == &LOST_COUNTS {
                "not looked for".to_owned()
            } else {
                format!("{by} of {}", e.table.sessions)
            };
            for estimate in &cause.estimates {
                let unit = if estimate.unit == "1" { String::new() } else { format!(", {}", estimate.unit) };
                causes.rows.push(
                    [
                        cause.label.clone(),
                        format!("{:.2}", cause.probability),
                        format!("{}{unit}", estimate.name),
                        format!("{:.5}", estimate.given),
                        format!("{:.5}", estimate.value),
                        format!("{:.5}", estimate.half_width),
                        folds.clone(),
                    ]
                    .map(Cell::from)
                    .to_vec(),
                );
            }
        }
        out.push(causes);
    }
    out
}

pub(crate) fn word(answer: Answer) -> &'static str {
    match answer {
        Answer::Nothing => "nothing is missing",
        Answer::Retune => "re-tune",
        Answer::Named => "explained",
        Answer::Unknown => "unknown",
    }
}
