//! Times of the paper's pieces: plant, controller, identifier, one whole draw.

use std::hint::black_box;

use controller::{Gains, Loop, LoopPath, PathReference, Tracking, WheelState};
use criterion::{Criterion, criterion_group, criterion_main};
use identifier::{Identifier, Midpoint};
use nn_basis::{Activation, Basis, SigmoidLayer};
use robot_model::paper::{PaperRobot, Parameters, State};
use sim::{Experiment, Recipe, RobotSet, rk4};

fn layer<const I: usize, const N: usize>() -> SigmoidLayer<f64, I, N> {
    let weight = std::array::from_fn(|j| std::array::from_fn(|i| 0.3 - 0.1 * (i + j) as f64));
    SigmoidLayer::new([0.1; N], weight, [5.0; I], Activation::Logistic).expect("valid")
}

fn plant(c: &mut Criterion) {
    let robot = PaperRobot::<f64>::new(&Parameters::SET_B).expect("valid");
    let state = State { vx: 0.5, vy: 0.01, yaw_rate: 0.3, speed: [4.0, 6.0], ..State::default() };
    c.bench_function("plant rate", |b| {
        b.iter(|| robot.rate(black_box(&state), black_box([-10.0, 12.0])));
    });
    let numbers = state.to_array();
    c.bench_function("plant step (one RK4 substep)", |b| {
        b.iter(|| rk4(black_box(&numbers), 5e-5, |s| robot.rate(&State::from_array(*s), [-10.0, 12.0]).to_array()));
    });
}

fn controller_step(c: &mut Criterion) {
    let path = LoopPath::new(&Loop::default()).expect("valid");
    let gains = Gains::for_robot(&Parameters::SET_B, 100.0);
    let mut controller = Tracking::<f64, _, 8>::new(&gains, layer::<4, 8>(), PathReference::new(path)).expect("valid");
    let state = WheelState { x: 0.1, y: 0.0, yaw: 0.0, angle: [1.0; 2], speed: [4.0, 6.0] };
    c.bench_function("controller step", |b| {
        b.iter(|| controller.step(black_box(&state), 1e-3));
    });
}

fn identifier_step(c: &mut Criterion) {
    let basis = layer::<4, 6>();
    let input = [4.0, 6.0, -10.0, 12.0];
    let phi = basis.regressor(&input);
    c.bench_function("regressor (6 logistic units)", |b| {
        b.iter(|| basis.regressor(black_box(&input)));
    });
    let mut identifier = Identifier::new(8.0, Midpoint::new(500.0).expect("valid"), 4.0).expect("valid");
    c.bench_function("identifier step", |b| {
        b.iter(|| identifier.step(black_box(4.0), black_box(4.001), black_box(&phi), 1e-3));
    });
    let step = identifier.step(4.0, 4.001, &phi, 1e-3);
    c.bench_function("certificate of a step", |b| {
        b.iter(|| identifier.certificate(black_box(&step), &[1.0; 6]));
    });
}

fn experiment(c: &mut Criterion) {
    let mut group = c.benchmark_group("experiment");
    group.sample_size(10);
    let recipe = Recipe::default();
    group.bench_function("robot, 32 s", |b| {
        b.iter(|| Experiment::new(&recipe, RobotSet::B));
    });
    let experiment = Experiment::new(&recipe, RobotSet::B).expect("runs");
    group.bench_function("one draw, 32 s, two wheels", |b| {
        b.iter(|| experiment.identify(1, black_box(0)));
    });
    group.finish();
}

criterion_group!(benches, plant, controller_step, identifier_step, experiment);
criterion_main!(benches);
