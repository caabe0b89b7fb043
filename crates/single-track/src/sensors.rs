//! Whether gyro and encoder show one share of what they measure, whatever its size.

use hierarchical_fit::{Kind, Solved, UnevenSensor};
use inference::robust::median;

use crate::model::Laws;
use crate::rows::Shown;
use crate::settings::{SETTINGS, Sensors};

const RULES: Sensors = SETTINGS.sensors;

impl Shown<'_> {
    /// What a sensor should show by pose and laws, and what it shows, of rows in motion.
    fn beside_pose(&self, laws: &Laws, kind: Kind) -> Vec<[f64; 2]> {
        let errors = self.rows.iter().zip(self.errors_of(laws)).filter(|(row, _)| row.kind != Kind::Pose);
        let of_kind = errors.zip(self.shown_by_sensors()).filter(|((row, error), _)| {
            // No error is none where the pose says nothing.
            row.kind == kind && row.is_moving && *error != 0.0
        });
        of_kind.map(|((_, error), shown)| [shown + error, shown]).collect()
    }
}

/// The sensor that shows another share of small sizes than of large ones, by the constants of the answer but for scales.
pub(crate) fn uneven(solved: &Solved<Shown<'_>>) -> Option<UnevenSensor> {
    if solved.onset.is_some() {
        return None;
    }
    let fitted = Laws::at(&solved.data.model, solved.corrected_from_now_on());
    let laws = Laws { encoder_scale: 1.0, gyro_scale: 1.0, ..fitted };
    let named = [(Kind::Encoder, "encoder", "speed", "m/s"), (Kind::Gyro, "gyro", "yaw rate", "rad/s")];
    named.into_iter().find_map(|(kind, sensor, quantity, unit)| {
        let drives = solved.data.drives.iter().filter(|drive| drive.drive.has_pose());
        let pairs: Vec<[f64; 2]> = drives.flat_map(|drive| drive.beside_pose(&laws, kind)).collect();
        let (limit, [small, large]) = shares(&pairs)?;
        let is_uneven = (large / small).ln().abs() > RULES.uneven.ln_1p();
        is_uneven.then_some(UnevenSensor { sensor, quantity, unit, limit, small, large })
    })
}

/// The median size of what should be shown, and the shares of it that are shown below and above; `None` of too few rows.
fn shares(pairs: &[[f64; 2]]) -> Option<(f64, [f64; 2])> {
    if pairs.len() < RULES.least {
        return None;
    }
    let limit = median(pairs.iter().map(|[should, _]| should.abs()))?;
    let share = |is_large: bool| {
        let half = || pairs.iter().filter(|[should, _]| (should.abs() > limit) == is_large);
        let squares: f64 = half().map(|[should, _]| should * should).sum();
        let share = half().map(|[should, shown]| should * shown).sum::<f64>() / squares;
        (share.is_finite() && share > 0.0).then_some(share)
    };
    Some((limit, [share(false)?, share(true)?]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sensor_that_reaches_its_end_shows_less_of_large_sizes_and_a_scale_shows_one_share() {
        let pairs = |of: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
            (0..400).map(|k| 0.01 * f64::from(k)).map(|v| [v, of(v)]).collect()
        };
        let (limit, [small, large]) = shares(&pairs(&|v| v.min(2.0))).expect("enough rows");
        assert!((limit - 2.0).abs() < 0.02 && (small - 1.0).abs() < 1e-9 && large < 0.75, "{limit} {small} {large}");
        let (_, [small, large]) = shares(&pairs(&|v| 0.9 * v)).expect("enough rows");
        assert!((small - large).abs() < 1e-9);
        assert_eq!(shares(&pairs(&|v| v)[..RULES.least - 1]), None);
    }
}
