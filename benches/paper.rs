//! Times of the paper's pieces: plant, controller, identifier by each law, one whole experiment, a thousand draws.

use std::hint::black_box;

use controller::{Gains, Loop, LoopPath, PathReference, Tracking, WheelState};
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use identifier::{
    CoupledIdentifier, CoupledSample, Euler, Exponential, HurwitzMatrix, Identifier, Law, Leaky, Memory,
    MemorySettings, Midpoint, Projection, Rate, Retaining, Sample,
};
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
    let mut group = c.benchmark_group("identifier step");
    law(&mut group, "forward Euler", &phi, Euler::new(500.0).expect("valid"));
    law(&mut group, "midpoint", &phi, Midpoint::new(500.0).expect("valid"));
    let exponential = Exponential::new(500.0).expect("valid");
    law(&mut group, "exponential", &phi, exponential);
    law(&mut group, "dead zone", &phi, Exponential::with_dead_zone(500.0, 0.1).expect("valid"));
    law(&mut group, "projection", &phi, Projection::new(exponential, 40.0).expect("valid"));
    let midpoint = Midpoint::new(500.0).expect("valid");
    law(&mut group, "sigma-modification", &phi, Leaky::new(midpoint, Rate::Sigma(1e-3)).expect("valid"));
    law(&mut group, "e-modification", &phi, Leaky::new(midpoint, Rate::Error(1e-2)).expect("valid"));

    let memory = Memory::new(MemorySettings::default()).expect("valid");
    let mut retaining = Retaining::new(8.0, midpoint, 4.0, memory).expect("valid");
    let sample = Sample { start: 4.0, end: 4.001, regressor: phi, known: 0.0, h: 1e-3 };
    group.bench_function("with memory", |b| b.iter(|| retaining.follow(black_box(&sample))));

    let matrix = HurwitzMatrix::new([[-1.0, 10.0], [0.0, -1.0]], [[0.5, 2.5], [2.5, 25.5]]).expect("proved");
    let mut coupled = CoupledIdentifier::<f64, 2, 6>::new(matrix, 500.0, [4.0; 2]).expect("valid");
    let sample = CoupledSample { start: [4.0; 2], end: [4.001; 2], regressor: phi, known: [0.0; 2], h: 1e-3 };
    group.bench_function("coupled, two outputs", |b| b.iter(|| coupled.follow(black_box(&sample))));

    let mut identifier = Identifier::new(8.0, midpoint, 4.0).expect("valid");
    let step = identifier.step(4.0, 4.001, &phi, 1e-3);
    group.bench_function("certificate", |b| b.iter(|| identifier.certificate(black_box(&step), &[1.0; 6])));
    group.finish();
}

fn law<L: Law<f64, 6>>(group: &mut BenchmarkGroup<WallTime>, name: &str, phi: &[f64; 6], law: L) {
    let mut identifier = Identifier::new(8.0, law, 4.0).expect("valid");
    group.bench_function(name, |b| b.iter(|| identifier.step(black_box(4.0), black_box(4.001), black_box(phi), 1e-3)));
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
    group.bench_function("whole experiment, 32 000 steps", |b| {
        b.iter(|| Experiment::new(&recipe, RobotSet::B).and_then(|e| e.identify(1, black_box(0))));
    });
    group.bench_function("ensemble of 1000 draws, all cores", |b| {
        b.iter(|| experiment.ensemble(1, 1000, || {}));
    });
    group.finish();
}

criterion_group!(benches, plant, controller_step, identifier_step, experiment);
criterion_main!(benches);
