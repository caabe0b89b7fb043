//! Draws a case: the robot, what is hidden, drives and sensors.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::PathBuf;

use super::plant::{Robot, Wheel};
use super::{Chassis, Hidden, RollingCase, RollingPlan, RollingTruth, Seen};
use crate::random::Stream;

/// Step of the motion, s.
const STEP: f64 = 0.005;
/// Seconds of a recording, at least and at most.
const SECONDS: [f64; 2] = [45.0, 75.0];
/// Recordings, each a session of its own.
const RECORDINGS: usize = 4;
/// Errors of the robot file, one sigma, as shares: radii, distances.
const KNOWN: [f64; 2] = [0.008, 0.012];
/// The same of steering, rad, and its gain.
const STEERING: [f64; 2] = [0.008, 0.01];
/// The same of the effective track of sides that skid, as a share, and of the point about which they turn, m.
const SKIDDING: f64 = 0.12;
const TURNS_ABOUT: f64 = 0.02;
/// Scale and bias, rad/s, of usual gyros, one sigma.
const GYRO: [f64; 2] = [0.008, 0.005];
/// By how much radii and distances differ from session to session, as a share.
const SESSION: f64 = 0.001;

/// The case of a plan.
pub(super) fn case(plan: &RollingPlan) -> RollingCase {
    let stream = |name: &str| Stream::new(plan.seed, name, plan.index);
    let mut s = stream("rolling robot");
    let stated = stated(plan.chassis, &mut s);
    let counts = s.uniform(1500.0, 10_000.0).round();

    let mut robot = as_built(plan.chassis, &stated, &mut stream("rolling errors"));
    let mut truth = RollingTruth {
        case: plan.name.clone(),
        chassis: plan.chassis,
        hidden: plan.hidden.into_iter().collect(),
        wheel: None,
        numbers: BTreeMap::new(),
    };
    let mut s = stream("rolling sizes");
    let wheel = s.index(robot.wheels.len());
    if let Some(flaw) = plan.in_all {
        hide(flaw, &mut robot, wheel, &mut truth.clone(), &mut stream("rolling flaw"));
    }
    let sound = robot.clone();
    if let Some(hidden) = plan.hidden {
        hide(hidden, &mut robot, wheel, &mut truth, &mut s);
    }

    let gyro = (plan.seen == Seen::Gyro).then(|| gyro(plan, &mut truth, &mut stream("rolling gyro")));
    let text = robot_file(plan.chassis, &stated, counts, plan.seen);
    let mut files = vec![(PathBuf::from("robot.toml"), text.into_bytes())];
    // Bias and scale of a gyro are hidden in it, and what is hidden is not there in references.
    let sound_gyro = (plan.seen == Seen::Gyro).then(|| {
        let nothing = RollingPlan { hidden: None, ..plan.clone() };
        self::gyro(&nothing, &mut truth.clone(), &mut stream("rolling gyro"))
    });
    for number in 1..=plan.references {
        let mut s = Stream::new(plan.seed, "rolling reference", plan.index * 100 + number as u64);
        let text = sheet(plan.chassis, &of_session(&sound, &mut s), counts, None, sound_gyro, &mut s);
        files.push((PathBuf::from(format!("references/ref_{number}.csv")), text.into_bytes()));
    }
    for number in 1..=RECORDINGS {
        let mut s = Stream::new(plan.seed, "rolling drive", plan.index * 100 + number as u64);
        let lost = (plan.hidden == Some(Hidden::LostCounts)).then_some(wheel);
        let text = sheet(plan.chassis, &of_session(&robot, &mut s), counts, lost, gyro, &mut s);
        files.push((PathBuf::from(format!("recordings/run_{number}.csv")), text.into_bytes()));
    }
    RollingCase { files, truth }
}

/// A gyro in the place of a pose.
#[derive(Clone, Copy)]
struct Gyro {
    scale: f64,
    bias: f64,
    /// One sigma of a reading, rad/s.
    noise: f64,
    /// Seconds at rest before the robot starts.
    rest: f64,
}

