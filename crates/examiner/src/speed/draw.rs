//! Draws a case: the robot, its days, and what happens.

use std::fmt::Write as _;
use std::ops::Range;
use std::path::PathBuf;

use super::drive::{Ground, Leg, Robot, Warmth, course, drive};
use super::sheet::{Sensors, mapping};
use super::{Event, Sight, SpeedCase, SpeedKind, SpeedPlan, SpeedTruth};
use crate::random::Stream;

/// Length of references and of recordings, s.
const LENGTH: f64 = 150.0;
const REFERENCES: usize = 3;
/// Length of a drive over several grounds, s, and legs of a round, in which every manoeuvre is driven once.
const LONG: f64 = 400.0;
const ROUND: usize = 6;

/// The case of a plan.
pub(super) fn case(plan: &SpeedPlan) -> SpeedCase {
    let stream = |name: &str| Stream::new(plan.seed, name, plan.index);
    let robot = robot(&mut stream("robot"));
    let sensors = Sensors::draw(&mut stream("sensors"));
    let sight = Sight::ALL[stream("sight").index(Sight::ALL.len())];
    let mut files = vec![
        (PathBuf::from("robot.toml"), toml(&robot, &mut stream("file")).into_bytes()),
        (PathBuf::from("mapping.toml"), mapping(sight, robot.radius).into_bytes()),
    ];
    let mut write = |folder: &str, number: usize, robot: &Robot, legs: &[Leg], warmth: Warmth| {
        let mut s = Stream::new(plan.seed, folder, plan.index * 100 + number as u64);
        let rows = drive(robot, legs, warmth);
        let file = |kind: &str| PathBuf::from(format!("{folder}/{kind}_{number:02}.csv"));
        files.push((file("pro"), sensors.drives(robot, &rows, &mut s).into_bytes()));
        files.push((file("imu"), sensors.inertial(sight, &rows, &mut s).into_bytes()));
    };

    let mut days = stream("days");
    for number in 1..=REFERENCES {
        let legs = course(&robot, LENGTH, &mut Stream::new(plan.seed, "course", plan.index * 100 + number as u64));
        write("reference", number, &robot, &legs, warmth(&mut days));
    }

    let mut s = stream("hidden");
    let mut here = robot;
    let mut legs = course(&robot, LENGTH, &mut stream("drive"));
    let mut events = Vec::new();
    let mut ground = Ground::HARD;
    match plan.kind {
        SpeedKind::FaultFree => {}
        SpeedKind::SoftGround => ground = soft(&mut s),
        SpeedKind::SlipperyGround => {
            ground = slippery(&mut s);
        }
        SpeedKind::Payload => here.mass *= s.uniform(1.3, 1.8),
        SpeedKind::DraggingSide => {
            let side = s.index(2);
            here.dry[side] += s.uniform(0.6, 1.5) * 0.5 * robot.straight(Ground::HARD)[0];
        }
        SpeedKind::Standing | SpeedKind::Slope | SpeedKind::Crossing => {
            events.push(happens(plan.kind, &mut legs, 0..usize::MAX, &mut s));
        }
        SpeedKind::Several => {
            let mut kinds = [SpeedKind::Standing, SpeedKind::Slope, SpeedKind::Crossing];
            s.shuffle(&mut kinds);
            let middle = legs.len() / 2;
            events.push(happens(kinds[0], &mut legs, 0..middle, &mut s));
            events.push(happens(kinds[1], &mut legs, middle + 1..usize::MAX, &mut s));
        }
        SpeedKind::Grounds => {
            legs = course(&robot, LONG, &mut stream("drive"));
            let rounds = (legs.len() - 2) / ROUND;
            let most = (rounds - 1) / 2;
            for k in 0..2 + s.index(most.min(3) - 1) {
                let at = 1 + ROUND * (1 + 2 * k);
                events.push(other_ground(&mut legs, at..at + ROUND, &mut s));
            }
        }
    }
    for leg in &mut legs {
        if leg.ground == Ground::HARD {
            leg.ground = ground;
        }
    }
    write("recordings", 1, &here, &legs, warmth(&mut days));
    let truth = SpeedTruth {
        case: plan.name.clone(),
        kind: plan.kind,
        sight,
        events: timed(&legs, &events),
        straight: [robot.straight(Ground::HARD), here.straight(ground)],
        track: [robot.slip * robot.track, robot.slip * robot.track * ground.track],
    };
    SpeedCase { files, truth }
}

/// A robot of 30 to 150 kg.
fn robot(s: &mut Stream) -> Robot {
    let mass = 30.0 * 5.0_f64.powf(s.unit());
    let size = (mass / 75.0).cbrt();
    let (radius, track) = (0.165 * size * s.uniform(0.85, 1.15), 0.57 * size * s.uniform(0.9, 1.1));
    let rolling = s.uniform(0.025, 0.05);
    // A third to a half of the straight load is the drive train's.
    let rolls = rolling * mass * 9.81 * radius;
    let dry = rolls * s.uniform(0.2, 0.45);
    Robot {
        mass,
        radius,
        track,
        base: track * s.uniform(0.8, 1.0),
        rolling,
        dry: [0, 1].map(|_| dry * (1.0 + s.normal(0.06))),
        viscous: rolls * s.uniform(0.05, 0.3),
        scrub: s.uniform(0.45, 0.75),
        slip: s.uniform(1.25, 1.6),
        // A straight drive reads a few amperes per side.
        per_current: (0.5 * rolls + dry) / s.uniform(1.6, 3.0),
    }
}

