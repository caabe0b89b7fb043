//! The accelerometer against the pose.
//!
//! Second differences of the pose over a second are weighted means of the acceleration: no derivative is taken and no
//! wheel is believed. What differs and turns with the robot is the accelerometer's; what stays fixed in the world is
//! the slope of the ground, which accelerometers do not see.

use robot_model::EffectSpec;
use robot_model::effect::Redundancy;

use super::pool::{Measured, beyond_usual, least_squares};
use super::{Fault, spec};
use crate::motion::{GyroError, Smoothed};
use crate::run::Run;
use crate::settings::redundancy::{Acceleration, SETTINGS};

const ACCELERATION: Acceleration = SETTINGS.acceleration;

/// Bias in x and y (m/s²) and angle about z (rad) of a run's accelerometer.
fn errors(run: &Run, gyro: GyroError) -> [Option<Measured>; 3] {
    let nothing = [None; 3];
    let poses: Vec<(usize, [f64; 2])> =
        (0..run.rows()).filter_map(|k| Some((k, [run.pose[0][k]?, run.pose[1][k]?]))).collect();
    if poses.len() < ACCELERATION.least_poses || run.accel.iter().any(|a| a.iter().flatten().next().is_none()) {
        return nothing;
    }

    let yaw = Smoothed::new(run, gyro, ACCELERATION.pose_sigma).yaw;
    let gaps = (poses[poses.len() - 1].0 - poses[0].0) as f64 * run.period / (poses.len() - 1) as f64;
    let half = (ACCELERATION.half / gaps).round().max(1.0) as usize;
    // Specific force of each row, the last one known where a sample is missing, and the direction it has.
    let mut last = [0.0; 2];
    let felt: Vec<[f64; 4]> = (0..run.rows())
        .map(|k| {
            for (last, a) in last.iter_mut().zip(&run.accel) {
                *last = a[k].unwrap_or(*last);
            }
            // A sample stands for the row before it.
            let (s, c) = (0.5 * (yaw[k] + yaw[k.saturating_sub(1)])).sin_cos();
            [last[0], last[1], c, s]
        })
        .collect();

    let mut rows: Vec<([f64; 5], f64)> = Vec::new();
    for w in poses.windows(2 * half + 1) {
        let [(a, from), (b, at), (c, to)] = [w[0], w[half], w[2 * half]];
        let (before, after) = ((b - a) as f64 * run.period, (c - b) as f64 * run.period);
        // ∫ k R(ψ) a, ∫ k R, ∫ k R J a, ∫ k with the hat k that turns acceleration into this second difference.
        let mut sums = [0.0; 7];
        for k in a + 1..=c {
            let t = (k as f64 - 0.5 - b as f64) * run.period;
            let hat = run.period * if t < 0.0 { 1.0 + t / before } else { 1.0 - t / after };
            let [x, y, cos, sin] = felt[k];
            let terms = [cos * x - sin * y, sin * x + cos * y, cos, sin, -cos * y - sin * x, cos * x - sin * y, 1.0];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum += hat * term;
            }
        }
        let [ax, ay, cos, sin, jx, jy, all] = sums.map(|s| s / (0.5 * (before + after)));
        let bend = |i: usize| ((to[i] - at[i]) / after - (at[i] - from[i]) / before) / (0.5 * (before + after));
        // Columns: bias x, bias y, angle, slope x, slope y.
        rows.push(([-cos, sin, jx, all, 0.0], bend(0) - ax));
        rows.push(([-sin, -cos, jy, 0.0, all], bend(1) - ay));
    }

    // Neighbouring second differences share their samples.
    least_squares(&rows, 2.0 * half as f64).map_or(nothing, |[x, y, angle, ..]| [Some(x), Some(y), Some(angle)])
}

/// Bias and angle of the accelerometer; without references only if `alone`, beside what is usual.
pub(super) fn check([runs, references]: [&[Run]; 2], gyro: [GyroError; 2], alone: bool, out: &mut Vec<Fault>) {
    if references.is_empty() && !alone {
        return;
    }
    let of = |runs: &[Run], gyro| runs.iter().map(|r| errors(r, gyro)).collect::<Vec<_>>();
    let (here, there) = (of(runs, gyro[0]), of(references, gyro[1]));
    let mut tell = |spec: &'static EffectSpec, parameter: usize, i: usize| {
        let usual = (ACCELERATION.usual[i], spec.interest);
        let pick = |all: &[[Option<Measured>; 3]]| all.iter().map(|e| e[i]).collect::<Vec<_>>();
        let d = beyond_usual(&pick(&here), &pick(&there), usual);
        if let Some(d) = d.filter(|d| d.is_reportable(spec.interest)) {
            out.push(Fault::new((spec, parameter), d, None));
        }
    };
    if let Some(spec) = spec(Redundancy::AccelOffset) {
        tell(spec, 0, 0);
        tell(spec, 1, 1);
    }
    if let Some(spec) = spec(Redundancy::AccelTurn) {
        tell(spec, 0, 2);
    }
}

