//! Draws a case: the robot, what is hidden, drives and sensors.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};
use std::fmt::Write as _;
use std::path::PathBuf;

use super::plant::{Caster, Motor, Robot, Wheel};
use super::sheet::{Lasting, column, measured, sheet};
use super::{Layout, WheeledCase, WheeledHidden as Hidden, WheeledPlan, WheeledTruth};
use crate::random::Stream;

/// Recordings of a case.
const RECORDINGS: usize = 3;
/// Share of a recording before and after what begins in it, at least.
const EARLIEST: f64 = 0.3;
/// How well the owner knows the robot, one sigma: mass, inertia, radii, torque as shares; centre of mass as a share of its length;
/// directions, rad; friction as a share.
const MASS: f64 = 0.02;
const INERTIA: f64 = 0.15;
const RADIUS: f64 = 0.006;
const TORQUE: f64 = 0.02;
const COM: f64 = 0.01;
const ANGLE: f64 = 0.006;
const FRICTION: f64 = 0.15;
const ROLLING: f64 = 0.003;

/// The case of a plan.
pub(super) fn case(plan: &WheeledPlan) -> WheeledCase {
    let stream = |name: &str| Stream::new(plan.seed, name, plan.index);
    let stated = stated(plan.layout, &mut stream("wheeled robot"));
    let mut robot = as_built(&stated, &mut stream("wheeled errors"));
    let mut truth = WheeledTruth {
        case: plan.name.clone(),
        layout: plan.layout,
        hidden: plan.hidden.into_iter().collect(),
        part: None,
        numbers: BTreeMap::new(),
        onset: None,
    };
    let sound = robot.clone();
    if let Some(hidden) = plan.hidden {
        hide(hidden, &stated, &mut robot, &mut truth, &mut stream("wheeled sizes"));
    }
    let mut files = vec![(PathBuf::from("robot.toml"), robot_file(plan.layout, &stated).into_bytes())];
    let mut of_onset = stream("wheeled onset");
    let onset = plan.begins.then(|| (1 + of_onset.index(RECORDINGS), of_onset.uniform(EARLIEST, 1.0 - EARLIEST)));
    for number in 1..=plan.references {
        let mut s = Stream::new(plan.seed, "wheeled reference", plan.index * 100 + number as u64);
        let lasting = Lasting { before: &sound, after: &sound, share: 0.0 };
        let (text, _) = sheet(plan.layout, &stated, lasting, &mut s);
        files.push((PathBuf::from(format!("references/ref_{number}.csv")), text.into_bytes()));
    }
    for number in 1..=RECORDINGS {
        let mut s = Stream::new(plan.seed, "wheeled drive", plan.index * 100 + number as u64);
        let share = onset.map_or(0.0, |(run, share)| match number.cmp(&run) {
            Ordering::Less => 1.0,
            Ordering::Equal => share,
            Ordering::Greater => 0.0,
        });
        let (text, from) = sheet(plan.layout, &stated, Lasting { before: &sound, after: &robot, share }, &mut s);
        if onset.is_some_and(|(run, _)| run == number) {
            truth.onset = Some((format!("run_{number}"), from));
        }
        files.push((PathBuf::from(format!("recordings/run_{number}.csv")), text.into_bytes()));
    }
    WheeledCase { files, truth }
}

/// Half of the length of a robot of these places.
fn reach(robot: &Robot) -> f64 {
    robot.wheels.iter().map(|w| w.place[0].hypot(w.place[1])).fold(0.0, f64::max)
}

