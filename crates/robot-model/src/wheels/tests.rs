//! Robots of several kinds, against formulas and against the plant of four wheels.

use super::*;
use crate::{Robot as FourWheels, State as FourState};
use approx::assert_relative_eq;
use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use scalar::Lanes;

const STEP: f64 = 5e-3;

fn wheel(place: [f64; 2], motor: Option<usize>) -> Wheel<f64> {
    Wheel { place, direction: 0.0, roller: None, radius: 0.1, inertia: 0.01, motor, joint: None }
}

const MOTOR: Motor<f64> =
    Motor { coupling: Coupling::Rigid, inertia: 0.02, gain: 1.0, lag: 0.0, coulomb: 0.0, viscous: 0.0 };
const CASTER: Caster<f64> = Caster { pivot: [-0.4, 0.0], trail: 0.03, rolling: 0.0, pivot_friction: 0.0 };

fn robot<const W: usize, const M: usize>(wheels: [Wheel<f64>; W], motors: [Motor<f64>; M]) -> Robot<f64> {
    let mut out = Robot {
        mass: 40.0,
        yaw_inertia: 3.0,
        com: [0.0, 0.0, 0.2],
        wheels: [None; MOST],
        casters: [None; MOST_CASTERS],
        motors: [None; MOST],
        joints: [None; MOST],
        drag: 0.0,
        ground: Ground { rolling: 0.0, roller_drag: 0.0, ..Ground::usual() },
    };
    out.wheels.iter_mut().zip(wheels).for_each(|(to, w)| *to = Some(w));
    out.motors.iter_mut().zip(motors).for_each(|(to, m)| *to = Some(m));
    out
}

fn differential() -> Robot<f64> {
    let mut out = robot([wheel([0.0, 0.25], Some(0)), wheel([0.0, -0.25], Some(1))], [MOTOR; 2]);
    out.casters[0] = Some(CASTER);
    out.com[0] = -0.05;
    out
}

fn tricycle() -> Robot<f64> {
    let front = Wheel { joint: Some(0), ..wheel([0.8, 0.0], Some(0)) };
    let mut out = robot([front, wheel([0.0, 0.3], None), wheel([0.0, -0.3], None)], [MOTOR]);
    out.joints[0] = Some(Joint { place: [0.8, 0.0], about: 0.0, offset: 0.0, gain: 1.0, lag: 0.0 });
    out.com[0] = 0.3;
    out
}

/// Four omni wheels at the corners of a square, turning the robot counter-clockwise when they turn forward.
fn omni() -> Robot<f64> {
    let corner = |k: usize| {
        let angle = FRAC_PI_2 * (k as f64 + 0.5);
        let (sin, cos) = angle.sin_cos();
        let place = [0.3 * cos, 0.3 * sin];
        Wheel { direction: angle + FRAC_PI_2, roller: Some(FRAC_PI_2), ..wheel(place, Some(k)) }
    };
    robot([corner(0), corner(1), corner(2), corner(3)], [MOTOR; 4])
}

fn all<const N: usize>(values: [f64; N]) -> [f64; MOST] {
    let mut out = [0.0; MOST];
    out.iter_mut().zip(values).for_each(|(to, x)| *to = x);
    out
}

fn run(robot: &Robot<f64>, seconds: f64, torque: [f64; MOST], steering: f64) -> State<f64> {
    let plant = Plant::new(&robot.checked().expect("a robot"), STEP);
    let mut s = State::default();
    for _ in 0..(seconds / STEP).round() as usize {
        plant.step(&mut s, &torque, &all([steering]));
    }
    s
}

#[test]
fn a_robot_accelerates_as_its_torques_over_all_inertia_say() {
    // 1 N m on each of two wheels of 0.1 m: 20 N on 40 kg and four times 0.01 + 0.02 kg m² at 0.1 m, casters without mass.
    let s = run(&differential(), 2.0, all([1.0, 1.0]), 0.0);
    let expected = 20.0 / (40.0 + 2.0 * 0.03 / 0.01);
    assert_relative_eq!(s.velocity[0], 2.0 * expected, max_relative = 2e-3);
    assert_relative_eq!(s.position[0], 0.5 * expected * 4.0, max_relative = 1e-2);
    assert!(s.velocity[1].abs() < 1e-9 && s.position[1].abs() < 1e-9);
    // A quarter of that drives a robot of four omni wheels ahead: each pushes at 45 degrees.
    let push = [-1.0, -1.0, 1.0, 1.0];
    let s = run(&omni(), 2.0, all(push), 0.0);
    let root = 2.0_f64.sqrt();
    let expected = 4.0 * 10.0 / root / (40.0 + 4.0 * 0.03 / 0.01 / 2.0);
    assert_relative_eq!(s.velocity[0], 2.0 * expected, max_relative = 5e-3);
    assert!(s.yaw_rate.abs() < 1e-9);
}

