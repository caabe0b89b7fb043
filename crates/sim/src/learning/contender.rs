//! The laws and regressors that are compared.

use identifier::{
    Euler, Exponential, Identifier, Law, Leaky, Memory, MemorySettings, Midpoint, Projection, Rate, Retaining,
};
use nn_basis::Constant;
use rayon::prelude::*;
use robot_model::paper::{PaperRobot, Structured};

use super::regressor::{Equation8, Network, Nothing, Regressor};
use super::score::Score;
use super::structured::StructuredFollower;
use super::study::Study;
use crate::{Purpose, SimError, Stream, UNITS};

/// Error that the dead zone tolerates, rad/s: the noise.
const TOLERATED: f64 = 0.01;
/// Radius of the projection, rad/s².
const RADIUS: f64 = 100.0;
/// σ of the sigma-modification.
const SIGMA: f64 = 1e-4;
/// κ of the e-modification.
const KAPPA: f64 = 1e-2;
/// How many times the paper's gain the control with a high gain has.
const HIGH: f64 = 10.0;

/// A law with its regressor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Contender {
    /// No learning: `G = a x` is given, that is, the speed stays as it is.
    Nothing,
    /// A constant regressor: integral action.
    Constant,
    /// The paper's network and law.
    Paper,
    /// The same with ten times the gain.
    HighGain,
    /// The paper's network by forward Euler.
    Euler,
    /// By the exponential scheme.
    Exponential,
    /// With a dead zone as wide as the noise.
    DeadZone,
    /// With weights in a ball.
    Projection,
    /// With sigma-modification.
    Sigma,
    /// With e-modification.
    ErrorModification,
    /// The paper's network, gain and law with a memory.
    Memory,
    /// Eq. 8 as regressor, the body's motion measured, under the paper's law.
    Structured,
    /// The same with a memory.
    StructuredMemory,
}

/// One contender over many draws.
#[derive(Debug, Clone)]
pub struct Tried {
    /// Which.
    pub contender: Contender,
    /// Its score in each draw.
    pub scores: Vec<Score>,
}

impl Contender {
    /// All of them, in the order of a table.
    pub const ALL: [Self; 13] = [
        Self::Nothing,
        Self::Constant,
        Self::Paper,
        Self::HighGain,
        Self::Euler,
        Self::Exponential,
        Self::DeadZone,
        Self::Projection,
        Self::Sigma,
        Self::ErrorModification,
        Self::Memory,
        Self::Structured,
        Self::StructuredMemory,
    ];

    /// What it is called in a table.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nothing => "nothing learned, G = a x given",
            Self::Constant => "constant regressor",
            Self::Paper => "the paper's law",
            Self::HighGain => "the paper's law, gain 5000",
            Self::Euler => "forward Euler",
            Self::Exponential => "exponential",
            Self::DeadZone => "dead zone",
            Self::Projection => "projection",
            Self::Sigma => "sigma-modification",
            Self::ErrorModification => "e-modification",
            Self::Memory => "the paper's law with memory",
            Self::Structured => "Eq. 8 as regressor",
            Self::StructuredMemory => "Eq. 8 with memory",
        }
    }

    /// Whether it is shown the motion of the body, which the paper's identifier is not.
    pub fn sees_the_body(self) -> bool {
        matches!(self, Self::Structured | Self::StructuredMemory)
    }
}

