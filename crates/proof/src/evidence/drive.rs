//! Command to wheel, wheel to body, pose over 2 s on windows that no fit has seen.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::ask::{Answer, Question, ask};
use super::drive_layout::{STEP, WINDOW, lay_out};
use super::find::{DataRun, Kind};
use super::hide::Table;
use crate::binary::Binary;

/// Robots of the data set by wheel radius, m: a neutral file is told by how far its wheels roll.
const ROBOTS: [(&str, f64); 2] = [("husky-drive", 0.1651), ("warthog-drive", 0.30)];
/// Share of the windows that a fit may see where no other table is named for it.
const TRAINING: f64 = 2.0 / 3.0;
/// Windows that tell the radius: wheels that turn this fast, rad/s, and differ by at most this share.
const ROLLING: f64 = 2.0;
const STRAIGHT: f64 = 0.2;

/// What came of one robot.
pub(super) struct Examined {
    pub(super) name: String,
    pub(super) answer: Answer,
    pub(super) document: Value,
}

impl Examined {
    /// Errors on unseen windows, over the whole window: what, nominal, re-tuned, corrected, placebo.
    pub(super) fn free_runs(&self) -> Vec<(&str, [f64; 4])> {
        let all = self.answer.diagnosis["free_runs"].as_array().map_or(&[][..], Vec::as_slice);
        let row =
            |r: &'_ Value| ["nominal", "retuned", "corrected", "placebo"].map(|k| r[k].as_f64().unwrap_or(f64::NAN));
        let unseen = all.iter().filter(|r| r["recording"] == "held out");
        unseen.filter_map(|r| Some((r["quantity"].as_str()?, row(r)))).collect()
    }
}

/// Rolling radius: way over turned angle in windows that run straight, m.
fn radius(table: &Table) -> Result<f64> {
    let column = |c: &str| table.column(c);
    let (left, right, x, y) = (column("wheel_left")?, column("wheel_right")?, column("icp_x")?, column("icp_y")?);
    let mut all: Vec<f64> = (0..table.rows.len() / WINDOW)
        .filter_map(|w| {
            let rows = w * WINDOW..(w + 1) * WINDOW;
            let mean = |z: &[f64]| z[rows.clone()].iter().sum::<f64>() / WINDOW as f64;
            let (l, r) = (mean(&left), mean(&right));
            let last = rows.end - 1;
            let rolls = l.abs().min(r.abs()) > ROLLING && (l - r).abs() < STRAIGHT * l.abs().max(r.abs());
            let turned = 0.5 * (l + r).abs() * STEP * (WINDOW - 1) as f64;
            rolls.then(|| x[last].hypot(y[last]) / turned)
        })
        .collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().context("no window runs straight: nothing tells which robot this is")
}

/// The robot whose wheel radius is nearest.
fn robot(table: &Table) -> Result<&'static str> {
    let radius = radius(table)?;
    let off = |r: &&(&str, f64)| (r.1 / radius).ln().abs();
    let nearest = ROBOTS.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    nearest.map(|r| r.0).context("there is no robot")
}

/// The files of a folder.
fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    case_files::inputs::list(folder)
}

/// Asks about one table; `others` are tables that may be fitted whole.
pub(super) fn examine(binary: &Binary, found: &DataRun, others: &[DataRun], out: &Path) -> Result<Examined> {
    let Kind::Drive(file) = &found.kind else { anyhow::bail!("'{}' is no table of DRIVE", found.name) };
    let table = Table::read(file)?;
    let robot = robot(&table)?;
    let bytes = std::fs::read(file).with_context(|| format!("cannot read '{}'", file.display()))?;
    let id = examiner::sha256(&bytes)[..8].to_owned();
    let folder = out.join("seen").join(&id);
    if folder.is_dir() {
        // What an earlier run laid out may hold other windows.
        std::fs::remove_dir_all(&folder).with_context(|| format!("cannot empty '{}'", folder.display()))?;
    }
    let mut fitted = None;
    for other in others {
        if let Kind::Drive(path) = &other.kind
            && path != file
            && self::robot(&Table::read(path)?)? == robot
        {
            fitted = Some(path);
        }
    }
    let (recordings, mapping) = match fitted {
        Some(path) => {
            lay_out(file, &folder, 0.0)?;
            let written = lay_out(path, &folder.join("fitted"), 1.0)?;
            (folder.join("fitted/recordings"), written.mapping)
        }
        None => (folder.join("recordings"), lay_out(file, &folder, TRAINING)?.mapping),
    };
    let question = Question {
        robot,
        mapping: &mapping,
        references: &[],
        recordings: &files(&recordings)?,
        held_out: &files(&folder.join("heldout"))?,
    };
    let answer = ask(binary, &question, &out.join("verdicts").join(format!("{id}-drive.json")))?;
    let d = &answer.diagnosis;
    let document = json!({
        "name": found.name,
        "id": id,
        "robot": robot,
        "sentence": answer.sentences.join(" "),
        "sentences": answer.sentences,
        "verdict": d["verdict"],
        "verdict_sha256": answer.sha256,
        "ranked": super::husky::ranked(d),
        "indistinguishable": d["indistinguishable"],
        "response": d["response"],
        "free_runs": d["free_runs"],
        "limits": d["limits"],
    });
    Ok(Examined { name: found.name.clone(), answer, document })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_robot_is_told_by_how_far_its_wheels_roll() {
        let columns = ["wheel_left", "wheel_right", "icp_x", "icp_y"].map(str::to_owned).to_vec();
        let table = |radius: f64| Table {
            columns: columns.clone(),
            rows: (0..3 * WINDOW).map(|i| vec![3.0, 3.1, 3.05 * radius * STEP * (i % WINDOW) as f64, 0.0]).collect(),
        };
        assert_eq!(robot(&table(0.16)).expect("a robot"), "husky-drive");
        assert_eq!(robot(&table(0.31)).expect("a robot"), "warthog-drive");
        assert!(robot(&Table { rows: Vec::new(), ..table(0.3) }).is_err());
    }
}
