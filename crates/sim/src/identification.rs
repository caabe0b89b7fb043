//! Identifiers over a recorded trajectory.

use identifier::{Identifier, Ledger, Midpoint, Step};
use nn_basis::{Activation, Basis, SigmoidLayer};

use crate::experiment::OutputIndices;
use crate::random::{Purpose, Stream};
use crate::{INPUTS, Recipe, SimError, Trajectory, UNITS};

/// Comparison weights are drawn between minus and plus this, rad/s²: the size that weights really take.
const COMPARISON_RANGE: f64 = 30.0;

/// A random first layer per output.
pub(crate) fn layers(
    recipe: &Recipe,
    trajectory: &Trajectory,
    seed: u64,
    draw: u64,
) -> Result<[SigmoidLayer<f64, INPUTS, UNITS>; 2], SimError> {
    let (p, i) = (&trajectory.parameters, &recipe.identifier);
    let speed = i.speed_scale * trajectory.speed / p.wheel_radius;
    let torque = i.torque_scale * p.adhesion * p.mass * p.gravity * p.wheel_radius;
    let range = i.first_layer_range;
    let mut stream = Stream::new(seed, Purpose::IdentifierLayer, draw);
    let mut layer = || {
        let threshold = std::array::from_fn(|_| stream.uniform(-range, range));
        let weight = std::array::from_fn(|_| std::array::from_fn(|_| stream.uniform(-range, range)));
        SigmoidLayer::new(threshold, weight, [speed, speed, torque, torque], Activation::Logistic)
    };
    Ok([layer()?, layer()?])
}

/// Comparison weights for the certificates of a draw.
pub(crate) fn comparison(seed: u64, draw: u64) -> [[f64; UNITS]; 2] {
    let mut stream = Stream::new(seed, Purpose::Comparison, draw);
    std::array::from_fn(|_| std::array::from_fn(|_| stream.uniform(-COMPARISON_RANGE, COMPARISON_RANGE)))
}

/// Follows both wheel speeds with the given bases; `watch` sees every step of both outputs.
///
/// The regressor of an interval is taken at its mean speeds and the torques held over it, as the midpoint rule asks.
/// Each step is certified against `comparison` and against zero weights.
pub(crate) fn follow<B: Basis<f64, INPUTS, UNITS>>(
    recipe: &Recipe,
    trajectory: &Trajectory,
    bases: &[B; 2],
    comparison: &[[f64; UNITS]; 2],
    mut watch: impl FnMut(usize, &[Step<f64, UNITS>; 2]),
) -> Result<[OutputIndices; 2], SimError> {
    let (pole, h) = (recipe.identifier.pole, trajectory.step);
    let law = Midpoint::new(recipe.identifier.gain)?;
    let mut identifiers = [Identifier::new(pole, law, 0.0)?, Identifier::new(pole, law, 0.0)?];
    let mut tallies = [Tally::new(pole), Tally::new(pole)];
    for (k, torque) in trajectory.torques.iter().enumerate() {
        let (now, next) = (&trajectory.states[k].speed, &trajectory.states[k + 1].speed);
        let mean = [0.5 * (now[0] + next[0]), 0.5 * (now[1] + next[1])];
        let steps: [Step<f64, UNITS>; 2] = std::array::from_fn(|i| {
            let other = 1 - i;
            let phi = bases[i].regressor(&[mean[i], mean[other], torque[i], torque[other]]);
            let step = identifiers[i].step(now[i], next[i], &phi, h);
            tallies[i].chosen.add(&identifiers[i].certificate(&step, &comparison[i]));
            tallies[i].zero.add(&identifiers[i].certificate(&step, &[0.0; UNITS]));
            step
        });
        let time = (k + 1) as f64 * h;
        for (i, step) in steps.iter().enumerate() {
            if !step.error_after.is_finite() {
                return Err(SimError::NotFinite { quantity: ["estimate of x3", "estimate of x4"][i], time });
            }
            tallies[i].add(trajectory, time, step);
        }
        watch(k, &steps);
    }
    Ok(tallies.map(|t| t.close(trajectory.torques.len())))
}

