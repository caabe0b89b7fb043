//! `lacuna robot`: a robot file from what a user has beside one.

mod from_logs;
mod from_model;

use std::path::PathBuf;

use anyhow::Result;
use clap::{Args as ClapArgs, ValueEnum};

use super::{Outcome, Reader};

const EXAMPLES: &str = "\
Examples:
  lacuna robot model.urdf -o robot.toml                from URDF, SDF or MJCF
  lacuna robot model.urdf --kind odometry              wheel motion and a pose
  lacuna robot model.urdf --kind wheeled               torques of any wheels
  lacuna robot model.xml --from-logs logs/ -o robot.toml
  lacuna robot --from-logs sim_1.csv sim_2.csv --mass 20 --wheel-radius 0.1 \\
      --track 0.4 --wheelbase 0.36 -o robot.toml
  lacuna robot --from-logs logs/ --mass 12 --wheel-radius 0.07 --track 0.3 \\
      --caster -0.18 -o robot.toml                     two wheels and a caster
  lacuna robot --from-logs logs/ --like old.toml -o robot.toml

A model is read with every joint at zero. Wheels are what turns without end
about a level axle and reaches down to the ground. Four fixed wheels make a
torque-driven robot, a steered and a fixed axle a car, others one of kind
odometry. Every number says where it was read; what the model lacks is a usual
value, called a guess, with a wide sigma. Expand xacro first.

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
    /// Model of the robot: URDF, SDF or MJCF.
    #[arg(value_name = "MODEL", required_unless_present = "from_logs")]
    model: Option<PathBuf>,
    /// Kind of the robot file; of a model, the usual one of its wheels.
    #[arg(long, value_enum, requires = "model", conflicts_with = "from_logs")]
    kind: Option<Kind>,
    /// Rollers on the wheels, where the model draws none.
    #[arg(long, value_enum, requires = "model")]
    rollers: Option<Rollers>,
    /// Logs of a simulator: files or folders.
    #[arg(long, value_name = "LOG", num_args = 1..)]
    from_logs: Vec<PathBuf>,
    #[command(flatten)]
    reader: Reader,
    /// Robot file, or name of a built-in robot, from whose constants the fit to logs starts.
    #[arg(long, value_name = "NAME|FILE", requires = "from_logs", conflicts_with_all = ["model", "mass", "wheel_radius", "track", "wheelbase", "caster"])]
    like: Option<String>,
    /// Mass of the simulated robot, kg.
    #[arg(long, value_name = "KG", value_parser = positive, conflicts_with = "model")]
    mass: Option<f64>,
    /// Radius of its wheels, m; of a model, of wheels whose shapes tell none.
    #[arg(long, value_name = "M", value_parser = positive)]
    wheel_radius: Option<f64>,
    /// Distance between the middles of its left and right wheels, m.
    #[arg(long, value_name = "M", value_parser = positive, conflicts_with = "model")]
    track: Option<f64>,
    /// Distance between its axles, m.
    #[arg(long, value_name = "M", value_parser = positive, conflicts_with = "model")]
    wheelbase: Option<f64>,
    /// Where a caster's pivot is from the middle of the driven axle, ahead and to the left, m, of a robot on two wheels and
    /// casters; again for a second one.
    #[arg(long, value_name = "X[,Y]", value_parser = place, allow_hyphen_values = true, conflicts_with_all = ["model", "wheelbase"])]
    caster: Vec<Place>,
    /// Name of the robot; that of the model, or "simulated".
    #[arg(long)]
    name: Option<String>,
    /// Write the robot file; `-` is standard output.
    #[arg(short, long, value_name = "FILE.toml|-", default_value = "-")]
    out: String,
    /// Write what was read or fitted as JSON to a file; `-` is standard output, instead of the text.
    #[arg(long, value_name = "FILE|-")]
    json: Option<String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Torques are given.
    TorqueDriven,
    /// Wheel speeds are given by drives, with currents.
    SpeedDriven,
    /// Wheel speeds are commanded.
    CommandDriven,
    /// Wheel motion beside a pose.
    Odometry,
    /// Throttle and steering in, motion out.
    Car,
    /// Torques of motors that turn any wheels.
    Wheeled,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Rollers {
    /// Across the wheel.
    Omni,
    /// At 45 degrees; the upper ones form an X seen from above.
    Mecanum,
}

/// A place on the ground, m.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Place([f64; 2]);

fn place(text: &str) -> Result<Place, String> {
    let number = |text: &str| -> Result<f64, String> {
        let given: f64 = text.trim().parse().map_err(|_| format!("'{text}' is no number"))?;
        if given.is_finite() { Ok(given) } else { Err("must be finite".to_owned()) }
    };
    let (x, y) = text.split_once(',').unwrap_or((text, "0"));
    Ok(Place([number(x)?, number(y)?]))
}

fn positive(text: &str) -> Result<f64, String> {
    let given: f64 = text.parse().map_err(|_| format!("'{text}' is no number"))?;
    if given.is_finite() && given > 0.0 { Ok(given) } else { Err("must be larger than zero".to_owned()) }
}

/// Makes a robot file.
pub(crate) fn run(args: &Args, verbose: bool) -> Result<Outcome> {
    match &args.model {
        Some(model) if args.from_logs.is_empty() => from_model::run(args, model),
        _ => from_logs::run(args, verbose),
    }
}
