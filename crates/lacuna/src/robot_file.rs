//! Robot files: TOML or JSON with value, unit, one sigma and source for each parameter.

use recordings::parse_unit;
use robot_model::robot::{Drive, USUAL_SLIDING_SHARE};
use robot_model::{ModelError, Robot};
use serde::Deserialize;

use crate::flat_robot::FlatRobot;

/// What is imposed and what comes out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Causality {
    /// Torque in; wheel speeds and body motion out.
    TorqueDriven,
    /// A drive imposes the wheel speeds; body motion and the torque that it takes come out.
    SpeedDriven,
}

/// What a robot file says.
#[derive(Debug, Clone)]
pub struct RobotSpec {
    /// Name of the robot.
    pub name: String,
    /// Torque-driven or speed-driven.
    pub causality: Causality,
    /// The model.
    pub robot: Robot<f64>,
    /// One sigma of each tunable: relative for factors, absolute for offsets.
    pub sigma: [f64; robot_model::tunable::COUNT],
    /// Noise of the pose sensor, m.
    pub pose_sigma: f64,
    /// Torque at the wheels of a side per ampere, and its one sigma, when currents are recorded.
    pub torque_per_current: Option<[f64; 2]>,
}

/// Why a robot file cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RobotFileError {
    /// No such built-in robot, and no such file.
    #[error("'{name}' is neither a file nor a built-in robot; built in are: {known}")]
    Unknown {
        /// What was asked for.
        name: String,
        /// Names that exist.
        known: String,
    },
    /// The text is not what a robot file looks like.
    #[error("{file}: {message}")]
    Syntax {
        /// File name.
        file: String,
        /// What and where.
        message: String,
    },
    /// A parameter is in a unit that does not fit.
    #[error("{file}: parameter '{key}' has unit '{unit}', expected {expected}")]
    Unit {
        /// File name.
        file: String,
        /// Parameter.
        key: &'static str,
        /// Unit given.
        unit: String,
        /// Unit expected.
        expected: &'static str,
    },
    /// A parameter is missing.
    #[error("{file}: parameter '{key}' ({expected}) is missing; add `{key} = {{ value = ..., unit = \"{expected}\", source = \"...\" }}`")]
    Missing {
        /// File name.
        file: String,
        /// Parameter.
        key: &'static str,
        /// Unit expected.
        expected: &'static str,
    },
    /// A parameter has a value that no robot can have.
    #[error("{file}: {source}")]
    Model {
        /// File name.
        file: String,
        /// What is wrong.
        source: ModelError,
    },
    /// A sigma is not a positive number.
    #[error("{file}: parameter '{key}' has sigma {sigma}; it must be a positive number, or be left out")]
    Sigma {
        /// File name.
        file: String,
        /// Parameter.
        key: &'static str,
        /// The sigma given.
        sigma: f64,
    },
}

/// Robots that are built in.
pub const BUILT_IN: [(&str, &str); 2] = [
    ("husky-a200", include_str!("../robots/husky-a200.toml")),
    ("hendzel-trojnacki-2014", include_str!("../robots/hendzel-trojnacki-2014.toml")),
];

/// A number with its unit, spread and source.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Quantity {
    value: f64,
    unit: String,
    sigma: Option<f64>,
    #[allow(dead_code, reason = "for people, and required so that every number has one")]
    source: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: String,
    #[allow(dead_code, reason = "for people")]
    description: Option<String>,
    causality: Causality,
    parameters: Parameters,
}

