//! A change at a known moment inside a recording, and blocks in which there is none.

use std::path::Path;

use anyhow::Result;
use rayon::prelude::*;
use serde::Deserialize;
use serde_json::{Value, json};
use verdict::Quantity;

use super::ask::{Answer, Question, ask, interval};
use super::find::DataRun;
use super::hide::{Sight, Table, copy};
use super::husky::{ROBOT, Run, seen_folder};
use super::witness::Witness;
use crate::binary::Binary;

/// Length of a block, s; a rest shorter than this is left out, s.
const BLOCK: f64 = 60.0;
const LEAST: f64 = 20.0;

/// A block of a reference run against the rest of the references.
pub(super) struct Block {
    pub(super) name: String,
    pub(super) answer: Answer,
    /// Answers given, and those whose 90 % interval excludes "no difference".
    pub(super) answers: usize,
    pub(super) alarms: Vec<String>,
}

/// Cuts the references into blocks and asks about each against all others.
pub(super) fn null(binary: &Binary, references: &[&Run], out: &Path) -> Result<Vec<Block>> {
    let folder = out.join("blocks");
    let mut blocks = Vec::new();
    for run in references {
        let time = run.speeds.column("time")?;
        let last = time.last().copied().unwrap_or(0.0);
        // The inertial unit is cut where its own clock shows the same moment.
        let lag = match &run.inertial {
            Some(inertial) => Some(Witness::of(&run.speeds, inertial)?),
            None => None,
        };
        let its =
            |t: f64| lag.as_ref().map_or(t, |w| t + w.lag[w.time.partition_point(|x| *x < t).min(w.lag.len() - 1)]);
        let mut from = 0.0;
        let mut k = 0;
        while last - from >= LEAST {
            let until = if last - from - BLOCK < LEAST { f64::MAX } else { from + BLOCK };
            let id = format!("{}b{k}", run.id);
            let cut = |t: &Table, a: f64, b: f64| t.between(a, b);
            let speeds = cut(&run.speeds, from, until)?;
            let inertial = run
                .inertial
                .as_ref()
                .map(|t| cut(t, its(from), if until < last { its(until) } else { f64::MAX }))
                .transpose()?;
            blocks.push((
                format!("{} from {from:.0} s", run.found.name),
                id.clone(),
                copy(&folder, &id, &speeds, inertial.as_ref(), Sight::All)?,
            ));
            from = until.min(last);
            k += 1;
        }
    }
    let mapping = seen_folder(out, Sight::All).join("mapping.toml");
    let files: Vec<_> = blocks.iter().map(|b| b.2.clone()).collect();
    let one = |(k, (name, id, file)): (usize, &(String, String, std::path::PathBuf))| -> Result<Block> {
        let others: Vec<_> = files.iter().enumerate().filter(|(i, _)| *i != k).map(|(_, f)| f.clone()).collect();
        let recordings = [file.clone()];
        let question =
            Question { robot: ROBOT, mapping: &mapping, references: &others, recordings: &recordings, held_out: &[] };
        let answer = ask(binary, &question, &out.join("verdicts").join(format!("{id}-null.json")))?;
        let ratios = answer.steady("ratios");
        let excluded = |r: &&Value| {
            let [a, b] = interval(&r["interval"]);
            let is_difference = Quantity::deserialize(&r["quantity"]).is_ok_and(Quantity::is_difference);
            let none = if is_difference { 0.0 } else { 1.0 };
            a > none || b < none
        };
        let mut alarms: Vec<String> = ratios
            .iter()
            .filter(excluded)
            .map(|r| {
                format!("{} {:.2}", r["quantity"].as_str().unwrap_or("?"), r["ratio"].as_f64().unwrap_or(f64::NAN))
            })
            .collect();
        if answer.diagnosis["verdict"] == "explained" || answer.diagnosis["verdict"] == "unknown" {
            alarms.push("a cause is named".to_owned());
        }
        // Whether a cause is named is an answer, too.
        let answers = ratios.len() + usize::from(!answer.diagnosis.is_null());
        Ok(Block { name: name.clone(), answers, alarms, answer })
    };
    blocks.par_iter().enumerate().map(one).collect()
}

/// Two recordings one after the other: where does the second begin?
pub(super) struct Joined {
    pub(super) names: [String; 2],
    /// When the second begins, s.
    pub(super) join: f64,
    /// The change that comes nearest: bracket of its onset and its end, s.
    pub(super) told: Option<[[f64; 2]; 2]>,
    /// Changes that were reported.
    pub(super) changes: usize,
    pub(super) answer: Answer,
}

impl Joined {
    /// How far the bracket of the onset is from the join; zero inside.
    pub(super) fn error(&self) -> Option<f64> {
        self.told.map(|[[a, b], _]| (a - self.join).max(self.join - b).max(0.0))
    }

    pub(super) fn as_json(&self) -> Value {
        json!({
            "recordings": self.names, "join_s": self.join, "told": self.told, "changes": self.changes,
            "onset_error_s": self.error(), "sealed": self.answer.seal(),
        })
    }
}

/// Joins a reference and another run (set speeds and currents only) and asks.
pub(super) fn joined(binary: &Binary, first: &Run, second: &Run, references: &[&Run], out: &Path) -> Result<Joined> {
    let (table, join) = first.speeds.then(&second.speeds)?;
    let id = format!("{}{}", first.id, second.id);
    let recordings = [out.join("joined").join(format!("pro_{id}.csv"))];
    table.write(&recordings[0])?;
    let others: Vec<_> = references
        .iter()
        .filter(|r| r.id != first.id && r.id != second.id)
        .map(|r| seen_folder(out, Sight::All).join(format!("pro_{}.csv", r.id)))
        .collect();
    let mapping = seen_folder(out, Sight::All).join("mapping.toml");
    let question =
        Question { robot: ROBOT, mapping: &mapping, references: &others, recordings: &recordings, held_out: &[] };
    let answer = ask(binary, &question, &out.join("verdicts").join(format!("{id}-joined.json")))?;
    let distance = |c: &&Value| {
        let [a, b] = interval(&c["onset"]);
        (a - join).max(join - b).max(0.0)
    };
    let all: Vec<&Value> = answer.changes("found").iter().chain(answer.steady("turning_changes")).collect();
    let nearest = all.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let changes = all.len();
    let told = nearest.map(|c| [interval(&c["onset"]), interval(&c["end"])]);
    let name = |f: &DataRun| f.name.clone();
    Ok(Joined { names: [name(&first.found), name(&second.found)], join, told, changes, answer })
}
