//! Poses that jump farther than a robot moves from row to row.
//!
//! A tracker that takes another body for the robot, or a map that is matched anew, moves the pose at once, and may move it back. Between
//! two such rows nothing tells how the robot moved but its motion before, which is put in their place: all that is compared are
//! motions, so that what follows is as good as before.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use inference::robust::{median, quantile, sorted};

use crate::motion::{placed, relative};
use crate::settings::{PoseJumps, SETTINGS};

const RULES: PoseJumps = SETTINGS.pose_jumps;

/// Motion from one row in which the pose is seen to the next: seconds, then ahead and to the left, m, and turned, rad.
type Step = (f64, [f64; 3]);

/// Takes jumps out of a pose in m and rad, rows that are not seen are NaN; a sentence on what was done.
///
/// A pose that is elsewhere for a row or few is taken as not seen there; one that stays there is continued as the robot moved before.
/// Where it jumps all the time nothing is done: that is how this pose is.
pub fn without_jumps(time: &[f64], pose: &mut [[f64; 3]]) -> Option<String> {
    let seen: Vec<usize> = (0..pose.len()).filter(|&k| pose[k].iter().all(|x| x.is_finite())).collect();
    let between = |pose: &[[f64; 3]], a: usize, b: usize| -> Step { (time[b] - time[a], relative(pose[a], pose[b])) };
    let mut steps: Vec<Step> = seen.windows(2).map(|pair| between(pose, pair[0], pair[1])).collect();
    let limits = Limits::of(&steps)?;

    let jumps: Vec<usize> = (0..steps.len()).filter(|&k| limits.are_passed(&steps[k])).collect();
    let duration = time.last()? - time.first()?;
    if jumps.is_empty() || jumps.len() as f64 > RULES.most * duration {
        return None;
    }

    let mut unseen: Vec<usize> = Vec::new();
    for &jump in &jumps {
        let lone = rows_before(&steps, jump, |a, b| between(pose, seen[a], seen[b]))
            .or_else(|| rows_after(&limits, (jump, seen.len()), |a, b| between(pose, seen[a], seen[b])));
        // Where these rows come back they do not leave anew.
        if let Some(rows) = lone.filter(|_| !unseen.contains(&seen[jump])) {
            unseen.extend_from_slice(&seen[rows]);
        }
    }
    unseen.sort_unstable();
    for &row in &unseen {
        pose[row] = [f64::NAN; 3];
    }
    let seen: Vec<usize> = seen.into_iter().filter(|row| !unseen.contains(row)).collect();
    steps = seen.windows(2).map(|pair| between(pose, pair[0], pair[1])).collect();

    // The others go on as the robot moved before.
    let mut jumped: Vec<Jump> = Vec::new();
    let mut frame = Frame::default();
    for k in 0..steps.len() {
        let row = seen[k + 1];
        let passed = limits.passed(&steps[k]);
        if passed.contains(&true) {
            jumped.push(Jump { time: time[row], way: steps[k].1, passed });
            steps[k].1 = before(&steps[..k]).map(|rate| rate * steps[k].0);
            frame.move_to(passed, pose[row], placed(pose[seen[k]], steps[k].1));
        }
        pose[row] = frame.of(pose[row]);
    }
    let elsewhere = unseen.first().map(|&row| elsewhere(unseen.len(), time[row]));
    Some([elsewhere, told(&jumped)].into_iter().flatten().collect::<Vec<_>>().join("; "))
}

/// Rows before a jump that are elsewhere, of which it is the way back: without them the robot goes on as before. They may have left
/// by less than is farther than a robot moves.
fn rows_before(steps: &[Step], jump: usize, between: impl Fn(usize, usize) -> Step) -> Option<RangeInclusive<usize>> {
    let off = |(dt, moved): Step, rate: [f64; 3]| {
        let off: [f64; 3] = std::array::from_fn(|axis| moved[axis] - rate[axis] * dt);
        [way(&off) / RULES.least[0], turned(&off) / RULES.least[1]].into_iter().fold(0.0, f64::max)
    };
    let is_back = |last: usize| {
        let rate = before(&steps[..last]);
        off(between(last, jump + 1), rate) < RULES.back * off(steps[jump], rate)
    };
    let last = (1..=RULES.lone).filter_map(|rows| jump.checked_sub(rows)).find(|last| is_back(*last))?;
    Some(last + 1..=jump)
}