impl Study {
    /// Takes a contender through all laps with one draw of first layers and noise.
    ///
    /// # Errors
    /// [`SimError`] if it cannot be built or an estimate stops being finite.
    pub fn run(&self, contender: Contender, seed: u64, draw: u64) -> Result<Score, SimError> {
        let gain = self.recipe.recipe.identifier.gain;
        let midpoint = Midpoint::new(gain)?;
        let exponential = Exponential::new(gain)?;
        let tolerated = TOLERATED * self.recipe.recipe.identifier.pole;
        match contender {
            Contender::Nothing => self.plain(midpoint, &Nothing, seed, draw),
            Contender::Constant => self.plain(midpoint, &Constant::new([0.5; UNITS])?, seed, draw),
            Contender::Paper => self.network(midpoint, seed, draw),
            Contender::HighGain => self.network(Midpoint::new(HIGH * gain)?, seed, draw),
            Contender::Euler => self.network(Euler::new(gain)?, seed, draw),
            Contender::Exponential => self.network(exponential, seed, draw),
            Contender::DeadZone => self.network(Exponential::with_dead_zone(gain, tolerated)?, seed, draw),
            Contender::Projection => self.network(Projection::new(exponential, RADIUS)?, seed, draw),
            Contender::Sigma => self.network(Leaky::new(midpoint, Rate::Sigma(SIGMA))?, seed, draw),
            Contender::ErrorModification => self.network(Leaky::new(midpoint, Rate::Error(KAPPA))?, seed, draw),
            Contender::Memory => self.retaining(midpoint, seed, draw),
            Contender::Structured => self.plain(midpoint, &self.equation_8(), seed, draw),
            Contender::StructuredMemory => self.structured(midpoint, seed, draw),
        }
    }

    /// Runs a contender with the draws `0..draws` on all cores, in their order; `done` is called after each.
    ///
    /// # Errors
    /// As [`Study::run`].
    pub fn ensemble(
        &self,
        contender: Contender,
        seed: u64,
        draws: u64,
        done: impl Fn() + Sync,
    ) -> Result<Tried, SimError> {
        self.all(contender, seed, draws, &done)
    }

    /// [`Study::ensemble`], compiled once and not in every crate that calls it.
    fn all(&self, contender: Contender, seed: u64, draws: u64, done: &(dyn Fn() + Sync)) -> Result<Tried, SimError> {
        let scores: Result<Vec<_>, _> = (0..draws)
            .into_par_iter()
            .map(|draw| {
                let score = self.run(contender, seed, draw);
                done();
                score
            })
            .collect();
        Ok(Tried { contender, scores: scores? })
    }

    fn plain<L: Law<f64, N> + Copy, R: Regressor<N>, const N: usize>(
        &self,
        law: L,
        regressor: &R,
        seed: u64,
        draw: u64,
    ) -> Result<Score, SimError> {
        let follower = || Identifier::new(self.recipe.recipe.identifier.pole, law, 0.0);
        self.score([follower()?, follower()?], regressor, seed, draw)
    }

    fn network<L: Law<f64, UNITS> + Copy>(&self, law: L, seed: u64, draw: u64) -> Result<Score, SimError> {
        self.plain(law, &self.layers(seed, draw)?, seed, draw)
    }

    fn retaining(&self, law: Midpoint<f64>, seed: u64, draw: u64) -> Result<Score, SimError> {
        let memory = Memory::new(MemorySettings::default())?;
        let follower = || Retaining::new(self.recipe.recipe.identifier.pole, law, 0.0, memory);
        self.score([follower()?, follower()?], &self.layers(seed, draw)?, seed, draw)
    }

    fn structured(&self, law: Midpoint<f64>, seed: u64, draw: u64) -> Result<Score, SimError> {
        // What it starts from are the constants of another robot.
        let guess = PaperRobot::new(&self.recipe.recipe.sets.a.robot)?;
        let guess = Structured::of(guess.constants());
        let pole = self.recipe.recipe.identifier.pole;
        let follower = || StructuredFollower::new(pole, law, &guess, self.torque_scale());
        self.score([follower()?, follower()?], &self.equation_8(), seed, draw)
    }

    fn layers(&self, seed: u64, draw: u64) -> Result<Network<UNITS>, SimError> {
        let mut stream = Stream::new(seed, Purpose::IdentifierLayer, draw);
        Ok(Network(self.recipe.recipe.identifier.network.layers(&self.training.run, &mut stream)?))
    }

    fn torque_scale(&self) -> f64 {
        self.recipe.recipe.identifier.network.scale(&self.training.run)[4]
    }

    fn equation_8(&self) -> Equation8 {
        Equation8 {
            robot: self.training.robot,
            torque_scale: self.torque_scale(),
            substeps: self.recipe.recipe.substeps,
        }
    }
}