/// A day: most drive trains are warm, some cold.
fn warmth(s: &mut Stream) -> Warmth {
    let cold = if s.unit() < 0.35 { s.uniform(0.1, 0.5) } else { 0.0 };
    Warmth { cold, day: (s.normal(0.05)).exp() }
}

fn slippery(s: &mut Stream) -> Ground {
    Ground { rolling: 1.0, scrub: s.uniform(0.25, 0.6), track: s.uniform(1.0, 1.15) }
}

/// Puts these legs on soft or slippery ground.
fn other_ground(legs: &mut [Leg], within: Range<usize>, s: &mut Stream) -> Happening {
    let kind = if s.index(2) == 0 { SpeedKind::SoftGround } else { SpeedKind::SlipperyGround };
    let ground = if kind == SpeedKind::SoftGround { soft(s) } else { slippery(s) };
    legs[within.clone()].iter_mut().for_each(|leg| leg.ground = ground);
    (within, Event { kind, interval: [0.0; 2], degrees: None })
}

fn soft(s: &mut Stream) -> Ground {
    Ground { rolling: s.uniform(1.9, 3.5), scrub: s.uniform(0.75, 1.0), track: s.uniform(1.12, 1.35) }
}

/// Something that happened on these legs.
type Happening = (Range<usize>, Event);

/// Makes something happen among the legs of `within`: to one of them, or to three where another ground is crossed.
fn happens(kind: SpeedKind, legs: &mut [Leg], within: Range<usize>, s: &mut Stream) -> Happening {
    let last = within.end.min(legs.len() - 1);
    let of = |straight: bool| -> Vec<usize> {
        let fits = |l: &Leg| l.speed != [0.0; 2] && (l.speed[0] == l.speed[1]) == straight;
        (within.start.max(1)..last).filter(|&i| fits(&legs[i])).collect()
    };
    let event = |degrees: Option<f64>| Event { kind, interval: [0.0; 2], degrees };
    match kind {
        SpeedKind::Slope => {
            // A spin has no way on which to leave a ramp.
            let leaves = |at: &usize| legs[at + 1].speed[0] * legs[at + 1].speed[1] > 0.0;
            let all: Vec<usize> = of(true).into_iter().filter(leaves).collect();
            let all = if all.is_empty() { of(true) } else { all };
            let at = all[s.index(all.len())];
            let degrees = s.sign() * s.uniform(2.5, 8.0);
            legs[at].seconds = s.uniform(14.0, 24.0);
            legs[at].degrees = degrees;
            (at..at + 1, event(Some(degrees)))
        }
        SpeedKind::Standing => {
            let all = of(false);
            let at = all[s.index(all.len())];
            legs[at].seconds = s.uniform(8.0, 20.0);
            legs[at].moves = s.uniform(0.0, 0.12);
            (at..at + 1, event(None))
        }
        _ => {
            let ground = soft(s);
            let all = of(true);
            let at = all[s.index(all.len())];
            let until = (at + 3).min(last);
            legs[at..until].iter_mut().for_each(|l| l.ground = ground);
            (at..until, event(None))
        }
    }
}

/// The events with their times.
fn timed(legs: &[Leg], events: &[Happening]) -> Vec<Event> {
    let starts = |leg: usize| legs[..leg].iter().map(|l| l.seconds).sum::<f64>();
    let of = |(legs, event): &Happening| Event { interval: [starts(legs.start), starts(legs.end)], ..event.clone() };
    events.iter().map(of).collect()
}

/// The robot file: values off by what their sigmas say.
fn toml(robot: &Robot, s: &mut Stream) -> String {
    let mut off = |value: f64, sigma: f64| (value * s.normal(sigma).exp(), value * sigma);
    let known = [
        ("mass", "kg", off(robot.mass, 0.05)),
        ("yaw_inertia", "kg m2", off(0.2 * robot.mass * robot.track * robot.track, 0.3)),
        ("com_height", "m", off(0.35 * robot.track, 0.25)),
        ("adhesion", "-", off(0.6, 0.3)),
        ("lateral_factor", "-", off(0.8, 0.4)),
        ("slip_at_peak", "-", off(0.12, 0.5)),
        ("rolling_resistance", "-", off(robot.rolling, 0.4)),
        ("coulomb", "N m", off(0.5 * (robot.dry[0] + robot.dry[1]), 0.5)),
        ("viscous", "N m s/rad", off(robot.viscous * robot.radius, 0.6)),
        ("torque_per_current", "N m/A", off(robot.per_current, 0.1)),
    ];
    let measured = [("wheelbase", robot.base), ("track", robot.track), ("wheel_radius", robot.radius)];
    let wheel = 0.5 * 0.03 * robot.mass * robot.radius * robot.radius;
    let inertia = [("wheel_inertia", wheel), ("motor_inertia", 5.0 * wheel)];
    let mut out = String::from("name = \"drawn\"\ncausality = \"speed-driven\"\n\n[parameters]\n");
    for (name, unit, (value, sigma)) in known {
        let _ = writeln!(
            out,
            "{name} = {{ value = {value:.5}, unit = \"{unit}\", sigma = {sigma:.5}, source = \"drawn\" }}"
        );
    }
    for (name, value) in measured {
        let _ = writeln!(out, "{name} = {{ value = {value:.4}, unit = \"m\", source = \"drawn\" }}");
    }
    for (name, value) in inertia {
        let _ = writeln!(out, "{name} = {{ value = {value:.5}, unit = \"kg m2\", source = \"drawn\" }}");
    }
    out += "rest_speed = { value = 0.03, unit = \"m/s\", source = \"drawn\" }\n";
    out
}