/// The robot as its owner states it.
fn stated(layout: Layout, s: &mut Stream) -> Robot {
    let (r, a) = (s.uniform(0.05, 0.13), s.uniform(0.2, 0.4));
    let mass = s.uniform(60.0, 140.0) * a * a * 4.0;
    let count = if layout == Layout::SixWheel { 2.0 } else { 3.0 };
    let motor_inertia = 0.03 * mass / count * r * r;
    // A tenth of what would hold the robot on a slope of one in ten.
    let friction = 0.015 * mass * 9.81 * r / count;
    let wheel = |name: &str, place: [f64; 2], motor: Option<usize>| Wheel {
        name: name.to_owned(),
        place,
        direction: 0.0,
        roller: None,
        radius: r,
        inertia: 0.01 * mass / 4.0 * r * r,
        motor,
        is_steered: false,
    };
    let steered = |w: Wheel| Wheel { is_steered: true, ..w };
    let around = |n: usize, first: f64| -> Vec<Wheel> {
        let one = |k: usize| {
            let at = first + TAU * k as f64 / n as f64;
            let place = [a * at.cos(), a * at.sin()];
            let name = format!("wheel {}", k + 1);
            Wheel { direction: at + FRAC_PI_2, roller: Some(FRAC_PI_2), ..wheel(&name, place, Some(k)) }
        };
        (0..n).map(one).collect()
    };
    let mecanum = |name: &str, [x, y]: [f64; 2], motor: usize, side: f64| Wheel {
        roller: Some(FRAC_PI_4 * side),
        ..wheel(name, [x * a, y * a], Some(motor))
    };
    let wheels = match layout {
        Layout::Differential => vec![wheel("left", [0.0, a], Some(0)), wheel("right", [0.0, -a], Some(1))],
        Layout::Tricycle => vec![
            steered(wheel("front", [2.2 * a, 0.0], Some(0))),
            wheel("rear left", [0.0, a], None),
            wheel("rear right", [0.0, -a], None),
        ],
        Layout::Car => vec![
            steered(wheel("front left", [2.2 * a, 0.8 * a], None)),
            steered(wheel("front right", [2.2 * a, -0.8 * a], None)),
            wheel("rear left", [0.0, 0.8 * a], Some(0)),
            wheel("rear right", [0.0, -0.8 * a], Some(0)),
        ],
        Layout::Omni3 => around(3, PI / 3.0),
        Layout::Omni4 => around(4, FRAC_PI_4),
        Layout::Mecanum4 => vec![
            mecanum("front left", [1.0, 0.8], 0, 1.0),
            mecanum("front right", [1.0, -0.8], 1, -1.0),
            mecanum("rear left", [-1.0, 0.8], 2, -1.0),
            mecanum("rear right", [-1.0, -0.8], 3, 1.0),
        ],
        Layout::SixWheel => [("front", 1.0), ("middle", 0.0), ("rear", -1.0)]
            .iter()
            .flat_map(|&(name, x)| {
                [("left", 1.0, 0), ("right", -1.0, 1)]
                    .map(|(side, y, k)| wheel(&format!("{name} {side}"), [0.8 * x * a, y * a], Some(k)))
            })
            .collect(),
    };
    let names: Vec<&str> = match layout {
        Layout::Tricycle => vec!["front"],
        Layout::Car => vec!["rear axle"],
        Layout::Differential | Layout::SixWheel => vec!["left", "right"],
        Layout::Omni3 => vec!["motor 1", "motor 2", "motor 3"],
        Layout::Omni4 => vec!["motor 1", "motor 2", "motor 3", "motor 4"],
        Layout::Mecanum4 => vec!["front left", "front right", "rear left", "rear right"],
    };
    let motor = |name: &&str| Motor {
        name: (*name).to_owned(),
        is_differential: layout == Layout::Car,
        inertia: motor_inertia,
        gain: 1.0,
        lag: 0.01,
        coulomb: friction,
        viscous: 0.02 * friction,
    };
    let caster = |x: f64| Caster { pivot: [x * a, 0.0], trail: 0.3 * r, rolling: 0.015 };
    let middle = match layout {
        Layout::Tricycle | Layout::Car => 0.9 * a,
        _ => 0.0,
    };
    Robot {
        mass,
        inertia: 0.8 * mass * a * a,
        com: [middle, 0.0, s.uniform(0.4, 0.9) * a],
        wheels,
        motors: names.iter().map(motor).collect(),
        casters: if layout == Layout::Differential { vec![caster(0.9), caster(-0.9)] } else { Vec::new() },
        steered_at: 2.2 * a,
        steering_zero: 0.0,
        steering_gain: 1.0,
        adhesion: 0.7,
        slip: 0.22,
        rolling: 0.015,
        roller_drag: 0.01,
        drag: 0.0,
        slope: [0.0; 2],
    }
}