/// A gyro within usual data sheets, with what is hidden in it.
fn gyro(plan: &RollingPlan, truth: &mut RollingTruth, s: &mut Stream) -> Gyro {
    let mut out = Gyro {
        scale: 1.0 + s.normal(GYRO[0]),
        bias: s.normal(GYRO[1]),
        noise: s.uniform(0.002, 0.01),
        rest: if s.uniform(0.0, 1.0) < 0.5 { s.uniform(1.5, 4.0) } else { 0.0 },
    };
    match plan.hidden {
        Some(Hidden::GyroScale) => {
            out.scale *= 1.0 + s.sign() * s.uniform(0.08, 0.2);
            truth.numbers.insert("gyro_scale".to_owned(), out.scale);
        }
        Some(Hidden::GyroBias) => {
            (out.bias, out.rest) = (s.sign() * s.uniform(0.04, 0.1), 0.0);
            truth.numbers.insert("gyro_bias".to_owned(), out.bias);
        }
        _ => {}
    }
    out
}

/// The robot as its owner states it.
fn stated(chassis: Chassis, s: &mut Stream) -> Robot {
    let radius = s.uniform(0.03, 0.12);
    let reach = s.uniform(0.1, 0.35);
    let wheel = |name: &str, place: [f64; 2], direction: f64| Wheel {
        name: name.to_owned(),
        place,
        direction,
        radius,
        roller: if chassis.is_omni() { 0.5 * PI } else { 0.0 },
    };
    let mecanum = |name: &str, [x, y]: [f64; 2], side: f64| Wheel {
        roller: 0.25 * PI * side,
        ..wheel(name, [x * reach, y * reach], 0.0)
    };
    let around = |count: usize, first: f64| -> Vec<Wheel> {
        let one = |k: usize| {
            let at = first + TAU * k as f64 / count as f64;
            wheel(&format!("wheel {}", k + 1), [reach * at.cos(), reach * at.sin()], at + 0.5 * PI)
        };
        (0..count).map(one).collect()
    };
    let wheels = match chassis {
        Chassis::Differential => vec![wheel("left", [0.0, reach], 0.0), wheel("right", [0.0, -reach], 0.0)],
        Chassis::Tricycle => vec![wheel("front", [2.0 * reach, 0.0], 0.0)],
        Chassis::Omni3 => around(3, PI / 3.0),
        Chassis::Omni4 => around(4, 0.25 * PI),
        Chassis::Mecanum4 => vec![
            mecanum("front left", [1.0, 0.9], 1.0),
            mecanum("front right", [1.0, -0.9], -1.0),
            mecanum("rear left", [-1.0, 0.9], -1.0),
            mecanum("rear right", [-1.0, -0.9], 1.0),
        ],
        // The owner takes the effective track to be wider than the measured one.
        Chassis::SkidSteer => {
            vec![wheel("left side", [0.0, 1.5 * reach], 0.0), wheel("right side", [0.0, -1.5 * reach], 0.0)]
        }
    };
    Robot {
        wheels,
        is_steered: chassis == Chassis::Tricycle,
        steering_zero: 0.0,
        steering_gain: 1.0,
        turn_slip: 0.0,
        rate_slip: 0.0,
        speed_slip: 0.0,
        roller_slip: 0.0,
        turns_about: 0.0,
        mounting: 0.0,
        origin: [0.0; 2],
        clock_offset: 0.0,
        clock_rate: 0.0,
    }
}

/// The robot as it is: within what its owner states.
fn as_built(chassis: Chassis, stated: &Robot, s: &mut Stream) -> Robot {
    let mut out = stated.clone();
    scale_places(&mut out, 1.0 + s.normal(track_share(chassis)));
    if chassis == Chassis::SkidSteer {
        out.turns_about = s.normal(TURNS_ABOUT);
    }
    for wheel in &mut out.wheels {
        wheel.radius *= 1.0 + s.normal(KNOWN[0]);
    }
    if out.is_steered {
        out.steering_zero = s.normal(STEERING[0]);
        out.steering_gain = 1.0 + s.normal(STEERING[1]);
    }
    out
}

/// The same in one session.
fn of_session(robot: &Robot, s: &mut Stream) -> Robot {
    let mut out = robot.clone();
    scale_places(&mut out, 1.0 + s.normal(SESSION));
    out.wheels.iter_mut().for_each(|w| w.radius *= 1.0 + s.normal(SESSION));
    out
}

