//! Drives to choose from: what a robot did in its recordings says how fast and how tightly it can be driven.

use inference::robust::{quantile, sorted};
use verdict::{Course, Manoeuvre};

use crate::settings::{Menu, SETTINGS};

const MENU: Menu = SETTINGS.menu;

/// What a robot can be asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Fastest speed, m/s.
    pub speed: f64,
    /// Fastest turning, rad/s.
    pub turning: f64,
    /// Tightest bend while it drives, 1/m.
    pub curvature: f64,
    /// Whether it turns on the spot.
    pub spins: bool,
    /// Whether it drives backward.
    pub backs: bool,
    /// Whether it drives sideways, and then any way.
    pub goes_sideways: bool,
}

impl Reach {
    /// Of what a robot did: speed m/s and yaw rate rad/s at instants; `None` where it hardly moved.
    pub fn of(did: &[[f64; 2]], goes_sideways: bool) -> Option<Self> {
        let most = |of: &mut dyn Iterator<Item = f64>| {
            let sizes = sorted({ of }.filter(|x| x.is_finite()));
            quantile(&sizes, MENU.quantile)
        };
        // What was seen for an instant alone is no speed of the robot.
        let speeds = sorted(did.iter().map(|d| d[0].abs()).filter(|v| v.is_finite()));
        let top = quantile(&speeds, MENU.top).unwrap_or(0.0);
        let drives = |d: &&[f64; 2]| d[0].abs() > MENU.moving * top;
        let speed = most(&mut did.iter().filter(drives).map(|d| d[0].abs())).filter(|v| *v > MENU.least_speed)?;
        let turning = most(&mut did.iter().map(|d| d[1].abs())).unwrap_or(0.0);
        let curvature = most(&mut did.iter().filter(drives).map(|d| (d[1] / d[0]).abs())).unwrap_or(0.0);
        let on_the_spot = |d: &&[f64; 2]| !drives(d) && d[1].abs() > MENU.turns * turning && turning > 0.0;
        let backward = did.iter().filter(|d| d[0] < -MENU.moving * top).count() as f64;
        let backs = backward > MENU.spun * did.len() as f64;
        let spins = did.iter().filter(on_the_spot).count() as f64 > MENU.spun * did.len() as f64;
        Some(Self { speed, turning, curvature, spins, backs, goes_sideways })
    }
}

/// The menu for a robot: drives of such a length, s.
pub fn menu(reach: Reach, length: f64) -> Vec<Manoeuvre> {
    let [slow, medium, fast] = MENU.speeds.map(|share| share * reach.speed);
    // A bend at a speed, as tight as it was driven and no faster than it turned.
    let bend = |v: f64| [v, (MENU.tight * reach.curvature * v).min(reach.turning)];
    let other_way = |[v, w]: [f64; 2]| [v, -w];
    let spin = |share: f64| [0.0, share * reach.turning];
    let mut drives: Vec<(&str, Vec<[f64; 2]>)> = vec![
        ("straight at three speeds", vec![[slow, 0.0], [medium, 0.0], [fast, 0.0]]),
        ("starts and stops", [[fast, 0.0], [0.0; 2]].repeat(MENU.repeats)),
    ];
    if reach.backs {
        drives.push(("straight ahead and back", vec![[medium, 0.0], [-medium, 0.0]]));
    }
    if reach.turning > 0.0 {
        let circles = |v: f64| vec![bend(v), other_way(bend(v))];
        drives.extend([
            ("slow circles, both ways", circles(slow)),
            ("fast circles, both ways", circles(fast)),
            ("circles to the left at three speeds", vec![bend(slow), bend(medium), bend(fast)]),
            ("slalom", circles(medium).repeat(MENU.repeats)),
            ("straights with bends between them", [[fast, 0.0], bend(medium)].repeat(MENU.repeats)),
        ]);
    }
    if reach.spins {
        drives.extend([
            ("slow spins, both ways", vec![spin(MENU.speeds[0]), other_way(spin(MENU.speeds[0]))]),
            ("fast spins, both ways", vec![spin(1.0), other_way(spin(1.0))]),
            ("straights with spins between them", [[medium, 0.0], spin(1.0)].repeat(MENU.repeats)),
        ]);
    }
    let forward =
        |(name, levels): (&str, Vec<[f64; 2]>)| Manoeuvre::new(name, Course::of_levels(&levels, length), [0.0; 3]);
    let mut out: Vec<Manoeuvre> = drives.into_iter().map(forward).collect();
    if reach.goes_sideways {
        let both_ways = || Course::of_levels(&[[medium, 0.0], [-medium, 0.0]], length);
        let turned =
            |name: &str, direction: f64| Manoeuvre { direction, ..Manoeuvre::new(name, both_ways(), [0.0; 3]) };
        out.push(turned("sideways, both ways", std::f64::consts::FRAC_PI_2));
        out.push(turned("diagonally ahead and back", std::f64::consts::FRAC_PI_4));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_robot_is_asked_for_what_it_did_and_no_more() {
        let straight = [[0.5, 0.0]; 90];
        let bends = [[0.4, 0.4]; 60];
        let car = Reach::of(&[&straight[..], &bends[..]].concat(), false).expect("it moves");
        assert!((car.speed - 0.5).abs() < 1e-9 && (car.curvature - 1.0).abs() < 1e-9 && !car.spins, "{car:?}");
        let drives = menu(car, 20.0);
        assert!(drives.iter().all(|m| !m.name.contains("spin") && !m.name.contains("back") && m.direction == 0.0));
        for m in &drives {
            assert!((m.length() - 20.0).abs() < 1e-9, "{}", m.name);
            assert!(m.profile.iter().all(|p| p[1].abs() <= 0.5 + 1e-9 && p[2].abs() <= 0.4 + 1e-9), "{}", m.name);
        }

        let spins = [[0.0, 0.8]; 60];
        let base = Reach::of(&[&straight[..], &spins[..]].concat(), true).expect("it moves");
        assert!(base.spins);
        let names: Vec<String> = menu(base, 20.0).into_iter().map(|m| m.name).collect();
        assert!(names.iter().any(|n| n == "fast spins, both ways") && names.iter().any(|n| n.starts_with("sideways")));
        assert_eq!(Reach::of(&[[0.0, 0.0]; 50], false), None);
        // A pose that jumps is no speed.
        let jumps = Reach::of(&[&straight[..], &bends[..], &[[40.0, 0.0]]].concat(), false).expect("it moves");
        assert!((jumps.speed - 0.5).abs() < 1e-9 && !jumps.spins, "{jumps:?}");
    }
}
