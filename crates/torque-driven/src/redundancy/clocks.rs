//! Clocks against each other: the gyro against the pose, and both against the wheels.
//!
//! Gyro and pose see the same turning of the same body, so a delay between them is one of their clocks. Which one, the
//! wheels tell: it is the one that moved more against them, or, where no references say how far it was, that is farther off them. They
//! cannot tell more: slip delays the body behind the
//! wheels, for both sensors alike, by an amount that a centre of mass or a belt changes by 0.1 s.

use robot_model::effect::Redundancy;

use super::pool::{Measured, beyond_usual, least_squares};
use super::{Fault, spec};
use crate::motion::{GyroError, integrated_yaw, pose_yaw};
use crate::run::Run;
use crate::settings::redundancy::{Clocks, SETTINGS};

const CLOCKS: Clocks = SETTINGS.clocks;

/// Delays of a run's clocks, s, and growth of one.
#[derive(Debug, Clone, Copy, Default)]
struct Delays {
    /// Gyro behind pose, constant.
    gyro: Option<Measured>,
    /// Gyro behind pose at the start, and growth of it in seconds per second.
    growing: Option<[Measured; 2]>,
    /// Gyro and pose behind the wheels.
    wheels: [Option<Measured>; 2],
}

fn delays(run: &Run) -> Delays {
    let mut out = Delays::default();
    let poses = pose_yaw(run);
    let Some(turned) = integrated_yaw(run, GyroError::default()) else { return out };
    let half = |x: &[f64], k: usize| 0.5 * (x[k] + x[k.saturating_sub(1)]);
    let mean = |k: usize| {
        let (a, b) = (k.saturating_sub(CLOCKS.around + 1), (k + CLOCKS.around).min(run.rows() - 1));
        (turned[b] - turned[a]) / ((b - a) as f64 * run.period)
    };
    let wheels = wheel_turning(run);
    let (mut pose, mut long, mut speed) = (Vec::new(), Vec::new(), 0.0);
    let mut against: [Vec<([f64; 6], f64)>; 2] = Default::default();
    for &(k, yaw) in &poses {
        let (t, rate, shown) = ((k as f64 - 0.5) * run.period, mean(k), half(&turned, k));
        speed = wheels[k].map_or(speed, |w| w.driving);
        // ∫gyro = c + b t + (1 + s) yaw − τ rate + g v, the last of a gyro that shows accelerations as turning.
        pose.push(([1.0, t, yaw, speed, -rate], shown));
        long.push(([1.0, t, yaw, speed, -rate, -rate * t], shown));
        if let Some(w) = wheels[k] {
            let [slipping, driving] = w.slipping;
            against[0].push(([1.0, t, w.angle, slipping, driving, -w.turning], shown));
            against[1].push(([1.0, t, w.angle, slipping, driving, -w.turning], yaw));
        }
    }
    out.gyro = least_squares(&pose, CLOCKS.alike).map(|x| x[4]);
    out.growing = least_squares(&long, CLOCKS.alike).map(|x| [x[4], x[5]]);
    out.wheels = against.map(|rows| {
        let [_, _, gain, _, _, delayed] = least_squares(&rows, CLOCKS.alike)?;
        let value = delayed.value / gain.value;
        (gain.value.abs() > CLOCKS.least_gain * gain.sigma)
            .then(|| Measured { value, sigma: (delayed.sigma / gain.value).abs() })
    });
    out
}

/// What the wheels show at a row.
#[derive(Debug, Clone, Copy)]
struct Wheels {
    /// Difference of the wheel angles, right less left, rad.
    angle: f64,
    /// Its parts that slip makes depend on the turning and on the driving speed.
    slipping: [f64; 2],
    /// Mean of the wheel speeds, rad/s.
    driving: f64,
    /// Their difference, rad/s.
    turning: f64,
}

