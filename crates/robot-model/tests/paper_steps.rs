//! The paper's plant arranged for speed against the plant as it reads, and both schemes against themselves.

use proptest::prelude::*;
use robot_model::Lanes;
use robot_model::paper::{Belt, PaperRobot, Parameters, State, Tyre, Variant};

const VARIANTS: [Variant; 4] = [
    Variant { belt: Belt::Literal, tyre: Tyre::Uncoupled },
    Variant { belt: Belt::SideSum, tyre: Tyre::Uncoupled },
    Variant { belt: Belt::Literal, tyre: Tyre::Combined },
    Variant { belt: Belt::SideSum, tyre: Tyre::Combined },
];

fn sets() -> [Parameters; 4] {
    let nose_heavy = Parameters { com_to_front_axle: 0.12, com_height: 0.3, ..Parameters::SET_B };
    [Parameters::SET_A, Parameters::SET_B, Parameters::SET_C, nose_heavy]
}

fn robot(p: &Parameters, variant: Variant) -> PaperRobot<f64> {
    PaperRobot::with_variant(p, variant).expect("a robot")
}

fn velocities(s: &State<f64>) -> [f64; 5] {
    [s.vx, s.vy, s.yaw_rate, s.speed[0], s.speed[1]]
}

/// The classical scheme over the rate as it reads, all ten numbers of the state alike.
fn plain_rk4(robot: &PaperRobot<f64>, s: &State<f64>, torque: [f64; 2], h: f64) -> State<f64> {
    let at = s.to_array();
    let rate = |x: [f64; 10]| robot.rate(&State::from_array(x), torque).to_array();
    let moved = |k: [f64; 10], h: f64| std::array::from_fn(|i| at[i] + h * k[i]);
    let k1 = rate(at);
    let k2 = rate(moved(k1, 0.5 * h));
    let k3 = rate(moved(k2, 0.5 * h));
    let k4 = rate(moved(k3, h));
    State::from_array(std::array::from_fn(|i| at[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i])))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn the_fast_plant_is_the_plant(
        set in 0..4_usize,
        variant in 0..4_usize,
        yaw in -7.0..7.0_f64,
        body in prop::array::uniform3(-2.0..2.0_f64),
        wheels in prop::array::uniform2(-25.0..25.0_f64),
        torque in prop::array::uniform2(-30.0..30.0_f64),
        slowness in 0..4_i32,
    ) {
        let robot = robot(&sets()[set], VARIANTS[variant]);
        let slow = 0.1_f64.powi(slowness);
        let s = State {
            x: 1.0, y: -2.0, yaw,
            vx: slow * body[0], vy: slow * body[1], yaw_rate: slow * body[2],
            angle: [3.0, 4.0], speed: wheels.map(|w| slow * w),
        };
        let (wanted, out) = robot.evaluate(&s, torque);
        prop_assert_eq!(robot.loads(&s), out.load);
        let found = robot.accelerations(&velocities(&s), torque);
        // Traction and torque cancel in the wheels: rounding is relative to what is subtracted.
        let size = velocities(&wanted).iter().fold(1.0 / robot.parameters().wheel_inertia, |m, a| a.abs().max(m));
        for (f, w) in found.iter().zip(velocities(&wanted)) {
            prop_assert!((f - w).abs() <= 1e-11 * size, "{:?} {:?}", found, wanted);
        }
        let mut stepped = s;
        robot.step_rk4(&mut stepped, torque, 5e-5);
        for (f, w) in stepped.to_array().iter().zip(plain_rk4(&robot, &s, torque, 5e-5).to_array()) {
            prop_assert!((f - w).abs() <= 1e-13 * w.abs().max(1.0) + 1e-12 * size * 5e-5, "{:?} {:?}", stepped, s);
        }
    }
}

/// Four robots that differ, and the same side by side.
#[test]
fn every_lane_of_a_step_has_the_bits_of_a_robot_of_its_own() {
    for variant in VARIANTS {
        let alone = robot(&Parameters::SET_B, variant);
        let wide = PaperRobot::<Lanes<4>>::with_variant(&Parameters::SET_B, variant).expect("a robot");
        for implicit in [false, true] {
            let start =
                |i: usize| State { yaw: i as f64, vx: 0.1 * i as f64, speed: [i as f64, 2.0], ..State::default() };
            let torque = |i: usize| [1.0 + i as f64, -0.5 * i as f64];
            let columns: [[f64; 10]; 4] = std::array::from_fn(|i| start(i).to_array());
            let mut all = State::from_array(std::array::from_fn(|j| Lanes(columns.map(|c| c[j]))));
            let held = [0, 1].map(|j| Lanes(std::array::from_fn(|i| torque(i)[j])));
            let mut each: [State<f64>; 4] = std::array::from_fn(start);
            for _ in 0..300 {
                if implicit {
                    wide.step_implicit(&mut all, held, Lanes([1e-3; 4]));
                    (0..4).for_each(|i| alone.step_implicit(&mut each[i], torque(i), 1e-3));
                } else {
                    wide.step_rk4(&mut all, held, Lanes([1e-4; 4]));
                    (0..4).for_each(|i| alone.step_rk4(&mut each[i], torque(i), 1e-4));
                }
            }
            for (i, one) in each.iter().enumerate() {
                assert!(one.vx.is_finite() && one.vx != 0.0);
                let lane = all.to_array().map(|x| x.0[i].to_bits());
                assert_eq!(lane, one.to_array().map(f64::to_bits), "{variant:?} {i} {implicit}");
            }
        }
    }
}

