//! What the gyro reads while the robot stands.
//!
//! A zero that is off turns a robot that goes straight: arcs come out wider one way than the other, and loads and tracks that are
//! told by turning come out wrong. Where wheels stand and are not asked to turn it is all that is read.

use std::f64::consts::FRAC_PI_2;

use inference::robust::{MAD_TO_SIGMA, NINETY, median, median_absolute_deviation};

use crate::run::SpeedRun;
use crate::settings::{MEASURING, measuring::GyroZero};
use crate::zero::rows_at_rest;

const ZERO: GyroZero = MEASURING.gyro_zero;

/// What a gyro reads at rest and the standard error of that, rad/s.
#[derive(Debug, Clone, Copy)]
struct Read {
    zero: f64,
    error: f64,
}

impl Read {
    /// Whether it differs from another zero by enough to matter, and clearly.
    fn is_off(self, other: f64) -> bool {
        (self.zero - other).abs() >= ZERO.matters.max(ZERO.clear * self.error)
    }
}

/// Subtracts from every yaw rate of a recording what its gyro reads at rest, where that is enough to matter. Returns a sentence about the
/// recordings in which the gyro reads something else at rest than in the references.
pub(crate) fn remove(references: &mut [SpeedRun], recordings: &mut [SpeedRun]) -> Option<String> {
    let usual = median(references.iter().filter_map(of).map(|read| read.zero)).unwrap_or(0.0);
    let read: Vec<(String, Read)> = recordings.iter().filter_map(|run| Some((run.name.clone(), of(run)?))).collect();
    for run in references.iter_mut().chain(recordings) {
        let Some(read) = of(run).filter(|read| read.is_off(0.0)) else { continue };
        if let Some(yaw_rate) = run.yaw_rate.as_mut() {
            for rate in yaw_rate {
                *rate -= read.zero;
            }
        }
    }
    let off: Vec<String> = read
        .into_iter()
        .filter(|(_, read)| read.is_off(usual))
        .map(|(name, read)| format!("{:.4} ± {:.4} rad/s (90 %) in {name}", read.zero, NINETY * read.error))
        .collect();
    let before = if references.is_empty() { String::new() } else { format!("; in the references {usual:.4} rad/s") };
    (!off.is_empty()).then(|| {
        format!(
            "while the robot stands its gyro reads {}{before}: the zero of the gyro is off by that, which was taken off its readings here; \
             correct it on the robot, too",
            off.join(", ")
        )
    })
}

/// What the gyro of a recording reads at rest, where it stood long enough and stretches agree.
fn of(run: &SpeedRun) -> Option<Read> {
    let yaw_rate = run.yaw_rate.as_ref()?;
    let stretches: Vec<Vec<f64>> = rows_at_rest(run)
        .into_iter()
        .map(|rows| rows.into_iter().map(|i| yaw_rate[i]).filter(|rate| rate.is_finite()).collect())
        .filter(|rates: &Vec<f64>| !rates.is_empty())
        .collect();
    let all = stretches.concat();
    if all.len() as f64 * run.period() < ZERO.least {
        return None;
    }

    let middles: Vec<f64> = stretches.iter().filter_map(|rates| median(rates.iter().copied())).collect();
    let zero = median(all.iter().copied())?;
    // About the middle of each stretch: what differs between these is no scatter.
    let apart = stretches.iter().zip(&middles).flat_map(|(rates, middle)| rates.iter().map(move |rate| rate - middle));
    let scatter = MAD_TO_SIGMA * median_absolute_deviation(&apart.collect::<Vec<_>>())?;
    // Of a median, √(π/2) of that of a mean.
    let error = |rows: usize| FRAC_PI_2.sqrt() * scatter / (rows as f64).sqrt();
    let agrees = |(middle, rates): (&f64, &Vec<f64>)| {
        let within = ZERO.agree * zero.abs().max(ZERO.matters) + ZERO.clear * error(rates.len());
        (middle - zero).abs() <= within
    };
    let all_agree = middles.iter().zip(&stretches).all(agrees);
    all_agree.then(|| Read { zero, error: error(all.len()) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Leg, drive};

    /// A drive that stands at both ends, whose gyro reads so much more than it should.
    fn off(zero: f64) -> SpeedRun {
        let still = || Leg { speed: [0.0; 2], straight: 0.0, scrub: 0.0, ..Leg::straight(6.0) };
        let mut run = drive(&[still(), Leg::straight(20.0), Leg::turn(6.0), Leg::straight(10.0), still()], false);
        run.yaw_rate.iter_mut().flatten().for_each(|rate| *rate += zero);
        run
    }

    #[test]
    fn what_a_gyro_reads_at_rest_is_taken_off_and_told_where_the_references_have_it_otherwise() {
        let (mut references, mut recordings) = ([off(0.0)], [off(0.03)]);
        let told = remove(&mut references, &mut recordings).expect("told");
        assert!(
            told.contains("0.0300 ± 0.0000 rad/s (90 %) in run") && told.contains("in the references 0.0000 rad/s"),
            "{told}"
        );
        assert!(of(&recordings[0]).is_some_and(|read| read.zero.abs() < 1e-9));
        // What the references have as well is taken off both, and is no news.
        let (mut references, mut recordings) = ([off(0.03)], [off(0.03)]);
        assert_eq!(remove(&mut references, &mut recordings), None);
        assert!(of(&references[0]).is_some_and(|read| read.zero.abs() < 1e-9));
        // What noise alone may read is none.
        let mut noisy = [off(0.0)];
        let rates = noisy[0].yaw_rate.as_mut().expect("a gyro");
        rates.iter_mut().enumerate().for_each(|(i, rate)| *rate += 0.012 + if i % 2 == 0 { 0.2 } else { -0.2 });
        assert_eq!(remove(&mut [], &mut noisy), None);
        // Little does not matter, and stays.
        let mut little = [off(0.004)];
        assert_eq!(remove(&mut [], &mut little), None);
        assert!(of(&little[0]).is_some_and(|read| (read.zero - 0.004).abs() < 1e-9));
    }

    #[test]
    fn a_robot_that_never_stands_and_one_that_turns_slowly_there_say_nothing() {
        let mut moving = [drive(&[Leg::straight(30.0)], false)];
        moving[0].yaw_rate.iter_mut().flatten().for_each(|rate| *rate += 0.03);
        assert_eq!(remove(&mut [], &mut moving), None);
        let mut run = off(0.0);
        let last = run.time.len() - 40;
        run.yaw_rate.as_mut().expect("a gyro")[last..].iter_mut().for_each(|rate| *rate += 0.1);
        assert_eq!(remove(&mut [], &mut [run]), None);
    }
}
