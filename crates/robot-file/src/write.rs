//! Robot files that are written: every constant with its spread and where it comes from, and the effects.

use std::collections::BTreeMap;

use inference::Corrected as _;
use robot_model::constants::{NO_LIMIT, Usual};
use robot_model::tunable::{Tunable, Tuning, USUAL_POSE_SIGMA, tunables};
use robot_model::{Chassis, Robot};
use verdict::Correction;

use crate::full::{File, Parameters, Quantity};
use crate::keys::{GEOMETRY, KEYS, POSE_NOISE, TORQUE_PER_CURRENT, USUAL_GEOMETRY_SIGMA, keys_of};
use crate::{DiagnosisError, RobotFileError, RobotSpec};

/// What a parameter without a source came from.
const UNTOLD: &str = "robot file";

impl RobotSpec {
    /// The robot as a diagnosis would have it: constants re-tuned, effects added.
    ///
    /// # Errors
    /// When the correction names what is not known, or makes a robot that cannot be.
    pub fn corrected(&self, correction: &Correction) -> Result<Self, DiagnosisError> {
        let robot = correction.robot(&self.robot)?;
        let is_chassis_stated = self.is_chassis_stated || correction.has_four_motors;
        let mut out = Self { robot, is_chassis_stated, ..self.clone() };
        out.effects.extend(correction.effects.iter().cloned());
        out.response = correction.response.clone().or(out.response);

        let (before, after) = (values(self), values(&out));
        for (key, value) in &after {
            let was = before.get(key).copied().unwrap_or_default();
            if was != *value {
                let how = format!("re-tuned by lacuna from {was:.6}; before: {}", self.source(key));
                out.sources.insert(key, how);
            }
        }
        Ok(out)
    }

    /// The robot as a robot file in TOML.
    ///
    /// # Errors
    /// When a number cannot be written.
    pub fn to_toml(&self) -> Result<String, RobotFileError> {
        let unwritable = |e: toml::ser::Error| RobotFileError::Unwritable { form: "TOML", reason: e.to_string() };
        toml::to_string(&self.file()).map_err(unwritable)
    }

    /// The robot as a robot file in JSON.
    ///
    /// # Errors
    /// When a number cannot be written.
    pub fn to_json(&self) -> Result<serde_json::Value, RobotFileError> {
        let unwritable = |e: serde_json::Error| RobotFileError::Unwritable { form: "JSON", reason: e.to_string() };
        serde_json::to_value(self.file()).map_err(unwritable)
    }

    fn source(&self, key: &str) -> &str {
        self.sources.get(key).map_or(UNTOLD, String::as_str)
    }

    fn file(&self) -> File {
        let values = values(self);
        let quantity = |key: &str, unit: &str| {
            let value = *values.get(key)?;
            let (unit, source) = (unit.to_owned(), self.source(key).to_owned());
            Some(Quantity { value, unit, sigma: self.sigma_of(key, value), source })
        };
        File {
            name: self.name.clone(),
            description: self.description.clone(),
            causality: self.causality,
            chassis: Some(self.robot.chassis).filter(|on| self.is_chassis_stated || *on != Chassis::default()),
            parameters: Parameters(KEYS.iter().filter_map(|key| Some((*key, quantity(key.name, key.unit)?))).collect()),
            effects: self.effects.clone(),
            response: self.response.clone(),
        }
    }

    /// The spread of a parameter, where it is not the usual one.
    fn sigma_of(&self, key: &str, value: f64) -> Option<f64> {
        if let Some([_, sigma]) = self.torque_per_current.filter(|_| key == TORQUE_PER_CURRENT) {
            return Some(sigma);
        }
        if let Some(k) = GEOMETRY.iter().position(|g| *g == key) {
            let sigma = self.geometry_sigma[k];
            return (sigma != USUAL_GEOMETRY_SIGMA).then_some(sigma * value.abs());
        }
        let is_under = |t: &Tunable<f64>| keys_of(t).first() == Some(&key);
        let (tunable, sigma) = tunables::<f64>().into_iter().zip(self.sigma).find(|(t, _)| is_under(t))?;
        let sigma = if tunable.tuning == Tuning::Factor { sigma * value.abs() } else { sigma };
        (sigma > 0.0).then_some(sigma)
    }
}

