//! The encoders against the speed of the pose.
//!
//! Slip looks like a wrong scale, but drags the wheel back when braking and lets it run ahead when driving; a wheel of
//! another radius looks the same to every sensor. So only a scale that both kinds of driving agree on counts, and it
//! must be one that no wheel's radius has: the effect's interest.

use robot_model::effect::Redundancy;

use super::pool::{Measured, beyond, beyond_usual, median};
use super::{Fault, spec};
use crate::run::Run;
use crate::settings::redundancy::{SETTINGS, Wheels};

const WHEELS: Wheels = SETTINGS.wheels;

/// ln(wheel speed over pose speed) of each side in straight driving and in straight braking, both alike.
fn scales(run: &Run) -> [Option<Measured>; 2] {
    let span = (WHEELS.span / run.period).round().max(1.0) as usize;
    let poses: Vec<(usize, [f64; 3])> =
        (0..run.rows()).filter_map(|k| Some((k, [run.pose[0][k]?, run.pose[1][k]?, run.pose[2][k]?]))).collect();
    let mut found: [[Vec<f64>; 2]; 2] = Default::default();
    let mut next = 0;
    for (i, &(a, from)) in poses.iter().enumerate() {
        let Some(&(b, to)) = poses[i..].iter().find(|p| p.0 >= a + span).filter(|_| a >= next) else { continue };
        next = b;
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let travel = dx.hypot(dy);
        let turn = (to[2] - from[2]).sin().abs();
        if turn > WHEELS.straight * travel {
            continue;
        }
        for (j, found) in found.iter_mut().enumerate() {
            // A pose sample was taken half a row before its row.
            let at = |k: usize| Some(0.5 * (run.angle[j][k]? + run.angle[j][k.checked_sub(1)?]?));
            let Some((x, y)) = at(a).zip(at(b)) else { continue };
            if (y - x).abs() < WHEELS.slowest * (b - a) as f64 * run.period {
                continue;
            }
            let work: f64 = run.torque[a..b].iter().map(|t| t[j]).sum::<f64>() * (y - x);
            found[usize::from(work < 0.0)].push(((y - x).abs() / travel.max(1e-6)).ln());
        }
    }
    found.map(|[driving, braking]| {
        if driving.len() < WHEELS.fewest || braking.len() < WHEELS.fewest {
            return None;
        }
        let ((d, ds), (b, bs)) = (median(&driving)?, median(&braking)?);
        // What driving and braking disagree about is slip.
        Some(Measured { value: 0.5 * (d + b), sigma: (0.25 * (d - b).powi(2) + ds * ds + bs * bs).sqrt() })
    })
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
            None => beyond(&of(&here, 1.0), &of(&there, 1.0), spec.interest),
        }
    });
    // Without references both sides off are a robot file of other wheels.
    let is_one = |side: usize| {
        !references.is_empty() || found[1 - side].is_none_or(|other| other.value.abs() < WHEELS.other * spec.interest)
    };
    for side in (0..2).filter(|side| is_one(*side)) {
        let Some(d) = found[side] else { continue };
        let scale = Measured { value: d.value.exp() - 1.0, sigma: d.value.exp() * d.sigma };
        if scale.is_reportable(spec.interest) {
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