/// The robot of 20 kg that drives and stops.
const DRIVEN: Parameters = Parameters {
    mass: 20.0,
    yaw_inertia: 0.9,
    wheel_radius: 0.0965,
    wheelbase: 0.35,
    track: 0.43,
    com_height: 0.12,
    com_to_front_axle: 0.175,
    wheel_inertia: 0.03,
    coulomb_torque: 0.15,
    adhesion: 0.6,
    slip_at_peak: 0.2,
    rolling_resistance: 0.02,
    gravity: 9.81,
    slip_floor: 0.15,
    sign_width: 0.3,
};

type Stepper = fn(&PaperRobot<f64>, &mut State<f64>, [f64; 2], f64);
const RK4: Stepper = |r, s, u, h| r.step_rk4(s, u, h);
const ROS2: Stepper = |r, s, u, h| r.step_implicit(s, u, h);

/// Distance of two states: velocities and pose.
fn apart(a: &State<f64>, b: &State<f64>) -> f64 {
    a.to_array().iter().zip(b.to_array()).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

#[test]
fn errors_fall_with_the_order_when_the_step_is_halved() {
    for variant in VARIANTS {
        let robot = robot(&DRIVEN, variant);
        for (scheme, h, order) in [(RK4, 2e-3, 4.0), (ROS2, 2e-3, 2.0)] {
            // Driven hard, so that no wheel changes over from driving to being dragged: the law has a kink there.
            let start = State { yaw: 0.5, vx: 0.8, yaw_rate: 0.05, speed: [10.0, 10.2], ..State::default() };
            let end = |halvings: i32| {
                let (mut s, h, n) = (start, h / 2.0_f64.powi(halvings), ((0.08 / h).round() as usize) << halvings);
                (0..n).for_each(|_| scheme(&robot, &mut s, [6.0, 6.5], h));
                s
            };
            // One step of h against two of h/2, twice.
            let ends = [0, 1, 2].map(end);
            let found = (apart(&ends[0], &ends[1]) / apart(&ends[1], &ends[2])).log2();
            assert!((found - order).abs() < 0.35, "{variant:?}: order {found} instead of {order}");
        }
    }
}

/// Five seconds of driving, turning and braking to rest in each second, held torques every millisecond.
fn stop_and_go(robot: &PaperRobot<f64>, scheme: Stepper, substeps: usize) -> State<f64> {
    let mut s = State::default();
    for k in 0..5000_u32 {
        let t = f64::from(k) * 1e-3;
        let turn = 1.5 * (1.3 * t).sin();
        let drive = if k % 1000 < 500 { [2.2 - turn, 2.2 + turn] } else { [0.0; 2] };
        let brake = if k % 1000 < 500 { 0.12 } else { 1.0 };
        let torque = [0, 1].map(|i| drive[i] - brake * s.speed[i]);
        (0..substeps).for_each(|_| scheme(robot, &mut s, torque, 1e-3 / substeps as f64));
    }
    s
}

fn missed(a: &State<f64>, b: &State<f64>) -> f64 {
    ((a.x - b.x).powi(2) + (a.y - b.y).powi(2)).sqrt()
}

#[test]
fn the_implicit_step_follows_stops_where_slip_is_stiff() {
    let robot = robot(&Parameters { slip_floor: 0.02, sign_width: 0.05, ..DRIVEN }, VARIANTS[1]);
    let truth = stop_and_go(&robot, RK4, 200);
    assert!(missed(&truth, &State::default()) > 0.3, "it has gone somewhere: {truth:?}");
    let (one, two) = (missed(&stop_and_go(&robot, ROS2, 1), &truth), missed(&stop_and_go(&robot, ROS2, 2), &truth));
    assert!(one < 1e-4 && two < 0.5 * one, "{one:e} m, {two:e} m with half the step");
}

#[test]
fn the_implicit_step_damps_what_the_explicit_one_cannot() {
    // Four times as stiff at rest.
    let stiff = Parameters { slip_floor: 0.005, sign_width: 0.05, ..DRIVEN };
    let robot = robot(&stiff, VARIANTS[1]);
    let truth = stop_and_go(&robot, RK4, 200);
    let (implicit, explicit) = (stop_and_go(&robot, ROS2, 1), stop_and_go(&robot, RK4, 1));
    let (good, bad) = (missed(&implicit, &truth), missed(&explicit, &truth));
    assert!(good < 3e-4, "implicit {good:e} m");
    assert!(bad.is_nan() || bad > 3.0 * good, "explicit {bad:e} m, implicit {good:e} m");
}
