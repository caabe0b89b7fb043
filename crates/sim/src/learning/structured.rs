//! An identifier that knows Eq. 8 by constants it learned.

use identifier::{
    Certificate, Identifier, IdentifierError, LeastSquares, LeastSquaresSettings, Midpoint, Sample, Step,
};
use nn_basis::dot;
use robot_model::paper::{Structured, TERMS, balance};

use super::follower::Follower;

/// Smallest wheel inertia that is believed, kg m²: the estimate divides by it. Below, the first guess acts.
const LEAST_INERTIA: f64 = 2e-3;
/// Smooth sign above which a wheel counts as turning: below, slip is noise over almost nothing.
const TURNING: f64 = 0.999_999;
/// Keeps everything; the ridge holds what a lap does not show near the first guess.
const SETTINGS: LeastSquaresSettings<f64> =
    LeastSquaresSettings { bandwidth: 15.0, lead: 0.0, forgetting: 0.0, ridge: 0.01 };

/// The paper's identifier over the terms of Eq. 8, beside least squares of the torque balance `τ = aᵀχ`, whose weights are
/// the constants. What these know enters the identifier as the known part `(τ − C)/(2 a1)` while the wheel turns.
pub(super) struct StructuredFollower {
    identifier: Identifier<f64, TERMS>,
    squares: LeastSquares<f64, TERMS>,
    guess: [f64; TERMS],
    constants: [f64; TERMS],
    torque_scale: f64,
}

impl StructuredFollower {
    /// Starts from the constants of a guess.
    pub(super) fn new(
        pole: f64,
        law: Midpoint<f64>,
        guess: &Structured<f64>,
        torque_scale: f64,
    ) -> Result<Self, IdentifierError> {
        let guess = guess.to_array();
        let (identifier, squares) = (Identifier::new(pole, law, 0.0)?, LeastSquares::new(SETTINGS)?);
        Ok(Self { identifier, squares, guess, constants: guess, torque_scale })
    }
}

impl Follower<TERMS> for StructuredFollower {
    fn follow(&mut self, sample: &Sample<f64, TERMS>) -> Step<f64, TERMS> {
        let terms = &sample.regressor;
        let turning = terms[4].abs() > TURNING;
        let remembered = if turning { dot(&self.kept(), terms) } else { 0.0 };
        let step = self.identifier.follow(&Sample { known: sample.known + remembered, ..*sample });
        if turning {
            let (torque, acceleration) = (terms[0] * self.torque_scale, (sample.end - sample.start) / sample.h);
            let learned = self.squares.learn(torque, &balance(terms, acceleration), sample.h, &self.guess);
            self.constants = learned.unwrap_or(self.constants);
        }
        step
    }

    fn certificate(&self, step: &Step<f64, TERMS>, w_star: &[f64; TERMS]) -> Certificate<f64> {
        self.identifier.certificate(step, w_star)
    }

    fn output(&self) -> f64 {
        self.identifier.model().output
    }

    fn acting(&self) -> [f64; TERMS] {
        let (known, law) = (self.kept(), &self.identifier.model().weight);
        std::array::from_fn(|i| known[i] + law[i])
    }

    fn kept(&self) -> [f64; TERMS] {
        let constants = Structured::from_array(self.constants);
        let believed = if constants.a1 < LEAST_INERTIA { Structured::from_array(self.guess) } else { constants };
        believed.weights(self.torque_scale)
    }

    fn constants(&self) -> Option<Structured<f64>> {
        Some(Structured::from_array(self.constants))
    }
}
