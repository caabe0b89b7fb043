//! The form of a robot file with value, unit, one sigma and source for each parameter.

use inference::DiagnosisError;
use recordings::{Spot, parse_unit};
use robot_model::robot::{Drive, USUAL_REST_SPEED, USUAL_SLIDING_SHARE};
use robot_model::tunable::{Tuning, tunables};
use robot_model::{ModelError, Robot};
use serde::{Deserialize, Serialize};
use verdict::EffectAt;
use verdict::ResponseError;
use verdict::ResponseModel;

use crate::robot_file::USUAL_POSE_SIGMA;
use crate::robot_text::RobotText;
use crate::{Causality, RobotFileError, RobotSpec, suggest};

/// Slip ratio at the peak of the adhesion of a tyre of which nothing is known.
const USUAL_SLIP_AT_PEAK: f64 = 0.12;
/// A torque beyond any robot's, N m: a drive whose limit is not given.
pub(crate) const NO_TORQUE_LIMIT: f64 = 1e6;
/// One sigma of the torque per ampere, relative, when the file says nothing.
const USUAL_CURRENT_SIGMA: f64 = 0.1;

/// A number with its unit, spread and source.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Quantity {
    pub(crate) value: f64,
    pub(crate) unit: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) sigma: Option<f64>,
    /// For people, and required so that every number has one.
    pub(crate) source: String,
}

/// A robot file.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct File {
    pub(crate) name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) description: Option<String>,
    pub(crate) causality: Causality,
    pub(crate) parameters: Parameters,
    /// What the simulation is given beside its constants.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) effects: Vec<EffectAt>,
    /// Response to commands, of a command-driven robot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) response: Option<ResponseModel>,
}

