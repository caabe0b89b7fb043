//! Clocks of counts and pose before any fit: two devices may start apart and run at unlike rates.

use crate::drive::Drive;
use crate::motion::{Laws, implied};
use crate::settings::{Clock, SETTINGS};
use crate::wheel::WheeledRobot;

const RULES: Clock = SETTINGS.clock;

/// Speed and turning rate on a grid of the counts' clock.
fn speeds(time: &[f64], pose: &[[f64; 3]], at: impl Fn(usize) -> f64, rows: usize) -> Vec<Option<[f64; 2]>> {
    let mut k = 0;
    let mut place = |t: f64| -> Option<[f64; 3]> {
        while k + 2 < time.len() && time[k + 1] < t {
            k += 1;
        }
        while k > 0 && time[k] > t {
            k -= 1;
        }
        if t < time[0] || t > time[time.len() - 1] {
            return None;
        }
        let share = (t - time[k]) / (time[k + 1] - time[k]);
        let out = [0, 1, 2].map(|axis| pose[k][axis] + share * (pose[k + 1][axis] - pose[k][axis]));
        out.iter().all(|x| x.is_finite()).then_some(out)
    };
    let mut of = |row: usize| {
        let half = 0.5 * RULES.step;
        let (before, after) = (place(at(row) - half)?, place(at(row) + half)?);
        let way = (after[0] - before[0]).hypot(after[1] - before[1]);
        Some([way / RULES.step, (after[2] - before[2]) / RULES.step])
    };
    (0..rows).map(&mut of).collect()
}

/// Offset and rate of the counts' clock that make speeds agree: [`Laws::clock`](crate::motion::Laws) to start a fit from;
/// `None` where the clocks agree as they are, or nothing tells.
pub(crate) fn alignment(robot: &WheeledRobot, drive: &Drive) -> Option<[f64; 2]> {
    let path = implied(robot, drive, &Laws::given(robot));
    let (first, last) = (drive.time[0], drive.time[drive.time.len() - 1]);
    let rows = ((last - first) / RULES.step) as usize;
    let middle = 0.5 * (first + last);
    let grid = |row: usize| first + (row as f64 + 0.5) * RULES.step;
    let of_pose = speeds(&drive.time, &drive.pose, grid, rows);

    let misfit = |offset: f64, rate: f64| -> f64 {
        let shifted = |row: usize| grid(row) - offset - rate * (grid(row) - middle);
        let of_counts = speeds(&drive.time, &path, shifted, rows);
        let pairs = of_counts.iter().zip(&of_pose).filter_map(|(a, b)| Some(((*a)?, (*b)?)));
        let [mut sum, mut count] = [0.0; 2];
        for (a, b) in pairs {
            sum += (a[0] - b[0]).abs() + (a[1] - b[1]).abs() / SETTINGS.windows.lever;
            count += 1.0;
        }
        // What overlaps little tells little.
        if 2.0 * count < rows as f64 { f64::INFINITY } else { sum / count }
    };

    let steps = |[most, step]: [f64; 2]| {
        let n = (most / step).round() as i32;
        (-n..=n).map(move |k| f64::from(k) * step)
    };
    let mut best = [0.0, 0.0];
    let as_it_is = misfit(0.0, 0.0);
    let size = |v: &[f64; 2]| v[0].abs() + v[1].abs() / SETTINGS.windows.lever;
    let usual = inference::robust::mean(of_pose.iter().flatten().map(size)).unwrap_or(0.0);
    if as_it_is <= RULES.wrong * usual {
        return None;
    }
    let mut least = as_it_is;
    for rate in steps(RULES.rate) {
        for offset in steps(RULES.offset) {
            let here = misfit(offset, rate);
            if here < least {
                (least, best) = (here, [offset, rate]);
            }
        }
    }
    (least < RULES.fall * as_it_is && best != [0.0; 2]).then_some(best)
}
