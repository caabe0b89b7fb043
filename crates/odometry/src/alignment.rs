//! Offset and rate of two devices' clocks, by the speeds of one drive that both measure.

use inference::robust::{mean, median};

use crate::settings::{Clock, SETTINGS};

const RULES: Clock = SETTINGS.clock;

/// Speed, m/s, and turning rate, rad/s, of a path on a grid of 0.2 s from its first row on (`step` of the settings of clocks).
pub fn speeds(time: &[f64], pose: &[[f64; 3]]) -> Vec<Option<[f64; 2]>> {
    on_grid(time, pose, RULES.step)
}

/// The same on a grid of 0.02 s (`fine`), to be looked up at any instant.
pub fn fine_speeds(time: &[f64], pose: &[[f64; 3]]) -> Vec<Option<[f64; 2]>> {
    on_grid(time, pose, RULES.fine)
}

/// Instants of the fine grid over a length of time, s from the start.
pub fn fine_grid(length: f64) -> impl Iterator<Item = f64> {
    (0..(length / RULES.fine) as usize).map(|row| (row as f64 + 0.5) * RULES.fine)
}

/// Speeds are those over [`Clock::step`] about each instant.
fn on_grid(time: &[f64], pose: &[[f64; 3]], grid: f64) -> Vec<Option<[f64; 2]>> {
    let (Some(&first), Some(&last)) = (time.first(), time.last()) else { return Vec::new() };
    let rows = ((last - first) / grid) as usize;
    let at = |row: usize| first + (row as f64 + 0.5) * grid;
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

/// Speeds of one drive by its pose and by another device.
#[derive(Debug, Clone)]
pub struct Compared {
    of_pose: Vec<Option<[f64; 2]>>,
    of_other: Vec<Option<[f64; 2]>>,
    /// Misfit of both with the clocks as they are.
    as_it_is: f64,
}

/// Speed and turning weighed together, m/s; what is NaN, since the other device does not measure it, counts nothing.
fn size([speed, turning]: [f64; 2]) -> f64 {
    [speed.abs(), turning.abs() / SETTINGS.windows.lever].into_iter().filter(|part| part.is_finite()).sum()
}

impl Compared {
    /// Speeds by the pose, as of [`speeds`], and by the other device, as of [`fine_speeds`].
    pub fn new(of_pose: Vec<Option<[f64; 2]>>, of_other: Vec<Option<[f64; 2]>>) -> Self {
        let mut out = Self { of_pose, of_other, as_it_is: 0.0 };
        out.as_it_is = out.misfit([0.0; 2]);
        out
    }

    /// Mean difference of speeds with this offset and rate, m/s.
    fn misfit(&self, [offset, rate]: [f64; 2]) -> f64 {
        let rows = self.of_pose.len();
        let other = |row: usize| {
            let since = (row as f64 + 0.5) * RULES.step;
            let place = (since - offset - rate * since) / RULES.fine;
            if place < 0.0 { None } else { self.of_other.get(place as usize).copied().flatten() }
        };
        let pairs = self.of_pose.iter().enumerate().filter_map(|(row, b)| Some((other(row)?, (*b)?)));
        let (mut sum, mut count) = (0.0, 0_usize);
        for (a, b) in pairs {
            sum += size([a[0] - b[0], a[1] - b[1]]);
            count += 1;
        }
        // What overlaps little tells little.
        if 2 * count < rows { f64::INFINITY } else { sum / count as f64 }
    }

    /// Whether speeds agree with the clocks as they are, to this share of their mean.
    fn agrees(&self, wrong: f64) -> bool {
        let usual = mean(self.of_pose.iter().flatten().map(|v| size(*v))).unwrap_or(0.0);
        self.as_it_is <= wrong * usual
    }

    /// Offset, s, and rate of the other device's clock that make speeds agree: it is behind by `offset + rate t` at the time `t`
    /// of the pose's clock since the start; `None` where none does much better than the clocks as they are.
    fn alignment(&self) -> Option<[f64; 2]> {
        let steps = |[most, step]: [f64; 2]| {
            let n = (most / step).round() as i32;
            (-n..=n).map(move |k| f64::from(k) * step)
        };
        let mut best = ([0.0, 0.0], self.as_it_is);
        let look = |tried: [f64; 2], best: &mut ([f64; 2], f64)| {
            let here = self.misfit(tried);
            if here < best.1 {
                *best = (tried, here);
            }
        };
        for rate in steps(RULES.rate) {
            for offset in steps(RULES.offset) {
                look([offset, rate], &mut best);
            }
        }
        // About the best of the grid, by steps that are halved.
        let mut step = [RULES.offset[1], RULES.rate[1]];
        for _ in 0..RULES.halvings {
            step = step.map(|s| 0.5 * s);
            let about = best.0;
            for a in [-1.0, 0.0, 1.0] {
                for b in [-1.0, 0.0, 1.0] {
                    look([about[0] + a * step[0], about[1] + b * step[1]], &mut best);
                }
            }
        }
        let (found, least) = best;
        (least < RULES.fall * self.as_it_is && found != [0.0; 2]).then_some(found)
    }
}

/// Clocks of drives: offset, s, and rate of the other device's against the pose's.
#[derive(Debug, Clone, PartialEq)]
pub struct Clocks {
    /// Medians of the drives that show any.
    pub usual: [f64; 2],
    /// Of each drive that shows any.
    pub of_drives: Vec<Option<[f64; 2]>>,
}

impl Clocks {
    /// The clocks of drives; `None` where the speeds of all agree with the clocks as they are, to the share `wrong` of their mean.
    pub fn of_most(compared: &[Compared], wrong: f64) -> Option<Self> {
        if compared.iter().all(|drive| drive.agrees(wrong)) {
            return None;
        }
        // One that disagrees asks for all: a slow or short drive shows its clock less.
        let of_drives: Vec<Option<[f64; 2]>> = compared.iter().map(Compared::alignment).collect();
        let known = || of_drives.iter().flatten();
        if 2 * known().count() < compared.len() {
            return None;
        }
        let usual = [median(known().map(|f| f[0]))?, median(known().map(|f| f[1]))?];
        Some(Self { usual, of_drives })
    }
}
