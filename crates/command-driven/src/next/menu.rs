//! Drives among which to advise: commanded speed and yaw rate over time.

use std::f64::consts::TAU;

use inference::robust::select_quantile;
use verdict::{Course, wheel_speeds};

use crate::controller::body;
use crate::run::STEP;
use crate::settings::{Menu, SETTINGS};
use crate::windows::Windows;

const MENU: Menu = SETTINGS.menu;

/// Twist of the body that wheels at these speeds are commanded for, on nominal radius and track.
fn twist(wheels: [f64; 2], [radius, track]: [f64; 2]) -> [f64; 2] {
    let [forward, turning] = body(wheels);
    [radius * forward, 2.0 * radius * turning / track]
}

/// Wheel speeds that command a twist of the body, on nominal radius and track.
pub(super) fn wheels(twist: [f64; 2], [radius, track]: [f64; 2]) -> [f64; 2] {
    wheel_speeds(twist, radius, 0.5 * track)
}

/// Drives no faster than what was commanded before, each of `length` s, with their names.
pub(super) fn drives(windows: &Windows, nominal: [f64; 2], length: f64) -> Vec<(String, Course)> {
    let commanded: Vec<[f64; 2]> =
        windows.pieces.iter().flat_map(|p| p.command.iter().map(|c| twist(*c, nominal))).collect();
    let reached = |k: usize| {
        let mut all: Vec<f64> = commanded.iter().map(|c| c[k].abs()).collect();
        select_quantile(&mut all, MENU.reached).unwrap_or(0.0)
    };
    // Robots that were never turned are turned as far as both sides reach, and the other way round.
    let side = windows.pieces.iter().flat_map(|p| p.command.iter().flatten()).fold(0.0_f64, |m, c| m.max(c.abs()));
    let [straight, spin] = [twist([side; 2], nominal)[0], twist([-side, side], nominal)[1]];
    let or = |reached: f64, both: f64| if reached > MENU.never * both { reached } else { MENU.slow * both };
    let [v, w] = [or(reached(0), straight), or(reached(1), spin)];

    let mut out: Vec<(String, Course)> = Vec::new();
    let mut add = |name: String, course: Course| out.push((name, course));
    for (word, share) in ["slow", "medium", "fast"].into_iter().zip(MENU.levels) {
        let there_and_back = |level: [f64; 2]| {
            let back = level.map(|l| -l);
            steps(&[level, [0.0; 2], back, [0.0; 2]].repeat(MENU.times), length)
        };
        add(format!("steps ahead and back, {word}"), there_and_back([share * v, 0.0]));
        add(format!("steps on the spot, both ways, {word}"), there_and_back([0.0, share * w]));
        let [left, right] = [1.0, -1.0].map(|sign| [share * v, sign * MENU.circle * share * w]);
        add(format!("steps into circles, left and right, {word}"), steps(&[left, right].repeat(MENU.times), length));
    }
    add("reversals, straight".to_owned(), steps(&[[v, 0.0], [-v, 0.0]].repeat(MENU.reversals), length));
    add("reversals on the spot".to_owned(), steps(&[[0.0, w], [0.0, -w]].repeat(MENU.reversals), length));
    add("ramps ahead and back".to_owned(), ramps([v, 0.0], length));
    add("ramps on the spot, both ways".to_owned(), ramps([0.0, w], length));
    add("weaving at constant speed".to_owned(), weaving([MENU.weaving * v, MENU.weaving * w], length));
    let rows = (length / STEP) as usize;
    let again = commanded.iter().cycle().take(rows).enumerate().map(|(i, c)| [i as f64 * STEP, c[0], c[1]]);
    add("the commands of the recordings again".to_owned(), from_rest(again.collect(), length));
    out
}

/// Levels held for equal times, each reached within one row: what the drive makes of a step is what is asked.
fn steps(levels: &[[f64; 2]], length: f64) -> Course {
    let each = length / levels.len() as f64;
    let held = |(i, level): (usize, &[f64; 2])| {
        let [from, until] = [i as f64 * each, (i + 1) as f64 * each];
        [[from + STEP, level[0], level[1]], [until, level[0], level[1]]]
    };
    from_rest(levels.iter().enumerate().flat_map(held).collect(), length)
}

/// Linear up to a level, back through rest to the level the other way, and to rest.
fn ramps(level: [f64; 2], length: f64) -> Course {
    let at = |(share, times): (f64, f64)| [share * length, times * level[0], times * level[1]];
    from_rest([(0.25, 1.0), (1.0 - 0.25, -1.0)].map(at).to_vec(), length)
}

/// Constant speed, the yaw rate a sine.
fn weaving([speed, yaw_rate]: [f64; 2], length: f64) -> Course {
    let points = (1..(length / MENU.drawn) as usize).map(|i| {
        let t = i as f64 * MENU.drawn;
        [t, speed, yaw_rate * (TAU * t / MENU.period).sin()]
    });
    from_rest(points.collect(), length)
}

fn from_rest(mut points: Vec<[f64; 3]>, length: f64) -> Course {
    points.retain(|p| p[0] > 0.0 && p[0] < length - STEP);
    points.insert(0, [0.0; 3]);
    if let Some(&[_, v, w]) = points.last() {
        points.push([length - STEP, v, w]);
    }
    points.push([length, 0.0, 0.0]);
    Course { points, torque_free: Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{NOMINAL, Truth};

    #[test]
    fn every_drive_begins_and_ends_at_rest_and_stays_within_what_was_commanded() {
        let run = Truth::perfect().run("a", 12, 1);
        let windows = Windows::new(&[run]);
        let most = windows.pieces[0].command.iter().flatten().fold(0.0_f64, |m, c| m.max(c.abs()));
        for (name, course) in drives(&windows, NOMINAL, 20.0) {
            assert_eq!((course.at(0.0), course.at(20.0)), ([0.0; 2], [0.0; 2]), "{name}");
            assert!(course.points.windows(2).all(|p| p[0][0] < p[1][0]), "{name}: {:?}", course.points);
            let fastest = (0..400)
                .map(|i| wheels(course.at(f64::from(i) * 0.05), NOMINAL))
                .fold(0.0_f64, |m, w| m.max(w[0].abs()).max(w[1].abs()));
            assert!(fastest > 0.1 * most && fastest < 1.6 * most, "{name}: {fastest} of {most}");
        }
    }

    #[test]
    fn a_twist_is_commanded_by_the_wheel_speeds_that_give_it() {
        let [v, w] = twist(wheels([0.4, -0.7], NOMINAL), NOMINAL);
        approx::assert_relative_eq!(v, 0.4, epsilon = 1e-12);
        approx::assert_relative_eq!(w, -0.7, epsilon = 1e-12);
    }
}
