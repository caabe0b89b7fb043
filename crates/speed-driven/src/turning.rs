//! Turning inferred from the loads alone: what is left where neither a gyro nor a difference of
//! the speeds is known.
//!
//! In a turn the outer side carries the scrub and reads more than both sides read in straight driving, the inner side
//! is dragged and reads next to nothing. In a spin both sides read that much, and unsigned currents do not say which
//! way it goes.

use crate::clock::box_mean;
use crate::run::SpeedRun;
use crate::settings::{CHANGES, changes::FromLoads};
use verdict::{Turning, Way};

const FROM_LOADS: FromLoads = CHANGES.turning;

/// The way at each row, `None` for straight driving or rest. `straight` is the usual straight load of both sides, N m.
pub(crate) fn ways(run: &SpeedRun, straight: f64) -> Vec<Option<Way>> {
    let side = |j: usize| {
        let torque: Vec<f64> = run.torque[j].iter().map(|t| t.abs()).collect();
        box_mean(&run.time, &torque, FROM_LOADS.mean)
    };
    let (left, right) = (side(0), side(1));
    let of_row = |i: usize| {
        if left[i].max(right[i]) <= straight {
            return None;
        }
        let forward = run.forward(i);
        let excess = (right[i] - left[i]) * forward.signum();
        Some(if forward.abs() < FROM_LOADS.least_speed || excess.abs() < FROM_LOADS.even * straight {
            Way::Unknown
        } else if excess > 0.0 {
            Way::Left
        } else {
            Way::Right
        })
    };
    (0..run.time.len()).map(of_row).collect()
}

/// Stretches of turning in a recording.
pub(crate) fn turning(run: &SpeedRun, straight: f64) -> Vec<Turning> {
    let ways = ways(run, straight);
    let rows: Vec<usize> = (0..ways.len()).collect();
    let stretch = |rows: &[usize]| {
        let way = ways[rows[0]]?;
        let (first, last) = (rows[0], rows[rows.len() - 1]);
        Some(Turning { recording: run.name.clone(), interval: [run.time[first], run.time[last]], way })
    };
    rows.chunk_by(|&a, &b| ways[a] == ways[b]).filter_map(stretch).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::tests::{CONSTANT, GROUND, Ground, RADIUS, recording};

    #[test]
    fn turns_show_in_the_loads_with_their_side() {
        let legs = [([0.5, 0.5], 8.0), ([0.3, 0.6], 8.0), ([0.5, 0.5], 8.0), ([0.6, 0.3], 8.0), ([-0.2, 0.2], 8.0)];
        let ground = Ground { straight: 12.0, turning: 20.0, ..GROUND };
        let run = SpeedRun::new(&recording(ground, &legs, None), RADIUS, CONSTANT).expect("a run");
        let found = turning(&run, 12.0);
        let ways: Vec<Way> = found.iter().map(|t| t.way).collect();
        assert_eq!(ways, [Way::Left, Way::Right, Way::Unknown]);
        for (t, from) in found.iter().zip([8.0, 24.0, 32.0]) {
            assert!((t.interval[0] - from).abs() < 0.5 && (t.interval[1] - from - 8.0).abs() < 0.7, "{t:?}");
        }
    }
}
