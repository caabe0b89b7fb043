//! What logs of the user's simulator say of its robot.

use serde::{Deserialize, Serialize};

use crate::Retuned;

/// Most constants that a sentence names.
const NAMED: usize = 4;

/// Constants with which the user's simulator behaves otherwise than the robot file says, by its own logs.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SimulatorConstants {
    /// They, from the file's value to the simulator's; none where it behaves as the file says.
    pub constants: Vec<Retuned>,
    /// Where one constant explains the logs: others, each alone, that the logs do not tell from it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub or: Vec<Retuned>,
    /// Whether only all of them together behave as the simulator does, so that none of them is known by itself.
    #[serde(default)]
    pub only_together: bool,
}

impl SimulatorConstants {
    /// For people, one sentence each.
    pub fn sentences(&self) -> Vec<String> {
        let list = |constants: &[Retuned], word: fn(&Retuned) -> String, between: &str| {
            constants.iter().take(NAMED).map(word).collect::<Vec<_>>().join(between)
        };
        if self.only_together && !self.constants.is_empty() {
            let more = self.constants.len().saturating_sub(NAMED);
            let more = if more > 0 { format!("; and {more} more") } else { String::new() };
            return vec![format!(
                "Your simulator does not behave as your robot file says, and no constant alone explains how. Together these \
                 behave like it, but its logs do not tell what each of them is: {}{more}.",
                list(&self.constants, Retuned::values, "; ")
            )];
        }
        let one = |constant: &Retuned| format!("{}.", constant.of_simulator());
        let mut out: Vec<String> = self.constants.iter().map(one).collect();
        if !self.or.is_empty() {
            out.push(format!(
                "Its logs do not tell this from another constant alone: {}.",
                list(&self.or, Retuned::change, "; or ")
            ));
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn constant(name: &str, from: f64, to: f64) -> Retuned {
        let half_width = 0.05 * to;
        Retuned { constant: name.to_owned(), unit: "-".to_owned(), from, to, half_width, sigmas: 5.0 }
    }

    #[test]
    fn one_constant_is_told_with_those_that_explain_as_well_and_several_only_together() {
        let one = SimulatorConstants {
            constants: vec![constant("adhesion", 0.5, 0.6)],
            or: vec![constant("torque_constant", 1.0, 0.9)],
            only_together: false,
        };
        let [first, second] = &one.sentences()[..] else { panic!("{:?}", one.sentences()) };
        assert!(
            first.starts_with("Your robot file says adhesion 0.500, but your simulator behaves like 0.600"),
            "{first}"
        );
        assert!(second.contains("from another constant alone: torque constant from 1.000 to 0.900"), "{second}");

        let several = SimulatorConstants { only_together: true, ..one };
        let [only] = &several.sentences()[..] else { panic!("{:?}", several.sentences()) };
        assert!(only.contains("Together these behave like it") && !only.contains("correct the file"), "{only}");
        assert!(SimulatorConstants::default().sentences().is_empty());
    }

    #[test]
    fn of_constants_that_only_explain_together_four_are_named_and_the_rest_is_counted() {
        let told = |names: &[&str]| {
            let constants = names.iter().map(|name| constant(name, 1.0, 2.0)).collect();
            let together = SimulatorConstants { constants, or: Vec::new(), only_together: true };
            together.sentences().concat()
        };
        let four = told(&["mass", "adhesion", "lag", "backlash"]);
        let list = ["mass", "adhesion", "lag", "backlash"].map(|name| format!("{name} from 1.00 to 2.00")).join("; ");
        assert!(four.ends_with(&format!(": {list}.")), "{four}");
        let six = told(&["mass", "adhesion", "lag", "backlash", "voltage", "radius"]);
        assert!(six.ends_with(&format!(": {list}; and 2 more.")), "{six}");
    }
}
