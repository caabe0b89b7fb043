//! Learns `sin x` online with eight fixed logistic units and prints how the error falls.

use nn_basis::{Activation, Basis, LinearNet, SigmoidLayer};

fn main() -> Result<(), nn_basis::BasisError> {
    let threshold = core::array::from_fn(|j| 1.5 * (j as f64 - 3.5));
    let layer = SigmoidLayer::new(threshold, [[6.0]; 8], [3.0], Activation::Logistic)?;
    let mut net = LinearNet::<f64, 8, 1>::default();
    for pass in 0..6 {
        let mut squares = 0.0_f64;
        for k in 0..2000 {
            // Jump about, so that the net sees the whole range before it forgets.
            let x = -3.0 + 6.0 * f64::from(k * 617 % 2000) / 2000.0;
            let phi = layer.regressor(&[x]);
            let error = x.sin() - net.output(&phi)[0];
            net.adapt(0, &phi, 0.05 * error, 0.0);
            squares += error * error;
        }
        println!("pass {pass}: RMS error {:.4}", (squares / 2000.0).sqrt());
    }
    Ok(())
}