#[test]
fn every_wheel_of_a_rolling_robot_rolls() {
    let mut slow = tricycle();
    slow.ground.rolling = 0.01;
    let s = run(&slow, 3.0, all([2.0]), 0.4);
    // On the circle of the rear axle: ω = v tan δ / L.
    let plant = Plant::new(&slow, STEP);
    let rear = plant.velocity_of(&s, [0.0, 0.0]);
    assert!(rear[0] > 0.5, "{rear:?}");
    assert_relative_eq!(s.yaw_rate, rear[0] * 0.4_f64.tan() / 0.8, max_relative = 0.02);
    assert_relative_eq!(s.wheel_speed[0] * 0.1, rear[0] / 0.4_f64.cos(), max_relative = 0.02);
    assert_relative_eq!(s.wheel_speed[1] * 0.1, rear[0] - 0.3 * s.yaw_rate, max_relative = 0.02);
    assert_relative_eq!(s.wheel_speed[2] * 0.1, rear[0] + 0.3 * s.yaw_rate, max_relative = 0.02);
}

#[test]
fn axles_of_steered_wheels_meet_where_ackermann_has_them() {
    let steered = |y: f64| Wheel { joint: Some(0), ..wheel([1.0, y], Some(0)) };
    let rear = |y: f64| wheel([0.0, y], None);
    let axle = Motor { coupling: Coupling::Differential, ..MOTOR };
    let mut car = robot([steered(0.3), steered(-0.3), rear(0.3), rear(-0.3)], [axle]);
    car.joints[0] = Some(Joint { place: [1.0, 0.0], about: 0.0, offset: 0.0, gain: 1.0, lag: 0.0 });
    car.com[0] = 0.5;
    let s = run(&car, 4.0, all([1.0]), 0.3);
    // Radius of the middle of the rear axle.
    let radius = 1.0 / 0.3_f64.tan();
    let plant = Plant::new(&car, STEP);
    let v = plant.velocity_of(&s, [0.0, 0.0]);
    assert_relative_eq!(v[0] / s.yaw_rate, radius, max_relative = 0.03);
    let hub = |y: f64| ((radius - y).powi(2) + 1.0).sqrt();
    // Driven through a differential, both turn as their ways ask.
    assert_relative_eq!(s.wheel_speed[0] / s.wheel_speed[1], hub(0.3) / hub(-0.3), max_relative = 0.01);
}

#[test]
fn joints_behind_the_unsteered_axle_steer_their_wheels_and_do_not_turn_them_round() {
    let steered = |x: f64, k: usize| Wheel { joint: Some(k), ..wheel([x, 0.0], Some(0)) };
    let with = |about: f64| {
        let mut out =
            robot([steered(0.4, 0), steered(-0.4, 1), wheel([0.0, 0.3], None), wheel([0.0, -0.3], None)], [MOTOR]);
        let joint = |x: f64| Some(Joint { place: [x, 0.0], about, offset: 0.0, gain: 1.0, lag: 0.0 });
        (out.joints[0], out.joints[1]) = (joint(0.4), joint(-0.4));
        let mut asked = [0.0; MOST];
        (asked[0], asked[1]) = (0.2, -0.2);
        let at = State { steering: asked, ..State::default() };
        Plant::new(&out, STEP).directions(&at)
    };
    // A wheel at the place of its joint points where the joint does, wherever the other axle is.
    for about in [0.0, -1.0, 1.0, 0.4] {
        let directions = with(about);
        for (k, angle) in [(0, 0.2_f64), (1, -0.2)] {
            let lies_on_the_line = about == 0.4 && k == 0;
            if !lies_on_the_line {
                assert_relative_eq!(directions[k][0], angle.cos(), max_relative = 1e-12);
                assert_relative_eq!(directions[k][1], angle.sin(), max_relative = 1e-12);
            }
        }
    }
}

