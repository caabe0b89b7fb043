//! The plants run on dual numbers, and what comes out are their derivatives.

use num_dual::{Dual2_64, Dual32, Dual64, DualSVec64, HyperDual64};
use robot_model::paper::{self, PaperRobot, Parameters};
use robot_model::tunable::tunables;
use robot_model::{Active, Plant, Presence, Robot, Scalar, State, effects, real};

fn is_scalar<T: Scalar>() {}

#[test]
fn dual_numbers_of_every_kind_are_scalars() {
    is_scalar::<Dual64>();
    is_scalar::<Dual32>();
    is_scalar::<DualSVec64<4>>();
    is_scalar::<Dual2_64>();
    is_scalar::<HyperDual64>();
}

/// Largest difference of `exact` from the central difference of `f` about zero, relative to the largest derivative.
fn error<const N: usize>(exact: [Dual64; N], step: f64, f: impl Fn(f64) -> [f64; N]) -> f64 {
    let (up, down) = (f(step), f(-step));
    let largest = exact.iter().map(|x| x.eps.abs()).fold(1e-6, f64::max);
    let mut worst = 0.0_f64;
    for ((u, d), x) in up.iter().zip(down).zip(exact) {
        assert!(x.re.is_finite() && x.eps.is_finite());
        worst = worst.max(((u - d) / (2.0 * step) - x.eps).abs());
    }
    worst / largest
}

/// States of the paper's robot: driving, turning, sliding, and slow.
const PAPER_STATES: [[f64; 10]; 3] = [
    [0.1, 0.2, 0.3, 0.50, 0.01, 0.30, 1.0, 2.0, 4.5, 6.0],
    [0.0, 0.0, 2.0, -0.30, 0.20, -1.5, 0.0, 0.0, 5.0, -3.0],
    [0.0, 0.0, 0.0, 0.01, 0.00, 0.02, 0.0, 0.0, 0.12, 0.05],
];

/// Rate of the paper's robot with entry `i` (ten of the state, two torques) moved by `by`.
fn paper_rate<T: Scalar>(state: [f64; 10], i: usize, by: T) -> [T; 10] {
    let robot = PaperRobot::<T>::new(&Parameters::SET_B).expect("a robot");
    let (mut x, mut torque) = (state.map(real::<T>), [real::<T>(-2.0), real(5.0)]);
    if i < 10 {
        x[i] += by;
    } else {
        torque[i - 10] += by;
    }
    robot.rate(&paper::State::from_array(x), torque).to_array()
}

#[test]
fn the_papers_plant_gives_its_jacobian() {
    for state in PAPER_STATES {
        for i in 0..12 {
            let exact = paper_rate(state, i, Dual64::new(0.0, 1.0));
            let e = error(exact, 1e-6, |by| paper_rate(state, i, by));
            assert!(e < 1e-6, "entry {i} of {state:?}: {e:e}");
        }
    }
}

/// Everything that the run below may be differentiated by.
#[derive(Debug, Clone, Copy)]
enum By {
    /// A tunable constant of the robot.
    Constant(usize),
    /// An entry of the initial state: forward, sideways, yaw rate, wheel speed.
    Start(usize),
    /// The torque command of a side.
    Command(usize),
    /// The strength of the viscous friction.
    Effect,
}

/// Half a second of a turning robot with an effect: pose, velocity, wheel speeds and gyro.
fn end<T: Scalar>(by: By, d: T) -> [T; 8] {
    let mut robot = Robot::<T>::from(&Parameters::SET_B);
    robot.drive.lag = real(0.02);
    robot.stribeck = real(0.05);
    robot.sliding_share = real(0.5);
    let (mut start, mut command, mut strength) = (State::<T>::default(), [real::<T>(2.5), real(4.0)], real::<T>(0.05));
    let mut velocity = [real::<T>(0.5), real(0.02)];
    start.yaw_rate = real(0.2);
    start.wheel_speed = [real(5.0), real(5.5)];
    start.passive = start.wheel_speed;
    match by {
        By::Constant(i) => (tunables::<T>()[i].apply)(&mut robot, d),
        By::Start(2) => start.yaw_rate += d,
        By::Start(3) => {
            start.wheel_speed[0] += d;
            start.passive[0] += d;
        }
        By::Start(i) => velocity[i] += d,
        By::Command(j) => command[j] += d,
        By::Effect => strength += d,
    }
    let active = [Active::new(&effects::viscous_friction::Law, &[strength], Presence::default())];
    let plant = Plant::new(&robot, &active, real(1e-3));
    plant.set_velocity(&mut start, velocity);
    for _ in 0..500 {
        plant.step(&mut start, command);
    }
    let ([x, y], [c, s], [left, right]) = (start.position, start.heading, start.wheel_speed);
    let [vx, vy] = plant.velocity(&start);
    [x, y, s / c, vx, vy, plant.readings(&start).gyro, left, right]
}

#[test]
fn the_plant_gives_derivatives_by_constants_start_command_and_effect() {
    let constants = (0..robot_model::tunable::COUNT).map(By::Constant);
    let all = constants.chain((0..4).map(By::Start)).chain((0..2).map(By::Command)).chain([By::Effect]);
    for by in all {
        let e = error(end(by, Dual64::new(0.0, 1.0)), 1e-5, |d| end(by, d));
        assert!(e < 1e-5, "{by:?}: {e:e}");
    }
}

#[test]
fn a_dual_number_without_derivative_is_the_plain_plant() {
    let (plain, dual) = (end(By::Effect, 0.0_f64), end(By::Effect, Dual64::from_re(0.0)));
    for (p, d) in plain.into_iter().zip(dual) {
        // The two take exp and sin from different libraries.
        assert!((p - d.re).abs() <= 1e-12 * p.abs().max(1.0));
        assert_eq!(d.eps, 0.0);
    }
}

#[test]
fn second_derivatives_are_those_of_the_first() {
    let one = |d: Dual2_64| end(By::Command(0), d);
    let second = one(Dual2_64::new(0.0, 1.0, 0.0));
    let slope = |at: f64| end(By::Command(0), Dual64::new(at, 1.0));
    let (up, down) = (slope(1e-4), slope(-1e-4));
    for i in 0..second.len() {
        let wanted = (up[i].eps - down[i].eps) / 2e-4;
        assert!((second[i].v2 - wanted).abs() < 1e-5 * wanted.abs().max(1.0), "{i}: {} {wanted}", second[i].v2);
    }
}
