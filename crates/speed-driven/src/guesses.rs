//! What a mapping may have wrong: said as a guess with its reason, never acted upon.

use crate::run::SpeedRun;
use crate::settings::{MEASURING, measuring::Guesses};

const GUESSES: Guesses = MEASURING.guesses;

/// Guesses about the signs of currents and about which speeds these are.
pub(crate) fn guesses(run: &SpeedRun) -> Vec<String> {
    ["left", "right"].into_iter().enumerate().filter_map(|(j, side)| sign(run, j, side)).chain(speeds(run)).collect()
}

/// Currents without a sign that have one, or the other way round.
fn sign(run: &SpeedRun, j: usize, side: &str) -> Option<String> {
    let torque = &run.torque[j];
    let largest = torque.iter().map(|t| t.abs()).fold(0.0, f64::max);
    let negative = torque.iter().filter(|t| **t < -GUESSES.noise * largest).count();
    let backward = (0..torque.len()).filter(|&i| run.speed[j][i] < 0.0 && torque[i].abs() > run.dead_band).count();
    let seconds = |rows: usize| rows as f64 * run.period();
    if run.magnitude_only && seconds(negative) > GUESSES.seconds {
        return Some(format!(
            "recording {}: the {side} current is mapped as a magnitude, and is negative for {:.0} s: it may have a sign; if \
             so, write `magnitude_only = false` for it in the mapping",
            run.name,
            seconds(negative)
        ));
    }
    (!run.magnitude_only && negative == 0 && seconds(backward) > GUESSES.seconds).then(|| {
        format!(
            "recording {}: the {side} current or torque is mapped with its sign, and is never negative, though this side turns \
             backward for {:.0} s: it may be a magnitude; if so, write `magnitude_only = true` for it in the mapping",
            run.name,
            seconds(backward)
        )
    })
}

/// Set speeds that scatter like measured ones, or measured ones that stand like set speeds.
fn speeds(run: &SpeedRun) -> Option<String> {
    let moving: Vec<usize> = (1..run.time.len()).filter(|&i| run.forward(i).abs() > GUESSES.moving).collect();
    if (moving.len() as f64) * run.period() < GUESSES.seconds {
        return None;
    }
    let stands = |&&i: &&usize| (0..2).all(|j| (run.speed[j][i] - run.speed[j][i - 1]).abs() < 1e-9);
    let share = moving.iter().filter(stands).count() as f64 / moving.len() as f64;
    let [few, many] = GUESSES.constant;
    if run.set_points && share < few {
        return Some(format!(
            "recording {}: the speeds are mapped as set-points, and change in {:.0} % of the rows: they may be measured; if so, \
             map them to wheel_speed_left and wheel_speed_right",
            run.name,
            100.0 * (1.0 - share)
        ));
    }
    (!run.set_points && share > many).then(|| {
        format!(
            "recording {}: the speeds are mapped as measured, and are constant in {:.0} % of the rows in which the robot moves: \
             they may be set-points; if so, map them to command_speed_left and command_speed_right",
            run.name,
            100.0 * share
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Leg, drive};

    fn back_and_forth() -> SpeedRun {
        drive(&[Leg::straight(20.0), Leg { speed: [-0.24; 2], ..Leg::straight(20.0) }], false)
    }

    #[test]
    fn what_the_mapping_says_and_the_signals_show_is_no_guess() {
        assert_eq!(guesses(&back_and_forth()), Vec::<String>::new());
    }

    #[test]
    fn currents_that_look_signed_or_unsigned_are_told() {
        let mut signed = back_and_forth();
        for torque in &mut signed.torque {
            for (t, v) in torque.iter_mut().zip(&signed.speed[0]) {
                *t *= v.signum();
            }
        }
        let told = guesses(&signed);
        assert!(
            told.len() == 2 && told[0].contains("left current") && told[0].contains("magnitude_only = false"),
            "{told:?}"
        );
        signed.magnitude_only = false;
        assert_eq!(guesses(&signed), Vec::<String>::new());
        let unsigned = SpeedRun { magnitude_only: false, ..back_and_forth() };
        assert!(guesses(&unsigned).iter().all(|g| g.contains("magnitude_only = true")), "{:?}", guesses(&unsigned));
    }

    #[test]
    fn speeds_that_look_measured_or_set_are_told() {
        let mut scatters = back_and_forth();
        for (i, v) in scatters.speed[0].iter_mut().enumerate() {
            *v += 1e-3 * (i % 7) as f64;
        }
        assert!(guesses(&scatters)[0].contains("map them to wheel_speed_left"), "{:?}", guesses(&scatters));
        scatters.set_points = false;
        assert_eq!(guesses(&scatters), Vec::<String>::new());
        let stands = SpeedRun { set_points: false, ..back_and_forth() };
        assert!(guesses(&stands)[0].contains("command_speed_left"), "{:?}", guesses(&stands));
    }
}
