//! A case: diagnosed, exported, run in MuJoCo, compared with the truth.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};
use case_files::case_folder::CaseFolder;
use case_files::envelope::Envelope;
use model_export::{Engine, Way, way};
use recordings::{Mapping, ReadOptions};
use serde_json::{Value, json};
use torque_driven::HeldOut;

use super::python;
use crate::blind::layout::Layout;
use crate::blind::seal::Seals;
use crate::blind::truth::{self, Response};
use crate::child;

/// Root mean square distance from the truth: wheel speed, rad/s, and yaw rate, rad/s.
pub(super) type Distance = [f64; 2];

/// What is run in MuJoCo: name of the file and the arguments that export it.
const MODELS: [(&str, &[&str]); 3] = [("nominal", &["--nominal"]), ("retuned", &["--retuned"]), ("corrected", &[])];

/// How far models are from the truth on the held-out drives of a case.
#[derive(Debug, Clone)]
pub(super) struct Proved {
    pub(super) name: String,
    /// What was hidden.
    pub(super) hidden: Vec<String>,
    /// What was named.
    pub(super) named: Vec<String>,
    /// How many of the named effects the engine holds.
    pub(super) held: usize,
    /// In MuJoCo: as it is, re-tuned only, corrected.
    pub(super) models: [Distance; 3],
    /// In MuJoCo, corrected, with the residual forces where there are any.
    pub(super) with_residual: Option<Distance>,
    /// The planar plant, corrected.
    pub(super) plant: Distance,
}

impl Proved {
    /// Whether all that was named is held.
    pub(super) fn is_held(&self) -> bool {
        !self.named.is_empty() && self.held == self.named.len()
    }

    /// Distance of the corrected model over that of the unexported one, wheel speed and yaw rate.
    pub(super) fn ratios(&self) -> [f64; 2] {
        [0, 1].map(|q| self.models[2][q] / self.models[0][q])
    }
}

/// Diagnoses, exports, runs and compares.
pub(super) fn prove(name: &str, layout: &Layout, seals: &Seals, lacuna: &Path, python: &Path) -> Result<Proved> {
    let folder = layout.root().join("models").join(name);
    fs::create_dir_all(&folder).with_context(|| format!("cannot create '{}'", folder.display()))?;
    let (verdict, predictions) = (folder.join("verdict.json"), folder.join("predictions"));
    let mut diagnose = Command::new(lacuna);
    diagnose.arg("diagnose").arg(layout.case(name)).arg("--json").arg(&verdict).arg("--predictions").arg(&predictions);
    succeed(&mut diagnose)?;
    for (model, arguments) in MODELS {
        let out = folder.join(format!("{model}.xml"));
        let mut export = Command::new(lacuna);
        export.arg("export").arg(&verdict).args(["--to", "mjcf", "--force"]).args(arguments).arg("-o").arg(&out);
        // What is not held is reported below.
        succeed(export.stderr(Stdio::null()))?;
    }
    let diagnosis = Envelope::open(&verdict)?.diagnosis;
    let named: Vec<String> = diagnosis.correction.effects.iter().map(|e| e.effect.clone()).collect();
    let held_out =
        CaseFolder::open(&layout.case(name), None, &Mapping::built_in("skid-steer-columns")?, &ReadOptions::default())?
            .torque_driven()?
            .held_out;
    let residual = folder.join("corrected_residual.py");
    let mut variants: Vec<(PathBuf, Option<&Path>)> =
        MODELS.iter().map(|(model, _)| (folder.join(format!("{model}.xml")), None)).collect();
    if residual.is_file() {
        variants.push((folder.join("corrected.xml"), Some(&residual)));
    }
    let run = |(model, residual): &(PathBuf, Option<&Path>), held: &HeldOut| json!({ "model": model, "residual": residual, "drive": drive(held) });
    let job: Vec<Value> = variants.iter().flat_map(|v| held_out.iter().map(|h| run(v, h))).collect();
    let results = python::simulate(python, &folder, &json!(job))?;
    // The truth is opened last.
    let opened = truth::open(layout, name, seals)?;
    let truths: Vec<&Response> = held_out
        .iter()
        .map(|h| opened.responses.get(&h.name).with_context(|| format!("no truth of drive {}", h.name)))
        .collect::<Result<_>>()?;
    let mut distances = Vec::new();
    for results in results.chunks(held_out.len()) {
        distances.push(distance(results, &truths)?);
    }
    let predicted = held_out
        .iter()
        .map(|h| truth::response(&predictions.join(format!("{}.csv", h.name))))
        .collect::<Result<Vec<_>>>()?;
    let held = |id: &String| matches!(way(Engine::Mjcf, id), Some(Way::Held(_)));
    Ok(Proved {
        name: name.to_owned(),
        hidden: opened.truth.effects.iter().map(|e| e.id.clone()).collect(),
        held: named.iter().filter(|id| held(id)).count(),
        named,
        models: [distances[0], distances[1], distances[2]],
        with_residual: distances.get(3).copied(),
        plant: distance(&predicted, &truths)?,
    })
}

/// A held-out drive as the script reads it.
fn drive(held: &HeldOut) -> Value {
    let restarts: Vec<Value> = held
        .restarts
        .iter()
        .map(|r| {
            json!({
                "row": r.row, "pose": r.pose, "velocity": r.velocity, "gyro": r.gyro,
                "wheel_speed": r.wheel_speed, "wheel_angle": r.wheel_angle,
            })
        })
        .collect();
    json!({ "period": held.period, "torque": held.torque, "restarts": restarts })
}

/// Over all drives and rows.
fn distance(runs: &[Response], truths: &[&Response]) -> Result<Distance> {
    let (mut sum, mut rows) = ([0.0; 2], 0.0);
    for (run, truth) in runs.iter().zip(truths) {
        ensure!(run.len() == truth.len(), "{} rows were run and {} recorded", run.len(), truth.len());
        for (a, b) in run.iter().zip(*truth) {
            let [left, right, yaw] = [0, 1, 2].map(|k| (a[k] - b[k]).powi(2));
            sum[0] += 0.5 * (left + right);
            sum[1] += yaw;
            rows += 1.0;
        }
    }
    Ok(sum.map(|s| (s / rows).sqrt()))
}

/// Runs a program that has done its work even where some input was lost.
fn succeed(command: &mut Command) -> Result<()> {
    let ended = child::run(command.stdin(Stdio::null()).stdout(Stdio::null()))?;
    ensure!(matches!(ended.status.code(), Some(0 | 3)), "lacuna ended with {}", ended.status);
    Ok(())
}
