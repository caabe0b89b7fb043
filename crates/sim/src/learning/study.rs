//! The laps, and a contender's way through them.

use controller::{Loop, Turn};
use identifier::{Ledger, Sample};
use nalgebra::{SMatrix, SVector};
use nn_basis::dot;
use robot_model::paper::State;

use super::course::Course;
use super::follower::Follower;
use super::free_run::{BETWEEN_STARTS, Errors};
use super::regressor::{Regressor, Sight, Start};
use super::score::Score;
use crate::{Recipe, SimError, comparison};

/// Keeps the normal equations of terms that a lap does not show solvable; far below any signal.
const HINDSIGHT_RIDGE: f64 = 1e-9;

/// What the study assumes besides the recipe of the reproduction.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyRecipe {
    /// The recipe; set B is driven.
    pub recipe: Recipe,
    /// Standard deviation of the noise of the measured wheel speeds, rad/s.
    pub noise: f64,
    /// Training laps.
    pub laps: u64,
}

impl Default for StudyRecipe {
    fn default() -> Self {
        Self { recipe: Recipe::default(), noise: 0.01, laps: 5 }
    }
}

/// The training lap and the unseen ones.
#[derive(Debug, Clone)]
pub struct Study {
    pub(super) recipe: StudyRecipe,
    pub(super) training: Course,
    unseen: Vec<Course>,
}

impl Study {
    /// Drives all laps once: the paper's for training; a wider and a tighter one the same way round, and one the other way
    /// round, to try what was learned on. The rolling resistance rises at 12 s on each.
    ///
    /// # Errors
    /// [`SimError`] if the recipe cannot be used or a simulation stops.
    pub fn new(recipe: &StudyRecipe) -> Result<Self, SimError> {
        let scenario = &recipe.recipe.sets.b;
        let path = recipe.recipe.path(scenario);
        let ramps = Loop { accelerate: 1.5, lead_in: 2.0, lead_out: 2.0, brake: 1.5, ..path };
        let course = |name, path: &Loop| Course::new(name, &recipe.recipe, path);
        Ok(Self {
            recipe: recipe.clone(),
            training: course("training", &path)?,
            unseen: vec![
                course("wider", &Loop { speed: 0.55, radius: 2.0, ..ramps })?,
                course("tighter", &Loop { speed: 0.4, radius: 1.25, ..ramps })?,
                course("other way round", &Loop { turn: Turn::Right, ..ramps })?,
            ],
        })
    }

    /// The unseen laps.
    pub fn unseen(&self) -> &[Course] {
        &self.unseen
    }

    /// The training lap.
    pub fn training(&self) -> &Course {
        &self.training
    }

    /// Takes a contender through all laps. `seed` and `draw` key the noise and the comparison weights.
    pub(super) fn score<F: Follower<N>, R: Regressor<N>, const N: usize>(
        &self,
        mut followers: [F; 2],
        regressor: &R,
        seed: u64,
        draw: u64,
    ) -> Result<Score, SimError> {
        let pole = self.recipe.recipe.identifier.pole;
        let mut way = Way {
            noise: self.recipe.noise,
            pole,
            seed,
            draw,
            lap: 0,
            score: Score::default(),
            drawn: comparison(seed, draw),
        };
        way.score.bounds_hold = true;
        for lap in 0..self.recipe.laps {
            let (squares, largest) = way.follow(&mut followers, regressor, &self.training, None)?;
            way.score.lap.push(pooled(squares));
            if lap == 0 {
                way.score.table1 = [largest[0], largest[1], squares[0].sqrt(), squares[1].sqrt()];
            }
        }
        let kept = [followers[0].kept(), followers[1].kept()];
        way.score.constants = followers[0].constants().zip(followers[1].constants()).map(|(left, right)| [left, right]);
        for course in &self.unseen {
            let [frozen, best] = way.frozen(&kept, regressor, course);
            way.score.frozen.push(frozen);
            way.score.hindsight.push(best);
            let mut errors = [Errors::default(); 2];
            let (squares, _) = way.follow(&mut followers, regressor, course, Some((&kept, &mut errors)))?;
            way.score.online.push(pooled(squares));
            way.score.ahead_acting.push(errors[0].rms());
            way.score.ahead_kept.push(errors[1].rms());
        }
        Ok(way.score)
    }
}

/// Root of the mean over both wheels.
fn pooled(squares: [f64; 2]) -> f64 {
    (0.5 * (squares[0] + squares[1])).sqrt()
}

/// A contender on its way through the laps.
struct Way<const N: usize> {
    noise: f64,
    pole: f64,
    seed: u64,
    draw: u64,
    lap: u64,
    score: Score,
    drawn: [[f64; N]; 2],
}

/// The body between two samples.
fn middle(course: &Course, k: usize) -> State<f64> {
    let (a, b) = (course.run.states[k].to_array(), course.run.states[k + 1].to_array());
    State::from_array(std::array::from_fn(|i| 0.5 * (a[i] + b[i])))
}

