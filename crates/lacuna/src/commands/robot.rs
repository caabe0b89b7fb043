//! `lacuna robot`: a robot file from what a user has beside one.

use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use case_files::case_folder::{self, file_names};
use case_files::envelope::Program;
use clap::Args as ClapArgs;
use inference::Options;
use pages::text_table::{TextTable, number};
use robot_file::{Causality, RobotSpec, Size};
use serde_json::json;
use torque_driven::{FittedRobot, Run, fit_logs};

use super::{Outcome, Reader, Usage, sources};
use crate::console::{Progress, emit, emit_json};

const EXAMPLES: &str = "\
Examples:
  lacuna robot --from-logs sim_1.csv sim_2.csv --mass 20 --wheel-radius 0.1 \\
      --track 0.4 --wheelbase 0.36 -o robot.toml
  lacuna robot --from-logs logs/ --like old.toml -o robot.toml

Logs of a simulator, torque-driven: the torques that it was given, and wheel
speeds and motion that came out. Constants are fitted so that free runs over
2 s behave as the simulator does. Together they do; one of them alone may be
off by tens of per cent, since a heavier body shows as larger motors do.

Exit codes: 0 done, 1 failed, 2 wrong usage, 3 done but some input was lost.
Failed is also a fit after which no such robot behaves like the logs.";

/// Arguments of `lacuna robot`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Logs of a simulator: files or folders.
    #[arg(long, value_name = "LOG", required = true, num_args = 1..)]
    from_logs: Vec<PathBuf>,
    #[command(flatten)]
    reader: Reader,
    /// Robot file, or name of a built-in robot, from whose constants the fit starts.
    #[arg(long, value_name = "NAME|FILE", conflicts_with_all = ["mass", "wheel_radius", "track", "wheelbase"])]
    like: Option<String>,
    /// Mass of the simulated robot, kg.
    #[arg(long, value_name = "KG", value_parser = positive)]
    mass: Option<f64>,
    /// Radius of its wheels, m.
    #[arg(long, value_name = "M", value_parser = positive)]
    wheel_radius: Option<f64>,
    /// Distance between the middles of its left and right wheels, m.
    #[arg(long, value_name = "M", value_parser = positive)]
    track: Option<f64>,
    /// Distance between its axles, m.
    #[arg(long, value_name = "M", value_parser = positive)]
    wheelbase: Option<f64>,
    /// Name of the robot.
    #[arg(long, default_value = "simulated")]
    name: String,
    /// Write the robot file; `-` is standard output.
    #[arg(short, long, value_name = "FILE.toml|-", default_value = "-")]
    out: String,
    /// Write what was fitted as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
}

fn positive(text: &str) -> Result<f64, String> {
    let given: f64 = text.parse().map_err(|_| format!("'{text}' is no number"))?;
    if given.is_finite() && given > 0.0 { Ok(given) } else { Err("must be larger than zero".to_owned()) }
}