macro_rules! parameters {
    ($($name:ident : $unit:literal),* $(,)?) => {
        #[derive(Debug, Default, Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(crate) struct Parameters {
            $(#[serde(skip_serializing_if = "Option::is_none")] $name: Option<Quantity>,)*
        }
        impl Parameters {
            /// Every parameter by name, with the unit it must be in.
            fn list(&self) -> Vec<(&'static str, &'static str, Option<&Quantity>)> {
                vec![$((stringify!($name), $unit, self.$name.as_ref())),*]
            }

            /// Each parameter as `quantity` has it, given its name and unit.
            pub(crate) fn make(quantity: impl Fn(&'static str, &'static str) -> Option<Quantity>) -> Self {
                Self { $($name: quantity(stringify!($name), $unit)),* }
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
    rest_speed: "m/s",
    lateral_factor: "-",
    rolling_resistance: "-",
    coulomb: "N m",
    coulomb_left: "N m",
    coulomb_right: "N m",
    viscous: "N m s/rad",
    viscous_left: "N m s/rad",
    viscous_right: "N m s/rad",
    stribeck: "N m",
    hitch_x: "m",
    torque_gain: "-",
    motor_delay: "s",
    motor_lag: "s",
    second_lag: "s",
    dead_band: "N m",
    torque_limit: "N m",
    gravity: "m/s2",
    torque_per_current: "N m/A",
    pose_noise: "m",
}

/// Names of model quantities that files call otherwise.
const KEYS: [(&str, &str); 12] = [
    ("half_wheelbase", "wheelbase"),
    ("half_track", "track"),
    ("coulomb (left)", "coulomb"),
    ("coulomb (right)", "coulomb_right"),
    ("viscous (left)", "viscous"),
    ("viscous (right)", "viscous_right"),
    ("drive.gain", "torque_gain"),
    ("drive.delay", "motor_delay"),
    ("drive.lag", "motor_lag"),
    ("drive.extra_lag", "second_lag"),
    ("drive.dead_band", "dead_band"),
    ("drive.limit", "torque_limit"),
];

/// Units that no recording has: taken as they are.
const COMPOUND: [&str; 5] = ["kg", "kg m2", "N m s/rad", "N m/A", "-"];

/// A compound unit without the marks that people write differently.
fn bare(unit: &str) -> String {
    let plain: String =
        unit.chars().filter(|c| !" ·*.^".contains(*c)).map(|c| if c == '²' { '2' } else { c }).collect();
    if plain == "1" { "-".to_owned() } else { plain }
}

/// The name of the quantity that a model refuses.
pub(crate) fn refused(error: &ModelError) -> &'static str {
    match error {
        ModelError::NotPositive { name, .. }
        | ModelError::Negative { name, .. }
        | ModelError::NotFinite { name, .. }
        | ModelError::OutOfRange { name, .. } => name,
        _ => "robot",
    }
}

struct Lookup<'a> {
    source: RobotText<'a>,
    list: Vec<(&'static str, &'static str, Option<&'a Quantity>)>,
}

impl Lookup<'_> {
    /// Value and sigma in SI.
    fn get(&self, key: &str) -> Result<Option<(f64, Option<f64>)>, RobotFileError> {
        let Some(&(key, expected, Some(q))) = self.list.iter().find(|l| l.0 == key) else {
            return Ok(None);
        };
        let factor = factor(&q.unit, expected).ok_or_else(|| RobotFileError::Unit {
            place: self.source.at(key),
            key: key.to_owned(),
            unit: q.unit.clone(),
            expected: if expected == "-" { "`-` (no unit)".to_owned() } else { format!("`{expected}`") },
        })?;
        let bad = |what, value, must| RobotFileError::Value {
            place: self.source.at(key),
            key: key.to_owned(),
            what,
            value,
            must,
        };
        if !q.value.is_finite() {
            return Err(bad("the value", q.value, "a finite number"));
        }
        if let Some(sigma) = q.sigma.filter(|s| !(s.is_finite() && *s > 0.0)) {
            return Err(bad("the sigma", sigma, "larger than zero, or be left out"));
        }
        Ok(Some((q.value * factor, q.sigma.map(|s| s * factor))))
    }

    /// Like [`Lookup::get`] for what must be larger than zero and the model does not check.
    fn positive(&self, key: &str) -> Result<Option<(f64, Option<f64>)>, RobotFileError> {
        let got = self.get(key)?;
        match got {
            Some((value, _)) if value <= 0.0 => Err(RobotFileError::Value {
                place: self.source.at(key),
                key: key.to_owned(),
                what: "the value",
                value,
                must: "larger than zero",
            }),
            _ => Ok(got),
        }
    }

    fn or(&self, key: &str, usual: f64) -> Result<f64, RobotFileError> {
        Ok(self.get(key)?.map_or(usual, |v| v.0))
    }

    fn need(&self, key: &'static str) -> Result<f64, RobotFileError> {
        let expected = self.list.iter().find(|l| l.0 == key).map_or("-", |l| l.1);
        let got = self.get(key)?.ok_or_else(|| RobotFileError::Missing {
            place: Spot::file(self.source.file),
            key: key.to_owned(),
            expected: expected.to_owned(),
        })?;
        Ok(got.0)
    }
}

/// What a number in `unit` is multiplied with to get one in `expected`; `None` when it is of another quantity.
fn factor(unit: &str, expected: &str) -> Option<f64> {
    if COMPOUND.contains(&expected) {
        return (bare(unit) == bare(expected)).then_some(1.0);
    }
    let (given, wanted) = (parse_unit(&unit.replace('²', "2"))?, parse_unit(expected)?);
    (given.unit == wanted.unit).then_some(given.factor / wanted.factor)
}

impl File {
    /// The robot of this file.
    pub(crate) fn spec(self, source: RobotText<'_>) -> Result<RobotSpec, RobotFileError> {
        let p = Lookup { source, list: self.parameters.list() };
        let robot = robot(&p)?.checked().map_err(|error| {
            let name = refused(&error);
            let key = KEYS.iter().find(|k| k.0 == name).map_or(name, |k| k.1);
            RobotFileError::Model { place: source.at(key), key: key.to_owned(), source: error }
        })?;
        for (n, effect) in self.effects.iter().enumerate() {
            inference::active(effect, "")
                .map_err(|error| RobotFileError::Effect { place: source.at_effect(n), message: nearest(&error) })?;
        }
        if let Some(response) = &self.response {
            response.checked().map_err(|error| RobotFileError::Effect {
                place: source.at("response"),
                message: nearest(&error.into()),
            })?;
        }
        let told = |(key, _, q): &(&'static str, _, Option<&Quantity>)| q.map(|q| (*key, q.source.clone()));
        Ok(RobotSpec {
            name: self.name.clone(),
            description: self.description.clone(),
            causality: self.causality,
            robot,
            effects: self.effects.clone(),
            response: self.response.clone(),
            sources: p.list.iter().filter_map(told).collect(),
            sigma: sigma(&p)?,
            pose_sigma: p.positive("pose_noise")?.map_or(USUAL_POSE_SIGMA, |v| v.0),
            torque_per_current: p
                .positive("torque_per_current")?
                .map(|(v, s)| [v, s.unwrap_or(USUAL_CURRENT_SIGMA * v)]),
        })
    }
}

/// What is wrong with an effect, with the nearest name.
fn nearest(error: &DiagnosisError) -> String {
    match error {
        DiagnosisError::NoSuchEffect { id } => {
            let known: Vec<&str> = robot_model::effects::catalogue::<f64>().iter().map(|e| e.spec().id).collect();
            match suggest::nearest(id, known) {
                Some(name) => format!("there is no effect `{id}`; did you mean `{name}`?"),
                None => format!("there is no effect `{id}`; `lacuna effects` lists them"),
            }
        }
        DiagnosisError::NoSuchParameter { effect, name, known } => {
            let known: Vec<&str> = known.split(", ").collect();
            format!("effect `{effect}` takes no number `{name}`, or not this one; {}", suggest::hint(name, &known))
        }
        DiagnosisError::Response(ResponseError::NoSuchConstant { name, known }) => {
            let known: Vec<&str> = known.split(", ").collect();
            format!("the response takes no number `{name}`, or not this one; {}", suggest::hint(name, &known))
        }
        other => other.to_string(),
    }
}

fn robot(p: &Lookup<'_>) -> Result<Robot<f64>, RobotFileError> {
    Ok(Robot {
        mass: p.need("mass")?,
        yaw_inertia: p.need("yaw_inertia")?,
        com: [p.or("com_x", 0.0)?, p.or("com_y", 0.0)?, p.need("com_height")?],
        half_wheelbase: 0.5 * p.need("wheelbase")?,
        half_track: 0.5 * p.need("track")?,
        wheel_radius: p.need("wheel_radius")?,
        wheel_inertia: p.need("wheel_inertia")?,
        motor_inertia: p.or("motor_inertia", 0.0)?,
        adhesion: p.need("adhesion")?,
        slip_at_peak: p.or("slip_at_peak", USUAL_SLIP_AT_PEAK)?,
        rest_speed: p.or("rest_speed", USUAL_REST_SPEED)?,
        sliding_share: p.or("sliding_share", USUAL_SLIDING_SHARE)?,
        lateral_factor: p.or("lateral_factor", 1.0)?,
        rolling_resistance: p.need("rolling_resistance")?,
        coulomb: sides(p, "coulomb", ["coulomb_left", "coulomb_right"])?,
        viscous: sides(p, "viscous", ["viscous_left", "viscous_right"])?,
        stribeck: p.or("stribeck", 0.0)?,
        hitch_x: p.or("hitch_x", -0.5 * p.need("wheelbase")?)?,
        drive: Drive {
            gain: p.or("torque_gain", 1.0)?,
            lag: p.or("motor_lag", 0.0)?,
            extra_lag: p.or("second_lag", 0.0)?,
            delay: p.or("motor_delay", 0.0)?,
            limit: p.or("torque_limit", NO_TORQUE_LIMIT)?,
            dead_band: p.or("dead_band", 0.0)?,
        },
        gravity: p.or("gravity", 9.81)?,
    })
}

/// Parameters whose spread is that of a tunable; the first that has one counts.
pub(crate) const fn keys(tunable: &'static str) -> [&'static str; 2] {
    match tunable.as_bytes() {
        b"coulomb_left" => ["coulomb_left", "coulomb"],
        b"coulomb_right" => ["coulomb_right", "coulomb"],
        b"viscous" => ["viscous", "viscous_left"],
        b"torque_constant" => ["torque_gain", "torque_per_current"],
        _ => [tunable, tunable],
    }
}

/// What both sides have, unless the file says it of one.
fn sides(p: &Lookup<'_>, both: &str, each: [&str; 2]) -> Result<[f64; 2], RobotFileError> {
    let both = p.or(both, 0.0)?;
    Ok([p.or(each[0], both)?, p.or(each[1], both)?])
}

/// One sigma of every tunable: the file's, or the usual one.
fn sigma(p: &Lookup<'_>) -> Result<[f64; robot_model::tunable::COUNT], RobotFileError> {
    let mut sigma = robot_model::tunable::usual_sigma();
    for (slot, t) in sigma.iter_mut().zip(tunables::<f64>()) {
        let mut given = None;
        for key in keys(t.id) {
            given = given.or(p.get(key)?.and_then(|(value, s)| Some((value, s?))));
        }
        let Some((value, s)) = given else { continue };
        *slot = if t.tuning == Tuning::Factor { s / value.abs().max(1e-12) } else { s };
    }
    Ok(sigma)
}
