//! A model in, a robot file out.

use robot_file::{Causality, RobotSpec};
use roxmltree::{Document, ParsingOptions};

use crate::error::ImportError;
use crate::layout::{Layout, Robot};
use crate::source::Source;
use crate::wheels::wheels;
use crate::{any_wheels, car, mjcf, odometry, sdf, torque, urdf};

/// Kinds of robot files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
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

impl Kind {
    /// As robot files write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::TorqueDriven => "torque-driven",
            Self::SpeedDriven => "speed-driven",
            Self::CommandDriven => "command-driven",
            Self::Odometry => "odometry",
            Self::Car => "car",
            Self::Wheeled => "wheeled",
        }
    }

    /// The kind that is usual for a layout.
    fn of(layout: Layout) -> Self {
        match layout {
            Layout::SkidSteer => Self::TorqueDriven,
            Layout::Differential | Layout::Tricycle | Layout::Rollers(_) => Self::Odometry,
            Layout::Car => Self::Car,
            Layout::SteeredAxles => Self::Wheeled,
        }
    }
}

/// Rollers on wheels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rollers {
    /// Across the wheel: they turn about its direction of rolling.
    Omni,
    /// At 45 degrees; the upper ones form an X seen from above.
    Mecanum,
}

/// What a user says beside the model.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Asked {
    /// Kind of the robot file; the usual one of the robot's wheels if not given.
    pub kind: Option<Kind>,
    /// Rollers of the wheels, where the model draws none.
    pub rollers: Option<Rollers>,
    /// Radius of wheels whose shapes tell none, m.
    pub wheel_radius: Option<f64>,
    /// Name of the robot; that of the model if not given.
    pub name: Option<String>,
}

/// A number of the robot file.
#[derive(Debug, Clone, PartialEq)]
pub struct Number {
    /// What it is, as the file calls it.
    pub name: String,
    /// Its value in `unit`.
    pub value: f64,
    /// SI; "-" of none.
    pub unit: String,
    /// Where it comes from.
    pub source: String,
    /// Whether the model states it; otherwise it is a usual value.
    pub is_stated: bool,
}

/// A robot file made of a model.
#[derive(Debug, Clone)]
pub struct Imported {
    /// Its kind.
    pub kind: Kind,
    /// What the model's wheels make it, in words.
    pub layout: &'static str,
    /// The file, TOML.
    pub text: String,
    /// The robot, of kinds that are one plant.
    pub spec: Option<RobotSpec>,
    /// Its numbers, each with its source.
    pub numbers: Vec<Number>,
    /// What a reader of the file should know, in sentences.
    pub notes: Vec<String>,
}

/// Makes a robot file of a model in URDF, SDF or MJCF, told apart by the outermost element. The model is taken as it stands
/// with every joint at zero; `file` is what messages call it.
///
/// Masses and inertias are summed over all links: `m = Σ mₖ`, `c = Σ mₖ cₖ / m`, `J = Σ Jₖ + mₖ (|dₖ|² 1 − dₖ dₖᵀ)` with
/// `dₖ = cₖ − c` (Steiner). Wheels are parts that turn without end about a level axle and reach down to the ground.
///
/// # Errors
/// No XML, another format, elements that are missing or cannot be, wheels that are not found, and kinds that such wheels are
/// not: each in one sentence with the line, where there is one, and the remedy.
pub fn import(file: &str, text: &str, asked: &Asked) -> Result<Imported, ImportError> {
    // Document types stand in files of some editors and mean nothing.
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|e| ImportError::At {
        file: file.to_owned(),
        line: e.pos().row,
        what: format!("this is no XML ({}); give a URDF, SDF or MJCF file", e.to_string().replace('\n', " ")),
    })?;
    let source = Source { file, document: &document };
    let root = document.root_element();
    source.ensure_sound()?;
    let model = match root.tag_name().name() {
        "robot" => urdf::read(&source, root)?,
        "sdf" | "gazebo" => sdf::read(&source, root)?,
        "mujoco" => mjcf::read(&source, root)?,
        other => {
            return Err(source.wrong(
                root,
                format!("<{other}> is no model; URDF begins with <robot>, SDF with <sdf>, MJCF with <mujoco>"),
            ));
        }
    };
    if model.links.is_empty() {
        return Err(source.whole("the model has no links; give the file in which they stand"));
    }
    let robot = Robot::new(&source, &model, wheels(&model, asked.wheel_radius), asked.rollers)?;
    let kind = asked.kind.unwrap_or_else(|| Kind::of(robot.layout));
    let name = asked.name.clone().unwrap_or_else(|| model.name.clone());
    match kind {
        Kind::TorqueDriven => torque::file(&source, &robot, &name, kind, Causality::TorqueDriven),
        Kind::SpeedDriven => torque::file(&source, &robot, &name, kind, Causality::SpeedDriven),
        Kind::CommandDriven => torque::file(&source, &robot, &name, kind, Causality::CommandDriven),
        Kind::Odometry => odometry::file(&source, &robot, &name),
        Kind::Car => car::file(&source, &robot, &name),
        Kind::Wheeled => any_wheels::file(&source, &robot, &name),
    }
}
