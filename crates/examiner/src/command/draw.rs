//! Draws a case: the robot, what is hidden, commands and sensors.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;

use super::drive::{Robot, run};
use super::{CommandCase, CommandPlan, CommandTruth, Hidden};
use crate::random::Stream;

/// Command steps of a recording, and seconds of each at least and at most.
const STEPS: usize = 24;
const SECONDS: [f64; 2] = [4.0, 7.0];
const RECORDINGS: usize = 2;
/// Name of the random numbers of a reference.
const REFERENCE: &str = "command reference";

/// The case of a plan.
pub(super) fn case(plan: &CommandPlan) -> CommandCase {
    let stream = |name: &str| Stream::new(plan.seed, name, plan.index);
    let mut s = stream("command robot");
    let (radius, track) = (s.uniform(0.06, 0.2), s.uniform(0.3, 0.8));
    let fastest = s.uniform(1.0, 2.0) / radius;
    let file = robot_file(radius, track);

    // Tyres and track are known to some per cent, as the file says.
    let mut robot =
        Robot::ideal(radius * (1.0 + s.normal(0.006)), track * (1.0 + s.normal(0.006)), s.uniform(0.004, 0.01));
    let hidden = chosen(plan, &mut stream("command hidden"));
    if plan.references > 0 {
        // Motors at their limit in hard steps make a robot another one for a law that knows no motors.
        let mut s = stream("command motors");
        robot.strength = [s.uniform(2.0, 6.0) * fastest, s.uniform(1.3, 2.0) * fastest];
    }
    if let Some(flaw) = plan.in_all.filter(|flaw| !hidden.contains(flaw)) {
        hide(flaw, &mut robot, fastest, [radius, track], &mut stream("command flaw"));
    }
    let sound = robot;
    let mut numbers = BTreeMap::new();
    let mut s = stream("command sizes");
    for kind in &hidden {
        let told = hide(*kind, &mut robot, fastest, [radius, track], &mut s);
        numbers.extend(told.into_iter().map(|(name, value)| (name.to_owned(), value)));
    }

    let mut files = vec![(PathBuf::from("robot.toml"), file.into_bytes())];
    // Every other case is driven smoothly beside references in steps, unless a smooth drive does not show what is hidden.
    let shows = !hidden.iter().any(|h| matches!(h, Hidden::TurnLimit | Hidden::Ramps));
    let is_smooth = plan.references > 0 && plan.index.is_multiple_of(2) && shows;
    let mut drives = |count: usize, [folder, of]: [&str; 2], robot: &Robot| {
        for number in 1..=count {
            let mut s = Stream::new(plan.seed, of, plan.index * 100 + number as u64);
            let drawn = if is_smooth && of != REFERENCE { smooth } else { commands };
            let steps = drawn(fastest, track / radius, &mut s);
            let text = sheet(&run(robot, &steps), radius, &mut s);
            files.push((PathBuf::from(format!("{folder}_{number}.csv")), text.into_bytes()));
        }
    };
    drives(plan.references, ["references/ref", REFERENCE], &sound);
    drives(RECORDINGS, ["recordings/run", "command drive"], &robot);
    CommandCase { files, truth: CommandTruth { case: plan.name.clone(), hidden, numbers } }
}

/// What is hidden: of two, one between command and wheel and one between wheel and body.
fn chosen(plan: &CommandPlan, s: &mut Stream) -> Vec<Hidden> {
    let mut others: Vec<Hidden> = Hidden::ALL.into_iter().filter(|h| h.is_drive() != plan.first.is_drive()).collect();
    s.shuffle(&mut others);
    std::iter::once(plan.first).chain(others).take(plan.hidden).collect()
}

/// Hides something in the robot; its numbers as the simulation would have them.
fn hide(
    kind: Hidden,
    robot: &mut Robot,
    fastest: f64,
    [radius, track]: [f64; 2],
    s: &mut Stream,
) -> Vec<(&'static str, f64)> {
    // Largest half difference of the sides that the commands ask for.
    let turn = 0.5 * fastest;
    match kind {
        Hidden::DeadTime => {
            robot.dead_time = s.uniform(0.1, 0.4);
            vec![("dead_time", robot.dead_time)]
        }
        Hidden::Lag => {
            robot.lag = s.uniform(0.15, 0.6);
            vec![("lag", robot.lag)]
        }
        Hidden::Gains => {
            robot.gains = [s.uniform(0.75, 1.3), s.uniform(0.6, 1.3)];
            vec![("forward_gain", robot.gains[0]), ("turn_gain", robot.gains[1])]
        }
        Hidden::TurnLimit => {
            robot.turn_limit = s.uniform(0.3, 0.7) * turn;
            vec![("turn_limit", robot.turn_limit)]
        }
        Hidden::Ramps => {
            robot.ramps = [s.uniform(0.4, 1.5) * fastest, s.uniform(0.4, 1.5) * turn];
            vec![("forward_ramp", robot.ramps[0]), ("turn_ramp", robot.ramps[1])]
        }
        Hidden::Track => {
            robot.track_factor = s.uniform(1.15, 2.0);
            vec![("track_factor", robot.track_factor * robot.track / track)]
        }
        Hidden::Radius => {
            robot.radius_factor = 1.0 + s.sign() * s.uniform(0.05, 0.15);
            vec![("radius_factor", robot.radius_factor * robot.radius / radius)]
        }
        Hidden::TurnSlip => {
            robot.turn_slip = s.uniform(0.15, 0.4);
            Vec::new()
        }
        Hidden::SideRadius => {
            robot.side_radius = s.sign() * s.uniform(0.015, 0.05);
            vec![("side_radius", robot.side_radius)]
        }
    }
}