/// How well the track is known, one sigma, as a share.
fn track_share(chassis: Chassis) -> f64 {
    if chassis == Chassis::SkidSteer { SKIDDING } else { KNOWN[1] }
}

fn scale_places(robot: &mut Robot, factor: f64) {
    robot.wheels.iter_mut().for_each(|w| w.place = w.place.map(|x| x * factor));
}

/// Hides something in the robot, and notes its numbers.
fn hide(hidden: Hidden, robot: &mut Robot, wheel: usize, truth: &mut RollingTruth, s: &mut Stream) {
    let chassis = truth.chassis;
    let mut note = |name: &str, value: f64| {
        truth.numbers.insert(name.to_owned(), value);
    };
    match hidden {
        Hidden::AllRadii => {
            let factor = 1.0 + s.sign() * s.uniform(0.06, 0.15);
            robot.wheels.iter_mut().for_each(|w| w.radius *= factor);
        }
        Hidden::OneRadius => {
            robot.wheels[wheel].radius *= 1.0 + s.sign() * s.uniform(0.05, 0.12);
            note("radius", robot.wheels[wheel].radius);
            truth.wheel = Some(robot.wheels[wheel].name.clone());
        }
        Hidden::Direction => {
            let angle = s.sign() * s.uniform(0.04, 0.1);
            robot.wheels[wheel].direction += angle;
            note("direction", angle);
            truth.wheel = Some(robot.wheels[wheel].name.clone());
        }
        Hidden::Distance => {
            scale_places(robot, 1.0 + s.sign() * s.uniform(0.08, 0.2));
            let [x, y] = robot.wheels[0].place;
            // Track and wheelbase of a mecanum robot show as their sum only.
            if chassis != Chassis::Mecanum4 {
                note("distance", if robot.wheels.len() == 2 { 2.0 * y } else { x.hypot(y) });
            }
        }
        Hidden::SteeringZero => {
            robot.steering_zero += s.sign() * s.uniform(0.05, 0.12);
            note("steering_zero", robot.steering_zero);
        }
        Hidden::SteeringGain => {
            robot.steering_gain *= 1.0 + s.sign() * s.uniform(0.08, 0.2);
            note("steering_gain", robot.steering_gain);
        }
        Hidden::TurnSlip => robot.turn_slip = s.uniform(0.08, 0.2),
        Hidden::RateSlip => robot.rate_slip = s.uniform(0.06, 0.15),
        Hidden::SpeedSlip => robot.speed_slip = s.uniform(0.06, 0.15),
        Hidden::RollerSlip => robot.roller_slip = s.uniform(0.06, 0.15),
        Hidden::ClockOffset => {
            robot.clock_offset = s.sign() * s.uniform(0.15, 0.5);
            note("clock_offset", robot.clock_offset.abs());
        }
        Hidden::ClockRate => {
            robot.clock_rate = s.sign() * s.uniform(0.01, 0.03);
            note("clock_rate", robot.clock_rate.abs());
        }
        Hidden::Mounting => {
            robot.mounting = s.sign() * s.uniform(0.04, 0.12);
            note("mounting", robot.mounting);
        }
        Hidden::Origin => {
            robot.origin = [s.sign() * s.uniform(0.03, 0.1), s.sign() * s.uniform(0.03, 0.1)];
            note("origin_x", robot.origin[0]);
            note("origin_y", robot.origin[1]);
        }
        Hidden::LostCounts => truth.wheel = Some(robot.wheels[wheel].name.clone()),
        // They are hidden in the gyro.
        Hidden::GyroScale | Hidden::GyroBias => {}
    }
}

