//! Exports of robots whose files name their columns: wheels beside a pose, cars, and any wheels under torque.

use anyhow::{Result, bail, ensure};
use case_files::corrected::ColumnsRobot;
use model_export::Engine;
use verdict::{Diagnosis, Verdict};

use super::{Args, Format, doubts, save};
use crate::commands::{Outcome, Usage};
use crate::console::warning;

/// Exports such a robot.
pub(super) fn run(args: &Args, robot: ColumnsRobot) -> Result<Outcome> {
    let kind = robot.kind.name();
    ensure!(
        !args.retuned,
        Usage(format!(
            "--retuned: verdicts of kind {kind} hold constants together with their causes alone; leave it out, or take \
             --nominal"
        ))
    );
    ensure!(
        !args.effects.is_any(),
        Usage(format!("--effects, --adopt: robots of kind {kind} have no effects; leave them out"))
    );
    let robot = if args.nominal { robot.nominal() } else { robot };
    let written = match args.to {
        Format::Toml => robot.robot_file()?,
        Format::Ros2 => robot.controllers()?,
        Format::Json => bail!("robot files of kind {kind} are TOML; export it with --to toml"),
        Format::Mjcf => robot.model(Engine::Mjcf)?,
        Format::Urdf => robot.model(Engine::Urdf)?,
        Format::Sdf => robot.model(Engine::Sdf)?,
    };
    for doubt in robot.correction().map(told).unwrap_or_default() {
        warning(&doubt);
    }
    for sentence in &written.not_held {
        warning(sentence.trim_end_matches('.'));
    }
    save(args, &written.text, None)
}

/// What speaks against taking the corrected robot for the true one.
fn told(diagnosis: &Diagnosis) -> Vec<String> {
    let mut out = doubts(diagnosis);
    if diagnosis.verdict == Verdict::Unknown
        && let Some(first) = out.first_mut()
    {
        "what is missing has no name: constants and causes are the nearest that were found".clone_into(first);
    }
    out
}
