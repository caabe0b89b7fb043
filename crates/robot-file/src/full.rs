//! The form of a robot file with value, unit, one sigma and source for each parameter.

use std::fmt;

use inference::KnownEffects;
use recordings::{Spot, parse_unit, suggest};
use robot_model::tunable::USUAL_POSE_SIGMA;
use robot_model::{Chassis, ModelError, Robot};
use serde::de::{Deserializer, Error as _, MapAccess, Visitor};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};

use crate::keys::{
    GEOMETRY, Given, KEYS, Key, NAMES, POSE_NOISE, TORQUE_PER_CURRENT, USUAL_GEOMETRY_SIGMA, is_constant, spreads,
};
use crate::text::RobotText;
use crate::{Causality, DiagnosisError, EffectAt, ResponseModel, RobotFileError, RobotSpec};

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
    /// What the robot stands on; four wheels if it says nothing, whether coupled by side or with a motor each.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) chassis: Option<Chassis>,
    pub(crate) parameters: Parameters,
    /// What the simulation is given beside its constants.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) effects: Vec<EffectAt>,
    /// Response to commands, of a command-driven robot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) response: Option<ResponseModel>,
}

/// The parameters of a file, each with its key.
#[derive(Debug)]
pub(crate) struct Parameters(pub(crate) Vec<(Key, Quantity)>);

impl Serialize for Parameters {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(key, quantity)| (key.name, quantity)))
    }
}

impl<'de> Deserialize<'de> for Key {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let known = KEYS.iter().find(|key| key.name == name);
        known.copied().ok_or_else(|| D::Error::unknown_field(&name, &NAMES))
    }
}

impl<'de> Deserialize<'de> for Parameters {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Table;

        impl<'de> Visitor<'de> for Table {
            type Value = Parameters;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a table of parameters")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Parameters, A::Error> {
                let mut out = Vec::new();
                while let Some(key) = map.next_key::<Key>()? {
                    if out.iter().any(|(other, _): &(Key, _)| other.name == key.name) {
                        return Err(A::Error::duplicate_field(key.name));
                    }
                    out.extend(map.next_value::<Option<Quantity>>()?.map(|quantity| (key, quantity)));
                }
                Ok(Parameters(out))
            }
        }

        deserializer.deserialize_map(Table)
    }
}

impl File {
    /// The robot of this file.
    pub(crate) fn spec(self, source: RobotText<'_>, known: KnownEffects) -> Result<RobotSpec, RobotFileError> {
        let given = self.parameters.0.iter().map(|p| in_key_unit(p, source)).collect::<Result<Vec<_>, _>>()?;
        let robot = robot(self.chassis.unwrap_or_default(), &given, source)?;
        let beside = |key: &str| given.iter().find(|g| g.key == key);
        for g in [TORQUE_PER_CURRENT, POSE_NOISE].into_iter().filter_map(beside) {
            if g.value <= 0.0 {
                return Err(bad(source, g.key, "the value", g.value, "larger than zero"));
            }
        }

        for (n, effect) in self.effects.iter().enumerate() {
            known.active(effect, "").map_err(|error| RobotFileError::Effect {
                place: source.at_effect(n),
                message: nearest(&error, known),
            })?;
            let spec = known.find(&effect.effect).map(robot_model::Effect::spec);
            if let Some(spec) = spec.ok().filter(|spec| !spec.is_of(robot.chassis)) {
                return Err(RobotFileError::Effect {
                    place: source.at_effect(n),
                    message: format!(
                        "effect `{}` is of {}, and this one has chassis = \"{}\"",
                        effect.effect,
                        spec.on(),
                        robot.chassis
                    ),
                });
            }
        }
        if let Some(response) = &self.response {
            response.checked().map_err(|error| RobotFileError::Effect {
                place: source.at("response"),
                message: nearest(&error.into(), known),
            })?;
        }

        Ok(RobotSpec {
            robot,
            is_chassis_stated: self.chassis.is_some(),
            sigma: spreads(&given),
            pose_sigma: beside(POSE_NOISE).map_or(USUAL_POSE_SIGMA, |g| g.value),
            torque_per_current: beside(TORQUE_PER_CURRENT)
                .map(|g| [g.value, g.sigma.unwrap_or(USUAL_CURRENT_SIGMA * g.value)]),
            geometry_sigma: GEOMETRY.map(|key| {
                let stated = beside(key).and_then(|g| Some(g.sigma? / g.value.abs()));
                stated.filter(|sigma| *sigma > 0.0).unwrap_or(USUAL_GEOMETRY_SIGMA)
            }),
            sources: self.parameters.0.into_iter().map(|(key, q)| (key.name, q.source)).collect(),
            name: self.name,
            description: self.description,
            causality: self.causality,
            effects: self.effects,
            known,
            response: self.response,
        })
    }
}