/// Every parameter that a file of this robot names, by name, in the unit that the file gives it.
fn values(spec: &RobotSpec) -> BTreeMap<&'static str, f64> {
    let mut out = BTreeMap::new();
    for constant in Robot::<f64>::CONSTANTS.iter().filter(|c| c.is_of(spec.robot.chassis)) {
        let value = (constant.get)(&spec.robot);
        let is_no_limit = constant.usual == Usual::Unlimited && value >= NO_LIMIT;
        // Under the key of both sides stands the left one, beside which the right one is told where it is another.
        let as_both = constant.both.is_some_and(|both| out.get(both) == Some(&value));
        if !is_no_limit && !as_both {
            let key = constant.tuning.as_ref().and_then(|t| keys_of(t).first().copied());
            out.insert(key.unwrap_or(constant.id), value);
        }
    }
    out.extend(spec.torque_per_current.map(|[value, _]| (TORQUE_PER_CURRENT, value)));
    out.extend((spec.pose_sigma != USUAL_POSE_SIGMA).then_some((POSE_NOISE, spec.pose_sigma)));
    out
}

#[cfg(test)]
mod tests {
    use verdict::{Correction, EffectAt, Side};
    use verdict::{ResponseModel, Scaling};

    use crate::{BUILT_IN, RobotSpec};

    fn correction() -> Correction {
        let brake = EffectAt {
            effect: "coulomb_side".to_owned(),
            values: [("Tb".to_owned(), 1.25)].into(),
            side: Some(Side::Left),
            from: [("run_1".to_owned(), 2.5)].into(),
            absent: vec!["run_2".to_owned()],
            ..EffectAt::default()
        };
        Correction {
            has_four_motors: false,
            tuning: [("coulomb_right".to_owned(), 0.1), ("com_y".to_owned(), 0.002)].into(),
            effects: vec![brake],
            response: Some(ResponseModel {
                scaling: Scaling::TurnFirst,
                constants: [("dead_time".to_owned(), 0.25), ("track_factor".to_owned(), 1.5)].into(),
                ..ResponseModel::default()
            }),
        }
    }

    #[test]
    fn a_robot_that_was_written_reads_back_the_same() {
        for (name, _) in BUILT_IN {
            let plain = RobotSpec::built_in(name).expect("built in");
            for robot in [plain.corrected(&correction()).expect("a robot"), plain] {
                let toml = robot.to_toml().expect("TOML");
                let json = robot.to_json().expect("JSON").to_string();
                for again in [RobotSpec::parse("a.toml", &toml), RobotSpec::parse("a.json", &json)] {
                    let again = again.unwrap_or_else(|e| panic!("{e}\n{toml}"));
                    assert_eq!(
                        (&again.robot, &again.effects, &again.response, again.causality),
                        (&robot.robot, &robot.effects, &robot.response, robot.causality)
                    );
                    assert_eq!((&again.name, again.torque_per_current), (&robot.name, robot.torque_per_current));
                    for (a, b) in again.sigma.iter().zip(robot.sigma) {
                        approx::assert_relative_eq!(*a, b, max_relative = 1e-12);
                    }
                }
            }
        }
    }

    #[test]
    fn what_was_re_tuned_says_so_and_what_was_not_keeps_its_source() {
        let plain = RobotSpec::built_in("husky-a200").expect("built in");
        let robot = plain.corrected(&correction()).expect("a robot");
        assert!(
            robot.sources["coulomb_right"].starts_with("re-tuned by lacuna from 3.0"),
            "{}",
            robot.sources["coulomb_right"]
        );
        assert_eq!(robot.sources["mass"], plain.sources["mass"]);
    }

    #[test]
    fn a_wrong_effect_is_refused_with_its_line_and_the_nearest_name() {
        let robot = RobotSpec::built_in("husky-a200").expect("built in").corrected(&correction()).expect("a robot");
        let toml = robot.to_toml().expect("TOML");
        let line = 1 + toml.lines().position(|l| l.starts_with("effect = ")).expect("an effect");
        let wrong = toml.replace("coulomb_side", "coulomb_sides");
        let e = RobotSpec::parse("r.toml", &wrong).expect_err("refused").to_string();
        assert_eq!(
            e,
            format!("r.toml: line {line}, column 1: there is no effect `coulomb_sides`; did you mean `coulomb_side`?")
        );
        let wrong = toml.replace("Tb = 1.25", "Tc = 1.25");
        let e = RobotSpec::parse("r.toml", &wrong).expect_err("refused").to_string();
        assert!(e.contains("takes no number `Tc`") && e.contains("Tb"), "{e}");
    }

    #[test]
    fn a_verdict_in_the_place_of_a_robot_file_is_told_with_the_way_to_its_robot() {
        let e = RobotSpec::parse("v.json", "{ \"format\": 4, \"diagnosis\": {} }").expect_err("refused").to_string();
        assert!(e.contains("verdict") && e.contains("lacuna export v.json --to toml -o robot.toml"), "{e}");
    }
}
