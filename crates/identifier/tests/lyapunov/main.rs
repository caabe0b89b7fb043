//! What may be asserted of the adaptive laws, over wide ranges of step size, gain, regressor and weights, in double and
//! in single precision; and what must not be believed of forward Euler and of the pure gradient law.

mod bounds;
mod coupled;
mod euler;
mod identities;
mod memory;

use identifier::{Identifier, Law, Scalar};
use proptest::prelude::*;

const POLE: f64 = 8.0;
const UNITS: usize = 6;

type Weights = [f64; UNITS];

/// A regressor and the output at the end of its interval.
type Interval = (Weights, f64);

fn real<T: Scalar>(x: f64) -> T {
    T::real(x)
}

fn cast<T: Scalar>(v: &Weights) -> [T; UNITS] {
    v.map(real)
}

fn regressor() -> impl Strategy<Value = Weights> {
    prop::array::uniform6(-1.0..1.0_f64)
}

fn weights() -> impl Strategy<Value = Weights> {
    prop::array::uniform6(-50.0..50.0_f64)
}

fn intervals(most: usize) -> impl Strategy<Value = Vec<Interval>> {
    prop::collection::vec((regressor(), -10.0..10.0_f64), 2..most)
}

/// Uniform in the logarithm between two powers of ten.
fn decades(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.log10()..high.log10()).prop_map(|e| 10_f64.powf(e))
}

fn norm(v: &Weights) -> f64 {
    dot(v, v).sqrt()
}

fn dot(a: &Weights, b: &Weights) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn identifier<T: Scalar, L: Law<T, UNITS>>(law: L) -> Identifier<T, UNITS, L> {
    Identifier::new(real(POLE), law, T::zero()).expect("valid")
}

/// The next output of the system whose right-hand side over the interval is `force` by the midpoint rule.
fn midpoint_system(x: f64, force: f64, h: f64) -> f64 {
    ((1.0 - 0.5 * POLE * h) * x + h * force) / (1.0 + 0.5 * POLE * h)
}

/// The next output of the system whose right-hand side is `force` all through the interval, exactly.
fn exact_system(x: f64, force: f64, h: f64) -> f64 {
    let risen = -(-POLE * h).exp_m1();
    (1.0 - risen) * x + risen / POLE * force
}
