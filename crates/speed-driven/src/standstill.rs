//! Wheels that are commanded to turn the robot while its body does not turn: dug in, or spinning free.

use crate::run::SpeedRun;
use crate::settings::{CHANGES, MEASURING, changes::Stuck, measuring::Turns};
use verdict::Standstill;

const STUCK: Stuck = CHANGES.standstill;
const TURNS: Turns = MEASURING.turns;

/// Stretches of a recording in which the body stood although the wheels were commanded to turn it;
/// `track` in m.
pub(crate) fn standstills(run: &SpeedRun, track: f64) -> Vec<Standstill> {
    let Some(yaw) = &run.yaw_rate else { return Vec::new() };
    let share = |i: usize| yaw[i] * track / run.difference(i);
    let stands = |i: usize| {
        run.difference(i).abs() > STUCK.turn && run.held(i, TURNS.steady, TURNS.hold) && share(i).abs() < STUCK.share
    };
    let rows: Vec<usize> = (0..run.time.len()).collect();
    let stretch = |rows: &[usize]| {
        let (first, last) = (rows[0], rows[rows.len() - 1]);
        let seconds = run.time[last] - run.time[first];
        (stands(first) && seconds >= STUCK.least_seconds).then(|| {
            let mean = |f: &dyn Fn(usize) -> f64| rows.iter().map(|&i| f(i)).sum::<f64>() / rows.len() as f64;
            Standstill {
                recording: run.name.clone(),
                interval: [run.time[first], run.time[last]],
                share: mean(&share),
                load: mean(&|i| run.torque[0][i].abs().max(run.torque[1][i].abs())),
            }
        })
    };
    rows.chunk_by(|&a, &b| stands(a) == stands(b)).filter_map(stretch).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::tests::{CONSTANT, GROUND, Ground, RADIUS, recording};

    #[test]
    fn a_body_that_does_not_turn_is_told_from_one_that_does() {
        let run = |track: f64| {
            let legs = [([0.5, 0.5], 5.0), ([-0.2, 0.2], 8.0), ([0.5, 0.5], 5.0)];
            SpeedRun::new(&recording(Ground { track, ..GROUND }, &legs, None), RADIUS, CONSTANT).expect("a run")
        };
        assert_eq!(standstills(&run(GROUND.track), GROUND.track), []);
        let found = standstills(&run(100.0), GROUND.track);
        assert_eq!(found.len(), 1);
        let [from, until] = found[0].interval;
        assert!((5.9..6.4).contains(&from) && (12.5..13.1).contains(&until), "{found:?}");
        assert!(found[0].share < 0.05);
    }
}
