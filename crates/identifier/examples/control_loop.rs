//! The identifier as it runs on a robot: single precision, 1 kHz, fed from an iterator of measurements, nothing allocated.
//!
//! [`run`] is what a firmware would call: its sizes are fixed, its work per sample is the same whatever is measured, and it
//! never panics. `main` plays the robot.

use identifier::{Identifier, IdentifierError, Memory, MemorySettings, Midpoint, Retaining, Sample};
use nn_basis::{Activation, Basis, SigmoidLayer};

/// What a wheel's controller knows every millisecond.
#[derive(Debug, Clone, Copy)]
struct Measurement {
    /// Wheel speed, rad/s.
    speed: f32,
    /// Torque held over the millisecond that follows, N m.
    torque: f32,
}

/// What is reported after each millisecond.
#[derive(Debug, Clone, Copy)]
struct Report {
    /// Estimated wheel speed, rad/s.
    estimate: f32,
    /// Residual of the Lyapunov balance: larger than rounding means that the numbers cannot be trusted.
    residual: f32,
}

/// Pole a, 1/s.
const POLE: f32 = 8.0;
/// Gain γ.
const GAIN: f32 = 500.0;
/// Sampling period, s.
const PERIOD: f32 = 1e-3;

/// Follows measurements; a report for each interval between two of them.
fn run<B: Basis<f32, 2, 6>>(
    basis: &B,
    measurements: impl Iterator<Item = Measurement>,
) -> Result<impl Iterator<Item = Report>, IdentifierError> {
    let memory = Memory::new(MemorySettings::default())?;
    let mut identifier = Retaining::<f32, 6>::new(POLE, Midpoint::new(GAIN)?, 0.0, memory)?;
    let mut last: Option<Measurement> = None;
    Ok(measurements.filter_map(move |now| {
        let before = last.replace(now)?;
        let mean = 0.5 * (before.speed + now.speed);
        let regressor = basis.regressor(&[mean, before.torque]);
        let sample = Sample { start: before.speed, end: now.speed, regressor, known: 0.0, h: PERIOD };
        let step = identifier.follow(&sample);
        let certificate = identifier.certificate(&step, &[0.0; 6]);
        Some(Report { estimate: step.after.output, residual: certificate.residual })
    }))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let weight = [[0.9, -0.2], [-0.5, 0.7], [0.1, 0.6], [-0.8, -0.3], [0.4, 0.4], [0.2, -0.9]];
    let layer = SigmoidLayer::new([-0.4, 0.3, 0.8, 0.1, -0.6, 0.5], weight, [10.0_f32, 5.0], Activation::Logistic)?;

    // The robot: an inertia of 0.25 kg m², friction, and a torque that steps every two seconds.
    let mut speed = 0.0_f32;
    let wheel = (0_u32..20_000).map(move |k| {
        let torque = if (k / 2000) % 2 == 0 { 2.0 } else { 1.0 };
        let measurement = Measurement { speed, torque };
        speed += PERIOD * (torque - 0.2 * speed - 0.5 * (speed / 0.05).tanh()) / 0.25;
        measurement
    });
    let truth: Vec<f32> = wheel.clone().skip(1).map(|m| m.speed).collect();

    let (mut worst, mut residual) = ([0.0_f32; 10], 0.0_f32);
    for (k, report) in run(&layer, wheel)?.enumerate() {
        let error = (truth[k] - report.estimate).abs();
        worst[k / 2000] = worst[k / 2000].max(error);
        residual = residual.max(report.residual);
    }
    for (i, worst) in worst.iter().enumerate() {
        println!("{:2} s to {:2} s: largest error {worst:.4} rad/s", 2 * i, 2 * i + 2);
    }
    println!("largest residual of the Lyapunov balance {residual:.1e}");
    println!("state of the identifier: {} bytes", std::mem::size_of::<Retaining<f32, 6>>());
    println!("state without memory: {} bytes", std::mem::size_of::<Identifier<f32, 6>>());
    Ok(())
}