/// Steps of forward speed and turning in any combination, with stands between some.
fn commands(fastest: f64, track_per_radius: f64, s: &mut Stream) -> Vec<([f64; 2], f64)> {
    let mut out = vec![([0.0; 2], 2.0)];
    for k in 0..STEPS {
        let forward = s.uniform(-0.5, 1.0) * fastest;
        // No faster turn than 2.5 rad/s.
        let most = (0.5 * fastest).min(1.25 * track_per_radius);
        let turn = s.uniform(-1.0, 1.0) * most;
        // Commands come with the rows: 20 Hz.
        let seconds = (s.uniform(SECONDS[0], SECONDS[1]) * 20.0).round() / 20.0;
        out.push(([forward - turn, forward + turn], seconds));
        if k % 8 == 7 {
            out.push(([0.0; 2], 3.0));
        }
    }
    out
}

/// Speeds that swell and fade, and bends to both sides, after a stand.
fn smooth(fastest: f64, track_per_radius: f64, s: &mut Stream) -> Vec<([f64; 2], f64)> {
    const ROW: f64 = 0.05;
    let most = (0.5 * fastest).min(1.25 * track_per_radius);
    let [swell, bend] = [s.uniform(10.0, 20.0), s.uniform(6.0, 14.0)].map(|period| std::f64::consts::TAU / period);
    let [first, second] = [0, 1].map(|_| s.uniform(0.0, 6.0));
    let row = |k: usize| {
        let t = ROW * k as f64;
        let begins = (t / 3.0).min(1.0);
        let forward = begins * fastest * (0.35 + 0.3 * (swell * t + first).sin());
        let turn = 0.7 * begins * most * (bend * t + second).sin();
        ([forward - turn, forward + turn], ROW)
    };
    std::iter::once(([0.0; 2], 2.0)).chain((0..(STEPS as f64 * SECONDS[0] / ROW) as usize).map(row)).collect()
}

/// Rows at 20 Hz as sensors show them.
fn sheet(rows: &[super::drive::Row], radius: f64, s: &mut Stream) -> String {
    // An encoder of so many ticks per turn, read every 50 ms.
    let ticks = s.uniform(2000.0, 8000.0);
    let pose_noise = [s.uniform(0.002, 0.008), s.uniform(0.001, 0.005)];
    let mut out = String::from(
        "time_s,command_speed_left_rad_s,command_speed_right_rad_s,wheel_speed_left_rad_s,wheel_speed_right_rad_s,pose_x_m,\
         pose_y_m,pose_yaw_rad\n",
    );
    let step = std::f64::consts::TAU / ticks / 0.05;
    for (k, row) in rows.iter().enumerate() {
        let wheel = row.wheel.map(|w| ((w * (1.0 + s.normal(0.002)) + s.normal(0.005 / radius)) / step).round() * step);
        let [x, y] = [row.pose[0], row.pose[1]].map(|p| p + s.normal(pose_noise[0]));
        let yaw = row.pose[2] + s.normal(pose_noise[1]);
        let _ = writeln!(
            out,
            "{:.2},{:.5},{:.5},{:.5},{:.5},{x:.4},{y:.4},{yaw:.5}",
            k as f64 * 0.05,
            row.command[0],
            row.command[1],
            wheel[0],
            wheel[1]
        );
    }
    out
}

/// The robot file: a command-driven robot of which radius and track are used.
fn robot_file(radius: f64, track: f64) -> String {
    let mut out = String::from("name = \"drawn\"\ncausality = \"command-driven\"\n\n[parameters]\n");
    let constants = [
        ("wheel_radius", "m", radius, 0.01 * radius),
        ("track", "m", track, 0.01 * track),
        ("mass", "kg", 40.0, 4.0),
        ("yaw_inertia", "kg m2", 3.0, 1.0),
        ("com_height", "m", 0.2, 0.05),
        ("adhesion", "-", 0.6, 0.2),
        ("rolling_resistance", "-", 0.03, 0.02),
    ];
    for (name, unit, value, sigma) in constants {
        let _ = writeln!(
            out,
            "{name} = {{ value = {value:.5}, unit = \"{unit}\", sigma = {sigma:.5}, source = \"drawn\" }}"
        );
    }
    for (name, unit, value) in [("wheelbase", "m", 0.9 * track), ("wheel_inertia", "kg m2", 0.01)] {
        let _ = writeln!(out, "{name} = {{ value = {value:.5}, unit = \"{unit}\", source = \"drawn\" }}");
    }
    out
}
