//! A robot file whose robot behaves like the logs of a simulator.

use anyhow::{Context, Result, bail};
use case_files::case_folder::{self, file_names};
use case_files::envelope::Program;
use inference::Options;
use pages::text_table::{TextTable, number};
use robot_file::{Causality, RobotSpec, Size, Stands};
use serde_json::json;
use torque_driven::{FittedRobot, Run, fit_logs};

use super::super::{Outcome, Usage, sources};
use super::{Args, Place, from_model};
use crate::console::{Progress, emit, emit_json};

/// Fits a robot to logs.
pub(super) fn run(args: &Args, verbose: bool) -> Result<Outcome> {
    let start = start(args)?;
    if let Some(given) = start.effects.first() {
        bail!(
            "robot '{}' gives its simulation the effect `{}`, which a fit of constants would count twice; take its effects out of the \
             file that --like names",
            start.name,
            given.effect
        );
    }
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
    if let Some(model) = &args.model {
        let made = from_model::read(args, model)?;
        let is_one = |spec: &RobotSpec| spec.causality == Causality::TorqueDriven;
        return made.spec.filter(is_one).with_context(|| {
            format!(
                "'{}' is {}: logs of torques can be fitted for torque-driven robots only; leave out --from-logs",
                model.display(),
                made.layout
            )
        });
    }
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
    let stands = match (args.wheelbase, &args.caster[..]) {
        (Some(wheelbase), _) => Some(Stands::Axles(wheelbase)),
        (None, []) => None,
        (None, [Place(only)]) => Some(Stands::Casters([*only; 2])),
        (None, [Place(first), Place(second)]) => Some(Stands::Casters([*first, *second])),
        (None, more) => bail!(Usage(format!("{} casters were given; a robot has one or two", more.len()))),
    };
    let sizes = [("--mass", args.mass), ("--wheel-radius", args.wheel_radius), ("--track", args.track)];
    let ([Some(mass), Some(wheel_radius), Some(track)], Some(stands)) = (sizes.map(|(_, given)| given), stands) else {
        let missing = sizes.iter().filter(|(_, given)| given.is_none()).map(|(name, _)| *name);
        let base = stands.is_none().then_some("--wheelbase (or --caster)");
        let missing: Vec<&str> = missing.chain(base).collect();
        bail!(Usage(format!("give {}, a model, or a robot to start from with --like", missing.join(", "))));
    };
    Ok(RobotSpec::of_size(name(args), &Size { mass, wheel_radius, track, stands })?)
}

/// Name of the robot.
fn name(args: &Args) -> &str {
    args.name.as_deref().unwrap_or("simulated")
}

/// The robot file of what was fitted: what was free came from the logs.
fn written(args: &Args, mut spec: RobotSpec, fitted: &FittedRobot, logs: usize) -> RobotSpec {
    spec.robot = fitted.robot;
    if args.name.is_some() || args.model.is_none() {
        name(args).clone_into(&mut spec.name);
    }
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
