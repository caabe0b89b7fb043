//! The path closes, the kinematic loop dissipates, bad gains are refused.

use nn_basis::{Activation, Constant, Lanes, SigmoidLayer};
use robot_model::paper::Parameters;

use crate::{
    ControllerError, Gains, Kinematic, Loop, LoopPath, PathReference, Pose, Profile, Reference, Tracking, Turn,
    WheelState,
};

fn path(turn: Turn) -> LoopPath<f64> {
    LoopPath::new(&Loop { turn, ..Loop::default() }).expect("valid")
}

#[test]
fn the_heading_changes_by_exactly_one_turn() {
    let left = path(Turn::Left);
    assert_eq!(left.yaw(left.events().entry), 0.0);
    assert!((left.yaw(32.0) - core::f64::consts::TAU).abs() < 1e-12);
    assert!((path(Turn::Right).yaw(32.0) + core::f64::consts::TAU).abs() < 1e-12);
}

#[test]
fn events_fall_where_the_study_puts_them() {
    let events = *path(Turn::Left).events();
    for (found, expected) in [(events.entry, 4.0), (events.exit, 22.85), (events.brake, 26.35), (events.rest, 28.35)] {
        assert!((found - expected).abs() < 1e-2, "{events:?}");
    }
}

#[test]
fn the_reference_closes_the_loop_and_stops() {
    let mut reference = PathReference::new(path(Turn::Left));
    let mut highest = 0.0_f64;
    for _ in 0..32_000 {
        reference.advance(1e-3);
        highest = highest.max(reference.now().y);
    }
    let end = reference.now();
    // One circle returns to the same line; the straights are what is left: 0.25 + 1.5 + 1.5 + 0.5 m and two blends.
    assert!((highest - 3.0).abs() < 0.05, "{highest}");
    assert!(end.speed.abs() < 1e-12 && end.y.abs() < 0.02, "{end:?}");
    assert!((end.x - 4.0).abs() < 0.05, "{end:?}");
}

#[test]
fn a_right_turn_mirrors_a_left_turn() {
    let (mut left, mut right) = (PathReference::new(path(Turn::Left)), PathReference::new(path(Turn::Right)));
    for _ in 0..20_000 {
        left.advance(1e-3);
        right.advance(1e-3);
        assert_eq!((left.now().x, left.now().y), (right.now().x, -right.now().y));
    }
}

#[test]
fn the_kinematic_loop_brings_ideal_wheels_to_the_path() {
    let law = Kinematic { kx: 1.0, ky: 4.0, k_yaw: 2.0 };
    let mut pose = Pose { x: -0.2, y: 0.3, yaw: 0.4 };
    let mut energy = f64::INFINITY;
    for k in 0..10_000 {
        let reference = Reference { x: 0.5e-3 * f64::from(k), y: 0.0, yaw: 0.0, speed: 0.5, yaw_rate: 0.0 };
        let (dx, dy) = (reference.x - pose.x, pose.y);
        let now = 0.5 * (dx * dx + dy * dy) + (1.0 - nalgebra::ComplexField::cos(pose.yaw)) / law.ky;
        assert!(now <= energy + 1e-6, "{now} {energy}");
        energy = now;
        let command = law.command(&pose, &reference);
        let (sin, cos) = nalgebra::ComplexField::sin_cos(pose.yaw);
        pose.x += 1e-3 * command.speed * cos;
        pose.y += 1e-3 * command.speed * sin;
        pose.yaw += 1e-3 * command.yaw_rate;
    }
    assert!(energy < 1e-4, "{energy}");
}

#[test]
fn what_cannot_be_used_is_refused_by_name() {
    let still = LoopPath::<f64>::new(&Loop { speed: 0.0, ..Loop::default() });
    assert_eq!(still, Err(ControllerError::NotPositive { name: "speed of the path", value: 0.0 }));
    let gains = Gains { leak: -1.0, ..Gains::for_robot(&Parameters::SET_B, 100.0) };
    let basis = Constant::new([0.5; 8]).expect("finite");
    let built = Tracking::<f64, _, 8>::new(&gains, basis, PathReference::new(path(Turn::Left)));
    assert_eq!(built, Err(ControllerError::Negative { name: "leak", value: -1.0 }));
}

#[test]
fn single_precision_reference_stays_close() {
    let narrow = LoopPath::<f32>::new(&Loop::default()).expect("valid");
    assert!((f64::from(narrow.yaw(15.0)) - path(Turn::Left).yaw(15.0)).abs() < 1e-5);
}

#[test]
fn the_leak_bounds_the_weights_whichever_way_the_wheels_err() {
    let gains = Gains::for_robot(&Parameters::SET_B, 100.0);
    for speed in [-30.0, 30.0] {
        let basis = Constant::new([0.5; 8]).expect("finite");
        let reference = PathReference::new(path(Turn::Left));
        let mut controller = Tracking::<f64, _, 8>::new(&gains, basis, reference).expect("valid");
        let stuck = WheelState { x: 0.0, y: 0.0, yaw: 0.0, angle: [0.0; 2], speed: [speed; 2] };
        for _ in 0..500 {
            let action = controller.step(&stuck, 1e-3);
            assert!(action.sliding[0] * speed < 0.0);
        }
        // At rest of the law, |W| = φ/κ.
        let bound = 0.5 / gains.leak;
        for w in controller.net().weight.iter().flatten() {
            assert!(w.abs() <= bound && w * speed < 0.0, "{w}");
        }
    }
}