#[cfg(test)]
mod tests {
    use robot_model::{Effect, Presence, effects};

    use super::super::check;
    use super::*;
    use crate::testing::driven;
    use inference::hypothesis::Dose;
    use testing::robot;

    fn runs(effect: Option<(&'static dyn Effect<f64>, &[f64])>) -> Vec<Run> {
        let doses: Vec<Dose> = effect
            .iter()
            .map(|(effect, v)| Dose { effect: *effect, values: v.to_vec(), presence: Presence::default() })
            .collect();
        [18.0, 20.0, 24.0].map(|seconds| driven(&robot(), &doses, seconds)).into()
    }

    fn told(effect: &'static dyn Effect<f64>, values: &[f64]) -> Vec<Fault> {
        check(&runs(Some((effect, values))), &runs(None), None).faults
    }

    #[test]
    fn a_bias_is_found_on_its_axis() {
        let found = told(&effects::accelerometer_bias::Law, &[0.5, -0.4]);
        assert_eq!(
            found.iter().map(|f| (f.spec.id, f.parameter)).collect::<Vec<_>>(),
            [("accelerometer_bias", 0), ("accelerometer_bias", 1)]
        );
        approx::assert_abs_diff_eq!(found[0].magnitude, 0.5, epsilon = 0.02);
        approx::assert_abs_diff_eq!(found[1].magnitude, -0.4, epsilon = 0.02);
    }

    #[test]
    fn a_tilt_reads_as_the_commoner_bias() {
        let found = told(&effects::imu_tilt::Law, &[0.0, 0.06]);
        assert_eq!((found.len(), found[0].spec.id, found[0].parameter), (1, "accelerometer_bias", 1));
        approx::assert_abs_diff_eq!(found[0].magnitude, 9.81 * 0.06_f64.sin(), epsilon = 0.02);
    }

    #[test]
    fn without_references_a_large_offset_is_told_beside_what_is_usual() {
        let alone = |effect: Option<(&'static dyn Effect<f64>, &[f64])>| check(&runs(effect), &[], Some(0.1)).faults;
        let found = alone(Some((&effects::accelerometer_bias::Law, &[0.7, 0.0])));
        assert_eq!((found.len(), found[0].spec.id, found[0].parameter), (1, "accelerometer_bias", 0), "{found:?}");
        approx::assert_abs_diff_eq!(found[0].magnitude, 0.7, epsilon = 0.03);
        // A mounting by eye, a slope, and references' own.
        for usual in [None, Some((&effects::accelerometer_bias::Law as &dyn Effect<f64>, &[0.35, 0.0][..]))] {
            assert!(alone(usual).is_empty(), "{:?}", alone(usual));
        }
        let grade: &dyn Effect<f64> = &effects::grade::Law;
        assert!(alone(Some((grade, &[0.06, -0.08]))).is_empty());
        let biased = runs(Some((&effects::accelerometer_bias::Law, &[0.7, 0.0])));
        assert!(check(&biased, &[], None).faults.is_empty());
    }

    #[test]
    fn a_turned_imu_is_found_with_its_angle() {
        for angle in [0.1, -0.3] {
            let found = told(&effects::imu_misalignment::Law, &[angle]);
            assert_eq!(found.len(), 1, "{found:?}");
            assert_eq!(found[0].spec.id, "imu_misalignment");
            approx::assert_abs_diff_eq!(found[0].magnitude, angle, epsilon = 0.02);
        }
    }

    #[test]
    fn slopes_and_forces_are_no_fault_of_the_accelerometer() {
        let grade: &dyn Effect<f64> = &effects::grade::Law;
        for (effect, values) in [
            (grade, &[0.06, -0.08][..]),
            (&effects::payload::Law, &[6.0]),
            (&effects::com_offset::Law, &[0.05, 0.0]),
            (&effects::quadratic_drag::Law, &[10.0]),
            (&effects::turning_resistance::Law, &[0.4]),
        ] {
            assert!(told(effect, values).is_empty(), "{}: {:?}", effect.spec().id, told(effect, values));
        }
    }

    #[test]
    fn without_a_pose_or_an_accelerometer_nothing_is_said() {
        let mut blind = runs(Some((&effects::accelerometer_bias::Law, &[0.5, 0.5])));
        for (i, run) in blind.iter_mut().enumerate() {
            run.accel[i % 2].fill(None);
        }
        assert!(check(&blind, &runs(None), None).faults.is_empty());
        let mut blind = runs(Some((&effects::accelerometer_bias::Law, &[0.5, 0.5])));
        for run in &mut blind {
            run.pose[0].fill(None);
        }
        assert!(check(&blind, &runs(None), None).faults.is_empty());
    }
}
