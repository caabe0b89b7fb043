//! Whether gyro and encoder show one share of what they measure, whatever its size.

use hierarchical_fit::{Kind, Observed as _, Solved, UnevenSensor};
use inference::robust::median;

use crate::model::Laws;
use crate::rows::Shown;
use crate::settings::{SETTINGS, Sensors};

const RULES: Sensors = SETTINGS.sensors;

/// What a sensor should show at an instant by pose and laws, what it shows, and what it should show just before and after: as large, but
/// with other errors of the pose.
#[derive(Debug, Clone, Copy)]
struct Reading {
    should: f64,
    shown: f64,
    beside: f64,
}

impl Shown<'_> {
    /// Readings of a sensor in motion.
    fn beside_pose(&self, laws: &Laws, kind: Kind) -> Vec<Reading> {
        let errors = self.rows.iter().zip(self.errors_of(laws)).filter(|(row, _)| row.kind != Kind::Pose);
        let of_kind = errors.zip(self.shown_by_sensors()).filter(|((row, error), _)| {
            // No error is none where the pose says nothing.
            row.kind == kind && row.is_moving && *error != 0.0
        });
        let pairs: Vec<[f64; 2]> = of_kind.map(|((_, error), shown)| [shown + error, shown]).collect();
        let apart = self.apart(kind);
        let of = |k: usize| Reading {
            should: pairs[k][0],
            shown: pairs[k][1],
            beside: 0.5 * (pairs[k - apart][0] + pairs[k + apart][0]),
        };
        (apart..pairs.len().saturating_sub(apart)).map(of).collect()
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
        let readings: Vec<Reading> = drives.flat_map(|drive| drive.beside_pose(&laws, kind)).collect();
        let (limit, [small, large]) = shares(&readings)?;
        let is_uneven = (large / small).ln().abs() > RULES.uneven.ln_1p();
        is_uneven.then_some(UnevenSensor { sensor, quantity, unit, limit, small, large })
    })
}

/// The median size of what should be shown, and the shares of it that are shown below and above; `None` of too few readings.
///
/// Sizes and shares are taken along what should be shown beside each reading (an instrumental variable, Söderström & Stoica): along the
/// reading's own, errors of the pose would make small sizes larger than they are, and their share smaller.
fn shares(readings: &[Reading]) -> Option<(f64, [f64; 2])> {
    if readings.len() < RULES.least {
        return None;
    }
    let limit = median(readings.iter().map(|r| r.beside.abs()))?;
    let share = |is_large: bool| {
        let half = || readings.iter().filter(|r| (r.beside.abs() > limit) == is_large);
        let along = |of: &dyn Fn(&Reading) -> f64| half().map(|r| r.beside * of(r)).sum::<f64>();
        let (size, share) = (along(&|r| r.should), along(&|r| r.shown) / along(&|r| r.should));
        // Sizes that change at once, or that errors of the pose drown, tell nothing.
        let is_told = size > RULES.reliable * along(&|r| r.beside);
        (is_told && share.is_finite() && share > 0.0).then_some(share)
    };
    Some((limit, [share(false)?, share(true)?]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn readings(of: &dyn Fn(f64) -> f64, noise: f64) -> Vec<Reading> {
        let error = |k: i32| noise * (0.37 * f64::from(k * k)).sin();
        let sizes = (0..400).map(|k| (k, 0.01 * f64::from(k)));
        let reading = |(k, v)| Reading { should: v + error(k), shown: of(v), beside: v + error(k + 1000) };
        sizes.map(reading).collect()
    }

    #[test]
    fn a_sensor_that_reaches_its_end_shows_less_of_large_sizes_and_a_scale_shows_one_share() {
        let (limit, [small, large]) = shares(&readings(&|v| v.min(2.0), 0.0)).expect("enough rows");
        assert!((limit - 2.0).abs() < 0.02 && (small - 1.0).abs() < 1e-9 && large < 0.75, "{limit} {small} {large}");
        let (_, [small, large]) = shares(&readings(&|v| 0.9 * v, 0.0)).expect("enough rows");
        assert!((small - large).abs() < 1e-9);
        assert_eq!(shares(&readings(&|v| v, 0.0)[..RULES.least - 1]), None);
    }

    #[test]
    fn errors_of_the_pose_make_no_sensor_show_less_of_small_sizes() {
        // Nothing is told of sizes that errors drown.
        assert_eq!(shares(&readings(&|v| v, 20.0)), None);
        // Small sizes are 0 to 2, with errors of 0.6 that no reading shares with those beside it.
        let (_, [small, large]) = shares(&readings(&|v| v, 1.0)).expect("enough rows");
        assert!((small / large - 1.0).abs() < 0.05, "{small} {large}");
    }
}