/// A smooth motion of the body: its velocities at every step.
fn motion(chassis: Chassis, turns_about: f64, seconds: f64, s: &mut Stream) -> Vec<[f64; 3]> {
    let (fastest, turn) = (s.uniform(0.4, 1.0), s.uniform(0.6, 1.2));
    let keep = (-STEP / s.uniform(0.2, 0.5)).exp();
    let steps = (seconds / STEP) as usize;
    let (mut wanted, mut first, mut now) = ([0.0; 3], [0.0_f64; 3], [0.0_f64; 3]);
    let mut until = 0;
    let mut out = Vec::with_capacity(steps);
    for k in 0..steps {
        if k >= until {
            until = k + (s.uniform(1.5, 5.0) / STEP) as usize;
            wanted = match chassis {
                Chassis::Tricycle => [s.uniform(0.3, 1.0) * fastest, 0.0, 0.0],
                Chassis::Differential | Chassis::SkidSteer => {
                    [s.uniform(-0.4, 1.0) * fastest, 0.0, s.uniform(-1.0, 1.0) * turn]
                }
                Chassis::Omni3 | Chassis::Omni4 | Chassis::Mecanum4 => {
                    [s.uniform(-1.0, 1.0) * fastest, s.uniform(-1.0, 1.0) * fastest, s.uniform(-1.0, 1.0) * turn]
                }
            };
            if chassis == Chassis::Tricycle {
                // No sharper than the steering goes.
                wanted[2] = s.uniform(-1.2, 1.2) * wanted[0];
            }
        }
        for axis in 0..3 {
            first[axis] = wanted[axis] + keep * (first[axis] - wanted[axis]);
            now[axis] = first[axis] + keep * (now[axis] - first[axis]);
        }
        // What turns about a point ahead moves its origin sideways.
        out.push([now[0], now[1] - turns_about * now[2], now[2]]);
    }
    out
}

/// Rows as sensors show them.
fn sheet(
    chassis: Chassis,
    robot: &Robot,
    counts: f64,
    loses: Option<usize>,
    gyro: Option<Gyro>,
    s: &mut Stream,
) -> String {
    let seconds = s.uniform(SECONDS[0], SECONDS[1]);
    let mut velocities = motion(chassis, robot.turns_about, seconds, s);
    if let Some(gyro) = gyro {
        velocities.splice(0..0, vec![[0.0; 3]; (gyro.rest / STEP) as usize]);
    }
    let noise = [s.uniform(0.0005, 0.004), s.uniform(0.0005, 0.004)];
    let every = [4, 5, 10][s.index(3)];

    // Poses and turns at every step.
    let (mut pose, mut turned) =
        ([s.uniform(-2.0, 2.0), s.uniform(-2.0, 2.0), s.uniform(-PI, PI)], vec![0.0; robot.wheels.len()]);
    let mut poses = vec![pose];
    let mut turns = vec![turned.clone()];
    let mut steering = vec![0.0];
    for &[vx, vy, rate] in &velocities {
        let middle = pose[2] + 0.5 * STEP * rate;
        let (sin, cos) = middle.sin_cos();
        pose = [pose[0] + STEP * (cos * vx - sin * vy), pose[1] + STEP * (sin * vx + cos * vy), pose[2] + STEP * rate];
        let (rates, angle) = robot.wheels([vx, vy, rate]);
        turned.iter_mut().zip(&rates).for_each(|(t, r)| *t += STEP * r);
        poses.push(pose);
        turns.push(turned.clone());
        steering.push(angle);
    }

    let mut out = String::from("time_s");
    for k in 1..=robot.wheels.len() {
        let _ = write!(out, ",tick_{k}");
    }
    out += if robot.is_steered { ",steer_rad" } else { "" };
    out += if gyro.is_some() { ",gyro_rad_s\n" } else { ",x_m,y_m,yaw_rad\n" };
    // Some bursts in which a wheel misses most of its counts.
    let bursts: Vec<[f64; 2]> = (0..3)
        .map(|k| {
            let from = seconds * (0.15 + 0.28 * f64::from(k)) + s.uniform(0.0, 4.0);
            [from, from + s.uniform(1.5, 3.5)]
        })
        .collect();
    let kept = s.uniform(0.1, 0.6);
    let mut before = vec![0.0; robot.wheels.len()];
    let mut row = 0;
    while row < turns.len() {
        let time = STEP * row as f64;
        let _ = write!(out, "{time:.3}");
        for (k, count) in before.iter_mut().enumerate() {
            let now = (turns[row][k] * counts / TAU).floor();
            let missed = loses == Some(k) && bursts.iter().any(|[a, b]| time > *a && time <= *b);
            let told = if missed { ((now - *count) * kept).round() } else { now - *count };
            let _ = write!(out, ",{told}");
            *count = now;
        }
        if robot.is_steered {
            let _ = write!(out, ",{:.5}", steering[row] + s.normal(0.001));
        }
        // The clock of the pose: what it stamps with this time was so much earlier.
        let at = (time - robot.clock_offset) * (1.0 - robot.clock_rate) / STEP;
        let at = at.round().clamp(0.0, (poses.len() - 1) as f64) as usize;
        row += every;
        if let Some(gyro) = gyro {
            let turning = velocities[at.min(velocities.len() - 1)][2];
            let _ = writeln!(out, ",{:.5}", gyro.scale * turning + gyro.bias + s.normal(gyro.noise));
            continue;
        }
        let [x, y, yaw] = robot.measured(poses[at]);
        let [x, y] = [x, y].map(|v| v + s.normal(noise[0]));
        let yaw = (yaw + s.normal(noise[1]) + PI).rem_euclid(TAU) - PI;
        let _ = writeln!(out, ",{x:.5},{y:.5},{yaw:.5}");
    }
    out
}

