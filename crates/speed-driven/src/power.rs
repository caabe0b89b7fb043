//! Signs of torques that no robot can have: in spins both ways both sides push against the ground.
//!
//! A slope may turn one side of a spin into a brake, and then the other side where the robot spins the other way.

use inference::DiagnosisError;
use inference::robust::median;

use crate::run::SpeedRun;
use crate::settings::{MEASURING, measuring::Power};

const POWER: Power = MEASURING.power;

/// Refuses recordings whose torques brake where they have to push.
///
/// # Errors
/// The first of them, with what is exchanged or turned and what to correct.
pub(crate) fn check<'a>(runs: impl IntoIterator<Item = &'a SpeedRun>) -> Result<(), DiagnosisError> {
    let refused = |run: &SpeedRun| {
        let what = wrong(run)?;
        Some(DiagnosisError::Impossible { recording: run.name.clone(), what })
    };
    runs.into_iter().find_map(refused).map_or(Ok(()), Err)
}

/// What is wrong with the signs of a recording's torques.
fn wrong(run: &SpeedRun) -> Option<String> {
    if run.magnitude_only {
        return None;
    }
    if let Some(what) = magnitudes(run) {
        return Some(what);
    }
    let drives = |i: usize| (0..2).all(|j| run.speed[j][i].abs() > POWER.turning && run.reads(i, j));
    let steady = |i: &usize| drives(*i) && run.held(*i, MEASURING.turns.steady, POWER.held);
    let (spins, straight): (Vec<usize>, Vec<usize>) = (0..run.time.len()).filter(steady).partition(|&i| run.spins(i));
    let seconds = |rows: &[usize]| rows.len() as f64 * run.period();
    let (left_turns, right_turns): (Vec<usize>, Vec<usize>) = spins.iter().partition(|&&i| run.difference(i) > 0.0);
    if [&left_turns, &right_turns].iter().any(|turns| seconds(turns) < POWER.least) {
        return None;
    }

    // Whether a side brakes in nearly all rows in which it does something.
    let brakes = |rows: &[usize], side: usize| {
        let torque = |i: usize| run.torque[side][i];
        let usual = median(rows.iter().map(|&i| torque(i).abs())).unwrap_or(0.0);
        let acts: Vec<usize> = rows.iter().copied().filter(|&i| torque(i).abs() > POWER.acts * usual).collect();
        let count = acts.iter().filter(|&&i| torque(i) * run.speed[side][i] < 0.0).count();
        count as f64 > POWER.share * acts.len() as f64
    };
    let [left, right] = [0, 1].map(|side| brakes(&left_turns, side) && brakes(&right_turns, side));
    let in_spins = format!("in {:.0} s of turns on the spot", seconds(&spins));
    match [left, right] {
        [false, false] => None,
        [true, true] if [0, 1].iter().any(|&side| brakes(&straight, side)) || straight.is_empty() => Some(format!(
            "{in_spins} the torques of both sides are against the turning of their wheels: the signs of both currents or torques are \
             turned; write sign = -1 for them in the mapping, or turn those of both speeds"
        )),
        [true, true] => Some(format!(
            "{in_spins} the torques of both sides are against the turning of their wheels, and straight ahead they are not: left and \
             right are exchanged between speeds and currents or torques; exchange their columns in the mapping"
        )),
        _ => Some(format!(
            "{in_spins} the torque of the {side} side is against the turning of its wheels: the sign of the {side} current or torque is \
             turned; write sign = -1 for it in the mapping",
            side = if left { "left" } else { "right" }
        )),
    }
}

/// Torques that have no sign though they are mapped with one: never negative, where a side turns backward in spins both ways. A slope
/// may make both sides brake on the way down, but not a side in spins both ways.
fn magnitudes(run: &SpeedRun) -> Option<String> {
    let backward = |side: usize| {
        let torque = &run.torque[side];
        let largest = torque.iter().map(|t| t.abs()).fold(0.0, f64::max);
        let noise = MEASURING.guesses.noise * largest;
        let negative = torque.iter().filter(|t| **t < -noise).count() as f64 * run.period();
        let is_negative = negative > MEASURING.guesses.seconds;
        let pushes = |i: &usize| run.spins(*i) && run.speed[side][*i] < -POWER.turning && torque[*i] > noise;
        let seconds = (0..torque.len()).filter(pushes).count() as f64 * run.period();
        (!is_negative && seconds > POWER.backward).then_some(seconds)
    };
    let (left, right) = (backward(0)?, backward(1)?);
    Some(format!(
        "the currents or torques are mapped with their signs, and are never negative, though in turns on the spot the left side \
         turns backward for {left:.0} s and the right one for {right:.0} s: they are magnitudes; write `magnitude_only = true` for them in the mapping"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Leg, drive};

    /// Straight ahead and spins both ways, with signed torques.
    fn signed() -> SpeedRun {
        let spin = |way: f64| Leg { speed: [-0.2 * way, 0.2 * way], ..Leg::straight(8.0) };
        let mut run = drive(&[Leg::straight(20.0), spin(1.0), Leg::straight(10.0), spin(-1.0)], false);
        run.magnitude_only = false;
        for j in 0..2 {
            for i in 0..run.time.len() {
                run.torque[j][i] = run.torque[j][i].abs() * run.speed[j][i].signum();
            }
        }
        run
    }

    #[test]
    fn torques_that_push_are_taken_and_others_refused_with_what_to_correct() {
        assert_eq!(check(&[signed()]), Ok(()));
        let refused = |run: SpeedRun| check(&[run]).expect_err("refused").to_string();

        let mut exchanged = signed();
        exchanged.torque.swap(0, 1);
        assert!(refused(exchanged).contains("left and right are exchanged"));
        let mut turned = signed();
        turned.torque.iter_mut().flatten().for_each(|t| *t = -*t);
        assert!(refused(turned).contains("the signs of both"));
        let mut right = signed();
        right.torque[1].iter_mut().for_each(|t| *t = -*t);
        assert!(refused(right).contains("the sign of the right current"));

        let mut unsigned = signed();
        unsigned.torque.iter_mut().flatten().for_each(|t| *t = t.abs());
        assert!(refused(unsigned).contains("write `magnitude_only = true`"));

        // Spins one way on a slope may make one side brake.
        let mut sloping = signed();
        let turned: Vec<f64> = (0..sloping.time.len()).map(|i| sloping.difference(i)).collect();
        let left = sloping.torque[0].iter_mut().zip(&turned).filter(|(_, turned)| **turned > 0.0);
        left.for_each(|(torque, _)| *torque = -*torque);
        assert_eq!(check(&[sloping.clone()]), Ok(()));
        assert!(wrong(&sloping.head(sloping.time.partition_point(|t| *t < 30.0))).is_none());

        // Magnitudes have no sign that could be wrong.
        let mut plain = signed();
        plain.torque.iter_mut().flatten().for_each(|t| *t = -*t);
        plain.magnitude_only = true;
        assert_eq!(check(&[plain]), Ok(()));
    }
}
