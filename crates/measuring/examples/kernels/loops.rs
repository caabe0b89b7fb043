//! The loops that are timed.

use std::hint::black_box;

use controller::WheelState;
use identifier::{AngleRow, Euler, Identifier};
use nn_basis::{Basis, SigmoidLayer};
use pulp::NullaryFnOnce;
use robot_model::paper::{PaperRobot, State};
use robot_model::{Lanes, Scalar, real};
use sim::{Experiment, Recipe, RobotSet};

use crate::Length;
use crate::clock::{Clock, median};
use crate::fixture::{self, LANES, Scheme, TORQUES, advance, layer, robot, torques, tracking};

type Wide = Lanes<LANES>;
type Figure = (f64, &'static str);

/// Times `run`, which makes so many steps of so many robots.
fn timed(length: Length, steps: usize, loops: usize, robots: usize, mut run: impl FnMut(usize)) -> Figure {
    let (steps, loops) = length.or(steps, loops);
    let one = |_| {
        let clock = Clock::start();
        run(steps);
        clock.seconds() / (steps * robots) as f64 * 1e9
    };
    (median((0..loops).map(one).collect()), "ns/step")
}

/// A loop that is compiled for every vector unit that the machine may have.
struct Wider<F: FnOnce()>(F);

impl<F: FnOnce()> NullaryFnOnce for Wider<F> {
    type Output = ();
    #[inline(always)]
    fn call(self) {
        (self.0)();
    }
}

/// Identifiers of both wheel speeds and the two rows of their angles.
#[derive(Clone, Copy)]
struct Four<T> {
    layers: [SigmoidLayer<T, 6, 6>; 2],
    speeds: [Identifier<T, 6, Euler<T>>; 2],
    angles: [AngleRow<T>; 2],
}

impl<T: Scalar> Four<T> {
    fn new(scale: [f64; 6]) -> Self {
        let (pole, law) = (real(8.0), Euler::new(real(500.0)).expect("a gain"));
        Self {
            layers: [layer(1.0, scale), layer(50.0, scale)],
            speeds: [Identifier::new(pole, law, T::zero()).expect("a pole"); 2],
            angles: [AngleRow::new(pole, T::zero()).expect("a pole"); 2],
        }
    }

    /// `x`: both angles, both speeds, both torques, now and a step later.
    #[inline(always)]
    fn step(&mut self, x: &[T; 6], next: &[T; 6]) {
        let h = real(1e-3);
        for i in 0..2 {
            let phi = self.layers[i].regressor(x);
            self.speeds[i].step(x[2 + i], next[2 + i], &phi, h);
            self.angles[i].step(x[i], next[i], x[2 + i], h);
        }
    }
}

/// Recorded signals, repeated.
fn signals() -> Vec<[f64; 6]> {
    let of = |k: u32| {
        let p = f64::from(k) * 0.02;
        [p.sin(), p.cos(), 2.0 * (0.3 * p).sin(), 2.0 * (0.37 * p).cos(), (1.7 * p).sin(), (1.3 * p).cos()]
    };
    (0..4096).map(of).collect()
}

pub(crate) fn ident_scalar(length: Length) -> Figure {
    let signals = signals();
    timed(length, 320_000, 9, 1, |steps| {
        let mut four = Four::<f64>::new([1.0; 6]);
        for k in 0..steps {
            four.step(&signals[k & 4095], &signals[(k + 1) & 4095]);
        }
        black_box(four.speeds[1].model().output);
    })
}

pub(crate) fn ident_lanes(length: Length) -> Figure {
    let signals: Vec<[Wide; 6]> = signals()[..64].iter().map(|s| s.map(real)).collect();
    timed(length, 6400, 9, 32 * LANES, |steps| {
        let mut all = vec![Four::<Wide>::new([1.0; 6]); 32];
        pulp::Arch::new().dispatch(Wider(
            #[inline(always)]
            || {
                for k in 0..steps {
                    for (b, four) in all.iter_mut().enumerate() {
                        four.step(&signals[(k + b) & 63], &signals[(k + b + 1) & 63]);
                    }
                }
            },
        ));
        black_box(all[3].speeds[1].model().output);
    })
}

pub(crate) fn plant_scalar(length: Length, scheme: Scheme) -> Figure {
    let torques = torques();
    timed(length, 100_000, 7, 1, |steps| {
        let robot = robot::<f64>(20.0);
        let mut s = State::default();
        for k in 0..steps {
            advance(&robot, &mut s, torques[(k / 10) % TORQUES], scheme);
        }
        black_box(s);
    })
}

pub(crate) fn plant_lanes(length: Length, scheme: Scheme) -> Figure {
    let torques = torques();
    let robots: Vec<PaperRobot<Wide>> = (0..8).map(|b| robot(20.0 + 0.1 * f64::from(b))).collect();
    timed(length, 6000, 7, robots.len() * LANES, |steps| {
        let mut states = [State::<Wide>::default(); 8];
        pulp::Arch::new().dispatch(Wider(
            #[inline(always)]
            || {
                for (robot, state) in robots.iter().zip(&mut states) {
                    let mut s = *state;
                    for k in 0..steps {
                        advance(robot, &mut s, torques[(k / 10) % TORQUES], scheme);
                    }
                    *state = s;
                }
            },
        ));
        black_box(states);
    })
}

fn controlled<T: Scalar>(steps: usize) -> T {
    let mut controller = tracking::<T>();
    let mut sum = T::zero();
    controlled_by(&mut controller, steps, &mut sum);
    sum
}

#[inline(always)]
fn controlled_by<T: Scalar>(
    controller: &mut controller::Tracking<T, SigmoidLayer<T, 4, 8>, 8>,
    steps: usize,
    sum: &mut T,
) {
    let mut state =
        WheelState { x: T::zero(), y: T::zero(), yaw: T::zero(), angle: [T::zero(); 2], speed: [T::zero(); 2] };
    for _ in 0..steps {
        let action = controller.step(&state, real(1e-3));
        // A robot that does what it is told.
        let reference = action.reference;
        state = WheelState {
            x: reference.x,
            y: reference.y,
            yaw: reference.yaw,
            angle: [0, 1].map(|i| state.angle[i] + real::<T>(1e-3) * action.desired_speed[i]),
            speed: action.desired_speed,
        };
        *sum += action.torque[0];
    }
}

pub(crate) fn controller_scalar(length: Length) -> Figure {
    timed(length, 100_000, 7, 1, |steps| {
        black_box(controlled::<f64>(steps));
    })
}

pub(crate) fn controller_lanes(length: Length) -> Figure {
    timed(length, 32_000, 7, LANES, |steps| {
        let mut controller = tracking::<Wide>();
        let mut sum = Wide::zero();
        pulp::Arch::new().dispatch(Wider(
            #[inline(always)]
            || controlled_by(&mut controller, steps, &mut sum),
        ));
        black_box(sum);
    })
}

/// Path, controller, plant and identifier, one after the other in each step.
pub(crate) fn seedloop(length: Length, substeps: usize) -> Option<Figure> {
    if substeps == 0 {
        return None;
    }
    let (steps, loops) = length.or(32_000, 9);
    let one = |_| {
        let clock = Clock::start();
        black_box(seed(steps, substeps));
        clock.seconds() * 1e3
    };
    Some((median((0..loops).map(one).collect()), "ms"))
}

fn seed(steps: usize, substeps: usize) -> [f64; 4] {
    let nominal = robot::<f64>(20.0);
    let disturbed = nominal.with_rolling_resistance(fixture::PARAMETERS.rolling_resistance + 0.3).expect("a robot");
    let (mut controller, mut four) = (tracking::<f64>(), Four::new([100.0, 100.0, 10.0, 10.0, 5.0, 5.0]));
    let (mut s, mut squares, mut largest) = (State::<f64>::default(), 0.0, 0.0_f64);
    let h = 1e-3 / substeps as f64;
    for k in 0..steps {
        let robot = if k < 12_000 { &nominal } else { &disturbed };
        let seen = WheelState { x: s.x, y: s.y, yaw: s.yaw, angle: s.angle, speed: s.speed };
        let torque = controller.step(&seen, 1e-3).torque;
        let held = [0, 1].map(|i| torque[i] - fixture::VISCOUS * s.speed[i]);
        robot.steps_rk4(&mut s, held, h, substeps);
        let now = [seen.angle[0], seen.angle[1], seen.speed[0], seen.speed[1], torque[0], torque[1]];
        let next = [s.angle[0], s.angle[1], s.speed[0], s.speed[1], torque[0], torque[1]];
        four.step(&now, &next);
        let error = s.speed[0] - four.speeds[0].model().output;
        squares += error * error;
        largest = largest.max(error.abs());
    }
    [s.x, s.yaw, squares, largest]
}

/// The reproduction's draws over one trajectory.
pub(crate) fn ensemble(length: Length, draws: u64) -> Option<Figure> {
    let draws = length.steps.map_or(draws, |n| n as u64);
    let experiment = Experiment::new(&Recipe::default(), RobotSet::B).ok()?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().ok()?;
    let seconds = pool.install(|| {
        let clock = Clock::start();
        black_box(experiment.ensemble(1, draws, || {}).ok()?);
        Some(clock.seconds())
    })?;
    Some((seconds, "s"))
}
