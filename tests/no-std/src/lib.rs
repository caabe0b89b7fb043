//! A control loop as it would run on a robot: plant, controller and identifier in single precision,
//! without the standard library and without an allocator.
//!
//! A static library is a final product: if any crate below asked for `alloc`, rustc would refuse to build it
//! ("no global memory allocator found"), and if any asked for `std`, the panic handler would be defined twice.
#![no_std]

use core::panic::PanicInfo;

use controller::{Gains, Loop, LoopPath, PathReference, Tracking, WheelState};
use identifier::{
    CoupledIdentifier, CoupledSample, Euler, Exponential, HurwitzMatrix, Identifier, Law, Leaky, Memory,
    MemorySettings, Midpoint, Projection, Rate, Retaining, Sample,
};
use nn_basis::{Activation, Basis, LinearNet, SigmoidLayer};
use robot_model::paper::{self, PaperRobot, Parameters};
use robot_model::wheels;
use robot_model::{Active, Lanes, Plant, Presence, Robot, Scalar, State, effects};

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    loop {}
}

/// Kept by the linker, so that nothing below is thrown away.
#[used]
static KEPT: [extern "C" fn(f32) -> f32; 9] =
    [plant, any_wheels, paper_plant, side_by_side, identify, every_law, remember, coupled, control];

/// One step of the plant with every effect of the catalogue at its neutral value.
extern "C" fn plant(torque: f32) -> f32 {
    let Ok(robot) = Robot::<f32>::from(&Parameters::SET_B).checked() else { return f32::NAN };
    let all = effects::catalogue::<f32>().map(|e| Active::new(e, &[], Presence::default()));
    let plant = Plant::new(&robot, &all, 1e-3);
    let mut state = State::default();
    plant.step(&mut state, [torque; 2]);
    plant.step_at_speed(&mut state, [torque; 2], [0.0; 2]);
    let mut readings = plant.readings(&state);
    plant.sense(&mut readings);
    readings.velocity[0] + readings.torque[0]
}

/// One step of a robot of any wheels: one steered and driven, one with rollers, one caster.
extern "C" fn any_wheels(torque: f32) -> f32 {
    let place = [torque, 0.0];
    let driven = wheels::Wheel {
        place,
        direction: 0.0,
        roller: None,
        radius: 0.1,
        inertia: 0.01,
        motor: Some(0),
        joint: Some(0),
    };
    let mut robot = wheels::Robot {
        mass: 10.0,
        yaw_inertia: 1.0,
        com: [0.0; 3],
        wheels: [None; wheels::MOST],
        casters: [Some(wheels::Caster { pivot: place, trail: 0.1, rolling: 0.0, pivot_friction: 0.1 });
            wheels::MOST_CASTERS],
        motors: [None; wheels::MOST],
        joints: [None; wheels::MOST],
        drag: 0.0,
        ground: wheels::Ground::usual(),
    };
    robot.wheels[0] = Some(driven);
    robot.wheels[1] = Some(wheels::Wheel { roller: Some(torque), motor: Some(1), joint: None, ..driven });
    robot.motors = [Some(wheels::Motor {
        coupling: wheels::Coupling::Differential,
        inertia: 0.01,
        gain: 1.0,
        lag: 0.1,
        coulomb: 0.1,
        viscous: 0.1,
    }); wheels::MOST];
    robot.joints[0] = Some(wheels::Joint { place, about: 0.0, offset: 0.0, gain: 1.0, lag: 0.1 });
    let plant = wheels::Plant::new(&robot, 5e-3);
    let mut state = wheels::State::default();
    plant.set_velocity(&mut state, [torque; 2]);
    plant.settle(&mut state, &[torque; wheels::MOST], &[torque; wheels::MOST]);
    plant.step(&mut state, &[torque; wheels::MOST], &[torque; wheels::MOST]);
    plant.velocity_of(&state, place)[0] + plant.place_of(&state, place)[1]
}

/// The rate of the paper's robot, and a step by each scheme.
extern "C" fn paper_plant(torque: f32) -> f32 {
    let Ok(robot) = PaperRobot::<f32>::new(&Parameters::SET_B) else { return f32::NAN };
    let mut state = paper::State::default();
    robot.step_rk4(&mut state, [torque; 2], 1e-4);
    robot.step_implicit(&mut state, [torque; 2], 1e-3);
    robot.rate(&state, [torque; 2]).speed[0]
}

