//! Rows at which the speeds and loads of both sides are known, whether or not their sensors share stamps.

use inference::robust::median;
use recordings::Channel;

use crate::settings::{MEASURING, measuring::Rows};
use crate::speeds::held;

const ROWS: Rows = MEASURING.rows;

/// Rows of a recording. Sides: 0 left, 1 right.
pub(crate) struct Joined {
    /// Their stamps, ns.
    pub(crate) stamps: Vec<i64>,
    /// Speeds of the sides, as recorded.
    pub(crate) speed: [Vec<f64>; 2],
    /// Loads of the sides, as recorded.
    pub(crate) load: [Vec<f64>; 2],
}

/// Joins speeds, which may be set, and loads: at the stamps that all share; where they share few, at those of the channel that has the
/// fewest, the others interpolated, and set speeds held. What is farther from its neighbours than usual is not known there.
pub(crate) fn joined(speed: [&Channel; 2], set: bool, load: [&Channel; 2]) -> Joined {
    let all = [speed[0], speed[1], load[0], load[1]];
    let slowest = all.into_iter().min_by_key(|c| c.t_ns().len()).unwrap_or(load[0]);
    let has = |c: &Channel, t: i64| c.t_ns().binary_search(&t).is_ok();
    let shared = slowest.t_ns().iter().filter(|t| all.iter().all(|c| has(c, **t))).count();
    // Of clocks that differ nobody knows by how much.
    let one_clock = all.iter().all(|c| c.clock() == all[0].clock());
    let is_shared = !one_clock || shared as f64 >= ROWS.shared * slowest.t_ns().len() as f64;

    let gaps = all.map(|c| ROWS.join_gap * median(c.t_ns().windows(2).map(|w| (w[1] - w[0]) as f64)).unwrap_or(0.0));
    let value = |k: usize, t: i64| match all[k].t_ns().binary_search(&t) {
        Ok(i) => Some(all[k].values()[i]),
        Err(_) if is_shared => None,
        Err(_) if set && k < 2 => held(all[k], t),
        Err(_) => between(all[k], t, gaps[k]),
    };
    let mut out = Joined { stamps: Vec::new(), speed: [const { Vec::new() }; 2], load: [const { Vec::new() }; 2] };
    for &t in slowest.t_ns() {
        let [Some(l), Some(r), Some(load_l), Some(load_r)] = [0, 1, 2, 3].map(|k| value(k, t)) else { continue };
        out.stamps.push(t);
        for (column, v) in out.speed.iter_mut().chain(&mut out.load).zip([l, r, load_l, load_r]) {
            column.push(v);
        }
    }
    out
}

/// Between the values before and after, no farther apart than so many ns.
fn between(c: &Channel, t: i64, gap: f64) -> Option<f64> {
    let next = c.t_ns().partition_point(|own| *own <= t);
    let before = next.checked_sub(1)?;
    let [a, b] = [*c.t_ns().get(before)?, *c.t_ns().get(next)?];
    let share = (t - a) as f64 / (b - a) as f64;
    ((b - a) as f64 <= gap).then(|| c.values()[before] * (1.0 - share) + c.values()[next] * share)
}

#[cfg(test)]
mod tests {
    use recordings::Signal;

    use super::*;

    fn channel(signal: Signal, from: i64, every: i64, count: i64, value: impl Fn(i64) -> f64) -> Channel {
        let stamps: Vec<i64> = (0..count).map(|k| (from + k * every) * 1_000_000).collect();
        let values = stamps.iter().map(|t| value(t / 1_000_000)).collect();
        Channel::new(signal, 0, stamps, values).expect("a channel")
    }

    #[test]
    fn sensors_with_stamps_of_their_own_are_joined_at_those_of_the_slowest() {
        let speed = [Signal::WheelSpeedLeft, Signal::WheelSpeedRight].map(|s| channel(s, 3, 50, 100, |ms| ms as f64));
        let load = [Signal::CurrentLeft, Signal::CurrentRight].map(|s| channel(s, 10, 100, 60, |ms| 2.0 * ms as f64));
        let rows = joined(speed.each_ref(), false, load.each_ref());
        // The speeds end after 4.953 s.
        assert_eq!((rows.stamps.len(), rows.stamps[1]), (50, 110_000_000));
        approx::assert_relative_eq!(rows.speed[0][1], 110.0, epsilon = 1e-9);
        approx::assert_relative_eq!(rows.load[1][1], 220.0, epsilon = 1e-9);

        // Speeds that are set are held, and not between two of them.
        let rows = joined(speed.each_ref(), true, load.each_ref());
        approx::assert_relative_eq!(rows.speed[0][1], 103.0, epsilon = 1e-9);
    }

    #[test]
    fn sensors_of_different_clocks_are_not_joined() {
        let speed = [Signal::WheelSpeedLeft, Signal::WheelSpeedRight].map(|s| channel(s, 3, 50, 100, |ms| ms as f64));
        let load = [Signal::CurrentLeft, Signal::CurrentRight].map(|s| {
            let own = channel(s, 10, 100, 60, |ms| ms as f64);
            Channel::new(s, 1, own.t_ns().to_vec(), own.values().to_vec()).expect("a channel")
        });
        assert_eq!(joined(speed.each_ref(), false, load.each_ref()).stamps.len(), 0);
    }

    #[test]
    fn stamps_that_are_shared_stay_the_only_rows_and_a_gap_is_not_bridged() {
        let speed = [Signal::WheelSpeedLeft, Signal::WheelSpeedRight].map(|s| channel(s, 0, 50, 40, |ms| ms as f64));
        let load = [Signal::CurrentLeft, Signal::CurrentRight].map(|s| channel(s, 0, 100, 20, |ms| ms as f64));
        assert_eq!(joined(speed.each_ref(), false, load.each_ref()).stamps.len(), 20);

        let late = channel(Signal::CurrentRight, 10, 100, 20, |ms| ms as f64);
        let mut stamps = speed[0].t_ns().to_vec();
        stamps.drain(10..20);
        let values = vec![1.0; stamps.len()];
        let broken = Channel::new(Signal::WheelSpeedLeft, 0, stamps, values).expect("a channel");
        let rows = joined([&broken, &speed[1]], false, [&load[0], &late]);
        assert!(rows.stamps.iter().all(|t| !(460_000_000..990_000_000).contains(t)), "{:?}", rows.stamps);
        assert!(rows.stamps.len() > 10);
    }
}