/// The robot file.
fn robot_file(chassis: Chassis, stated: &Robot, counts: f64, seen: Seen) -> String {
    let mut out = String::from("name = \"drawn\"\nkind = \"odometry\"\n");
    for (k, wheel) in stated.wheels.iter().enumerate() {
        let [x, y] = wheel.place;
        let _ = write!(
            out,
            "\n[[wheel]]\nname = \"{}\"\nplace = [{x:.5}, {y:.5}]\ndirection_deg = {:.3}\nradius = {:.5}\nradius_sigma = {:.6}\n\
             counts_per_turn = {counts:.1}\ncolumn = \"tick_{}\"\nsource = \"drawn\"\n",
            wheel.name,
            wheel.direction.to_degrees(),
            wheel.radius,
            KNOWN[0] * wheel.radius,
            k + 1
        );
        if chassis.is_omni() {
            let _ = writeln!(out, "roller_deg = {:.0}", wheel.roller.to_degrees());
        }
        if stated.is_steered {
            out += "steered = true\n";
        }
    }
    if stated.is_steered {
        let radius = stated.wheels[0].radius;
        let _ = write!(
            out,
            "\n[[wheel]]\nname = \"rear axle\"\nplace = [0, 0]\nradius = {radius:.5}\nsource = \"drawn\"\n"
        );
    }
    let [x, y] = stated.wheels[0].place;
    out += "\n[known]\n";
    if stated.is_steered {
        let _ = write!(
            out,
            "wheelbase_sigma = {:.6}\nsteering_sigma_deg = {:.4}\nsteering_gain_sigma = {:.4}\n",
            KNOWN[1] * x,
            STEERING[0].to_degrees(),
            STEERING[1]
        );
    } else if chassis.is_omni() {
        let extent = |axis: usize| {
            let of =
                |pick: fn(f64, f64) -> f64, start: f64| stated.wheels.iter().map(|w| w.place[axis]).fold(start, pick);
            of(f64::max, f64::NEG_INFINITY) - of(f64::min, f64::INFINITY)
        };
        let _ =
            write!(out, "wheelbase_sigma = {:.6}\ntrack_sigma = {:.6}\n", KNOWN[1] * extent(0), KNOWN[1] * extent(1));
    } else {
        let _ = writeln!(out, "track_sigma = {:.6}", track_share(chassis) * 2.0 * y);
    }
    if chassis == Chassis::SkidSteer {
        let _ = writeln!(out, "pose_origin_sigma = {TURNS_ABOUT}");
    }
    out += "\n[columns]\ntime = \"time_s\"\nwheels = \"counts\"\n";
    out += match seen {
        Seen::Pose => "x = \"x_m\"\ny = \"y_m\"\nyaw = \"yaw_rad\"\nlength_unit = \"m\"\nangle_unit = \"rad\"\n",
        Seen::Gyro => "gyro = \"gyro_rad_s\"\nangle_unit = \"rad\"\n",
    };
    if stated.is_steered {
        out += "steering = \"steer_rad\"\n";
    }
    out
}
