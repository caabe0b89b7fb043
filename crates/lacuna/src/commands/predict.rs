//! `lacuna predict`: robot files against drives that they have not seen.

use pages::text_table::TextTable;
use robot_file::RobotSpec;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use case_files::case_folder::{self, file_names};
use case_files::envelope::Program;
use case_files::kind::{self, Kind};
use case_files::own_effects;
use case_files::predictions;
use clap::Args as ClapArgs;
use recordings::Read;
use serde_json::{Value, json};

use super::{Outcome, OwnEffects, Reader, Usage, paths, sources};
use crate::console::{emit, emit_json, warning};

const EXAMPLES: &str = "\
Examples:
  lacuna predict robot.toml --drives heldout/ --out predicted/
  lacuna predict robot.toml corrected.toml --drives run_7.csv run_8.csv
  lacuna predict corrected.toml --drives heldout/ --effects my-law.toml

Several robot files are compared on the same drives. The simulation runs freely
and is set to the recorded state at rows that hold all of it (pose, body
velocity, gyro, wheels), at most every --restart seconds. Errors are given where
the drive also holds what was to be predicted. Command-driven robots are
forecast from their commands in windows of 2 s. Of speed-driven robots no drive
is forecast freely: `lacuna simulate` gives the torque that their speeds take.
Robots whose files name their columns (kinds odometry, car and wheeled) are
forecast from their inputs alone, and the pose is what is compared and written.

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some input was lost.";

/// Arguments of `lacuna predict`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Robot files, or names of built-in robots.
    #[arg(required = true, num_args = 1..)]
    pub(crate) robot: Vec<String>,
    /// Files or folders of drives.
    #[arg(long, required = true, value_name = "PATH", num_args = 1..)]
    pub(crate) drives: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) reader: Reader,
    #[command(flatten)]
    pub(crate) effects: OwnEffects,
    /// Least time between two restarts from the recorded state, s [default: 2].
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) restart: Option<f64>,
    /// Write the predicted responses as CSV into this folder; of several robots, into a folder for each.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Write the errors as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    pub(crate) json: Option<String>,
}

/// A time between a hundredth of a second and an hour.
fn seconds(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if (0.01..=3600.0).contains(&value) { Ok(value) } else { Err("must lie between 0.01 and 3600 s".to_owned()) }
}

/// Root mean squared errors of a drive's prediction by quantity with its unit; `None` where the drive does not hold what
/// is predicted.
type Rms = Vec<(String, Option<f64>)>;

/// Errors of all robots on a drive.
struct Errors {
    drive: String,
    of: Vec<Rms>,
}

impl Args {
    fn restart(&self) -> f64 {
        self.restart.unwrap_or(2.0)
    }
}

/// Predicts drives.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    if paths::predicted(args)? {
        return Ok(Outcome::Done);
    }
    let known = args.effects.known()?;
    let robots: Vec<RobotSpec> =
        args.robot.iter().map(|name| case_folder::robot_with(known, name)).collect::<Result<_>>()?;
    robots.iter().try_for_each(own_effects::ensure_torque_driven)?;
    // With and without a law may be what is to be compared.
    for sentence in robots.iter().map(own_effects::unused).min_by_key(Vec::len).unwrap_or_default() {
        warning(&sentence);
    }
    let causality = robots[0].causality;
    for robot in &robots {
        ensure!(
            robot.causality == causality,
            "robot '{}' is {}, robot '{}' {}; compare robots of one kind",
            robots[0].name,
            causality.name(),
            robot.name,
            robot.causality.name()
        );
    }
    let kind = kind::of(causality);
    if let Some(why) = kind.no_forecast() {
        bail!("robot '{}' is {}; {why}", robots[0].name, causality.name());
    }
    if args.out.is_some() && kind.no_prediction().is_some() {
        bail!(Usage(format!(
            "--out is for torque-driven robots; `lacuna simulate` writes what a {} robot does",
            causality.name()
        )));
    }
    let (loaded, _) = args.reader.load(&args.drives)?;
    let mut errors = Vec::new();
    for read in &loaded.reads {
        let of = forecast(args, kind, &robots, read).with_context(|| file_names(read))?;
        errors.push(Errors { drive: read.recording.name().to_owned(), of });
    }
    if let Some(target) = &args.json {
        emit_json(target, &as_json(args, &loaded.reads, &errors))?;
    }
    if args.json.as_deref() != Some("-") {
        emit(&as_text(&args.robot, &errors))?;
    }
    let lost: Vec<String> = loaded.lost().collect();
    Ok(Outcome::of(&lost))
}

/// Errors of every robot on a drive; what they predict is written.
fn forecast(args: &Args, kind: &dyn Kind, robots: &[RobotSpec], read: &Read) -> Result<Vec<Rms>> {
    let mut out = Vec::new();
    for (robot, name) in robots.iter().zip(&args.robot) {
        let forecast = kind.forecast(robot, &read.recording, args.restart())?;
        for sentence in forecast.prediction.iter().flat_map(|p| own_effects::beyond_seen_in_forecast(robot, p)) {
            warning(&sentence);
        }
        out.push(forecast.errors);
        if let (Some(dir), Some(prediction)) = (&args.out, &forecast.prediction) {
            let dir = if robots.len() > 1 { dir.join(stem(name)?) } else { dir.clone() };
            predictions::write_one(&dir, prediction)?;
        }
    }
    Ok(out)
}

/// The folder of a robot's predictions: the name of its file.
pub(crate) fn stem(robot: &str) -> Result<&str> {
    match Path::new(robot).file_stem().and_then(|s| s.to_str()) {
        Some(stem) => Ok(stem),
        None => bail!("'{robot}' has no name that a folder could have; rename it"),
    }
}

fn as_text(robots: &[String], errors: &[Errors]) -> String {
    let quantities = errors.first().and_then(|e| e.of.first()).map_or(&[][..], Vec::as_slice);
    let header: Vec<String> = ["drive".to_owned(), "robot".to_owned()]
        .into_iter()
        .chain(quantities.iter().map(|(quantity, _)| format!(">{quantity}")))
        .collect();
    let mut table = TextTable::new(&header.iter().map(String::as_str).collect::<Vec<_>>());
    let number = |e: Option<f64>| e.map_or_else(|| "-".to_owned(), pages::text_table::number);
    for e in errors {
        for (robot, rms) in robots.iter().zip(&e.of) {
            let of = |quantity: &String| rms.iter().find(|(q, _)| q == quantity).and_then(|(_, e)| *e);
            let cells = quantities.iter().map(|(quantity, _)| number(of(quantity)));
            table.row([e.drive.clone(), robot.clone()].into_iter().chain(cells));
        }
    }
    format!("Free runs against what was recorded (rms; - where it was not)\n{}", table.render())
}

fn as_json(args: &Args, reads: &[Read], errors: &[Errors]) -> Value {
    let of = |e: &Errors| -> Vec<Value> {
        let rows = args.robot.iter().zip(&e.of);
        let rms = |rms: &Rms| rms.iter().cloned().map(|(q, e)| (q, json!(e))).collect::<serde_json::Map<_, _>>();
        rows.map(|(robot, of)| json!({ "robot": robot, "rms": rms(of) })).collect()
    };
    let one = |(e, read): (&Errors, &Read)| json!({ "drive": e.drive, "sources": sources(&read.sources), "of": of(e) });
    json!({
        "format": 1,
        "program": Program::default(),
        "restart_s": args.restart(),
        "drives": errors.iter().zip(reads).map(one).collect::<Vec<_>>(),
    })
}
