//! Clocks of counts and pose before any fit: two devices may start apart and run at unlike rates.

use std::borrow::Cow;

use inference::robust::{mean, median};

use crate::case::Case;
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

/// Speeds of a drive by its pose and by its counts.
struct Compared {
    /// On a grid of [`Clock::step`].
    of_pose: Vec<Option<[f64; 2]>>,
    /// By its counts, on a grid of [`Clock::fine`].
    of_counts: Vec<Option<[f64; 2]>>,
    /// Misfit of both with the clocks as they are.
    as_it_is: f64,
}

impl Compared {
    fn new(robot: &WheeledRobot, drive: &Drive) -> Self {
        let path = implied(robot, drive, &Laws::given(robot));
        let first = drive.time[0];
        let length = drive.time[drive.time.len() - 1] - first;
        let of = |path: &[[f64; 3]], step: f64| {
            speeds(&drive.time, path, |row| first + (row as f64 + 0.5) * step, (length / step) as usize)
        };
        let (of_pose, of_counts) = (of(&drive.pose, RULES.step), of(&path, RULES.fine));
        let mut out = Self { of_pose, of_counts, as_it_is: 0.0 };
        out.as_it_is = out.misfit([0.0; 2]);
        out
    }

    /// Mean difference of speeds with this offset and rate, m/s.
    fn misfit(&self, [offset, rate]: [f64; 2]) -> f64 {
        let rows = self.of_pose.len();
        let counted = |row: usize| {
            let since = (row as f64 + 0.5) * RULES.step;
            let place = (since - offset - rate * since) / RULES.fine;
            if place < 0.0 { None } else { self.of_counts.get(place as usize).copied().flatten() }
        };
        let pairs = self.of_pose.iter().enumerate().filter_map(|(row, b)| Some((counted(row)?, (*b)?)));
        let [mut sum, mut count] = [0.0; 2];
        for (a, b) in pairs {
            sum += (a[0] - b[0]).abs() + (a[1] - b[1]).abs() / SETTINGS.windows.lever;
            count += 1.0;
        }
        // What overlaps little tells little.
        if 2.0 * count < rows as f64 { f64::INFINITY } else { sum / count }
    }

    /// Whether speeds agree with the clocks as they are.
    fn agrees(&self) -> bool {
        let size = |v: &[f64; 2]| v[0].abs() + v[1].abs() / SETTINGS.windows.lever;
        let usual = mean(self.of_pose.iter().flatten().map(size)).unwrap_or(0.0);
        self.as_it_is <= RULES.wrong * usual
    }

    /// Offset and rate of the counts' clock that make speeds agree: [`Laws::clock`](crate::motion::Laws) to start a fit from;
    /// `None` where none does much better than the clocks as they are.
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

/// The same case with drives whose clocks start apart by unlike times brought to what is usual among them, which the fit then
/// finds, and without the pose where no counts stand beside it. Counts and pose that two devices write, or that were joined by
/// hand, start so.
///
/// With the usual offset and rate of the recordings, where they disagree.
pub(crate) fn joined(case: &Case) -> (Cow<'_, Case>, Option<[f64; 2]>) {
    let [references, recordings] = [&case.references, &case.recordings].map(|drives| together(&case.robot, drives));
    let usual = recordings.as_ref().map(|(_, usual)| *usual);
    if references.is_none() && recordings.is_none() {
        return (Cow::Borrowed(case), usual);
    }
    let or_as_given = |drives: Option<(Vec<Drive>, [f64; 2])>, given: &[Drive]| {
        drives.map_or_else(|| given.to_vec(), |(drives, _)| drives)
    };
    let joined = Case {
        robot: case.robot.clone(),
        references: or_as_given(references, &case.references),
        recordings: or_as_given(recordings, &case.recordings),
    };
    (Cow::Owned(joined), usual)
}

/// Clocks of drives: offset and rate.
struct Clocks {
    usual: [f64; 2],
    /// Of each drive that shows any.
    of_drives: Vec<Option<[f64; 2]>>,
}

/// The clocks of drives; `None` where those of most agree as they are.
fn of_most(robot: &WheeledRobot, drives: &[Drive]) -> Option<Clocks> {
    let compared: Vec<Compared> = drives.iter().map(|d| Compared::new(robot, d)).collect();
    if compared.iter().all(Compared::agrees) {
        return None;
    }
    // One that disagrees asks for all: a slow or short drive shows its clock less.
    let found: Vec<Option<[f64; 2]>> = compared.iter().map(Compared::alignment).collect();
    let known = || found.iter().flatten();
    if 2 * known().count() < drives.len() {
        return None;
    }
    let usual = [median(known().map(|f| f[0]))?, median(known().map(|f| f[1]))?];
    Some(Clocks { usual, of_drives: found })
}

/// `None` where the clocks of most agree as they are.
fn together(robot: &WheeledRobot, drives: &[Drive]) -> Option<(Vec<Drive>, [f64; 2])> {
    let Clocks { usual, of_drives } = of_most(robot, drives)?;
    let mut moved = Vec::new();
    let mut of = |(drive, found): (&Drive, &Option<[f64; 2]>)| {
        let apart = found.map_or(0.0, |f| f[0] - usual[0]);
        let mut out = drive.clone();
        if apart.abs() > RULES.apart {
            out.shift_counts(apart);
            moved.push(format!("{} in '{}'", behind(usual[0] + apart), drive.name));
        }
        out.forget_pose_beyond(usual, apart);
        out
    };
    let mut out: Vec<Drive> = drives.iter().zip(&of_drives).map(&mut of).collect();
    if let (Some(first), false) = (out.first_mut(), moved.is_empty()) {
        first.told.push(format!(
            "by the speeds of counts and pose their clocks are apart by unlike times: that of the counts is {}; the counts of these \
             drives were moved to what is usual among all, {}, before the comparison",
            moved.join(", "),
            behind(usual[0])
        ));
    }
    Some((out, usual))
}

/// "1.5 s behind", "0.3 s ahead"
fn behind(offset: f64) -> String {
    format!("{:.1} s {}", offset.abs(), if offset < 0.0 { "ahead" } else { "behind" })
}
