//! The identifiers over the stretches of a recording, and what is certified of them.

use anyhow::Result;
use identifier::{AngleRow, Identifier, Ledger, Midpoint};
use nn_basis::{Basis, Constant};
use robot_model::Robot;
use sim::{Purpose, Recipe, SIGNALS, Stream, UNITS, comparison};

use super::samples::{Samples, Stretch};

/// Errors are also counted without the first second of each stretch, in which the weights grow from zero.
pub(super) const SETTLED: f64 = 1.0;
/// What a unit of the network is when its input says nothing: the regressor of the baseline.
const HALF: f64 = 0.5;

/// Comparison weights of a certificate, by what they are.
pub(super) const COMPARISONS: [&str; 3] = ["zero", "drawn at random", "learned in this run"];

type Weights = [[f64; UNITS]; 2];

/// Error indices of one output.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Indices {
    pub(super) max: f64,
    pub(super) max_at: f64,
    squares: f64,
    count: usize,
}

impl Indices {
    fn add(&mut self, time: f64, error: f64) {
        if error.abs() > self.max {
            (self.max, self.max_at) = (error.abs(), time);
        }
        self.squares += error * error;
        self.count += 1;
    }

    /// Root mean square; `None` without samples.
    pub(super) fn rmse(&self) -> Option<f64> {
        (self.count > 0).then(|| (self.squares / self.count as f64).sqrt())
    }
}

/// Indices over everything and without the first second of each stretch.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Errors {
    pub(super) all: Indices,
    pub(super) settled: Indices,
}

impl Errors {
    fn add(&mut self, stretch: &Stretch, k: usize, error: f64) {
        let time = stretch.time[k + 1];
        self.all.add(time, error);
        if time - stretch.time[0] > SETTLED {
            self.settled.add(time, error);
        }
    }
}

/// The mean-square bound against one choice of comparison weights, over all stretches.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bound {
    pub(super) error_energy: f64,
    pub(super) limit: f64,
    pub(super) holds: bool,
    pub(super) residual: f64,
    pub(super) rises: u64,
}

/// What one side's identifier did.
#[derive(Debug, Clone)]
pub(super) struct Side {
    pub(super) errors: Errors,
    /// In the order of [`COMPARISONS`].
    pub(super) bounds: Vec<Bound>,
    pub(super) weights: [f64; UNITS],
}

/// What the identifiers did.
pub(super) struct Followed {
    pub(super) sides: [Side; 2],
    /// Errors with a constant regressor in the place of the network.
    pub(super) baseline: [Errors; 2],
    /// Errors of the angle rows, where angles are recorded.
    pub(super) angles: Option<[Errors; 2]>,
    pub(super) pole: f64,
    pub(super) gain: f64,
    pub(super) speed_scale: f64,
    pub(super) torque_scale: f64,
    /// Time followed, s.
    pub(super) duration: f64,
}

impl Followed {
    /// The largest relative residual of the exact identity over all steps, sides and comparison weights.
    pub(super) fn residual(&self) -> f64 {
        let bounds = self.sides.iter().flat_map(|s| &s.bounds);
        bounds.map(|b| b.residual).fold(0.0, f64::max)
    }

    /// Whether the mean-square bound held against all comparison weights on both sides.
    pub(super) fn holds(&self) -> bool {
        self.sides.iter().flat_map(|s| &s.bounds).all(|b| b.holds)
    }
}

