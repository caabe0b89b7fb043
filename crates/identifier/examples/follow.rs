//! Follows a wheel speed that an unknown drive produces, and checks the certificate of every step.

use identifier::{Identifier, Ledger, Midpoint};
use nn_basis::{Activation, Basis, SigmoidLayer};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let layer =
        SigmoidLayer::new([-0.4, 0.3, 0.8], [[0.9, -0.2], [-0.5, 0.7], [0.1, 0.6]], [7.0, 3.0], Activation::Logistic)?;
    let mut identifier = Identifier::new(8.0, Midpoint::new(500.0)?, 0.0)?;
    let mut ledger = Ledger::new(8.0);
    let (h, mut speed, mut worst) = (1e-3, 0.0_f64, 0.0_f64);
    for k in 0..10_000 {
        let torque = if k < 5000 { 2.0 } else { 1.0 };
        // The unknown system: inertia 0.5 kg m², friction that grows with speed.
        let next = speed + h * (torque - 0.2 * speed - 0.02 * speed * speed) / 0.5;
        let phi = layer.regressor(&[speed, torque]);
        let step = identifier.step(speed, next, &phi, h);
        ledger.add(&identifier.certificate(&step, &[0.0; 3]));
        worst = worst.max(step.error_after.abs());
        speed = next;
    }
    println!("largest error {worst:.4} rad/s, weights {:.2?}", identifier.model().weight);
    println!("largest residual of the identity {:.1e}", ledger.worst_residual());
    println!("error energy {:.2e} <= bound {:.2e}: {}", ledger.error_energy(), ledger.bound(), ledger.holds());
    Ok(())
}
