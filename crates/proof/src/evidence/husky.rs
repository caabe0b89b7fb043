//! One recording of a Husky, its labels and witnesses hidden.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use inference::robust::NINETY;
use serde_json::{Value, json};

use super::ask::{Answer, Question, ask, interval};
use super::find::DataRun;
use super::hide::{Sight, Table, copy};
use super::slopes::{Claim, SeenTilt, as_json, claims, seen};
use super::turns::{Turns, turns};
use super::witness::Witness;
use crate::binary::Binary;

/// The robot of the data set.
pub(super) const ROBOT: &str = "husky-a200";

/// A recording of a Husky as it is given to the program: by a random id, without labels.
pub(super) struct Run {
    pub(super) found: DataRun,
    pub(super) id: String,
    pub(super) speeds: Table,
    pub(super) inertial: Option<Table>,
}

impl Run {
    pub(super) fn read(found: &DataRun) -> Result<Self> {
        let (speeds, inertial) = found.husky().context("this is no recording of a Husky")?;
        // An id that says nothing, and is the same for the same recording under another name.
        let bytes = std::fs::read(speeds).with_context(|| format!("cannot read '{}'", speeds.display()))?;
        let id = examiner::sha256(&bytes)[..8].to_owned();
        Ok(Self {
            id,
            speeds: Table::read(speeds)?,
            inertial: inertial.map(Table::read).transpose()?,
            found: found.clone(),
        })
    }

    /// Writes its neutral copy.
    pub(super) fn show(&self, out: &Path, sight: Sight) -> Result<PathBuf> {
        copy(&seen_folder(out, sight), &self.id, &self.speeds, self.inertial.as_ref(), sight)
    }
}

/// Where neutral copies and their mapping lie.
pub(super) fn seen_folder(out: &Path, sight: Sight) -> PathBuf {
    out.join("seen").join(match sight {
        Sight::Yaw => "yaw",
        Sight::Gyro => "gyro",
        Sight::All => "all",
        Sight::Currents => "currents",
    })
}

/// Writes the mapping of a sight.
pub(super) fn mapping(out: &Path, sight: Sight) -> Result<PathBuf> {
    let folder = seen_folder(out, sight);
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot create '{}'", folder.display()))?;
    let path = folder.join("mapping.toml");
    std::fs::write(&path, sight.mapping()).with_context(|| format!("cannot write '{}'", path.display()))?;
    Ok(path)
}

/// What came of one recording.
pub(super) struct Examined {
    pub(super) name: String,
    pub(super) label: String,
    pub(super) hard: bool,
    /// Everything seen: what differs from the references.
    pub(super) open: Answer,
    /// By currents; by currents and gyro: what the witness saw, what was claimed.
    pub(super) by_currents: Option<(Vec<SeenTilt>, Vec<Claim>)>,
    pub(super) by_gyro: Option<(Vec<SeenTilt>, Vec<Claim>)>,
    pub(super) turns: Option<Turns>,
    /// Where the currents could show nothing, s.
    pub(super) hidden: Vec<[f64; 2]>,
    /// The accelerometer and gyro, opened last.
    pub(super) witness: Option<Witness>,
    /// The recording's file.
    pub(super) document: Value,
}

/// Causes with the 90 % interval of their size.
pub(super) fn ranked(diagnosis: &Value) -> Value {
    let with_interval = |cause: &Value| {
        let mut cause = cause.clone();
        if let (Some(size), Some(sigma)) = (cause["magnitude"].as_f64(), cause["sigma"].as_f64()) {
            cause["interval_90"] = json!([size - NINETY * sigma, size + NINETY * sigma]);
        }
        cause
    };
    diagnosis["ranked"].as_array().map_or(Value::Null, |all| all.iter().map(with_interval).collect())
}

/// Runs the protocols on one recording. The witness is opened after the last verdict is on disk.
pub(super) fn examine(binary: &Binary, run: &Run, references: &[&Run], out: &Path) -> Result<Examined> {
    ensure!(references.iter().any(|r| r.id != run.id), "there is no reference run but this one");
    let say = |sight: Sight, what: &str| -> Result<Answer> {
        let others: Vec<PathBuf> = references
            .iter()
            .filter(|r| r.id != run.id)
            .map(|r| seen_folder(out, sight).join(format!("pro_{}.csv", r.id)))
            .collect();
        let recording = [seen_folder(out, sight).join(format!("pro_{}.csv", run.id))];
        let mapping = seen_folder(out, sight).join("mapping.toml");
        let question =
            Question { robot: ROBOT, mapping: &mapping, references: &others, recordings: &recording, held_out: &[] };
        ask(binary, &question, &out.join("verdicts").join(format!("{}-{what}.json", run.id)))
    };
    let currents = say(Sight::Yaw, "1-currents-and-yaw")?;
    let gyro = say(Sight::Gyro, "2-gyro")?;
    let withheld = say(Sight::Currents, "3-gyro-withheld")?;
    let open = say(Sight::All, "4-labels-hidden")?;
    // All verdicts are sealed: open the envelope.
    let witness = match run.found.husky() {
        Some((speeds, Some(inertial))) => Some(Witness::open(speeds, inertial)?),
        _ => None,
    };
    let beside = |answer: &Answer, hides: bool| witness.as_ref().map(|w| (seen(answer, w, hides), claims(answer, w)));
    let (by_currents, by_gyro) = (beside(&currents, true), beside(&gyro, false));
    let turned = witness.as_ref().map(|w| turns(&withheld, w));
    let with_witness = |answer: &Answer, both: &Option<(Vec<SeenTilt>, Vec<Claim>)>| {
        let mut v = answer.seal();
        v["changes"] = answer.diagnosis["steady"]["changes"].clone();
        v["witness"] = both.as_ref().map_or(Value::Null, |(s, c)| as_json(s, c));
        v
    };
    let mut without_gyro = withheld.seal();
    without_gyro["turning"] = withheld.diagnosis["steady"]["turning"].clone();
    without_gyro["witness"] = turned.map_or(Value::Null, |t| t.as_json());
    let d = &open.diagnosis;
    let document = json!({
        "name": run.found.name,
        "label": run.found.label,
        "id": run.id,
        "references": references.iter().filter(|r| r.id != run.id).map(|r| r.id.as_str()).collect::<Vec<_>>(),
        "sentence": open.sentences.join(" "),
        "sentences": open.sentences,
        "verdict": d["verdict"],
        "verdict_sha256": open.sha256,
        "ranked": ranked(d),
        "indistinguishable": d["indistinguishable"],
        "loads": d["steady"]["ratios"],
        "withheld": d["steady"]["withheld"],
        "changes": d["steady"]["changes"],
        "turning_changes": d["steady"]["turning_changes"],
        "standstills": d["steady"]["standstills"],
        "forecasts": d["steady"]["forecasts"],
        "free_runs": d["free_runs"],
        "clock": d["steady"]["clocks"],
        "limits": d["limits"],
        "protocols": {
            "currents_and_yaw_rate": with_witness(&currents, &by_currents),
            "with_roll_and_pitch_rate": with_witness(&gyro, &by_gyro),
            "gyro_withheld": without_gyro,
        },
    });
    Ok(Examined {
        name: run.found.name.clone(),
        label: run.found.label.clone(),
        hard: run.found.is_hard(),
        open,
        by_currents,
        by_gyro,
        turns: turned,
        hidden: currents.changes("hidden").iter().map(|h| interval(&h["interval"])).collect(),
        witness,
        document,
    })
}