#[test]
fn the_tracking_law_runs_in_single_precision() {
    let narrow = LoopPath::<f32>::new(&Loop::default()).expect("valid");
    let gains = Gains::for_robot(&Parameters::SET_B, 100.0);
    let basis = Constant::new([0.5_f32; 8]).expect("finite");
    let mut controller = Tracking::<f32, _, 8>::new(&gains, basis, PathReference::new(narrow)).expect("valid");
    let still = WheelState { x: 0.0, y: 0.0, yaw: 0.0, angle: [0.0; 2], speed: [0.0; 2] };
    controller.step(&still, 1e-3);
    let [left, right] = controller.step(&still, 1e-3).torque;
    assert!(left > 0.0 && left == right);
}

#[test]
fn the_yaw_rate_is_the_slope_of_the_heading() {
    let path = path(Turn::Left);
    for k in 0..3200 {
        let t = 0.005 + 0.01 * f64::from(k);
        let slope = (path.yaw(t + 1e-4) - path.yaw(t - 1e-4)) / 2e-4;
        assert!((slope - path.yaw_rate(t)).abs() < 1e-6, "at {t}");
    }
}

#[test]
fn the_command_does_not_depend_on_where_the_plane_points() {
    let law = Kinematic { kx: 1.0, ky: 4.0, k_yaw: 2.0 };
    let command = |turn: f64| {
        let (sin, cos) = nalgebra::ComplexField::sin_cos(turn);
        let place = |x: f64, y: f64| (cos * x - sin * y, sin * x + cos * y);
        let ((x, y), (xd, yd)) = (place(0.1, 0.2), place(0.4, 0.7));
        let reference = Reference { x: xd, y: yd, yaw: turn + 0.1, speed: 0.5, yaw_rate: 0.2 };
        law.command(&Pose { x, y, yaw: turn }, &reference)
    };
    let straight = command(0.0);
    assert!((straight.speed - (0.5 * nalgebra::ComplexField::cos(0.1_f64) + 0.3)).abs() < 1e-12);
    assert!((straight.yaw_rate - (0.2 + 4.0 * 0.5 * 0.5 + 2.0 * nalgebra::ComplexField::sin(0.1_f64))).abs() < 1e-12);
    for turn in [0.7, 2.0, -2.5] {
        let turned = command(turn);
        assert!((turned.speed - straight.speed).abs() < 1e-12, "{turned:?}");
        assert!((turned.yaw_rate - straight.yaw_rate).abs() < 1e-12, "{turned:?}");
    }
}

#[test]
fn the_smooth_profile_starts_and_ends_without_a_jump_of_acceleration() {
    let sharp = path(Turn::Left);
    let smooth = LoopPath::<f64>::new(&Loop { profile: Profile::Smoothstep, ..Loop::default() }).expect("valid");
    assert_eq!(smooth.events(), sharp.events());
    let slope = |path: &LoopPath<f64>, t: f64| (path.speed(t + 1e-6) - path.speed(t - 1e-6)) / 2e-6;
    let brake = sharp.events().brake;
    for (begin, duration, speed) in [(0.0, 1.0, 0.5), (brake, 2.0, -0.5)] {
        for end in [begin, begin + duration] {
            assert!(slope(&smooth, end).abs() < 1e-5 && slope(&sharp, end).abs() > 0.1, "at {end} s");
        }
        let middle = begin + 0.5 * duration;
        assert!((slope(&smooth, middle) - 1.5 * speed / duration).abs() < 1e-6);
        assert!((smooth.speed(middle) - 0.25).abs() < 1e-12);
    }
    assert_eq!((smooth.speed(10.0), smooth.yaw_rate(4.1)), (sharp.speed(10.0), sharp.yaw_rate(4.1)));
    assert_eq!((smooth.speed(-1.0), smooth.speed(40.0)), (0.0, 0.0));
}

#[test]
fn every_lane_of_the_controller_has_the_bits_of_its_own() {
    let gains = Gains::for_robot(&Parameters::SET_B, 100.0);
    let layers: [SigmoidLayer<f64, 4, 8>; 2] = core::array::from_fn(|l| {
        let weight = core::array::from_fn(|j| core::array::from_fn(|i| 0.3 - 0.1 * (i + j + l) as f64));
        SigmoidLayer::new([0.1; 8], weight, [5.0; 4], Activation::Logistic).expect("finite")
    });
    let wide = SigmoidLayer::side_by_side(&layers).expect("of one kind");
    let path = LoopPath::<Lanes<2>>::new(&Loop::default()).expect("valid");
    let mut together = Tracking::<Lanes<2>, _, 8>::new(&gains, wide, PathReference::new(path)).expect("valid");
    let mut each = layers
        .map(|l| Tracking::<f64, _, 8>::new(&gains, l, PathReference::new(self::path(Turn::Left))).expect("valid"));
    for k in 0..6000 {
        let yaw = |i: usize| 1e-3 * (k * (i + 1)) as f64;
        let state = WheelState { x: 0.1, y: 0.0, yaw: 0.0, angle: [1.0; 2], speed: [4.0, 6.0] };
        let seen = WheelState {
            x: Lanes([0.1; 2]),
            y: Lanes([0.0; 2]),
            yaw: Lanes([yaw(0), yaw(1)]),
            angle: [Lanes([1.0; 2]); 2],
            speed: [Lanes([4.0; 2]), Lanes([6.0; 2])],
        };
        let all = together.step(&seen, Lanes([1e-3; 2]));
        for i in 0..2 {
            let one = each[i].step(&WheelState { yaw: yaw(i), ..state }, 1e-3);
            let lane = |x: [Lanes<2>; 2]| x.map(|x| x.0[i].to_bits());
            assert_eq!(lane(all.torque), one.torque.map(f64::to_bits), "step {k}");
            assert_eq!(all.reference.y.0[i].to_bits(), one.reference.y.to_bits(), "step {k}");
        }
    }
}