/// Rows from a jump on that are elsewhere, until the pose is where it would be had it not jumped, whatever time has passed; of so many.
fn rows_after(
    limits: &Limits,
    (jump, count): (usize, usize),
    between: impl Fn(usize, usize) -> Step,
) -> Option<RangeInclusive<usize>> {
    let next = (1..=RULES.lone).map(|rows| jump + 1 + rows).filter(|next| *next < count);
    let back = next.into_iter().find(|next| !limits.are_passed(&(limits.apart, between(jump, *next).1)))?;
    Some(jump + 1..=back - 1)
}

/// A jump of a pose.
struct Jump {
    time: f64,
    way: [f64; 3],
    /// Whether by its place, and by its yaw.
    passed: [bool; 2],
}

/// Rows in which the pose is elsewhere, the first of them at this time, for people.
fn elsewhere(rows: usize, time: f64) -> String {
    let [of_rows, are] = if rows == 1 {
        [format!("the pose at {time:.1} s"), "is".to_owned()]
    } else {
        [format!("{rows} single poses, the first at {time:.1} s,"), "are".to_owned()]
    };
    format!(
        "{of_rows} {are} farther from those before and after than the robot moves from row to row, and {are} taken as not seen"
    )
}

/// Jumps of a pose that stays where it is then, for people.
fn told(jumps: &[Jump]) -> Option<String> {
    let first = jumps.first()?;
    let more = match jumps.len() {
        1 => String::new(),
        2 => ", and once more".to_owned(),
        count => format!(", and {} times more", count - 1),
    };
    let by = [format!("{:.2} m", way(&first.way)), format!("{:.2} rad", turned(&first.way))];
    let by: Vec<String> = by.into_iter().zip(first.passed).filter(|(_, passed)| *passed).map(|(by, _)| by).collect();
    Some(format!(
        "the pose jumps by {} at {:.1} s{more}, farther than the robot moves from row to row: it is continued there as the robot moved \
         before",
        by.join(" and "),
        first.time
    ))
}

/// A frame that moved, so that places and yaw are other numbers in it.
#[derive(Default)]
struct Frame {
    /// Of places, about the origin, rad.
    turned: f64,
    /// Added to yaw, rad.
    yaw: f64,
    /// m.
    shift: [f64; 2],
}

impl Frame {
    fn of(&self, [x, y, yaw]: [f64; 3]) -> [f64; 3] {
        let (sin, cos) = self.turned.sin_cos();
        [x * cos - y * sin + self.shift[0], x * sin + y * cos + self.shift[1], yaw + self.yaw]
    }

    /// Moves it where a pose is another: in place, in yaw, or in both, when places are seen turned as well.
    fn move_to(&mut self, [is_place, is_yaw]: [bool; 2], pose: [f64; 3], to: [f64; 3]) {
        if is_yaw {
            let by = to[2] - pose[2] - self.yaw;
            self.yaw += by;
            self.turned += if is_place { by } else { 0.0 };
        }
        if is_place {
            let now = self.of(pose);
            self.shift = [0, 1].map(|axis| self.shift[axis] + to[axis] - now[axis]);
        }
    }
}

/// What is farther than a robot moves.
struct Limits {
    /// Usual time between rows, s.
    apart: f64,
    /// m/s and rad/s.
    rates: [f64; 2],
}

impl Limits {
    fn of(steps: &[Step]) -> Option<Self> {
        let apart = median(steps.iter().map(|(dt, _)| *dt))?;
        let largest = |of: fn(&[f64; 3]) -> f64| {
            let rates = steps.iter().map(|(dt, moved)| of(moved) / dt.max(apart));
            Some(RULES.times * quantile(&sorted(rates), RULES.quantile)?)
        };
        Some(Self { apart, rates: [largest(way)?, largest(turned)?] })
    }

    fn are_passed(&self, step: &Step) -> bool {
        self.passed(step).contains(&true)
    }

    /// By the way, and by turning.
    fn passed(&self, (dt, moved): &Step) -> [bool; 2] {
        let of = [way(moved), turned(moved)];
        [0, 1].map(|k| of[k] > (self.rates[k] * dt.max(self.apart)).max(RULES.least[k]))
    }
}

fn way(moved: &[f64; 3]) -> f64 {
    moved[0].hypot(moved[1])
}

/// The shorter way around.
fn turned(moved: &[f64; 3]) -> f64 {
    (moved[2] - turns(moved, 2)).abs()
}