#[test]
fn mecanum_wheels_drive_sideways_and_rollers_drag() {
    let at = |x: f64, y: f64, roller: f64, motor: usize| Wheel { roller: Some(roller), ..wheel([x, y], Some(motor)) };
    let wheels = [
        at(0.3, 0.2, FRAC_PI_4, 0),
        at(0.3, -0.2, -FRAC_PI_4, 1),
        at(-0.3, 0.2, -FRAC_PI_4, 2),
        at(-0.3, -0.2, FRAC_PI_4, 3),
    ];
    let free = robot(wheels, [MOTOR; 4]);
    let sideways = all([-1.0, 1.0, 1.0, -1.0]);
    let s = run(&free, 2.0, sideways, 0.0);
    assert!(s.velocity[1] > 0.5 && s.velocity[0].abs() < 1e-6 && s.yaw_rate.abs() < 1e-6, "{s:?}");
    // Upwards along y as fast as the rim of each wheel.
    assert_relative_eq!(s.wheel_speed[1] * 0.1, s.velocity[1], max_relative = 0.02);
    let mut dragged = free;
    dragged.ground.roller_drag = 0.03;
    assert!(run(&dragged, 2.0, sideways, 0.0).velocity[1] < s.velocity[1] - 0.2);
}

#[test]
fn four_wheels_by_side_move_as_the_plant_of_four_wheels_says() {
    let given = [
        ("mass", 40.0),
        ("yaw_inertia", 3.0),
        ("com_height", 0.2),
        ("com_x", 0.03),
        ("wheelbase", 0.5),
        ("track", 0.6),
        ("wheel_radius", 0.1),
        ("wheel_inertia", 0.01),
        ("adhesion", 0.7),
        ("slip_at_peak", 0.15),
        ("rolling_resistance", 0.02),
        ("coulomb", 0.4),
        ("viscous", 0.05),
    ];
    let four = FourWheels::from_constants(&given).expect("a robot");
    let motor = Motor { coulomb: 0.4, viscous: 0.05, inertia: four.motor_inertia, lag: four.drive.lag, ..MOTOR };
    let places = [([0.25, 0.3], 0), ([0.25, -0.3], 1), ([-0.25, 0.3], 0), ([-0.25, -0.3], 1)];
    let mut any = robot(places.map(|(p, m)| wheel(p, Some(m))), [motor; 2]);
    any.com = [0.03, 0.0, 0.2];
    any.ground = Ground {
        adhesion: 0.7,
        slip_at_peak: 0.15,
        sliding_share: four.sliding_share,
        brush_share: 0.0,
        rest_speed: four.rest_speed,
        rolling: 0.02,
        gravity: four.gravity,
        ..any.ground
    };
    // Forces that are held over a step come half a step late.
    let step = 5e-4;
    let (plant, other) = (crate::Plant::new(&four, &[], step), Plant::new(&any, step));
    let (mut a, mut b) = (FourState::default(), State::default());
    let mut farthest = 0.0_f64;
    for k in 0..12_000 {
        let t = step * f64::from(k);
        let torque = [3.5 + 2.0 * (1.1 * t).sin(), 3.5 + 2.5 * (0.7 * t).cos()];
        plant.step(&mut a, torque);
        other.step(&mut b, &all(torque), &[0.0; MOST]);
        farthest = farthest.max((a.position[0] - b.position[0]).hypot(a.position[1] - b.position[1]));
        assert!((a.wheel_speed[0] - b.wheel_speed[0]).abs() < 0.05, "{t} s: {:?} {:?}", a.wheel_speed, b.wheel_speed);
        assert!((a.yaw_rate - b.yaw_rate).abs() < 5e-3, "{t} s: {} {}", a.yaw_rate, b.yaw_rate);
    }
    assert!(a.position[0].abs() > 3.0 && farthest < 0.01, "{farthest} m after {:?}", a.position);
}

#[test]
fn a_caster_swings_behind_and_its_pivot_holds_it() {
    let mut held = differential();
    let backwards = run(&held, 2.0, all([-0.5, -0.5]), 0.0);
    // It swings round: its wheel then points the way the robot goes.
    assert!(backwards.velocity[0] < -0.3);
    assert!(backwards.caster[0].cos().abs() > 0.9);
    let turning = |r: &Robot<f64>| run(r, 2.0, all([-0.3, 0.3]), 0.0).yaw_rate;
    let free = turning(&held);
    if let Some(caster) = &mut held.casters[0] {
        caster.rolling = 0.05;
    }
    assert!(turning(&held) < 0.9 * free);
}