impl<const N: usize> Way<N> {
    /// Noise of the next lap; both passes over an unseen lap get the same.
    fn measured(&self, course: &Course) -> Vec<[f64; 2]> {
        course.measured(self.noise, self.seed, 64 * self.draw + self.lap)
    }

    /// Follows a lap; returns mean squared and largest errors of both wheels, and adds predictions where asked.
    fn follow<F: Follower<N>, R: Regressor<N>>(
        &mut self,
        followers: &mut [F; 2],
        regressor: &R,
        course: &Course,
        mut ahead: Option<(&[[f64; N]; 2], &mut [Errors; 2])>,
    ) -> Result<([f64; 2], [f64; 2]), SimError> {
        let (run, h) = (&course.run, course.run.step);
        let measured = self.measured(course);
        let every = (BETWEEN_STARTS / h).round() as usize;
        let far = Errors::intervals(course);
        let mut ledgers = [[Ledger::new(self.pole); 2]; 2];
        let (mut squares, mut largest) = ([0.0; 2], [0.0_f64; 2]);
        for k in 0..run.torques.len() {
            if let Some((kept, errors)) = &mut ahead
                && k % every == 0
                && k + far < run.torques.len()
            {
                let speed = [followers[0].output(), followers[1].output()];
                let start = Start { course, pole: self.pole, k, speed };
                let acting = [followers[0].acting(), followers[1].acting()];
                for (weights, errors) in [&acting, *kept].into_iter().zip(errors.iter_mut()) {
                    errors.add(course, k, &regressor.ahead(weights, &start, far));
                }
            }
            let (now, next) = (measured[k], measured[k + 1]);
            let speed = [0, 1].map(|i| 0.5 * (now[i] + next[i]));
            let body = middle(course, k);
            let sight = Sight { speed, torque: run.torques[k], body: &body };
            for (i, follower) in followers.iter_mut().enumerate() {
                let known = regressor.known(i, self.pole, &sight);
                let phi = regressor.phi(i, &sight);
                let sample = Sample { start: now[i], end: next[i], regressor: phi, known, h };
                let step = follower.follow(&sample);
                for (ledger, w) in ledgers[i].iter_mut().zip([&[0.0; N], &self.drawn[i]]) {
                    ledger.add(&follower.certificate(&step, w));
                }
                let error = run.states[k + 1].speed[i] - step.after.output;
                if !error.is_finite() {
                    let quantity = ["estimate of x3", "estimate of x4"][i];
                    return Err(SimError::NotFinite { quantity, time: (k + 1) as f64 * h });
                }
                squares[i] += error * error / run.torques.len() as f64;
                largest[i] = largest[i].max(error.abs());
            }
        }
        for ledger in ledgers.iter().flatten() {
            self.score.residual = self.score.residual.max(ledger.worst_residual());
            self.score.bounds_hold &= ledger.holds() && ledger.worst_residual().is_finite();
        }
        self.lap += 1;
        Ok((squares, largest))
    }

    /// RMSE of `d/dt x̂ = −a x̂ + Wᵀφ` with fixed weights, φ from the measured speeds of the lap; and the smallest that any
    /// fixed weights reach on this lap, chosen with hindsight: what the regressor itself cannot do.
    fn frozen<R: Regressor<N>>(&self, weight: &[[f64; N]; 2], regressor: &R, course: &Course) -> [f64; 2] {
        let (run, h) = (&course.run, course.run.step);
        let measured = self.measured(course);
        let (damping, samples) = (0.5 * self.pole * h, run.torques.len() as f64);
        // The midpoint rule with a fixed right-hand side.
        let lag = |state: f64, drive: f64| ((1.0 - damping) * state + h * drive) / (1.0 + damping);
        let mut frozen = [0.0; 2];
        let mut best = [0.0; 2];
        for i in 0..2 {
            let (mut estimate, mut known, mut filtered) = (0.0, 0.0, SVector::<f64, N>::zeros());
            let (mut normal, mut cross) = (SMatrix::<f64, N, N>::identity() * HINDSIGHT_RIDGE, SVector::zeros());
            let mut energy = 0.0;
            for k in 0..run.torques.len() {
                let speed = [0, 1].map(|i| 0.5 * (measured[k][i] + measured[k + 1][i]));
                let body = middle(course, k);
                let sight = Sight { speed, torque: run.torques[k], body: &body };
                let (phi, given) = (regressor.phi(i, &sight), regressor.known(i, self.pole, &sight));
                estimate = lag(estimate, dot(&weight[i], &phi) + given);
                known = lag(known, given);
                filtered.zip_apply(&SVector::from(phi), |state, drive| *state = lag(*state, drive));
                let truth = run.states[k + 1].speed[i];
                frozen[i] += (truth - estimate).powi(2) / samples;
                normal += filtered * filtered.transpose() / samples;
                cross += filtered * ((truth - known) / samples);
                energy += (truth - known).powi(2) / samples;
            }
            best[i] = normal.cholesky().map_or(energy, |factor| (energy - cross.dot(&factor.solve(&cross))).max(0.0));
        }
        [pooled(frozen), pooled(best)]
    }
}