/// The robot of these constants.
fn robot(chassis: Chassis, given: &[Given], source: RobotText<'_>) -> Result<Robot<f64>, RobotFileError> {
    let constants = given.iter().filter(|g| is_constant(g.key)).map(|g| (g.key, g.value));
    Robot::on_chassis(chassis, &constants.collect::<Vec<_>>()).map_err(|error| match error {
        ModelError::Missing { name, unit } => {
            RobotFileError::Missing { place: Spot::file(source.file), key: name.to_owned(), expected: unit.to_owned() }
        }
        ModelError::Value { name, value, must } => {
            // A side may have its number from the key of both.
            let row = Robot::<f64>::CONSTANTS.iter().find(|row| row.id == name);
            let is_given = |key: &&str| given.iter().any(|g| g.key == *key);
            let key = [Some(name), row.and_then(|row| row.both)].into_iter().flatten().find(is_given).unwrap_or(name);
            RobotFileError::Model { place: source.at(key), key: key.to_owned(), value, must }
        }
        ModelError::Foreign { name, .. } | ModelError::Caster { name, .. } => {
            RobotFileError::Syntax { place: source.at(name), message: error.to_string() }
        }
        other => RobotFileError::Syntax { place: Spot::file(source.file), message: other.to_string() },
    })
}

/// A number in the unit of its key.
fn in_key_unit((key, q): &(Key, Quantity), source: RobotText<'_>) -> Result<Given, RobotFileError> {
    let Key { name, unit } = *key;
    let factor = factor(&q.unit, unit).ok_or_else(|| RobotFileError::Unit {
        place: source.at(name),
        key: name.to_owned(),
        unit: q.unit.clone(),
        expected: if unit == "-" { "`-` (no unit)".to_owned() } else { format!("`{unit}`") },
    })?;
    if !q.value.is_finite() {
        return Err(bad(source, name, "the value", q.value, "a finite number"));
    }
    if let Some(sigma) = q.sigma.filter(|s| !(s.is_finite() && *s > 0.0)) {
        return Err(bad(source, name, "the sigma", sigma, "larger than zero, or be left out"));
    }
    Ok(Given { key: name, value: q.value * factor, sigma: q.sigma.map(|s| s * factor) })
}

fn bad(source: RobotText<'_>, key: &str, what: &'static str, value: f64, must: &'static str) -> RobotFileError {
    RobotFileError::Value { place: source.at(key), key: key.to_owned(), what, value, must }
}

/// A compound unit without the marks that people write differently.
fn bare(unit: &str) -> String {
    let plain: String =
        unit.chars().filter(|c| !" ·*.^".contains(*c)).map(|c| if c == '²' { '2' } else { c }).collect();
    if plain == "1" { "-".to_owned() } else { plain }
}

/// What a number in `unit` is multiplied with to get one in `expected`; `None` when it is of another quantity. A unit that
/// no recording has is taken as it is.
fn factor(unit: &str, expected: &str) -> Option<f64> {
    let Some(wanted) = parse_unit(expected).filter(|_| expected != "-") else {
        return (bare(unit) == bare(expected)).then_some(1.0);
    };
    let given = parse_unit(&unit.replace('²', "2"))?;
    (given.unit == wanted.unit).then_some(given.factor / wanted.factor)
}

/// What is wrong with an effect, with the nearest name.
fn nearest(error: &DiagnosisError, known: KnownEffects) -> String {
    match error {
        DiagnosisError::NoSuchEffect { id } => {
            let known: Vec<&str> = known.all().map(|e| e.spec().id).collect();
            match suggest::nearest(id, known) {
                Some(name) => format!("there is no effect `{id}`; did you mean `{name}`?"),
                None => format!(
                    "there is no effect `{id}`; `lacuna effects` lists them, and one of a law file is there with --effects \
                     or --adopt {id}.toml"
                ),
            }
        }
        DiagnosisError::NoSuchParameter { effect, name, known } => {
            let known: Vec<&str> = known.split(", ").collect();
            format!("effect `{effect}` takes no number `{name}`, or not this one; {}", suggest::hint(name, &known))
        }
        DiagnosisError::Response(verdict::ResponseError::NoSuchConstant { name, known }) => {
            let known: Vec<&str> = known.split(", ").collect();
            format!("the response takes no number `{name}`, or not this one; {}", suggest::hint(name, &known))
        }
        other => other.to_string(),
    }
}
