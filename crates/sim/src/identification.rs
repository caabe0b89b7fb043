//! Identifiers over a recorded trajectory.

use identifier::{Identifier, Law, Ledger, Step};
use nn_basis::Basis;

use crate::experiment::OutputIndices;
use crate::network_recipe::SIGNALS;
use crate::random::{Purpose, Stream};
use crate::{SimError, Trajectory};

/// Comparison weights are drawn between minus and plus this, rad/s²: the size that weights really take.
const COMPARISON_RANGE: f64 = 30.0;

/// Comparison weights W* for the certificates of a draw, one set per output, rad/s².
pub fn comparison<const N: usize>(seed: u64, draw: u64) -> [[f64; N]; 2] {
    let mut stream = Stream::new(seed, Purpose::Comparison, draw);
    std::array::from_fn(|_| std::array::from_fn(|_| stream.uniform(-COMPARISON_RANGE, COMPARISON_RANGE)))
}

/// Follows both wheel speeds with the given bases; `watch` sees every step of both outputs.
///
/// The regressor of an interval is taken at its mean speeds and the torques held over it, as the midpoint rule asks.
/// Each step is certified against `comparison` and against zero weights.
pub(crate) fn follow<B: Basis<f64, SIGNALS, N>, L: Law<f64, N> + Copy, const N: usize>(
    trajectory: &Trajectory,
    pole: f64,
    law: L,
    bases: &[B; 2],
    comparison: &[[f64; N]; 2],
    mut watch: impl FnMut(usize, &[Step<f64, N>; 2]),
) -> Result<[OutputIndices; 2], SimError> {
    let h = trajectory.step;
    let mut identifiers = [Identifier::new(pole, law, 0.0)?, Identifier::new(pole, law, 0.0)?];
    let mut tallies = [Tally::new(pole), Tally::new(pole)];
    for k in 0..trajectory.torques.len() {
        let (now, next) = (&trajectory.states[k].speed, &trajectory.states[k + 1].speed);
        let signals = trajectory.signals(k);
        let steps: [Step<f64, N>; 2] = std::array::from_fn(|i| {
            let step = identifiers[i].step(now[i], next[i], &bases[i].regressor(&signals[i]), h);
            tallies[i].chosen.add(&identifiers[i].certificate(&step, &comparison[i]));
            tallies[i].zero.add(&identifiers[i].certificate(&step, &[0.0; N]));
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
    window: [f64; 5],
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
            window: [0.0; 5],
            quiet: 0.0,
            quiet_count: 0,
        }
    }

    fn add<const N: usize>(&mut self, trajectory: &Trajectory, time: f64, step: &Step<f64, N>) {
        let error = step.error_after.abs();
        self.max = self.max.max(error);
        self.squares += error * error;
        self.phi2 += step.sample.regressor.iter().map(|p| p * p).sum::<f64>();
        let windows = &trajectory.windows;
        if let Some(i) = windows.end.iter().position(|end| time <= *end) {
            self.window[i] += error * error;
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
            share: self.window.map(|w| w / self.squares),
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

    use identifier::Midpoint;
    use nn_basis::Basis;

    use super::follow;
    use crate::network_recipe::{SIGNALS, Signals};
    use crate::{Recipe, RobotSet, Trajectory, UNITS};

    /// A basis that notes what it is shown.
    #[derive(Default)]
    struct Probe(RefCell<Vec<Signals>>);

    impl Basis<f64, SIGNALS, UNITS> for Probe {
        fn regressor(&self, input: &Signals) -> [f64; UNITS] {
            self.0.borrow_mut().push(*input);
            [0.5; UNITS]
        }
    }

    #[test]
    fn each_output_sees_its_own_wheel_first() {
        let recipe = Recipe { samples: 5000, ..Recipe::default() };
        let run = Trajectory::simulate(&recipe, RobotSet::B).expect("runs");
        let probes = [Probe::default(), Probe::default()];
        let law = Midpoint::new(500.0).expect("valid");
        follow(&run, 8.0, law, &probes, &[[0.0; UNITS]; 2], |_, _| {}).expect("finite");
        let k = 4800;
        let mean = |i: usize| 0.5 * (run.states[k].speed[i] + run.states[k + 1].speed[i]);
        let turned = |i: usize| 0.5 * (run.states[k].angle[i] + run.states[k + 1].angle[i]);
        let u = run.torques[k];
        assert!((u[0] - u[1]).abs() > 1.0, "the robot turns here, so the sides differ");
        assert_eq!(probes[0].0.borrow()[k], [turned(0), turned(1), mean(0), mean(1), u[0], u[1]]);
        assert_eq!(probes[1].0.borrow()[k], [turned(1), turned(0), mean(1), mean(0), u[1], u[0]]);
    }
}
