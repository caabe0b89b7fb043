//! The encoders against the speed of the pose.
//!
//! Slip looks like a wrong scale, but drags the wheel back when braking and lets it run ahead when driving; a wheel of
//! another radius looks the same to every sensor. So only a scale that both kinds of driving agree on counts, or one that no usual slip
//! has, and it must be one that no wheel's radius has: the effect's interest.

use inference::robust::{MAD_TO_SIGMA, median, median_absolute_deviation};
use robot_model::effect::Redundancy;

use super::pool::{Measured, beyond, beyond_usual, least_squares};
use super::{Fault, spec};
use crate::run::Run;
use crate::settings::redundancy::{SETTINGS, Wheels};

const WHEELS: Wheels = SETTINGS.wheels;

/// A stretch: way and turning by the pose, and the angle of a wheel.
type Stretch = ([f64; 2], f64);

/// ln(wheel speed over speed of its side by the pose) of each side, in driving and in braking alike.
///
/// A side goes at `v ∓ h ψ̇`, and nobody knows its lever `h` before: `|Δφ| = a |Δs| + c Δψ` over stretches of straight driving and of gentle
/// bends, in which a robot drives whose controller believes an encoder of another scale; `a` is the number. Where a drive hardly ever brakes,
/// the slip of driving wheels is in it.
fn scales(run: &Run) -> [Option<Measured>; 2] {
    let span = (WHEELS.span / run.period).round().max(1.0) as usize;
    let poses: Vec<(usize, [f64; 3])> =
        (0..run.rows()).filter_map(|k| Some((k, [run.pose[0][k]?, run.pose[1][k]?, run.pose[2][k]?]))).collect();
    let mut found: [[Vec<Stretch>; 2]; 2] = Default::default();
    let mut next = 0;
    for (i, &(a, from)) in poses.iter().enumerate() {
        let Some(&(b, to)) = poses[i..].iter().find(|p| p.0 >= a + span).filter(|_| a >= next) else { continue };
        next = b;
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let travel = dx.hypot(dy);
        let turn = (to[2] - from[2]).sin();
        if turn.abs() > WHEELS.bend * travel {
            continue;
        }
        let (sin, cos) = (from[2] + 0.5 * turn).sin_cos();
        let forward = (dx * cos + dy * sin).signum();
        for (j, found) in found.iter_mut().enumerate() {
            // A pose sample was taken half a row before its row.
            let at = |k: usize| Some(0.5 * (run.angle[j][k]? + run.angle[j][k.checked_sub(1)?]?));
            let Some((x, y)) = at(a).zip(at(b)) else { continue };
            if (y - x).abs() < WHEELS.slowest * (b - a) as f64 * run.period {
                continue;
            }
            let work: f64 = run.torque[a..b].iter().map(|t| t[j]).sum::<f64>() * (y - x);
            found[usize::from(work < 0.0)].push(([travel, forward * turn], (y - x).abs()));
        }
    }
    found.map(|[driving, braking]| {
        if let Some((d, b)) = scale(&driving).zip(scale(&braking)) {
            // What driving and braking disagree about is slip.
            let slip = 0.5 * (d.value - b.value);
            return Some(Measured { value: 0.5 * (d.value + b.value), sigma: slip.hypot(d.sigma).hypot(b.sigma) });
        }
        let most = if driving.len() > braking.len() { driving } else { braking };
        scale(&most).map(|m| Measured { sigma: m.sigma.hypot(WHEELS.slip), ..m })
    })
}

/// Logarithm of the angle over the way, straight ahead, by least squares, twice: the second time without stretches that are far off.
fn scale(all: &[Stretch]) -> Option<Measured> {
    let fitted = |rows: &[Stretch]| least_squares(rows, 1.0).filter(|_| rows.len() >= WHEELS.fewest);
    let [way, turn] = fitted(all)?;
    let off = |([s, psi], angle): &Stretch| (angle - way.value * s - turn.value * psi) / s.max(f64::MIN_POSITIVE);
    let errors: Vec<f64> = all.iter().map(off).collect();
    let middle = median(errors.iter().copied())?;
    let most = WHEELS.far * MAD_TO_SIGMA * median_absolute_deviation(&errors)?;
    let is_near = |e: f64| (e - middle).abs() <= most;
    let near: Vec<Stretch> = all.iter().zip(&errors).filter(|(_, e)| is_near(**e)).map(|(row, _)| *row).collect();
    let [scale, _] = fitted(&near)?;
    (scale.value > 0.0).then(|| Measured { value: scale.value.ln(), sigma: scale.sigma / scale.value })
}

