//! The menu: drives that a user can make without preparation, and two that need some.

use inference::robust::select_quantile;
use robot_model::Robot;

use crate::channel::{Channel, Channels};
use crate::settings::next::{Limits, Menu, SETTINGS};
use crate::windows::{Cut, WINDOW};
use verdict::Course;

const LIMITS: Limits = SETTINGS.scope;
const MENU: Menu = SETTINGS.menu;

/// How the robot is prepared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Setup {
    /// As it was.
    AsItIs,
    /// With a known load over its centre.
    Loaded,
    /// Wheels off the ground.
    Lifted,
}

/// One drive of the menu.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) name: String,
    pub(crate) setup: Setup,
    /// Pose at the start: x, y in m, yaw in rad.
    pub(crate) start: [f64; 3],
    pub(crate) course: Course,
    /// Found by a search for these rivals.
    pub(crate) optimised: bool,
}

/// How fast the robot may go, turn, and where it starts.
#[derive(Debug, Clone)]
pub(crate) struct Scope {
    /// m/s and rad/s.
    pub(crate) limits: [f64; 2],
    pub(crate) start: [f64; 3],
    /// Length of every drive, s.
    pub(crate) length: f64,
    /// The recorded path as a course.
    path: Course,
}

impl Scope {
    /// What the drives of a case reached; starts where the first recording starts.
    pub(crate) fn new(references: &[Cut], recordings: &[Cut], robot: &Robot<f64>, length: f64) -> Self {
        let of = |w: &Channels<f64>| {
            let [left, right] = Channel::WHEELS.map(|wheel| w[wheel]);
            [0.5 * robot.wheel_radius * (left + right), w[Channel::YawRate]]
        };
        let mut reached = [Vec::new(), Vec::new()];
        for s in references.iter().chain(recordings).flat_map(|c| &c.segments) {
            for (w, valid) in s.observed.iter().zip(&s.valid) {
                let known = [Channel::WHEELS.into_iter().all(|wheel| valid[wheel]), valid[Channel::YawRate]];
                for ((v, reached), _) in of(w).into_iter().zip(&mut reached).zip(known).filter(|(_, known)| *known) {
                    reached.push(v.abs());
                }
            }
        }
        let mut limit = |c: usize| select_quantile(&mut reached[c], LIMITS.reached).unwrap_or(0.0).max(LIMITS.least[c]);
        let mut limits = [limit(0), limit(1)];
        limits[1] = limits[1].max(LIMITS.spin * limits[0] / robot.turning_lever());

        let windows: Vec<[f64; 2]> =
            recordings.iter().take(1).flat_map(|c| c.segments.iter().flat_map(|s| s.observed.iter().map(of))).collect();
        let start = recordings.first().and_then(|c| c.path.first()).copied().unwrap_or_default();
        Self { limits, start, length, path: again(&windows, length) }
    }

    /// The menu.
    pub(crate) fn entries(&self) -> Vec<Entry> {
        let [v, w] = self.limits;
        let entry = |name: &str, course: Course| Entry {
            name: name.to_owned(),
            setup: Setup::AsItIs,
            start: self.start,
            course,
            optimised: false,
        };
        let both = |level: [f64; 2], times: usize| {
            let back = [-level[0], -level[1]];
            Course::of_levels(&[level, back].repeat(times), self.length)
        };
        let mut out = Vec::new();
        for (word, share) in ["slow", "medium", "fast"].into_iter().zip(MENU.levels) {
            out.push(entry(&format!("{word} spins, both ways"), both([0.0, share * w], 1)));
            out.push(entry(&format!("straight ahead and back, {word}"), both([share * v, 0.0], 1)));
        }
        for (word, share) in ["slow", "fast"].into_iter().zip(MENU.circles) {
            let turn = MENU.circle_turning * share * w;
            let arcs = [[share * v, turn], [share * v, -turn]];
            out.push(entry(
                &format!("{word} circles of one radius, left then right"),
                Course::of_levels(&arcs, self.length),
            ));
        }
        out.push(entry("slow reversals, straight", both([MENU.slow * v, 0.0], MENU.slow_times)));
        out.push(entry("fast reversals, straight", both([v, 0.0], MENU.fast_times)));
        out.push(entry("fast reversals, on the spot", both([0.0, w], MENU.fast_times)));
        let turning = [MENU.turning[0] * v, MENU.turning[1] * w];
        out.push(entry("fast reversals while turning", both(turning, MENU.fast_times)));

        let mut coasting = both([v, 0.0], 1);
        // From speed to rest without torque, once each way.
        let coast = |share: f64| [share * self.length, (share + MENU.coast) * self.length];
        coasting.torque_free = MENU.coasts.map(coast).to_vec();
        out.push(entry("coast-down, ahead and back", coasting));
        for (word, turned) in [("a quarter turn", 0.5), ("half a turn", 1.0)] {
            let mut e = entry(&format!("the recorded path, begun {word} further left"), self.path.clone());
            e.start[2] += turned * std::f64::consts::PI;
            out.push(e);
        }

        let prepared = |name: &str, setup: Setup, course: Course| Entry { setup, ..entry(name, course) };
        let loaded = |name: &str, level| prepared(name, Setup::Loaded, both(level, MENU.loaded_times));
        out.push(loaded("with a known load: straight reversals", [MENU.loaded_speed * v, 0.0]));
        out.push(loaded("with a known load: spins, both ways", [0.0, MENU.loaded_spin * w]));
        let lifted = both([v, 0.0], MENU.lifted_times);
        out.push(prepared("wheels off the ground: reversals", Setup::Lifted, lifted));
        out
    }

    /// Straight through a place and back again: its centre lies half way.
    pub(crate) fn across(&self, [x, y, _]: [f64; 3]) -> Entry {
        let speed = MENU.across * self.limits[0];
        let (sin, cos) = self.start[2].sin_cos();
        // Half of the first half of the drive, ramps aside.
        let reach = MENU.across_reach * self.length * speed;
        Entry {
            name: "across the place and back".to_owned(),
            setup: Setup::AsItIs,
            start: [x - reach * cos, y - reach * sin, self.start[2]],
            course: Course::of_levels(&[[speed, 0.0], [-speed, 0.0]], self.length),
            optimised: false,
        }
    }
}

/// The path of a recording as a course of the usual length, begun again where it is shorter.
fn again(windows: &[[f64; 2]], length: f64) -> Course {
    let means: Vec<[f64; 2]> = windows
        .chunks(LIMITS.thinned)
        .map(|part| [0, 1].map(|c| part.iter().map(|w| w[c]).sum::<f64>() / part.len() as f64))
        .collect();
    let each = LIMITS.thinned as f64 * WINDOW;
    let count = (length / each) as usize;
    let inner = means.iter().cycle().take(count.saturating_sub(2)).enumerate();
    let mut points = vec![[0.0; 3]];
    points.extend(inner.map(|(i, m)| [(i as f64 + 1.0) * each, m[0], m[1]]));
    points.push([length, 0.0, 0.0]);
    Course { points, torque_free: Vec::new() }
}