#[test]
fn wheels_roll_with_the_body_and_the_body_with_its_wheels() {
    for (robot, body, steering) in
        [(differential(), [0.7, 0.0, 0.4], 0.0), (omni(), [0.5, -0.3, 0.6], 0.0), (tricycle(), [0.8, 0.0, 0.0], 0.0)]
    {
        let plant = Plant::new(&robot, STEP);
        let mut s = State { yaw_rate: body[2], ..State::default() };
        plant.settle(&mut s, &[0.0; MOST], &all([steering]));
        plant.set_velocity(&mut s, [body[0], body[1]]);
        plant.roll_wheels(&mut s);
        let mut speeds = [None; MOST];
        for (to, (speed, wheel)) in speeds.iter_mut().zip(s.wheel_speed.iter().zip(&robot.wheels)) {
            *to = wheel.and_then(|w| w.motor).map(|_| *speed);
        }
        let mut found = State::default();
        plant.settle(&mut found, &[0.0; MOST], &all([steering]));
        plant.roll_body(&mut found, &speeds, None);
        for (a, b) in
            [(found.velocity[0], s.velocity[0]), (found.velocity[1], s.velocity[1]), (found.yaw_rate, body[2])]
        {
            assert_relative_eq!(a, b, epsilon = 1e-6);
        }
        // Nothing slips, so that nothing but inertia changes the speeds.
        let before = s.velocity;
        plant.step(&mut s, &[0.0; MOST], &all([steering]));
        assert!((s.velocity[0] - before[0]).hypot(s.velocity[1] - before[1]) < 5e-3, "{:?} {before:?}", s.velocity);
    }
}

#[test]
fn a_slope_pulls_along_the_world() {
    let mut robot = omni();
    robot.ground.slope = [0.0, -1.0];
    let s = run(&robot, 1.0, [0.0; MOST], 0.0);
    let per_mass = 40.0 / (40.0 + 4.0 * 0.03 / 0.01 / 2.0);
    assert_relative_eq!(s.velocity[1], -per_mass, max_relative = 0.01);
    assert!(s.velocity[0].abs() < 1e-9);
}

#[test]
fn lanes_have_the_bits_of_each_robot_alone() {
    let one = tricycle();
    let mut other = one;
    other.mass = 50.0;
    let robots = [one, other];
    // Nothing but the mass is 40.
    let both = one.cast(|x| Lanes([x, if x == 40.0 { 50.0 } else { x }]));
    let plant = Plant::new(&both, Lanes([STEP; 2]));
    let mut s = State::default();
    for _ in 0..200 {
        plant.step(&mut s, &all([1.5]).map(|x| Lanes([x; 2])), &all([0.2]).map(|x| Lanes([x; 2])));
    }
    for (lane, robot) in robots.iter().enumerate() {
        let alone = run(robot, 1.0, all([1.5]), 0.2);
        assert_eq!((s.position[0].0[lane], s.yaw_rate.0[lane]), (alone.position[0], alone.yaw_rate));
    }
}

#[test]
fn what_cannot_be_is_refused() {
    let mut robot = differential();
    robot.casters[0] = None;
    assert_eq!(robot.checked().unwrap_err(), crate::ModelError::OnALine);
    let mut robot = differential();
    robot.motors[1] = None;
    assert_eq!(robot.checked().unwrap_err(), crate::ModelError::NotThere { what: "motor of a wheel" });
    let mut robot = differential();
    robot.casters[0] = Some(Caster { trail: 0.0, ..CASTER });
    assert!(matches!(robot.checked(), Err(crate::ModelError::Value { name: "trail of a caster", .. })));
    robot.mass = f64::NAN;
    assert!(robot.checked().is_err());
}

