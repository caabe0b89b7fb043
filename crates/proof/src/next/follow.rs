//! The drives of the proof: a calm one to begin with, the advised one, and two at random.

use examiner::Course;
use sim::{Purpose, Stream};
use verdict::Manoeuvre;

/// Speed and yaw rate of calm drives, m/s and rad/s.
const CALM: [[f64; 2]; 2] = [[0.12, 0.3], [0.15, 0.4]];
/// Time of a calm ramp, s.
const RAMP: f64 = 1.5;
/// Time of a level of a random profile, s, and of each ramp.
const EACH: f64 = 1.5;
const SHORT_RAMP: f64 = 0.7;

/// What the random draws come from: one stream for each purpose of a case.
fn stream(seed: u64, purpose: u64) -> Stream {
    Stream::new(seed, Purpose::Search, purpose)
}

/// One gentle kind of drive: straight ahead and back, or one circle, or a slow spin one way.
pub(super) fn calm(seed: u64, seconds: f64) -> Course {
    let mut s = stream(seed, 0);
    let [v, w] = CALM.map(|[low, high]| s.uniform(low, high));
    let side = if s.uniform(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 };
    let kind = s.uniform(0.0, 3.0);
    let levels = if kind < 1.0 {
        vec![[v, 0.0], [-v, 0.0]]
    } else if kind < 2.0 {
        vec![[v, 0.6 * side * w]]
    } else {
        vec![[0.0, side * w]]
    };
    Course { points: points(&levels, seconds, RAMP), ..Course::default() }
}

/// Levels held for equal times, from rest to rest.
fn points(levels: &[[f64; 2]], seconds: f64, ramp: f64) -> Vec<[f64; 3]> {
    let each = seconds / levels.len() as f64;
    let ramp = ramp.min(0.45 * each);
    let mut out = vec![[0.0; 3]];
    for (i, [v, w]) in levels.iter().enumerate() {
        let (from, last) = (i as f64 * each, i + 1 == levels.len());
        out.push([from + ramp, *v, *w]);
        out.push([from + each - if last { ramp } else { 0.0 }, *v, *w]);
    }
    out.push([seconds, 0.0, 0.0]);
    out
}

/// A drive as it was advised.
pub(super) fn advised(m: &Manoeuvre) -> Course {
    Course { start: Some(m.start), points: m.profile.clone(), torque_free: m.torque_free.clone() }
}

/// A random drive of the menu: any whose recording can be added to the others, the searched one aside.
pub(super) fn of_menu(menu: &[Manoeuvre], seed: u64) -> Option<&Manoeuvre> {
    let mut can: Vec<&Manoeuvre> = menu.iter().filter(|m| m.joins && !m.optimised).collect();
    // In an order that owes nothing to the advice.
    can.sort_by(|a, b| a.name.cmp(&b.name));
    let at = stream(seed, 1).uniform(0.0, can.len() as f64) as usize;
    can.get(at).copied()
}

/// A random speed profile within what the menu reaches, begun where the menu begins.
pub(super) fn by_lot(menu: &[Manoeuvre], seed: u64, seconds: f64) -> Option<Course> {
    let start = menu.iter().find(|m| m.joins)?.start;
    let all = || menu.iter().filter(|m| m.joins).flat_map(|m| &m.profile);
    let most = [1, 2].map(|c| all().map(|p| p[c].abs()).fold(0.0, f64::max));
    let mut s = stream(seed, 2);
    // Wheels turn no faster than at the limits of speed or of yaw rate alone, as in the advice.
    let mut level = || {
        let [v, w] = [s.uniform(-1.0, 1.0), s.uniform(-1.0, 1.0)];
        let size = (v.abs() + w.abs()).max(1.0);
        [most[0] * v / size, most[1] * w / size]
    };
    let count = (seconds / EACH).round().max(3.0) as usize;
    let levels: Vec<[f64; 2]> = (0..count).map(|_| level()).collect();
    Some(Course { start: Some(start), points: points(&levels, seconds, SHORT_RAMP), torque_free: Vec::new() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drives_are_sound_and_depend_on_the_seed_alone() {
        for seed in 0..20 {
            let c = calm(seed, 12.0);
            assert_eq!(c, calm(seed, 12.0));
            assert!(c.points.windows(2).all(|p| p[0][0] < p[1][0]), "{c:?}");
            assert!(c.points.iter().all(|p| p[1].abs() <= CALM[0][1] && p[2].abs() <= CALM[1][1]));
        }
        assert_ne!(calm(1, 12.0), calm(2, 12.0));
    }
}