/// The robot as it is: every number a little off.
fn as_built(stated: &Robot, s: &mut Stream) -> Robot {
    let mut out = stated.clone();
    out.mass *= 1.0 + s.normal(MASS);
    out.inertia *= 1.0 + s.normal(INERTIA);
    let com = COM * reach(stated);
    out.com = [out.com[0] + s.normal(com), out.com[1] + s.normal(com), out.com[2]];
    let torque = 1.0 + s.normal(0.7 * TORQUE);
    for motor in &mut out.motors {
        motor.gain *= torque * (1.0 + s.normal(0.7 * TORQUE));
        motor.coulomb *= 1.0 + s.normal(FRICTION);
        motor.viscous *= 1.0 + s.normal(FRICTION);
    }
    for wheel in &mut out.wheels {
        wheel.radius *= 1.0 + s.normal(RADIUS);
        wheel.direction += s.normal(ANGLE);
    }
    out.steering_zero += s.normal(ANGLE);
    out.steering_gain *= 1.0 + s.normal(0.01);
    out.adhesion = s.uniform(0.55, 0.9);
    out.slip *= 1.0 + s.normal(0.15);
    out.rolling += s.normal(ROLLING);
    out.roller_drag = (out.roller_drag + s.normal(ROLLING)).max(0.0);
    for caster in &mut out.casters {
        caster.rolling += s.normal(ROLLING);
    }
    out.slope = [s.normal(0.03), s.normal(0.03)];
    out
}

/// Puts something hidden into the robot.
fn hide(hidden: Hidden, stated: &Robot, robot: &mut Robot, truth: &mut WheeledTruth, s: &mut Stream) {
    let motor = s.index(robot.motors.len());
    let driven: Vec<usize> = (0..robot.wheels.len()).filter(|&i| robot.wheels[i].motor.is_some()).collect();
    let wheel = driven[s.index(driven.len())];
    let mut note = |name: &str, value: f64| {
        truth.numbers.insert(name.to_owned(), value);
    };
    // Torque at one motor that a hundredth of the weight would ask for.
    let scale = 0.01 * stated.mass * 9.81 * stated.wheels[0].radius / stated.motors.len() as f64;
    let mut part = None;
    match hidden {
        Hidden::Mass => {
            robot.mass *= 1.0 + s.uniform(0.2, 0.5);
            note("mass", robot.mass);
        }
        Hidden::CentreOfMass => {
            robot.com[0] += s.sign() * s.uniform(0.2, 0.35) * reach(stated);
            note("com_x", robot.com[0]);
        }
        Hidden::DryFriction => {
            robot.motors[motor].coulomb += s.uniform(2.0, 4.0) * scale;
            part = Some(robot.motors[motor].name.clone());
            note("coulomb", robot.motors[motor].coulomb);
        }
        Hidden::ViscousFriction => {
            let at = stated.wheels[0].radius;
            robot.motors[motor].viscous += s.uniform(3.0, 6.0) * scale * at;
            part = Some(robot.motors[motor].name.clone());
            note("viscous", robot.motors[motor].viscous);
        }
        Hidden::TorqueScale => {
            robot.motors[motor].gain *= 1.0 + if s.sign() < 0.0 { -s.uniform(0.2, 0.35) } else { s.uniform(0.2, 0.4) };
            part = Some(robot.motors[motor].name.clone());
            note("gain", robot.motors[motor].gain);
        }
        Hidden::Lag => {
            let lag = s.uniform(0.06, 0.15);
            robot.motors.iter_mut().for_each(|m| m.lag = lag);
            note("lag", lag);
        }
        Hidden::Radius => {
            robot.wheels[wheel].radius *= 1.0 + s.sign() * s.uniform(0.05, 0.12);
            part = Some(robot.wheels[wheel].name.clone());
            note("radius", robot.wheels[wheel].radius);
        }
        Hidden::Direction => {
            let fixed: Vec<usize> = (0..robot.wheels.len()).filter(|&i| !robot.wheels[i].is_steered).collect();
            let wheel = fixed[s.index(fixed.len())];
            robot.wheels[wheel].direction += s.sign() * s.uniform(0.05, 0.1);
            part = Some(robot.wheels[wheel].name.clone());
            note("direction", robot.wheels[wheel].direction);
        }
        Hidden::SteeringZero => {
            robot.steering_zero += s.sign() * s.uniform(0.05, 0.1);
            note("steering_zero", robot.steering_zero);
        }
        Hidden::SteeringGain => {
            robot.steering_gain *= 1.0 + s.sign() * s.uniform(0.1, 0.2);
            note("steering_gain", robot.steering_gain);
        }
        Hidden::Rolling => {
            robot.rolling += s.uniform(0.02, 0.05);
            note("rolling", robot.rolling);
        }
        Hidden::Drag => {
            robot.drag = s.uniform(0.03, 0.06) * stated.mass * 9.81;
            note("drag", robot.drag);
        }
        Hidden::RollerDrag => {
            robot.roller_drag += s.uniform(0.03, 0.06);
            note("roller_drag", robot.roller_drag);
        }
        Hidden::CasterDrag => {
            let more = s.uniform(0.06, 0.12);
            robot.casters.iter_mut().for_each(|c| c.rolling += more);
            note("caster_rolling", robot.casters[0].rolling);
        }
        Hidden::Slope => {
            robot.slope = [s.sign() * s.uniform(0.25, 0.6), s.sign() * s.uniform(0.1, 0.4)];
            note("slope_x", -robot.slope[0] / 9.81);
            note("slope_y", -robot.slope[1] / 9.81);
        }
    }
    truth.part = part;
}

