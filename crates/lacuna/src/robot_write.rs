//! Robot files that are written: every constant with its spread and where it comes from, and the effects.

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use inference::Corrected as _;
use robot_model::Robot;
use robot_model::tunable::{Tuning, tunables};
use verdict::Correction;

use crate::RobotSpec;
use crate::robot_file::USUAL_POSE_SIGMA;
use crate::robot_parameters::{File, NO_TORQUE_LIMIT, Parameters, Quantity, keys};

/// What a parameter without a source came from.
const UNTOLD: &str = "robot file";

impl RobotSpec {
    /// The robot as a diagnosis would have it: constants re-tuned, effects added.
    ///
    /// # Errors
    /// When the correction names what is not known, or makes a robot that cannot be.
    pub fn corrected(&self, correction: &Correction) -> Result<Self> {
        let mut out = Self { robot: correction.robot(&self.robot)?, ..self.clone() };
        out.effects.extend(correction.effects.iter().cloned());
        out.response = correction.response.clone().or(out.response);
        let (before, after) = (constants(self), constants(&out));
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
    pub fn to_toml(&self) -> Result<String> {
        toml::to_string(&self.file()).context("a robot that cannot be written as TOML")
    }

    /// The robot as a robot file in JSON.
    ///
    /// # Errors
    /// When a number cannot be written.
    pub fn to_json(&self) -> Result<serde_json::Value> {
        serde_json::to_value(self.file()).context("a robot that cannot be written as JSON")
    }

    fn source(&self, key: &str) -> &str {
        self.sources.get(key).map_or(UNTOLD, String::as_str)
    }

    fn file(&self) -> File {
        let values = constants(self);
        let quantity = |key: &'static str, unit: &'static str| {
            let value = *values.get(key)?;
            let source = self.source(key).to_owned();
            Some(Quantity { value, unit: unit.to_owned(), sigma: self.sigma_of(key, value), source })
        };
        File {
            name: self.name.clone(),
            description: self.description.clone(),
            causality: self.causality,
            parameters: Parameters::make(quantity),
            effects: self.effects.clone(),
            response: self.response.clone(),
        }
    }

    /// The spread of a parameter, where it is not the usual one.
    fn sigma_of(&self, key: &str, value: f64) -> Option<f64> {
        if let Some([_, sigma]) = self.torque_per_current.filter(|_| key == "torque_per_current") {
            return Some(sigma);
        }
        let (tunable, sigma) = tunables::<f64>().into_iter().zip(self.sigma).find(|(t, _)| keys(t.id)[0] == key)?;
        let sigma = if tunable.tuning == Tuning::Factor { sigma * value.abs() } else { sigma };
        (sigma > 0.0).then_some(sigma)
    }
}

/// Every parameter that a file of this robot names, by name, in the unit that the file gives it.
fn constants(spec: &RobotSpec) -> BTreeMap<&'static str, f64> {
    let Robot { drive, .. } = &spec.robot;
    let r = &spec.robot;
    let mut out = BTreeMap::from([
        ("mass", r.mass),
        ("yaw_inertia", r.yaw_inertia),
        ("com_x", r.com[0]),
        ("com_y", r.com[1]),
        ("com_height", r.com[2]),
        ("wheelbase", 2.0 * r.half_wheelbase),
        ("track", 2.0 * r.half_track),
        ("wheel_radius", r.wheel_radius),
        ("wheel_inertia", r.wheel_inertia),
        ("motor_inertia", r.motor_inertia),
        ("adhesion", r.adhesion),
        ("slip_at_peak", r.slip_at_peak),
        ("sliding_share", r.sliding_share),
        ("rest_speed", r.rest_speed),
        ("lateral_factor", r.lateral_factor),
        ("rolling_resistance", r.rolling_resistance),
        ("coulomb_left", r.coulomb[0]),
        ("coulomb_right", r.coulomb[1]),
        ("viscous", r.viscous[0]),
        ("stribeck", r.stribeck),
        ("hitch_x", r.hitch_x),
        ("torque_gain", drive.gain),
        ("motor_delay", drive.delay),
        ("motor_lag", drive.lag),
        ("second_lag", drive.extra_lag),
        ("dead_band", drive.dead_band),
        ("gravity", r.gravity),
    ]);
    let perhaps = [
        ("viscous_right", (r.viscous[1] != r.viscous[0]).then_some(r.viscous[1])),
        ("torque_limit", (drive.limit < NO_TORQUE_LIMIT).then_some(drive.limit)),
        ("torque_per_current", spec.torque_per_current.map(|t| t[0])),
        ("pose_noise", (spec.pose_sigma != USUAL_POSE_SIGMA).then_some(spec.pose_sigma)),
    ];
    out.extend(perhaps.into_iter().filter_map(|(key, value)| Some((key, value?))));
    out
}

#[cfg(test)]
mod tests {
    use verdict::{Correction, EffectAt, Side};
    use verdict::{ResponseModel, Scaling};

    use crate::RobotSpec;
    use crate::robot_file::BUILT_IN;

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
}