/// Fits a robot to logs.
pub(crate) fn run(args: &Args, verbose: bool) -> Result<Outcome> {
    let start = start(args)?;
    let (loaded, _) = args.reader.load(&args.from_logs)?;
    if loaded.reads.is_empty() {
        bail!("there is no log among what was given; give files, or a folder of files, of a simulator");
    }
    let logs = loaded
        .reads
        .iter()
        .map(|read| Run::new(&read.recording).with_context(|| file_names(read)))
        .collect::<Result<Vec<_>>>()?;

    let progress = Progress::new(verbose);
    progress.stage("fitting the robot to the logs");
    let fitted = fit_logs(&start.robot, &logs, &Options::default())?;
    drop(progress);
    if !fitted.is_alike() {
        let ([_, after], motion) = (fitted.errors, fitted.motion);
        bail!(
            "no robot file was written: the fitted robot does not behave like the logs (in free runs over 2 s wheel speeds \
             are off by {:.3} rad/s rms, of {:.2} rad/s driven; the yaw rate by {:.4} of {:.3} rad/s); check wheel radius, \
             track and units, or start from a robot nearer to it with --like",
            after[0],
            motion[0],
            after[1],
            motion[1]
        );
    }

    let spec = written(args, start, &fitted, logs.len());
    let toml = spec.to_toml()?;
    if args.out != "-" {
        std::fs::write(&args.out, &toml).with_context(|| format!("cannot write '{}'", args.out))?;
    }
    if let Some(target) = &args.json {
        let files: Vec<_> = loaded.reads.iter().flat_map(|read| sources(&read.sources)).collect();
        let constants: Vec<_> = fitted
            .constants
            .iter()
            .map(|c| json!({ "constant": c.id, "unit": c.unit, "from": c.from, "to": c.to }))
            .collect();
        let whole = json!({
            "format": 1,
            "program": Program::default(),
            "robot": spec.to_json()?,
            "sources": files,
            "constants": constants,
            "errors": {
                "quantities": ["wheel speed, rad/s", "yaw rate, rad/s"],
                "before": fitted.errors[0],
                "after": fitted.errors[1],
            },
        });
        emit_json(target, &whole)?;
    } else if args.out == "-" {
        emit(&toml)?;
    } else {
        emit(&text(&fitted, logs.len()))?;
    }
    let lost: Vec<String> = loaded.lost().collect();
    Ok(Outcome::of(&lost))
}

/// The robot from which the fit starts.
fn start(args: &Args) -> Result<RobotSpec> {
    if let Some(like) = &args.like {
        let spec = case_folder::robot(like)?;
        if spec.causality != Causality::TorqueDriven {
            bail!(
                "robot '{}' is {}: logs of torques can be fitted for torque-driven robots only",
                spec.name,
                spec.causality.name()
            );
        }
        return Ok(spec);
    }
    let sizes = [
        ("--mass", args.mass),
        ("--wheel-radius", args.wheel_radius),
        ("--track", args.track),
        ("--wheelbase", args.wheelbase),
    ];
    let [Some(mass), Some(wheel_radius), Some(track), Some(wheelbase)] = sizes.map(|(_, given)| given) else {
        let missing: Vec<&str> = sizes.iter().filter(|(_, given)| given.is_none()).map(|(name, _)| *name).collect();
        bail!(Usage(format!("give {}, or a robot to start from with --like", missing.join(", "))));
    };
    Ok(RobotSpec::of_size(&args.name, &Size { mass, wheel_radius, track, wheelbase })?)
}

/// The robot file of what was fitted: what was free came from the logs.
fn written(args: &Args, mut spec: RobotSpec, fitted: &FittedRobot, logs: usize) -> RobotSpec {
    spec.robot = fitted.robot;
    spec.name.clone_from(&args.name);
    let [_, after] = fitted.errors;
    spec.description = Some(format!(
        "Behaves like {logs} {} of a simulator: free runs over 2 s are off by {:.3} rad/s of a wheel and {:.4} rad/s of \
         the yaw rate (rms); constants hold together, not one by one",
        if logs == 1 { "log" } else { "logs" },
        after[0],
        after[1]
    ));
    for constant in &fitted.constants {
        spec.sources.insert(constant.id, "fitted to the logs of a simulator".to_owned());
    }
    spec
}

fn text(fitted: &FittedRobot, logs: usize) -> String {
    let [before, after] = fitted.errors;
    let mut table = TextTable::new(&["constant", ">from", ">to", "unit"]);
    for c in &fitted.constants {
        table.row([c.id.to_owned(), number(c.from), number(c.to), c.unit.to_owned()]);
    }
    format!(
        "Fitted to {logs} {}: in free runs over 2 s from measured states wheel speeds are off by {:.3} rad/s \
         (rms; {:.3} before) and the yaw rate by {:.4} rad/s ({:.4} before).\n\n{}\nThese constants behave alike together; \
         one of them alone may be off by tens of per cent.\n",
        if logs == 1 { "log" } else { "logs" },
        after[0],
        before[0],
        after[1],
        before[1],
        table.render()
    )
}