/// Whole turns of a yaw that wraps around, rad; none of a way.
fn turns(moved: &[f64; 3], axis: usize) -> f64 {
    if axis == 2 { (moved[2] / TAU).round() * TAU } else { 0.0 }
}

/// Rates over the last steps.
fn before(steps: &[Step]) -> [f64; 3] {
    let last = &steps[steps.len().saturating_sub(RULES.before)..];
    let time: f64 = last.iter().map(|(dt, _)| dt).sum();
    let sum = |axis: usize| last.iter().map(|(_, moved)| moved[axis] - turns(moved, axis)).sum::<f64>();
    if time > 0.0 { [0, 1, 2].map(|axis| sum(axis) / time) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EVERY: f64 = 0.02;

    /// A circle at 1 m/s.
    fn circle() -> (Vec<f64>, Vec<[f64; 3]>) {
        let time: Vec<f64> = (0..2000).map(|k| EVERY * f64::from(k)).collect();
        let at = |t: &f64| [2.0 * (0.5 * t).sin(), 2.0 * (1.0 - (0.5 * t).cos()), 0.5 * t];
        let pose = time.iter().map(at).collect();
        (time, pose)
    }

    fn most_apart(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
        let seen = a.iter().zip(b).filter(|(a, _)| a[0].is_finite());
        seen.flat_map(|(a, b)| (0..3).map(|axis| (a[axis] - b[axis]).abs())).fold(0.0, f64::max)
    }

    #[test]
    fn a_pose_that_jumps_and_stays_or_comes_back_goes_on_as_the_robot_moved() {
        let (time, right) = circle();
        let mut untouched = right.clone();
        assert_eq!(without_jumps(&time, &mut untouched), None);
        assert_eq!(untouched, right);

        let (sin, cos) = 0.2_f64.sin_cos();
        let elsewhere = |[x, y, yaw]: [f64; 3]| [x * cos - y * sin + 0.3, x * sin + y * cos - 0.2, yaw + 0.2 - TAU];
        let turned = |[x, y, yaw]: [f64; 3]| [x, y, yaw + 0.3];
        for (until, to) in [(1040, &elsewhere as &dyn Fn([f64; 3]) -> [f64; 3]), (2000, &elsewhere), (2000, &turned)] {
            let mut pose = right.clone();
            for row in &mut pose[1000..until] {
                *row = to(*row);
            }
            let told = without_jumps(&time, &mut pose).expect("a jump");
            assert!(told.contains("at 20.0 s"), "{told}");
            assert_eq!(told.contains("once more"), until < 2000);
            assert!(most_apart(&pose, &right) < 1e-3, "{}", most_apart(&pose, &right));
        }
    }

    #[test]
    fn a_row_that_leaves_by_less_than_is_no_motion_and_comes_back_by_more_moves_nothing_that_follows() {
        let (time, right) = circle();
        // Up to 0.1 rad from row to row may be motion: the one is no motion as it leaves, the other as it comes back.
        let mut pose = right.clone();
        pose[400][2] += 0.105;
        pose[800][2] -= 0.105;
        let told = without_jumps(&time, &mut pose).expect("a jump");
        let unseen: Vec<usize> = (0..pose.len()).filter(|k| pose[*k][0].is_nan()).collect();
        assert_eq!(unseen, [400, 800], "{told}");
        assert_eq!(most_apart(&pose, &right), 0.0, "{told}");
        assert!(told.starts_with("2 single poses, the first at 8.0 s, are") && !told.contains("jumps"), "{told}");
    }

    #[test]
    fn single_rows_elsewhere_are_not_seen_and_a_pose_that_always_jumps_stays() {
        let (time, right) = circle();
        let mut pose = right.clone();
        pose[500][0] += 1.0;
        pose[900][2] += 1.0;
        pose[901][2] += 1.0;
        without_jumps(&time, &mut pose).expect("jumps");
        let unseen: Vec<usize> = (0..pose.len()).filter(|k| pose[*k][0].is_nan()).collect();
        assert_eq!(unseen, [500, 900, 901]);
        assert_eq!(most_apart(&pose, &right), 0.0);

        let mut always = right.clone();
        for (k, row) in always.iter_mut().enumerate() {
            row[1] += 0.3 * f64::from(u8::from(k / 125 % 2 == 1));
        }
        let before = always.clone();
        assert_eq!(without_jumps(&time, &mut always), None);
        assert_eq!(always, before);
    }
}
