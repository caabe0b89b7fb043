//! `lacuna simulate`: a robot file on the inputs of a recording.

use std::path::PathBuf;

use anyhow::{Context, Result};
use case_files::case_folder::{self, file_names};
use case_files::envelope::Program;
use case_files::own_effects;
use case_files::simulated::simulated;
use clap::Args as ClapArgs;
use recordings::write_csv;
use serde_json::json;

use super::{Outcome, OwnEffects, Reader, only, paths, sources};
use crate::console::{emit, emit_json, warning};

const EXAMPLES: &str = "\
Examples:
  lacuna simulate robot.toml run_1.csv > simulated.csv
  lacuna simulate corrected.toml run_1.csv -o simulated.csv
  lacuna simulate corrected.toml run_1.csv --effects my-law.toml
  lacuna simulate husky-a200 FLOORING/pro_01.csv --mapping husky-open -o s.csv

The robot file may hold effects: `lacuna export verdict.json --to toml` writes
such a file, corrected. Torque-driven robots need the commanded torques of both
sides, and start in the state of the first row where all of it was recorded,
else at rest. Speed-driven robots need the wheel speeds; the torque that they
take comes out. Command-driven robots need the commanded wheel speeds, and do
what the file's [response] says. The columns are those of the mapping
skid-steer-columns.

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some input was lost.";

/// Arguments of `lacuna simulate`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Robot file, or name of a built-in robot.
    pub(crate) robot: String,
    /// Recording with the inputs; of a run in several files, any one, or all.
    #[arg(required = true, num_args = 1..)]
    pub(crate) recording: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) reader: Reader,
    #[command(flatten)]
    pub(crate) effects: OwnEffects,
    /// Write the simulated drive as CSV to a file; `-` is standard output.
    #[arg(short, long, value_name = "FILE|-", default_value = "-")]
    pub(crate) out: String,
    /// Write it as JSON to a file instead; `-` is standard output.
    #[arg(long, value_name = "FILE|-", conflicts_with = "out")]
    pub(crate) json: Option<String>,
}

/// Simulates a drive.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    if paths::written(args)? {
        return Ok(Outcome::Done);
    }
    let robot = case_folder::robot_with(args.effects.known()?, &args.robot)?;
    own_effects::ensure_torque_driven(&robot)?;
    for sentence in own_effects::unused(&robot) {
        warning(&sentence);
    }
    let (loaded, _) = args.reader.load(&args.recording)?;
    let read = only(&loaded)?;
    let simulated = simulated(&robot, &read.recording).with_context(|| file_names(read))?;
    for sentence in own_effects::beyond_seen(&robot, &simulated) {
        warning(&sentence);
    }
    if let Some(target) = &args.json {
        let columns = simulated.channels().iter().map(|c| (c.signal().column_name(), json!(c.values())));
        let stamps = simulated.channels().first().map(|c| c.t_ns().to_vec());
        let whole = json!({
            "format": 1,
            "program": Program::default(),
            "robot": robot.to_json()?,
            "recording": simulated.name(),
            "sources": sources(&read.sources),
            "t_ns": stamps,
            "columns": columns.collect::<serde_json::Map<_, _>>(),
        });
        emit_json(target, &whole)?;
    } else {
        let csv = write_csv(&simulated, 0);
        if args.out == "-" {
            emit(&csv)?;
        } else {
            std::fs::write(&args.out, csv).with_context(|| format!("cannot write '{}'", args.out))?;
        }
    }
    let lost: Vec<String> = loaded.lost().collect();
    Ok(Outcome::of(&lost))
}