fn wheel_turning(run: &Run) -> Vec<Option<Wheels>> {
    let mut sums = [0.0; 2];
    (0..run.rows())
        .map(|k| {
            let angle = |k: usize| Some([run.angle[0].get(k).copied()??, run.angle[1].get(k).copied()??]);
            let time = (2 * CLOCKS.around + 1) as f64 * run.period;
            let (before, after) = (angle(k.checked_sub(CLOCKS.around + 1)?)?, angle(k + CLOCKS.around)?);
            let speed = [0, 1].map(|j| (after[j] - before[j]) / time);
            let (turning, driving) = (speed[1] - speed[0], 0.5 * (speed[0] + speed[1]));
            sums[0] += turning * turning.abs() * run.period;
            sums[1] += turning * driving.abs() * run.period;
            let (now, last) = (angle(k)?, angle(k.checked_sub(1)?)?);
            let angle = 0.5 * (now[1] - now[0] + last[1] - last[0]);
            Some(Wheels { angle, slipping: sums, driving, turning })
        })
        .collect()
}

/// Offset and drift of the clocks of IMU and pose.
pub(super) fn check(runs: &[Run], references: &[Run], out: &mut Vec<Fault>) {
    let (Some(offset), Some(drift)) = (spec(Redundancy::Delay), spec(Redundancy::DelayGrowth)) else { return };
    let (here, there): (Vec<Delays>, Vec<Delays>) =
        (runs.iter().map(delays).collect(), references.iter().map(delays).collect());
    // Without references sound clocks are taken to agree, but for what usual ones differ by.
    let compare = |pick: &dyn Fn(&Delays) -> Option<Measured>, interest: f64, usual: f64| {
        let of = |all: &[Delays]| all.iter().map(pick).collect::<Vec<_>>();
        beyond_usual(&of(&here), &of(&there), (usual, interest))
    };
    let [usual, usual_growth] = CLOCKS.usual;
    let growth =
        compare(&|d| d.growing.map(|g| g[1]), drift.interest, usual_growth).filter(|g| g.is_reportable(drift.interest));
    // Beside a drift, the offset is that at the start.
    let delay = if growth.is_some() {
        compare(&|d| d.growing.map(|g| g[0]), offset.interest, usual)
    } else {
        compare(&|d| d.gyro, offset.interest, usual)
    };
    // The sensor that moved against the wheels is the late one; without references the one that is farther from them.
    let moved = [0, 1].map(|i| compare(&|d| d.wheels[i], offset.interest, usual));
    if references.is_empty() && moved.contains(&None) {
        return;
    }
    let moved = moved.map(|m| m.map_or(0.0, |m| m.value.abs()));
    let pose = usize::from(moved[1] > moved[0]);
    let mut tell = |spec, m: Measured| {
        let value = if pose == 1 { -m.value } else { m.value };
        out.push(Fault::new((spec, pose), Measured { value, ..m }, None));
    };
    if let Some(growth) = growth {
        tell(drift, growth);
    }
    if let Some(delay) = delay.filter(|d| d.is_reportable(offset.interest)) {
        tell(offset, delay);
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

    fn runs(doses: &[Dose]) -> Vec<Run> {
        [18.0, 20.0, 24.0].map(|seconds| driven(&robot(), doses, seconds)).into()
    }

    /// Writes every sample later: by `rows`, and by a share `growth` of the time that has passed.
    fn late(channel: &mut Vec<Option<f64>>, rows: f64, growth: f64) {
        let sound = std::mem::replace(channel, vec![None; channel.len()]);
        for (k, v) in sound.into_iter().enumerate().filter(|(_, v)| v.is_some()) {
            let row = (k as f64 * (1.0 + growth) + rows).round().max(0.0) as usize;
            if let Some(slot) = channel.get_mut(row) {
                *slot = v;
            }
        }
    }

    fn imu_late(rows: f64, growth: f64) -> Vec<Run> {
        let mut all = runs(&[]);
        for run in &mut all {
            late(&mut run.gyro, rows, growth);
            run.accel.iter_mut().for_each(|a| late(a, rows, growth));
        }
        all
    }

    #[test]
    fn a_late_sensor_is_found_with_its_delay() {
        for rows in [-3.0, 3.0, 8.0] {
            let found = check(&imu_late(rows, 0.0), &runs(&[]), None).faults;
            assert_eq!(found.len(), 1, "{found:?}");
            assert_eq!((found[0].spec.id, found[0].parameter), ("clock_offset", 0));
            approx::assert_abs_diff_eq!(found[0].magnitude, 0.01 * rows, epsilon = 2e-3);
            // Without references clocks may differ by what is usual.
            let alone = check(&imu_late(rows, 0.0), &[], None).faults;
            assert_eq!(alone.len(), usize::from(rows > 4.0), "{alone:?}");
        }
        let alone = check(&imu_late(8.0, 0.0), &[], None).faults;
        assert_eq!((alone[0].spec.id, alone[0].parameter), ("clock_offset", 0));
        approx::assert_abs_diff_eq!(alone[0].magnitude, 0.08, epsilon = 3e-3);
        let mut all = runs(&[]);
        all.iter_mut().flat_map(|r| &mut r.pose).for_each(|p| late(p, 5.0, 0.0));
        let found = check(&all, &runs(&[]), None).faults;
        assert_eq!((found.len(), found[0].spec.id, found[0].parameter), (1, "clock_offset", 1));
        approx::assert_abs_diff_eq!(found[0].magnitude, 0.05, epsilon = 2e-3);
        let alone = check(&all, &[], None).faults;
        assert_eq!((alone.len(), alone[0].spec.id, alone[0].parameter), (1, "clock_offset", 1));
    }

    #[test]
    fn a_clock_that_runs_slow_is_found_with_its_rate() {
        let found = check(&imu_late(0.0, 4e-3), &runs(&[]), None).faults;
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].spec.id, "clock_drift");
        assert_eq!(check(&imu_late(0.0, 4e-3), &[], None).faults[0].spec.id, "clock_drift");
        approx::assert_abs_diff_eq!(found[0].magnitude, 4e-3, epsilon = 4e-4);
    }

    #[test]
    fn a_gyro_that_shows_accelerations_as_turning_is_no_fault_of_a_clock() {
        let mut all = runs(&[]);
        for run in &mut all {
            for (gyro, ahead) in run.gyro.iter_mut().zip(&run.accel[0]) {
                *gyro = gyro.zip(*ahead).map(|(gyro, ahead)| gyro + 0.06 * ahead);
            }
        }
        for run in &all {
            // Without a term that goes with the speed it is 0.6 to 1 %.
            let [_, growth] = delays(run).growing.expect("poses");
            assert!(growth.value.abs() < 3e-4, "{growth:?}");
        }
        for references in [runs(&[]), Vec::new()] {
            let found = check(&all, &references, None).faults;
            assert!(found.iter().all(|f| !f.spec.id.starts_with("clock")), "{found:?}");
        }
    }

    #[test]
    fn a_robot_that_answers_late_is_no_fault_of_a_clock() {
        let lag: &dyn Effect<f64> = &effects::motor_lag::Law;
        for (effect, values) in [
            (lag, &[0.2][..]),
            (&effects::transport_delay::Law, &[0.1]),
            (&effects::slip_stiffness::Law, &[3.0]),
            (&effects::com_offset::Law, &[0.08, 0.0]),
            (&effects::payload::Law, &[8.0]),
        ] {
            let dose = Dose { effect, values: values.to_vec(), presence: Presence::default() };
            for references in [runs(&[]), Vec::new()] {
                let found = check(&runs(std::slice::from_ref(&dose)), &references, None).faults;
                assert!(found.is_empty(), "{}: {found:?}", effect.spec().id);
            }
        }
    }
}