/// Two robots in double precision side by side.
extern "C" fn side_by_side(torque: f32) -> f32 {
    let Ok(robot) = PaperRobot::<Lanes<2>>::new(&Parameters::SET_B) else { return f32::NAN };
    let mut state = paper::State::default();
    let torque = Lanes([f64::from(torque), 1.0]);
    robot.step_rk4(&mut state, [torque; 2], Lanes([1e-4; 2]));
    robot.step_implicit(&mut state, [torque; 2], Lanes([1e-3; 2]));
    state.x.exp_m1().exp().logistic().0[1] as f32
}

/// One step of the identifier on a sigmoid basis, with its certificate.
extern "C" fn identify(x: f32) -> f32 {
    let (Ok(layer), Ok(law)) = (layer::<2>(), Midpoint::new(500.0)) else { return f32::NAN };
    let phi = layer.regressor(&[x; 2]);
    let mut net = LinearNet::<f32, 4, 1>::default();
    net.adapt(0, &phi, 0.1, 0.0);
    let Ok(mut identifier) = Identifier::new(8.0, law, x) else { return f32::NAN };
    let step = identifier.step(x, x + 1e-3, &phi, 1e-3);
    identifier.certificate(&step, &[0.0; 4]).residual + net.output(&phi)[0]
}

/// One step of a law on a constant regressor, with its certificate.
fn step<L: Law<f32, 2>>(law: L, x: f32) -> f32 {
    let Ok(mut identifier) = Identifier::new(8.0, law, x) else { return f32::NAN };
    let step = identifier.step(x, x + 1e-3, &[0.5; 2], 1e-3);
    identifier.certificate(&step, &[1.0; 2]).residual
}

/// One step of each adaptive law.
extern "C" fn every_law(x: f32) -> f32 {
    let (Ok(euler), Ok(midpoint), Ok(dead)) =
        (Euler::new(500.0), Midpoint::new(500.0), Exponential::with_dead_zone(500.0, 0.1))
    else {
        return f32::NAN;
    };
    let (Ok(ball), Ok(sigma), Ok(error)) =
        (Projection::new(dead, 40.0), Leaky::new(midpoint, Rate::Sigma(1e-3)), Leaky::new(dead, Rate::Error(1e-2)))
    else {
        return f32::NAN;
    };
    step(euler, x) + step(dead, x) + step(ball, x) + step(sigma, x) + step(error, x)
}

/// One step of the identifier with a memory.
extern "C" fn remember(x: f32) -> f32 {
    let (Ok(law), Ok(memory)) = (Midpoint::new(500.0), Memory::new(MemorySettings::default())) else { return f32::NAN };
    let Ok(mut identifier) = Retaining::<f32, 6>::new(8.0, law, x, memory) else { return f32::NAN };
    let sample = Sample { start: x, end: x + 1e-3, regressor: [0.5; 6], known: 0.0, h: 1e-3 };
    identifier.follow(&sample).error_after + identifier.weight()[0] + identifier.memory().kept()[5]
}

/// One step with a general A, whose P a host has computed.
extern "C" fn coupled(x: f32) -> f32 {
    let Ok(matrix) = HurwitzMatrix::new([[-1.0, 10.0], [0.0, -1.0]], [[0.5, 2.5], [2.5, 25.5]]) else {
        return f32::NAN;
    };
    let Ok(mut identifier) = CoupledIdentifier::<f32, 2, 3>::new(matrix, 500.0, [x; 2]) else { return f32::NAN };
    let sample = CoupledSample { start: [x; 2], end: [x + 1e-3; 2], regressor: [0.5; 3], known: [0.0; 2], h: 1e-3 };
    identifier.follow(&sample)[0]
}

/// One step of the tracking controller.
extern "C" fn control(speed: f32) -> f32 {
    let (Ok(layer), Ok(path)) = (layer::<4>(), LoopPath::new(&Loop::default())) else { return f32::NAN };
    let gains = Gains::for_robot(&Parameters::SET_B, 100.0);
    let reference = PathReference::new(path);
    let Ok(mut controller) = Tracking::<f32, _, 4>::new(&gains, layer, reference) else { return f32::NAN };
    let measured = WheelState { x: 0.0, y: 0.0, yaw: 0.0, angle: [0.0; 2], speed: [speed; 2] };
    controller.step(&measured, 1e-3).torque[0]
}

fn layer<const I: usize>() -> Result<SigmoidLayer<f32, I, 4>, nn_basis::BasisError> {
    SigmoidLayer::new([0.1, 0.2, 0.3, 0.4], [[0.5; I]; 4], [1.0; I], Activation::Logistic)
}