/// Running sums of one output.
struct Tally {
    chosen: Ledger<f64>,
    zero: Ledger<f64>,
    max: f64,
    squares: f64,
    phi2: f64,
    peak: [f64; 5],
    peak_at: [f64; 5],
    quiet: f64,
    quiet_count: usize,
}

impl Tally {
    fn new(pole: f64) -> Self {
        Self {
            chosen: Ledger::new(pole),
            zero: Ledger::new(pole),
            max: 0.0,
            squares: 0.0,
            phi2: 0.0,
            peak: [0.0; 5],
            peak_at: [0.0; 5],
            quiet: 0.0,
            quiet_count: 0,
        }
    }

    fn add(&mut self, trajectory: &Trajectory, time: f64, step: &Step<f64, UNITS>) {
        let error = step.error_after.abs();
        self.max = self.max.max(error);
        self.squares += error * error;
        self.phi2 += step.sample.regressor.iter().map(|p| p * p).sum::<f64>();
        let windows = &trajectory.windows;
        if let Some(i) = windows.end.iter().position(|end| time <= *end) {
            if time > windows.quiet[i] {
                self.quiet += error * error;
                self.quiet_count += 1;
            } else if error > self.peak[i] {
                self.peak[i] = error;
                self.peak_at[i] = time;
            }
        }
    }

    fn close(self, samples: usize) -> OutputIndices {
        let n = samples as f64;
        OutputIndices {
            max: self.max,
            rmse: (self.squares / n).sqrt(),
            peak: self.peak,
            peak_at: self.peak_at,
            quiet_rms: (self.quiet / self.quiet_count.max(1) as f64).sqrt(),
            mean_regressor_square: self.phi2 / n,
            identity_residual: self.chosen.worst_residual().max(self.zero.worst_residual()),
            mean_square_bound_holds: self.chosen.holds() && self.zero.holds(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use nn_basis::Basis;

    use super::{follow, layers};
    use crate::{INPUTS, Recipe, RobotSet, Trajectory, UNITS};

    /// A basis that notes what it is shown.
    #[derive(Default)]
    struct Probe(RefCell<Vec<[f64; INPUTS]>>);

    impl Basis<f64, INPUTS, UNITS> for Probe {
        fn regressor(&self, input: &[f64; INPUTS]) -> [f64; UNITS] {
            self.0.borrow_mut().push(*input);
            [0.5; UNITS]
        }
    }

    #[test]
    fn outputs_have_their_own_layers_and_thresholds() {
        let recipe = Recipe { samples: 1, ..Recipe::default() };
        let run = Trajectory::simulate(&recipe, RobotSet::B).expect("runs");
        let [three, four] = layers(&recipe, &run, 1, 0).expect("valid");
        assert_ne!(three, four);
        let mut spread = 0.0_f64;
        for layer in [three, four] {
            for phi in layer.regressor(&[0.0; INPUTS]) {
                // logistic(±1): thresholds are U(−1, 1) too.
                assert!((0.268..0.732).contains(&phi), "{phi}");
                spread = spread.max((phi - 0.5).abs());
            }
        }
        assert!(spread > 0.05);
        assert_eq!([three, four], layers(&recipe, &run, 1, 0).expect("valid"));
    }

    #[test]
    fn each_output_sees_its_own_wheel_first() {
        let recipe = Recipe { samples: 5000, ..Recipe::default() };
        let run = Trajectory::simulate(&recipe, RobotSet::B).expect("runs");
        let probes = [Probe::default(), Probe::default()];
        follow(&recipe, &run, &probes, &[[0.0; UNITS]; 2], |_, _| {}).expect("finite");
        let k = 4800;
        let mean = |i: usize| 0.5 * (run.states[k].speed[i] + run.states[k + 1].speed[i]);
        let u = run.torques[k];
        assert!((u[0] - u[1]).abs() > 1.0, "the robot turns here, so the sides differ");
        assert_eq!(probes[0].0.borrow()[k], [mean(0), mean(1), u[0], u[1]]);
        assert_eq!(probes[1].0.borrow()[k], [mean(1), mean(0), u[1], u[0]]);
    }
}
