//! `lacuna export`: a diagnosed robot as a model of a simulator, as a robot file, or as parameters of its controller.

mod columns;

use robot_file::RobotSpec;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use case_files::case_folder;
use case_files::corrected::ColumnsRobot;
use case_files::envelope::{Answered, Envelope};
use case_files::inputs;
use case_files::kind;
use case_files::own_effects;
use clap::{Args as ClapArgs, ValueEnum};
use model_export::{Engine, Model};
use verdict::{Cause, Diagnosis, EffectAt, Verdict};

use super::{Outcome, OwnEffects, Usage};
use crate::console::{emit, warning};

const EXAMPLES: &str = "\
Examples:
  lacuna diagnose case/ --json verdict.json
  lacuna export verdict.json --to mjcf -o robot.xml    for MuJoCo
  lacuna export verdict.json --to toml -o robot.toml   for simulate and predict
  lacuna export verdict.json --to sdf --retuned        re-tuned, no effects
  lacuna export robot.toml --to urdf                   with the file's effects
  lacuna export husky-a200 --to toml                   the file of a built-in one
  lacuna export verdict.json --to ros2 -o controllers.yaml
                                                       of wheels or a car: ROS 2
  lacuna export verdict.json --to mjcf -o robot.xml --effects my-law.toml
                                                       it names a law of a file

Laws that an engine has become values of its model, with comments that say
where they come from. What an engine cannot hold is listed in the model as
lines to be added, with the reason; for MuJoCo they also are a Python file
beside the model, robot_residual.py.

Verdicts of kind odometry, car and wheeled become the owner's robot file with
the corrected numbers (toml); of the first two, parameters of the controller
of ros2_controllers that the wheels ask for (ros2); of kind wheeled, models of
MuJoCo, ROS and Gazebo (mjcf, urdf, sdf). What such a file cannot hold is a
warning.

Exit codes: 0 done, 1 failed, 2 wrong usage.";

/// Arguments of `lacuna export`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// What `lacuna diagnose --json` wrote, a robot file (.toml), or the name of a built-in robot.
    from: PathBuf,
    /// Format of the model.
    #[arg(long, value_enum)]
    to: Format,
    /// File to write; `-` is standard output.
    #[arg(short, long, value_name = "FILE|-", default_value = "-")]
    out: String,
    /// The constants of the robot's file alone: nothing re-tuned, no effects.
    #[arg(long, conflicts_with = "retuned")]
    nominal: bool,
    /// The robot with its constants as re-tuned together with the effects, but without these.
    #[arg(long)]
    retuned: bool,
    #[command(flatten)]
    effects: OwnEffects,
    /// Write over a file that is there.
    #[arg(long)]
    force: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Robot file of lacuna: every constant and every effect.
    Toml,
    /// The same as JSON.
    Json,
    /// MuJoCo.
    Mjcf,
    /// ROS, with tags for Gazebo.
    Urdf,
    /// Gazebo, with the ground.
    Sdf,
    /// Parameters of a ROS 2 controller (of kinds odometry and car).
    Ros2,
}

/// A robot and where it comes from.
struct Source {
    robot: RobotSpec,
    before: Option<RobotSpec>,
    causes: Vec<Cause>,
}

/// Exports a robot.
pub(crate) fn run(args: &Args) -> Result<Outcome> {
    let Source { robot, before, causes } = match source(args)? {
        Exportable::Model(source) => *source,
        Exportable::Columns(robot) => return columns::run(args, *robot),
    };
    let engine = match args.to {
        Format::Toml => return save(args, &robot.to_toml()?, None),
        Format::Json => return save(args, &(serde_json::to_string_pretty(&robot.to_json()?)? + "\n"), None),
        Format::Mjcf => Engine::Mjcf,
        Format::Urdf => Engine::Urdf,
        Format::Sdf => Engine::Sdf,
        Format::Ros2 => bail!(
            "robot '{}' is {}: its sides skid in turns, so that it turns as if its track were wider, and no verdict of \
             this kind says by how much a controller has to count that in; compare its wheel speeds with a pose \
             (`lacuna diagnose --robot skid-steer-4 --recordings ... --json verdict.json`) and export that verdict",
            robot.name,
            robot.causality.name()
        ),
    };
    let no_forces = kind::of(robot.causality).no_forces();
    ensure!(
        no_forces.is_none(),
        "robot '{}' is {}: {}; export it with --to toml or json",
        robot.name,
        robot.causality.name(),
        no_forces.unwrap_or_default()
    );
    let name = stem(&robot.name);
    let model = Model {
        name: &name,
        robot: &robot.robot,
        effects: &robot.effects,
        known: robot.known,
        before: before.as_ref().map(|b| &b.robot),
        causes: &causes,
    };
    let exported = model.export(engine)?;
    for note in &exported.notes {
        warning(&format!("{} does not hold {note}", engine.name()));
    }
    save(args, &exported.text, exported.residual.as_deref())
}