/// The robot file.
fn robot_file(layout: Layout, stated: &Robot) -> String {
    let mut out = format!(
        "name = \"drawn\"\nkind = \"wheeled\"\nmass = {{ value = {:.4}, sigma = {:.4}, source = \"drawn\" }}\nyaw_inertia = {{ value = {:.5}, \
         sigma = {:.5}, source = \"drawn\" }}\ncentre_of_mass = [{:.5}, {:.5}, {:.5}]\ncentre_of_mass_sigma = {:.5}\n",
        stated.mass,
        MASS * stated.mass,
        stated.inertia,
        INERTIA * stated.inertia,
        stated.com[0],
        stated.com[1],
        stated.com[2],
        COM * reach(stated)
    );
    let measured = measured(layout);
    for (i, w) in stated.wheels.iter().enumerate() {
        let [x, y] = w.place;
        let _ = write!(
            out,
            "\n[[wheel]]\nname = \"{}\"\nplace = [{x:.5}, {y:.5}]\ndirection_deg = {:.4}\nradius = {:.5}\nradius_sigma = {:.6}\n\
             inertia = {:.6}\n",
            w.name,
            w.direction.to_degrees(),
            w.radius,
            RADIUS * w.radius,
            w.inertia
        );
        if let Some(roller) = w.roller {
            let _ = writeln!(out, "roller_deg = {:.0}", roller.to_degrees());
        }
        if let Some(motor) = w.motor {
            let _ = writeln!(out, "motor = \"{}\"", stated.motors[motor].name);
        }
        out += if w.is_steered { "steered_by = \"steering\"\n" } else { "" };
        if measured.contains(&i) {
            let _ = writeln!(out, "column = \"speed_{}\"", column(&w.name));
        }
    }
    for c in &stated.casters {
        let _ = write!(
            out,
            "\n[[caster]]\nplace = [{:.5}, {:.5}]\ntrail = {:.5}\nrolling_resistance = {:.4}\n",
            c.pivot[0], c.pivot[1], c.trail, c.rolling
        );
    }
    for m in &stated.motors {
        let _ = write!(
            out,
            "\n[[motor]]\nname = \"{}\"\ncolumn = \"torque_{}\"\ndifferential = {}\ninertia = {:.6}\nlag = {}\ncoulomb = {:.5}\n\
             coulomb_sigma = {:.5}\nviscous = {:.6}\nviscous_sigma = {:.6}\n",
            m.name,
            column(&m.name),
            m.is_differential,
            m.inertia,
            m.lag,
            m.coulomb,
            FRICTION * m.coulomb,
            m.viscous,
            FRICTION * m.viscous
        );
    }
    if layout.is_steered() {
        let _ = write!(
            out,
            "\n[[joint]]\nname = \"steering\"\nplace = [{:.5}, 0.0]\ncolumn = \"steer_rad\"\n",
            stated.steered_at
        );
    }
    let _ = write!(
        out,
        "\n[ground]\nadhesion = {}\nslip_at_peak = 0.12\nrolling_resistance = {}\nroller_drag = {}\n\n[known]\ntorque_share = {TORQUE}\n\
         direction_deg = {:.4}\nsteering_deg = {:.4}\nsteering_share = 0.01\nrolling_resistance = {ROLLING}\n\n[columns]\n\
         time = \"time_s\"\nwheels = \"speed\"\ngyro = \"gyro_z\"\nx = \"x_m\"\ny = \"y_m\"\nyaw = \"yaw_rad\"\n",
        stated.adhesion,
        stated.rolling,
        stated.roller_drag,
        ANGLE.to_degrees(),
        ANGLE.to_degrees()
    );
    out
}
