//! Constants of the robot file that the recordings want elsewhere.

use serde::{Deserialize, Serialize};

/// A constant that explains better than at its value in the robot file, or since the references.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Retuned {
    /// Its name, as in robot files.
    pub constant: String,
    /// Its unit; "-" when it has none.
    pub unit: String,
    /// Value that the robot file, or the references, have.
    pub from: f64,
    /// Value that these recordings want.
    pub to: f64,
    /// Half width of the 90 % interval of that value.
    pub half_width: f64,
    /// How far it moved, in its sigmas: of the robot file, or the usual one.
    pub sigmas: f64,
}

impl Retuned {
    /// For people: "adhesion from 0.600 to 0.510 ± 0.020 (90 %), which is 1.3 times its sigma (of the robot file, or the usual one)".
    pub fn sentence(&self) -> String {
        format!(
            "{}, which is {:.1} times its sigma (of the robot file, or the usual one)",
            self.change(),
            self.sigmas.abs()
        )
    }

    /// "adhesion from 0.600 to 0.510 ± 0.020 (90 %)"
    pub fn change(&self) -> String {
        let digits = self.digits();
        let name = self.constant.replace('_', " ");
        format!("{name} from {:.digits$}{} to {}", self.from, self.unit(), self.now())
    }

    /// "adhesion from 0.600 to 0.510", of a constant that is not known by itself.
    pub fn values(&self) -> String {
        // Without an interval, no more than shows a hundredth of the move.
        let least = 0.01 * (self.to - self.from).abs();
        let (digits, unit) = (places(self.half_width.max(least)), self.unit());
        let name = self.constant.replace('_', " ");
        format!("{name} from {:.digits$}{unit} to {:.digits$}{unit}", self.from, self.to)
    }

    /// The same of a simulator: "Your robot file says mass 22.00 kg, but your simulator behaves like 24.10 ± 0.05 kg".
    pub fn of_simulator(&self) -> String {
        let digits = self.digits();
        format!(
            "Your robot file says {} {:.digits$}{}, but your simulator behaves like {}: correct the file, or the simulator",
            self.constant.replace('_', " "),
            self.from,
            self.unit(),
            self.now()
        )
    }

    /// "0.510 ± 0.020 (90 %)"
    fn now(&self) -> String {
        let digits = self.digits();
        format!("{:.digits$} ± {:.digits$}{} (90 %)", self.to, self.half_width, self.unit())
    }

    fn unit(&self) -> String {
        if self.unit == "-" { String::new() } else { format!(" {}", self.unit) }
    }

    /// Decimal places that show two digits of the interval.
    fn digits(&self) -> usize {
        places(self.half_width)
    }
}

/// Decimal places that show two digits of a number.
fn places(x: f64) -> usize {
    (1.0 - x.abs().max(1e-9).log10().floor()).clamp(0.0, 6.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_re_tuning_is_reported_with_both_values_its_interval_and_its_sigmas() {
        let retuned = Retuned {
            constant: "rolling_resistance".to_owned(),
            unit: "-".to_owned(),
            from: 0.02,
            to: 0.0261,
            half_width: 0.0012,
            sigmas: 2.04,
        };
        let text = "rolling resistance from 0.0200 to 0.0261 ± 0.0012 (90 %), which is 2.0 times its sigma (of the robot \
                    file, or the usual one)";
        assert_eq!(retuned.sentence(), text);
        let mass = Retuned {
            constant: "mass".to_owned(),
            unit: "kg".to_owned(),
            from: 22.0,
            to: 24.1,
            half_width: 0.3,
            sigmas: 9.5,
        };
        let text = "Your robot file says mass 22.00 kg, but your simulator behaves like 24.10 ± 0.30 kg (90 %): correct the \
                    file, or the simulator";
        assert_eq!(mass.of_simulator(), text);
    }

    #[test]
    fn a_constant_that_is_not_known_by_itself_is_told_without_an_interval() {
        let mut track = Retuned {
            constant: "half_track".to_owned(),
            unit: "m".to_owned(),
            from: 0.2,
            to: 0.2468,
            half_width: 0.03,
            sigmas: 3.0,
        };
        assert_eq!(track.values(), "half track from 0.200 m to 0.247 m");
        track.unit = "-".to_owned();
        assert_eq!(track.values(), "half track from 0.200 to 0.247");
    }
}
