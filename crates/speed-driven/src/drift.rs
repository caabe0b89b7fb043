//! A side whose wheels roll as if they had another radius: the body turns while both sides turn alike.
//!
//! The drift is measured with the effective track of the same recording, so that no law of tyres is asked for its size. What such
//! wheels do to the loads the plant says, and which side it is: as much less on the one is as much more on the other.

use inference::hypothesis::{Dose, Place, Variant, variants};
use inference::robust::NINETY;
use robot_model::effects::wheel_radius_mismatch;
use verdict::{Quantity, SideDrift};

use crate::compare::scatter;
use crate::name::Difference;
use crate::settings::{MEASURING, NAMING};

/// Drift of a robot with these effects; one whose sides are alike goes straight.
pub(crate) fn of_doses(doses: &[Dose]) -> f64 {
    let of_radius = doses.iter().filter(|dose| dose.effect.spec().id == wheel_radius_mismatch::SPEC.id);
    of_radius.map(|dose| if dose.presence.side == Some(0) { -dose.values[0] } else { dose.values[0] }).sum()
}

/// By how much the drift of the recordings differs from that of the references.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Drift {
    /// Weighted mean of the recordings: right less left, over the speed.
    difference: f64,
    sigma: f64,
}

impl Drift {
    /// From the differences that are drifts, where these are clear; `None` where they are not, or without any.
    pub(crate) fn of(differences: &[Difference]) -> Option<Self> {
        let own = || differences.iter().filter(|d| d.here.at.quantity == Quantity::Drift);
        let usual = scatter(Quantity::Drift);
        let weight = |d: &Difference| 1.0 / (d.here.error.powi(2) + usual.powi(2));
        let total: f64 = own().map(weight).sum();
        let sum: f64 = own().map(|d| weight(d) * (d.here.value - d.reference.value)).sum();
        // Recordings share their references, and a day.
        let shared = own().map(|d| d.reference.error).fold(0.0, f64::max).hypot(usual);
        let found = Self { difference: sum / total, sigma: (1.0 / total + shared.powi(2)).sqrt() };
        (total > 0.0 && found.difference.abs() > MEASURING.drift.clear * found.sigma).then_some(found)
    }

    /// Wheels of a side that make this drift.
    pub(crate) fn part(self, side: usize) -> Option<(Variant, f64)> {
        let is_it = |v: &Variant| v.spec().id == wheel_radius_mismatch::SPEC.id && v.place == Place::Side(side);
        let share = if side == 1 { self.difference } else { -self.difference };
        variants(true).into_iter().find(is_it).map(|variant| (variant, share))
    }

    /// The same as the plant takes it.
    pub(crate) fn dose(self, side: usize) -> Option<Dose> {
        self.part(side).map(|(variant, share)| variant.dose(&[share], None))
    }

    /// What is told of it: the loads leave so many nats unexplained with the left and with the right side.
    pub(crate) fn told(self, left: [f64; 2]) -> SideDrift {
        let side = usize::from(left[1] < left[0]);
        let is_told = (left[0] - left[1]).abs() > NAMING.answer.indistinguishable;
        SideDrift {
            difference: self.difference,
            half: NINETY * self.sigma,
            side: is_told.then(|| inference::words::side(side).into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use inference::Options;
    use verdict::Verdict;

    use crate::testing::{case, drive, rounds};
    use crate::{SpeedRun, diagnose_steady};

    /// A drive whose wheels on the right are larger by a share.
    fn drifting(name: &str, share: f64) -> SpeedRun {
        let mut run = drive(&rounds(3), false);
        let turned: Vec<f64> = (0..run.time.len()).map(|i| share * run.forward(i) / 0.77).collect();
        run.yaw_rate.iter_mut().flatten().zip(turned).for_each(|(yaw, more)| *yaw += more);
        SpeedRun { name: name.to_owned(), ..run }
    }

    #[test]
    fn wheels_of_another_radius_are_told_by_the_drift_with_both_sides_where_the_loads_tell_none() {
        let told = |share: f64| {
            let case = case(vec![drifting("right", 0.0)], vec![drifting("a", share), drifting("b", share)]);
            diagnose_steady(&case, &Options::default(), &|_| {}).expect("a diagnosis")
        };
        let d = told(-0.05);
        assert_eq!(
            (d.verdict, d.ranked[0].effect.as_str()),
            (Verdict::Explained, "wheel_radius_mismatch"),
            "{:?}",
            d.ranked
        );
        let cause = &d.ranked[0];
        let [size, sigma] = [cause.magnitude, cause.sigma].map(|number| number.expect("a number"));
        assert!((size.abs() - 0.05).abs() < 1.645 * sigma && sigma < 0.012, "{size} {sigma}");
        assert!(d.sentences[0].starts_with("Missing: wheels of one side of another radius"), "{:?}", d.sentences);
        assert_eq!(d.indistinguishable[0], ["wheel_radius_mismatch", "encoder_scale"]);
        assert!(d.correction.effects.iter().any(|e| e.effect == "wheel_radius_mismatch"));

        assert_eq!(told(0.003).verdict, Verdict::NoMismatch, "tyres differ by as much");
    }

    #[test]
    fn a_gyro_that_shows_more_than_the_pose_is_told_and_no_track_is_blamed() {
        let with = |share: f64, name: &str| {
            let gyro_share = Some(inference::gyro_beside_pose::GyroShare { share, sigma: 0.002 });
            SpeedRun { gyro_share, ..drifting(name, 0.0) }
        };
        // The pose of the third says nothing of its gyro.
        let mut plain = drifting("c", 0.0);
        plain.yaw_rate.iter_mut().flatten().for_each(|rate| *rate *= 1.08);
        let case = case(vec![with(1.0, "right")], vec![with(1.08, "a"), with(1.08, "b"), plain]);
        let d = diagnose_steady(&case, &Options::default(), &|_| {}).expect("a diagnosis");
        assert_eq!((d.verdict, d.ranked[0].effect.as_str()), (Verdict::Explained, "gyro_scale"), "{:?}", d.ranked);
        assert!(d.sentences[0].starts_with("Missing: gyro scale error by +0.080"), "{:?}", d.sentences);
        assert!(d.sentences[1].starts_with("Apart from that"), "{:?}", d.sentences);
    }
}
