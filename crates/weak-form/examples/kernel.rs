//! How long the weak form of 13 signals takes: `cargo run --release -p weak-form --example kernel -- --rows 12000`.
//!
//! Prints the time on a processor for all rows, the median of several rounds. `--rounds 1` is for counting instructions.

use std::error::Error;
use std::hint::black_box;

use weak_form::{Shape, WeakForm, vector_unit};

#[path = "../../../benches/shared/clock.rs"]
mod clock;

const SIGNALS: usize = 13;

/// Made-up signals of some ten to a hundred hertz at 1 kHz.
fn signals(rows: usize) -> Vec<f64> {
    let one = |i: usize, j: usize| {
        let (t, k) = (i as f64, j as f64);
        (0.001 * (k + 1.3) * t + k).sin() + 0.1 * (0.0173 * (k + 2.0) * t).cos()
    };
    (0..rows).flat_map(|i| (0..SIGNALS).map(move |j| one(i, j))).collect()
}

fn main() -> Result<(), Box<dyn Error>> {
    let rows = clock::option("--rows", 12_000)?;
    let usual = if rows < 100_000 { 31 } else { 5 };
    let rounds = clock::option("--rounds", usual)?;
    let shape = Shape::new(SIGNALS, 49, 12, 4)?;
    let signals = signals(rows);
    let (seconds, gram) = clock::timed(rounds, || {
        let mut weak = WeakForm::new(shape);
        weak.push(black_box(&signals)).map(|()| weak.gram())
    });
    let gram = gram?;
    println!(
        "weakform.lacuna {:.4} ms   N {rows}, {:.2} ns/sample, {} windows, trace {:.9e}, vector unit: {}",
        1e3 * seconds,
        1e9 * seconds / rows as f64,
        gram.windows(),
        gram.trace(),
        vector_unit()
    );
    Ok(())
}
