//! Many identifiers over one trajectory.

use identifier::{AngleRow, Euler, Exponential, Law, Midpoint, Step};
use nn_basis::{Basis, Constant};
use rayon::prelude::*;

use crate::group;
use crate::identification::follow;
use crate::network_recipe::SIGNALS;
use crate::recipe::WIDE;
use crate::tally::OutputIndices;
use crate::{Purpose, Recipe, RobotSet, Scheme, SimError, Stream, Trajectory, UNITS, comparison};

/// One draw of first layers and what became of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Draw {
    /// Which draw.
    pub number: u64,
    /// Wheels 3 and 4.
    pub output: [OutputIndices; 2],
}

impl Draw {
    /// The indices of Table 1 in its order: x̃3max, x̃4max, x̃3R, x̃4R, rad/s.
    pub fn table1(&self) -> [f64; 4] {
        let [three, four] = &self.output;
        [three.max, four.max, three.rmse, four.rmse]
    }
}

/// Histories of one draw, for figures. One entry per sample 1..=n.
#[derive(Debug, Clone, Default)]
pub struct Trace {
    /// Time, s.
    pub time: Vec<f64>,
    /// Estimated wheel angles with the measured speed (Eq. 23 as written), rad.
    pub angle_estimate: [Vec<f64>; 2],
    /// Error of the wheel angles with the measured speed, rad.
    pub angle_error: [Vec<f64>; 2],
    /// Error of the wheel angles if rows 1 and 2 use the estimated speed, rad.
    pub angle_error_estimated_speed: [Vec<f64>; 2],
    /// Estimated wheel speeds, rad/s.
    pub speed_estimate: [Vec<f64>; 2],
    /// Error of the wheel speeds, rad/s.
    pub speed_error: [Vec<f64>; 2],
    /// Weights of both outputs, rad/s².
    pub weight: [Vec<Vec<f64>>; 2],
}

/// The paper's experiment: one trajectory, any number of identifiers.
#[derive(Debug, Clone)]
pub struct Experiment {
    recipe: Recipe,
    trajectory: Trajectory,
}

impl Experiment {
    /// Simulates the robot; identifiers come later.
    ///
    /// # Errors
    /// [`SimError`] if the recipe cannot be used or the simulation stops.
    pub fn new(recipe: &Recipe, set: RobotSet) -> Result<Self, SimError> {
        Ok(Self { recipe: recipe.clone(), trajectory: Trajectory::simulate(recipe, set)? })
    }

    /// What the robot did.
    pub fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    /// Runs the identifiers of one draw of first layers.
    ///
    /// # Errors
    /// [`SimError`] if the identifier cannot be built or an estimate stops being finite.
    pub fn identify(&self, seed: u64, number: u64) -> Result<Draw, SimError> {
        match self.recipe.identifier.network.units {
            WIDE => self.draw::<WIDE>(seed, number, |_, _| {}),
            _ => self.draw::<UNITS>(seed, number, |_, _| {}),
        }
    }

    fn draw<const N: usize>(
        &self,
        seed: u64,
        number: u64,
        watch: impl FnMut(usize, &[Step<f64, N>; 2]),
    ) -> Result<Draw, SimError> {
        let mut stream = Stream::new(seed, Purpose::IdentifierLayer, number);
        let layers = self.recipe.identifier.network.layers::<N>(&self.trajectory, &mut stream)?;
        Ok(Draw { number, output: self.follow(&layers, &comparison(seed, number), watch)? })
    }

    /// Follows the run by the recipe's scheme.
    fn follow<B: Basis<f64, SIGNALS, N>, const N: usize>(
        &self,
        bases: &[B; 2],
        comparison: &[[f64; N]; 2],
        watch: impl FnMut(usize, &[Step<f64, N>; 2]),
    ) -> Result<[OutputIndices; 2], SimError> {
        let i = &self.recipe.identifier;
        match i.scheme {
            Scheme::Midpoint => self.follow_by(Midpoint::new(i.gain)?, bases, comparison, watch),
            Scheme::Exponential => self.follow_by(Exponential::new(i.gain)?, bases, comparison, watch),
            Scheme::Euler => self.follow_by(Euler::new(i.gain)?, bases, comparison, watch),
        }
    }