macro_rules! parameters {
    ($($(#[$doc:meta])* $name:ident : $unit:literal),* $(,)?) => {
        #[derive(Debug, Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Parameters {
            $($(#[$doc])* $name: Option<Quantity>,)*
        }
        impl Parameters {
            /// Every parameter by name, with the unit it must be in.
            fn list(&self) -> Vec<(&'static str, &'static str, Option<&Quantity>)> {
                vec![$((stringify!($name), $unit, self.$name.as_ref())),*]
            }
        }
    };
}

parameters! {
    mass: "kg",
    yaw_inertia: "kg m2",
    com_x: "m",
    com_y: "m",
    com_height: "m",
    wheelbase: "m",
    track: "m",
    wheel_radius: "m",
    wheel_inertia: "kg m2",
    motor_inertia: "kg m2",
    adhesion: "-",
    slip_at_peak: "-",
    sliding_share: "-",
    lateral_factor: "-",
    rolling_resistance: "-",
    coulomb: "N m",
    viscous: "N m s/rad",
    hitch_x: "m",
    motor_lag: "s",
    torque_limit: "N m",
    gravity: "m/s2",
    torque_per_current: "N m/A",
    pose_noise: "m",
}

/// Units without a dimension that recordings know.
const COMPOUND: [&str; 5] = ["kg", "kg m2", "N m s/rad", "N m/A", "-"];

struct Lookup<'a> {
    file: &'a str,
    list: Vec<(&'static str, &'static str, Option<&'a Quantity>)>,
}

impl Lookup<'_> {
    /// Value and sigma in SI.
    fn get(&self, key: &str) -> Result<Option<(f64, Option<f64>)>, RobotFileError> {
        let Some(&(key, expected, quantity)) = self.list.iter().find(|l| l.0 == key) else { return Ok(None) };
        let Some(q) = quantity else { return Ok(None) };
        let plain = q.unit.replace('²', "2");
        let wrong = || RobotFileError::Unit { file: self.file.to_owned(), key, unit: q.unit.clone(), expected };
        let factor = if COMPOUND.contains(&expected) {
            if plain == expected { 1.0 } else { return Err(wrong()) }
        } else {
            let (given, wanted) = (parse_unit(&plain).ok_or_else(wrong)?, parse_unit(expected).ok_or_else(wrong)?);
            if given.unit == wanted.unit { given.factor / wanted.factor } else { return Err(wrong()) }
        };
        if let Some(sigma) = q.sigma.filter(|s| !(s.is_finite() && *s > 0.0)) {
            return Err(RobotFileError::Sigma { file: self.file.to_owned(), key, sigma });
        }
        Ok(Some((q.value * factor, q.sigma.map(|s| s * factor))))
    }

    fn or(&self, key: &'static str, usual: f64) -> Result<f64, RobotFileError> {
        Ok(self.get(key)?.map_or(usual, |v| v.0))
    }

    fn need(&self, key: &'static str) -> Result<f64, RobotFileError> {
        let expected = self.list.iter().find(|l| l.0 == key).map_or("-", |l| l.1);
        self.get(key)?.map(|v| v.0).ok_or(RobotFileError::Missing { file: self.file.to_owned(), key, expected })
    }
}

impl RobotSpec {
    /// A built-in robot.
    ///
    /// # Errors
    /// When there is none of this name.
    pub fn built_in(name: &str) -> Result<Self, RobotFileError> {
        let text = BUILT_IN.iter().find(|b| b.0 == name).ok_or_else(|| RobotFileError::Unknown {
            name: name.to_owned(),
            known: BUILT_IN.map(|b| b.0).join(", "),
        })?;
        Self::parse(&format!("{name}.toml"), text.1)
    }

    /// Reads a robot file; JSON when its name ends so, else TOML.
    ///
    /// # Errors
    /// Syntax, unknown keys, units and values, each with file and place.
    pub fn parse(file: &str, text: &str) -> Result<Self, RobotFileError> {
        let json = std::path::Path::new(file).extension().is_some_and(|e| e.eq_ignore_ascii_case("json"));
        let syntax = |message: String| RobotFileError::Syntax { file: file.to_owned(), message };
        if json {
            let value: serde_json::Value = serde_json::from_str(text).map_err(|e| syntax(e.to_string()))?;
            if value.get("parameters").is_none() && value.get("mass_kg").is_some() {
                let flat: FlatRobot = serde_json::from_str(text).map_err(|e| syntax(e.to_string()))?;
                return flat.spec(file);
            }
            let parsed: File = serde_json::from_str(text).map_err(|e| syntax(e.to_string()))?;
            return Self::from_file(file, &parsed);
        }
        let parsed: File = toml::from_str(text).map_err(|e| {
            let line = e.span().map_or(1, |s| text[..s.start].matches('\n').count() + 1);
            syntax(format!("line {line}: {}", e.message()))
        })?;
        Self::from_file(file, &parsed)
    }

    fn from_file(file: &str, parsed: &File) -> Result<Self, RobotFileError> {
        let p = Lookup { file, list: parsed.parameters.list() };
        let radius = p.need("wheel_radius")?;
        let robot = Robot {
            mass: p.need("mass")?,
            yaw_inertia: p.need("yaw_inertia")?,
            com: [p.or("com_x", 0.0)?, p.or("com_y", 0.0)?, p.need("com_height")?],
            half_wheelbase: 0.5 * p.need("wheelbase")?,
            half_track: 0.5 * p.need("track")?,
            wheel_radius: radius,
            wheel_inertia: p.need("wheel_inertia")?,
            motor_inertia: p.or("motor_inertia", 0.0)?,
            adhesion: p.need("adhesion")?,
            slip_at_peak: p.or("slip_at_peak", 0.12)?,
            sliding_share: p.or("sliding_share", USUAL_SLIDING_SHARE)?,
            lateral_factor: p.or("lateral_factor", 1.0)?,
            rolling_resistance: p.need("rolling_resistance")?,
            coulomb: [p.or("coulomb", 0.0)?; 2],
            viscous: [p.or("viscous", 0.0)?; 2],
            stribeck: 0.0,
            hitch_x: p.or("hitch_x", -0.5 * p.need("wheelbase")?)?,
            drive: Drive {
                gain: 1.0,
                lag: p.or("motor_lag", 0.0)?,
                extra_lag: 0.0,
                delay: 0.0,
                limit: p.or("torque_limit", 1e6)?,
                dead_band: 0.0,
            },
            gravity: p.or("gravity", 9.81)?,
        }
        .checked()
        .map_err(|source| RobotFileError::Model { file: file.to_owned(), source })?;
        let mut sigma = diagnosis::case::usual_sigma();
        for (slot, t) in sigma.iter_mut().zip(robot_model::tunable::tunables::<f64>()) {
            let key = if t.id.starts_with("coulomb") { "coulomb" } else { t.id };
            let key = if key == "torque_constant" { "torque_per_current" } else { key };
            let Some((value, Some(s))) = p.get(key)? else { continue };
            *slot = if t.tuning == robot_model::tunable::Tuning::Factor { s / value.abs().max(1e-12) } else { s };
        }
        Ok(Self {
            name: parsed.name.clone(),
            causality: parsed.causality,
            robot,
            sigma,
            pose_sigma: p.or("pose_noise", 0.004)?,
            torque_per_current: p.get("torque_per_current")?.map(|(v, s)| [v, s.unwrap_or(0.1 * v)]),
        })
    }
}
