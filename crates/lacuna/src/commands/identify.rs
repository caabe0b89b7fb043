//! `lacuna identify`: the paper's online identifier on a recording.

use std::path::PathBuf;

use anyhow::Result;
use case_files::case_folder;
use clap::Args as ClapArgs;

use super::{Outcome, Reader, only};
use crate::console::{emit, emit_json};

mod as_json;
mod as_text;
mod choose;
mod follow;
mod lines;
mod samples;

use follow::Followed;
use samples::Samples;

const EXAMPLES: &str = "\
Examples:
  lacuna identify robot.toml run_1.csv
  lacuna identify husky-a200 FLOORING/pro_01.csv --mapping husky-open
  lacuna identify robot.toml run_1.csv --step 0.001 --seed 7 --json -

The identifier of Hendzel & Trojnacki 2014: d/dt x^ = -8 x^ + W'phi for each
wheel speed, gamma 500, six logistic units of a random first layer per side.
Torque-driven robots: measured wheel speeds, commanded torques. Speed-driven
robots: commanded wheel speeds, currents times torque_per_current of the robot
file.

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some input was lost.";

/// Arguments of `lacuna identify`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Robot file, or name of a built-in robot.
    robot: String,
    /// File of the recording; of a run in several files, any one, or all.
    #[arg(required = true, num_args = 1..)]
    recording: Vec<PathBuf>,
    #[command(flatten)]
    reader: Reader,
    /// Resample to this period: states by linear interpolation, inputs held. Without it, the recording's own samples.
    #[arg(long, value_name = "SECONDS", value_parser = period)]
    step: Option<f64>,
    /// Seed of the first layers.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write everything as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
}

/// A period between a microsecond and ten seconds.
fn period(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if (1e-6..=10.0).contains(&value) { Ok(value) } else { Err("must lie between 0.000001 and 10 s".to_owned()) }
}

/// What was done with a recording.
struct Identification {
    robot: String,
    causality: &'static str,
    recording: String,
    sources: Vec<recordings::Source>,
    seed: u64,
    samples: Samples,
    followed: Followed,
}

/// Runs the identifier over a recording.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    let robot = case_folder::robot(&args.robot)?;
    let (loaded, _) = args.reader.load(&args.recording)?;
    let read = only(&loaded)?;
    let samples = samples::sample(read, &robot, args.step)?;
    let followed = follow::follow(&samples, &robot.robot, args.seed)?;
    let done = Identification {
        robot: robot.name.clone(),
        causality: robot.causality.name(),
        recording: read.recording.name().to_owned(),
        sources: read.sources.clone(),
        seed: args.seed,
        samples,
        followed,
    };
    let lost: Vec<String> = loaded.lost().collect();
    if let Some(target) = &args.json {
        emit_json(target, &as_json::render(&done, &lost))?;
    }
    if args.json.as_deref() != Some("-") {
        emit(&as_text::render(&done, &lost))?;
    }
    Ok(Outcome::of(&lost))
}
