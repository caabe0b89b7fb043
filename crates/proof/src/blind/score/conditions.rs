//! What a case was recorded under, and the strata that figures are told for.

use examiner::Settings;
use serde::Serialize;

/// Robot, sensors and visit of a case.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[expect(clippy::struct_excessive_bools, reason = "sensors and laws that are there or not")]
pub(in crate::blind) struct Conditions {
    /// Middle of the mass, kg, where the size of the robot was drawn.
    pub(in crate::blind) mass_kg: Option<f64>,
    pub(in crate::blind) rows_per_second: f64,
    pub(in crate::blind) duration_s: f64,
    pub(in crate::blind) references: usize,
    /// Sigmas of the robot file by which constants moved at most.
    pub(in crate::blind) moved: f64,
    pub(in crate::blind) pose: bool,
    pub(in crate::blind) accelerometer: bool,
    pub(in crate::blind) heavy_tails: bool,
    pub(in crate::blind) other_laws: bool,
}

/// A part of the cases by what they were recorded under.
pub(in crate::blind) struct Stratum {
    pub(in crate::blind) name: &'static str,
    pub(in crate::blind) holds: fn(&Conditions) -> bool,
}

/// Parts of a wide set, in the order of the page.
pub(in crate::blind) const STRATA: [Stratum; 19] = [
    Stratum { name: "5 to 15 kg", holds: |c| c.mass_kg.is_some_and(|m| m < 15.0) },
    Stratum { name: "15 to 45 kg", holds: |c| c.mass_kg.is_some_and(|m| (15.0..45.0).contains(&m)) },
    Stratum { name: "45 to 120 kg", holds: |c| c.mass_kg.is_some_and(|m| (45.0..120.0).contains(&m)) },
    Stratum { name: "120 to 300 kg", holds: |c| c.mass_kg.is_some_and(|m| m >= 120.0) },
    Stratum { name: "20 and 50 rows/s", holds: |c| c.rows_per_second < 75.0 },
    Stratum { name: "100 and 200 rows/s", holds: |c| (75.0..300.0).contains(&c.rows_per_second) },
    Stratum { name: "500 and 1000 rows/s", holds: |c| c.rows_per_second > 300.0 },
    Stratum { name: "no reference", holds: |c| c.references == 0 },
    Stratum { name: "1 reference", holds: |c| c.references == 1 },
    Stratum { name: "2 to 4 references", holds: |c| (2..=4).contains(&c.references) },
    Stratum { name: "6 and 10 references", holds: |c| c.references > 4 },
    Stratum { name: "constants stayed", holds: |c| c.references > 0 && c.moved == 0.0 },
    Stratum { name: "constants moved by up to 0.3 sigma", holds: |c| c.moved > 0.0 && c.moved < 0.5 },
    Stratum { name: "constants moved by up to 1 sigma", holds: |c| c.moved > 0.5 },
    Stratum { name: "no pose", holds: |c| !c.pose },
    Stratum { name: "no accelerometer", holds: |c| !c.accelerometer },
    Stratum { name: "heavy tails", holds: |c| c.heavy_tails },
    Stratum { name: "laws by another hand", holds: |c| c.other_laws },
    Stratum { name: "60 s", holds: |c| c.duration_s > 50.0 },
];

impl Conditions {
    pub(super) fn of(settings: &Settings) -> Self {
        Self {
            mass_kg: settings.mass_kg,
            rows_per_second: settings.row_rate_hz,
            duration_s: settings.duration_s,
            references: settings.references,
            moved: settings.moved,
            pose: settings.pose,
            accelerometer: settings.accelerometer,
            heavy_tails: settings.heavy_tails,
            other_laws: settings.other_laws,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Conditions, STRATA};

    #[test]
    fn strata_of_one_question_share_out_all_cases() {
        for plan in examiner::wide(3, 200) {
            let conditions = Conditions::of(&plan.settings);
            for questions in [0..4, 4..7, 7..11] {
                let holding = STRATA[questions].iter().filter(|s| (s.holds)(&conditions)).count();
                assert_eq!(holding, 1, "{conditions:?}");
            }
        }
    }
}