#[test]
fn a_wheel_that_slips_comes_to_roll_and_never_swings_beyond() {
    // Light wheels in long steps: the tangent of a tyre that holds less the more it slips would throw them far beyond.
    let mut light = omni();
    for wheel in light.wheels.iter_mut().flatten() {
        wheel.inertia = 1e-3;
    }
    for motor in light.motors.iter_mut().flatten() {
        (motor.inertia, motor.coulomb) = (2e-3, 0.3);
    }
    for over_peak in [0.2, 0.5, 0.9, 1.5, 4.0] {
        let plant = Plant::new(&light, STEP);
        let mut s = State::default();
        plant.set_velocity(&mut s, [0.3, 0.1]);
        plant.roll_wheels(&mut s);
        let rolling = s.wheel_speed[0];
        let slip = over_peak * light.ground.slip_at_peak * light.ground.rest_speed / 0.1;
        s.wheel_speed[0] = rolling + slip;
        let mut before = slip;
        for _ in 0..20 {
            plant.step(&mut s, &[0.0; MOST], &[0.0; MOST]);
            let mut rolls = s;
            plant.roll_wheels(&mut rolls);
            let now = s.wheel_speed[0] - rolls.wheel_speed[0];
            // What dry friction holds it back by is a small share of the slip at the peak.
            assert!(now < before + 1e-3 && now > -0.1 * slip.max(0.1), "{over_peak}: {before} then {now}");
            before = now;
        }
        assert!(before.abs() < 0.05, "{over_peak}: {before} rad/s after 0.1 s");
    }
}

#[test]
fn dry_friction_stops_a_wheel_and_never_turns_it_back() {
    let mut slippery = omni();
    slippery.ground.adhesion = 1e-6;
    for motor in slippery.motors.iter_mut().flatten() {
        (motor.inertia, motor.coulomb) = (2e-3, 0.5);
    }
    for wheel in slippery.wheels.iter_mut().flatten() {
        wheel.inertia = 1e-3;
    }
    let plant = Plant::new(&slippery, STEP);
    let mut s = State { wheel_speed: all([2.0, 2.0, 2.0, 2.0]), ..State::default() };
    let mut before = 2.0;
    for _ in 0..40 {
        plant.step(&mut s, &[0.0; MOST], &[0.0; MOST]);
        assert!(s.wheel_speed[0] >= 0.0 && s.wheel_speed[0] <= before, "{before} then {}", s.wheel_speed[0]);
        before = s.wheel_speed[0];
    }
    assert!(before < 1e-3, "{before} rad/s");
}

#[test]
fn tyres_lie_between_kienckes_law_and_the_brush_and_have_one_stiffness() {
    use super::tyre::{of_wheel, tyre};
    let ground = |brush_share: f64, lateral_stiffness: f64| Ground {
        brush_share,
        lateral_stiffness,
        sliding_share: 1.0,
        slip_at_peak: 0.15,
        ..Ground::usual()
    };
    let d2 = 0.5;
    let d = f64::sqrt(d2);
    for slip in [1e-6, 0.02, 0.06, 0.11, 0.14, 0.3] {
        let share = |brush| slip * tyre([slip, 0.0], d2, &ground(brush, 1.0));
        let kiencke = slip * crate::contact::combined([slip, 0.0], d2, 0.15, 1.0).0;
        let rho: f64 = slip / (1.5 * 0.15 * d);
        let brush = if rho < 1.0 { 3.0 * rho - 3.0 * rho * rho + rho * rho * rho } else { 1.0 };
        assert_relative_eq!(share(0.0), kiencke, max_relative = 1e-9);
        assert_relative_eq!(share(1.0), brush, max_relative = 1e-9);
        assert_relative_eq!(share(0.25), 0.75 * kiencke + 0.25 * brush, max_relative = 1e-9);
    }
    // Both begin with 2/λp over the reference speed.
    for brush in [0.0, 1.0] {
        assert_relative_eq!(tyre([1e-7, 0.0], d2, &ground(brush, 1.0)), 2.0 / (0.15 * d), max_relative = 1e-5);
    }

    // A wheel that points to the left, twice as stiff sideways, which is along x.
    let (force, per_slip) = of_wheel([1e-7, 1e-7], [0.0, 1.0], d2, &ground(0.5, 2.0));
    assert_relative_eq!(force[0], 2.0 * force[1], max_relative = 1e-5);
    assert_relative_eq!(force[1], 2e-7 / (0.15 * d), max_relative = 1e-5);
    assert_relative_eq!(per_slip[0] * 1e-7 + per_slip[1] * 1e-7, force[0], max_relative = 1e-9);
    // Sliding, it holds as much as any.
    let (force, _) = of_wheel([3.0, 0.0], [0.0, 1.0], d2, &ground(0.5, 2.0));
    assert_relative_eq!(force[0], 1.0, max_relative = 1e-6);
    for wrong in [ground(1.5, 1.0), ground(0.5, 0.0)] {
        let robot = Robot { ground: wrong, ..differential() };
        assert!(matches!(robot.checked(), Err(crate::ModelError::Value { .. })), "{wrong:?}");
    }
}