/// What is exported.
enum Exportable {
    /// A robot with masses and forces.
    Model(Box<Source>),
    /// A robot whose file names its columns.
    Columns(Box<ColumnsRobot>),
}

fn source(args: &Args) -> Result<Exportable> {
    let toml = args.from.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"));
    if toml
        && args.from.is_file()
        && let Some(robot) = ColumnsRobot::of_file(&args.from)?
    {
        return Ok(Exportable::Columns(Box::new(robot)));
    }
    let known = args.effects.known()?;
    let is_name = !args.from.is_file() && !inputs::is_path(&args.from.to_string_lossy());
    if is_name && let Some(robot) = ColumnsRobot::built_in(&args.from.to_string_lossy()) {
        return Ok(Exportable::Columns(Box::new(robot)));
    }
    if toml || is_name {
        let whole = case_folder::robot_with(known, &args.from.display().to_string())?;
        own_effects::ensure_torque_driven(&whole)?;
        for sentence in own_effects::unused(&whole) {
            warning(&sentence);
        }
        let robot = if args.nominal || args.retuned { RobotSpec { effects: Vec::new(), ..whole } } else { whole };
        return Ok(Exportable::Model(Box::new(Source { robot, before: None, causes: Vec::new() })));
    }
    let envelope: Box<Envelope> = match Answered::open(&args.from)? {
        Answered::Mapped(envelope) => envelope,
        Answered::Columns(envelope) => {
            let robot = ColumnsRobot::of_verdict(&args.from.display().to_string(), *envelope)?;
            return Ok(Exportable::Columns(Box::new(robot)));
        }
    };
    let nominal = envelope.robot_with(known)?;
    own_effects::ensure_torque_driven(&nominal)?;
    let plain = RobotSpec { effects: Vec::new(), ..nominal.clone() };
    if args.nominal {
        return Ok(Exportable::Model(Box::new(Source { robot: plain, before: None, causes: Vec::new() })));
    }
    if !args.retuned {
        envelope.ensure_known(known)?;
    }
    for doubt in doubts(&envelope.diagnosis) {
        warning(&doubt);
    }
    let mut correction = envelope.diagnosis.correction.clone();
    if args.retuned {
        correction.effects.clear();
    }
    let robot = if args.retuned { plain } else { nominal.clone() }.corrected(&correction)?;
    Ok(Exportable::Model(Box::new(Source { robot, before: Some(nominal), causes: envelope.diagnosis.ranked })))
}

/// What speaks against taking the corrected robot for the true one.
fn doubts(d: &Diagnosis) -> Vec<String> {
    let mut out = Vec::new();
    match d.verdict {
        Verdict::Explained => {}
        Verdict::NoMismatch => out.push("the diagnosis found nothing missing: constants alone are re-tuned".to_owned()),
        Verdict::Unknown => out.push("what is missing is not in the catalogue: the effect is the nearest".to_owned()),
        Verdict::Withheld => out.push("the recordings permitted no answer: the robot is as it was".to_owned()),
    }
    for class in d.indistinguishable.iter().filter(|class| class.len() > 1) {
        out.push(format!("these recordings cannot tell apart {}; the first is exported", class.join(", ")));
    }
    let onset = |e: &&EffectAt| !e.from.is_empty() || !e.absent.is_empty();
    for e in d.correction.effects.iter().filter(onset) {
        out.push(format!("{} began at an instant; the model of an engine has it throughout", e.effect));
    }
    out
}

/// A name without folders and ending, such as robots have that are named after their file.
fn stem(name: &str) -> String {
    let last = Path::new(name).file_stem().map(|s| s.to_string_lossy().into_owned());
    last.filter(|s| !s.is_empty()).unwrap_or_else(|| "robot".to_owned())
}

/// Writes the model, and beside it what its engine cannot hold.
fn save(args: &Args, text: &str, residual: Option<&str>) -> Result<Outcome> {
    if args.out == "-" {
        if residual.is_some() {
            warning("the residual forces are a file of their own: write to a file with -o to get it");
        }
        emit(text)?;
        return Ok(Outcome::Done);
    }
    let out = Path::new(&args.out);
    let mut files = vec![(out.to_owned(), text)];
    // A name that Python can import.
    let beside = format!("{}_residual.py", out.file_stem().unwrap_or_default().to_string_lossy());
    files.extend(residual.map(|r| (out.with_file_name(beside), r)));
    for (path, _) in &files {
        let free = args.force || !path.exists();
        ensure!(free, Usage(format!("'{}' is there already; --force writes over it", path.display())));
    }
    for (path, text) in &files {
        std::fs::write(path, text).with_context(|| format!("cannot write '{}'", path.display()))?;
    }
    Ok(Outcome::Done)
}