    fn follow_by<B: Basis<f64, SIGNALS, N>, L: Law<f64, N> + Copy, const N: usize>(
        &self,
        law: L,
        bases: &[B; 2],
        comparison: &[[f64; N]; 2],
        watch: impl FnMut(usize, &[Step<f64, N>; 2]),
    ) -> Result<[OutputIndices; 2], SimError> {
        let tallies = follow(&self.trajectory, self.recipe.identifier.pole, law, bases, comparison, watch)?;
        Ok(tallies.map(|t| t.close(self.trajectory.torques.len())))
    }

    /// Runs the draws `0..draws` on all cores, several side by side on each where the recipe has the paper's scheme and number
    /// of neurons; `done` is called after each.
    ///
    /// The result is in the order of the draws, does not depend on the number of threads and has the bits that
    /// [`Experiment::identify`] gives each draw alone.
    ///
    /// # Errors
    /// The error of a draw that failed.
    pub fn ensemble(&self, seed: u64, draws: u64, done: impl Fn() + Sync) -> Result<Vec<Draw>, SimError> {
        self.all(seed, draws, &done)
    }

    /// [`Experiment::ensemble`], compiled once and not in every crate that calls it.
    fn all(&self, seed: u64, draws: u64, done: &(dyn Fn() + Sync)) -> Result<Vec<Draw>, SimError> {
        let side_by_side = group::WIDTH as u64;
        let i = &self.recipe.identifier;
        let grouped = i.scheme == Scheme::Midpoint && i.network.units == UNITS;
        let groups: Vec<Vec<Draw>> = (0..draws.div_ceil(side_by_side))
            .into_par_iter()
            .map(|g| {
                let numbers: Vec<u64> = (g * side_by_side..draws.min((g + 1) * side_by_side)).collect();
                let one_by_one = || numbers.iter().map(|n| self.identify(seed, *n)).collect();
                let found = match grouped.then(|| group::identify(&self.recipe, &self.trajectory, seed, &numbers)) {
                    // An estimate that stops being finite stops its own draw only: one by one it is found which.
                    None | Some(Err(SimError::NotFinite { .. })) => one_by_one(),
                    Some(other) => other,
                };
                for _ in &numbers {
                    done();
                }
                found
            })
            .collect::<Result<_, _>>()?;
        Ok(groups.into_iter().flatten().collect())
    }

    /// Runs the identifier without a network: all regressor entries 0.5 at all times.
    ///
    /// # Errors
    /// As [`Experiment::identify`].
    pub fn constant_regressor(&self) -> Result<Draw, SimError> {
        let basis = Constant::new([0.5; UNITS])?;
        let output = self.follow(&[basis; 2], &comparison(0, 0), |_, _| {})?;
        Ok(Draw { number: 0, output })
    }

    /// Runs one draw and keeps its histories.
    ///
    /// # Errors
    /// As [`Experiment::identify`].
    pub fn trace(&self, seed: u64, number: u64) -> Result<Trace, SimError> {
        match self.recipe.identifier.network.units {
            WIDE => self.traced::<WIDE>(seed, number),
            _ => self.traced::<UNITS>(seed, number),
        }
    }

    fn traced<const N: usize>(&self, seed: u64, number: u64) -> Result<Trace, SimError> {
        let row = AngleRow::new(self.recipe.identifier.pole, 0.0)?;
        let (mut measured, mut estimated) = ([row; 2], [row; 2]);
        let (run, h) = (&self.trajectory, self.trajectory.step);
        let mut trace = Trace { weight: [0, 1].map(|_| vec![Vec::new(); N]), ..Trace::default() };
        self.draw::<N>(seed, number, |k, steps| {
            trace.time.push((k + 1) as f64 * h);
            for (i, step) in steps.iter().enumerate() {
                let (from, to) = (run.states[k].angle[i], run.states[k + 1].angle[i]);
                // The mean speed over the interval, as an encoder measures it.
                let speed = (to - from) / h;
                trace.angle_error[i].push(measured[i].step(from, to, speed, h));
                trace.angle_estimate[i].push(measured[i].estimate());
                let missed = 0.5 * (step.error_before + step.error_after);
                trace.angle_error_estimated_speed[i].push(estimated[i].step(from, to, speed - missed, h));
                trace.speed_estimate[i].push(step.after.output);
                trace.speed_error[i].push(step.error_after);
                for (history, w) in trace.weight[i].iter_mut().zip(step.after.weight) {
                    history.push(w);
                }
            }
        })?;
        Ok(trace)
    }
}