/// Follows both wheel speeds of a recording with the recipe of the paper's reproduction.
pub(super) fn follow(samples: &Samples, robot: &Robot<f64>, seed: u64) -> Result<Followed> {
    let recipe = Recipe::default().identifier;
    let network = &recipe.network;
    let speed_scale = network.speed_scale * samples.fastest();
    let weight = robot.mass * robot.gravity;
    let torque_scale = network.torque_scale * robot.adhesion * weight * robot.wheel_radius;
    // The recipe's network sees no angles.
    let scale = [1.0, 1.0, speed_scale, speed_scale, torque_scale, torque_scale];
    let mut stream = Stream::new(seed, Purpose::IdentifierLayer, 0);
    let layers = [network.layer(&mut stream, scale)?, network.layer(&mut stream, scale)?];

    // The certificate holds against any weights; those learned at the end are only known after a first pass.
    let (pole, gain) = (recipe.pole, recipe.gain);
    let law = Midpoint::new(gain)?;
    let learned = run(samples, &layers, pole, law, &[])?.map(|s| s.weights);
    let comparisons = [[[0.0; UNITS]; 2], comparison(seed, 0), learned];
    let flat = [Constant::new([HALF; UNITS])?; 2];
    Ok(Followed {
        sides: run(samples, &layers, pole, law, &comparisons)?,
        baseline: run(samples, &flat, pole, law, &[])?.map(|s| s.errors),
        angles: angles(samples, pole)?,
        pole,
        gain,
        speed_scale,
        torque_scale,
        duration: samples.stretches.iter().map(|s| s.time[s.time.len() - 1] - s.time[0]).sum(),
    })
}

/// One identifier per side and stretch; each starts at the first measured speed with zero weights.
fn run<B: Basis<f64, SIGNALS, UNITS>>(
    samples: &Samples,
    bases: &[B; 2],
    pole: f64,
    law: Midpoint<f64>,
    comparisons: &[Weights],
) -> Result<[Side; 2]> {
    let none = Bound { error_energy: 0.0, limit: 0.0, holds: true, residual: 0.0, rises: 0 };
    let side = |_| Side { errors: Errors::default(), bounds: vec![none; comparisons.len()], weights: [0.0; UNITS] };
    let mut sides = [0, 1].map(side);
    for stretch in &samples.stretches {
        for (i, side) in sides.iter_mut().enumerate() {
            let other = 1 - i;
            let mut identifier = Identifier::new(pole, law, stretch.speed[0][i])?;
            let mut ledgers = vec![Ledger::new(pole); comparisons.len()];
            for k in 0..stretch.time.len() - 1 {
                let (now, next) = (stretch.speed[k], stretch.speed[k + 1]);
                let mean = |j: usize| 0.5 * (now[j] + next[j]);
                let u = stretch.torque[k];
                let phi = bases[i].regressor(&[0.0, 0.0, mean(i), mean(other), u[i], u[other]]);
                let h = stretch.time[k + 1] - stretch.time[k];
                let step = identifier.step(now[i], next[i], &phi, h);
                for (ledger, weights) in ledgers.iter_mut().zip(comparisons) {
                    ledger.add(&identifier.certificate(&step, &weights[i]));
                }
                side.errors.add(stretch, k, step.error_after);
            }
            side.weights = identifier.model().weight;
            for (sum, ledger) in side.bounds.iter_mut().zip(&ledgers) {
                sum.add(ledger);
            }
        }
    }
    Ok(sides)
}

impl Bound {
    /// Adds a stretch.
    fn add(&mut self, ledger: &Ledger<f64>) {
        self.error_energy += ledger.error_energy();
        self.limit += ledger.bound();
        self.holds &= ledger.holds();
        let worst = ledger.worst_residual();
        // A residual that is not a number is kept, not lost.
        self.residual = if worst.is_nan() { worst } else { self.residual.max(worst) };
        self.rises += ledger.rises() as u64;
    }
}

/// Rows 1 and 2 of the paper's Eq. 23, which know their rate: the measured speed.
fn angles(samples: &Samples, pole: f64) -> Result<Option<[Errors; 2]>> {
    let mut out = [Errors::default(); 2];
    for s in &samples.stretches {
        if s.angle.is_empty() {
            return Ok(None);
        }
        for (i, errors) in out.iter_mut().enumerate() {
            let mut row = AngleRow::new(pole, s.angle[0][i])?;
            for k in 0..s.time.len() - 1 {
                let rate = 0.5 * (s.speed[k][i] + s.speed[k + 1][i]);
                let error = row.step(s.angle[k][i], s.angle[k + 1][i], rate, s.time[k + 1] - s.time[k]);
                errors.add(s, k, error);
            }
        }
    }
    Ok(Some(out))
}