/// Encoder scale of each side; without references beside a wheel of this radius, m, if it is known.
pub(super) fn check(runs: &[Run], references: &[Run], radius: Option<f64>, out: &mut Vec<Fault>) {
    let Some(spec) = spec(Redundancy::WheelScale) else { return };
    let (here, there): (Vec<_>, Vec<_>) = (runs.iter().map(scales).collect(), references.iter().map(scales).collect());
    let found = [0, 1].map(|side| {
        let of = |all: &[[Option<Measured>; 2]], radius: f64| -> Vec<Option<Measured>> {
            all.iter().map(|s| s[side].map(|m| Measured { value: m.value + radius.ln(), ..m })).collect()
        };
        match radius.filter(|_| references.is_empty()) {
            Some(radius) => beyond_usual(&of(&here, radius), &[], (WHEELS.usual, spec.interest)),
            None => beyond(&of(&here, 1.0), &of(&there, 1.0), WHEELS.differ),
        }
    });
    // Without references both sides off are a robot file of other wheels.
    let is_one = |side: usize| {
        !references.is_empty() || found[1 - side].is_none_or(|other| other.value.abs() < WHEELS.other * spec.interest)
    };
    for side in (0..2).filter(|side| is_one(*side)) {
        let Some(d) = found[side] else { continue };
        let scale = Measured { value: d.value.exp() - 1.0, sigma: d.value.exp() * d.sigma };
        if scale.value.abs() > spec.interest && d.is_reportable(0.0) {
            out.push(Fault::new((spec, 0), scale, Some(side)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::*;
    use crate::testing::blank;
    use testing::PERIOD;

    /// Straight driving at a speed that rises and falls, on wheels of 0.1 m that slip by a share `slip` with the torque
    /// and whose right encoder shows `scale` times the angle.
    fn straight(slip: f64, scale: f64) -> Vec<Run> {
        let mut run = blank(2400);
        let (mut x, mut angle) = (0.0, [0.0; 2]);
        for k in 0..run.rows() {
            let t = k as f64 * PERIOD;
            let (speed, push) = (0.6 - 0.3 * (0.8 * t).cos(), (0.8 * t).sin());
            run.torque[k] = [2.0 * push; 2];
            for (j, a) in angle.iter_mut().enumerate() {
                run.angle[j][k] = Some(*a * if j == 1 { scale } else { 1.0 });
                *a += speed * PERIOD / 0.1 * (1.0 + slip * push.signum());
            }
            x += speed * PERIOD;
            if k % 10 == 0 {
                for (channel, v) in run.pose.iter_mut().zip([0.8 * x, 0.6 * x, 0.6_f64.atan2(0.8)]) {
                    channel[k] = Some(v);
                }
            }
        }
        vec![run; 3]
    }

    #[test]
    fn an_encoder_of_the_wrong_scale_is_found_with_its_side() {
        for scale in [0.5, 1.4, 2.0] {
            let found = check(&straight(0.02, scale), &straight(0.02, 1.0), None).faults;
            assert_eq!(found.len(), 1, "{found:?}");
            assert_eq!((found[0].spec.redundancy, found[0].side), (Redundancy::WheelScale, Some(1)));
            approx::assert_abs_diff_eq!(found[0].magnitude, scale - 1.0, epsilon = 0.02);
        }
    }

    /// A drive in a bend of a metre whose driver never brakes and changes speed, on wheels of 0.1 m and a lever of 0.2 m; the right encoder
    /// shows `scale` times the angle, and the right wheel spins for a moment now and then.
    fn bends(scale: f64) -> Vec<Run> {
        let mut run = blank(2400);
        let (mut pose, mut angle) = ([0.0_f64; 3], [0.0; 2]);
        for k in 0..run.rows() {
            let t = k as f64 * PERIOD;
            let speed = 0.6 - 0.3 * (0.8 * t).cos();
            let turning = (0.6 + 0.4 * (0.3 * t).sin()) * speed;
            run.torque[k] = [1.0; 2];
            for (j, a) in angle.iter_mut().enumerate() {
                run.angle[j][k] = Some(*a * if j == 1 { scale } else { 1.0 });
                let lever = if j == 1 { 0.2 } else { -0.2 };
                let spins = if j == 1 && k % 400 > 370 { 1.5 } else { 1.0 };
                *a += spins * (speed + lever * turning) * PERIOD / 0.1;
            }
            if k % 10 == 0 {
                run.pose.iter_mut().zip(pose).for_each(|(channel, v)| channel[k] = Some(v));
            }
            pose[0] += speed * pose[2].cos() * PERIOD;
            pose[1] += speed * pose[2].sin() * PERIOD;
            pose[2] += turning * PERIOD;
        }
        vec![run; 3]
    }

    #[test]
    fn an_encoder_that_a_controller_believes_is_found_in_the_bends_that_it_drives() {
        for scale in [0.7, 1.35, 1.5] {
            let found = check(&bends(scale), &straight(0.0, 1.0), None).faults;
            assert_eq!((found.len(), found[0].side), (1, Some(1)), "{found:?}");
            approx::assert_abs_diff_eq!(found[0].magnitude, scale - 1.0, epsilon = 0.03);
        }
        for scale in [1.0, 1.1] {
            assert!(check(&bends(scale), &straight(0.0, 1.0), None).faults.is_empty(), "{scale}");
        }
    }

    #[test]
    fn without_references_the_radius_of_the_robot_file_tells() {
        let found = check(&straight(0.02, 1.4), &[], Some(0.1)).faults;
        assert_eq!((found.len(), found[0].side), (1, Some(1)), "{found:?}");
        approx::assert_abs_diff_eq!(found[0].magnitude, 0.4, epsilon = 0.02);
        // Wheels of another radius than the file says, and of what nothing is known.
        assert!(check(&straight(0.02, 1.0), &[], Some(0.14)).faults.is_empty());
        assert!(check(&straight(0.02, 1.0), &[], Some(0.1)).faults.is_empty());
        assert!(check(&straight(0.02, 1.4), &[], None).faults.is_empty());
    }

    #[test]
    fn slip_and_a_wheel_of_another_radius_are_no_fault() {
        for (slip, scale) in [(0.02, 1.0), (0.4, 1.0), (0.02, 1.1), (0.3, 0.9)] {
            let found = check(&straight(slip, scale), &straight(0.02, 1.0), None).faults;
            assert!(found.is_empty(), "slip {slip}, scale {scale}: {found:?}");
        }
    }
}
