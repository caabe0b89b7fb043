//! What the identifier's network sees and how its first layer is drawn.

use nn_basis::{Activation, BasisError, SigmoidLayer};
use serde::{Deserialize, Serialize};

use crate::recipe::{UNITS, WIDE, positive};
use crate::{SimError, Stream};

/// Number of signals that a network may see; see [`Input`].
pub const SIGNALS: usize = 6;

/// Signals at one output, its own wheel first.
pub type Signals = [f64; SIGNALS];

/// A signal that the network may see, at one of its outputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Input {
    /// Angle of the wheel that is followed, rad.
    OwnAngle,
    /// Angle of the other wheel, rad.
    OtherAngle,
    /// Speed of the wheel that is followed, rad/s.
    OwnSpeed,
    /// Speed of the other wheel, rad/s.
    OtherSpeed,
    /// Torque of the followed side, N m.
    OwnTorque,
    /// Torque of the other side, N m.
    OtherTorque,
}

/// How inputs are brought to the order of one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scaling {
    /// By magnitudes known beforehand: `speed_scale · v_max/r`, `torque_scale · μ_p m g r`, and angles by the speed
    /// times the duration.
    #[default]
    APriori,
    /// Not at all.
    Raw,
    /// To zero mean and unit covariance over the run: for comparison, since nobody knows a run beforehand.
    Whitened,
}

/// A fixed first layer drawn at random.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NetworkRecipe {
    /// Neurons per output, 6 or 12.
    pub units: usize,
    /// Function of a neuron is tanh instead of logistic.
    pub tanh: bool,
    /// What it sees besides the threshold.
    pub inputs: Vec<Input>,
    /// How inputs are scaled.
    pub scaling: Scaling,
    /// First-layer weights and thresholds are uniform between these.
    pub first_layer: [f64; 2],
    /// Speed inputs are divided by this times v_max/r.
    pub speed_scale: f64,
    /// Torque inputs are divided by this times μ_p m g r.
    pub torque_scale: f64,
}

impl Default for NetworkRecipe {
    fn default() -> Self {
        Self {
            units: UNITS,
            tanh: false,
            inputs: vec![Input::OwnSpeed, Input::OtherSpeed, Input::OwnTorque, Input::OtherTorque],
            scaling: Scaling::APriori,
            first_layer: [-1.0, 1.0],
            speed_scale: 1.4,
            torque_scale: 0.5,
        }
    }
}

impl NetworkRecipe {
    pub(crate) fn check(&self) -> Result<(), SimError> {
        positive("identifier.network.speed_scale", self.speed_scale)?;
        positive("identifier.network.torque_scale", self.torque_scale)?;
        let [low, high] = self.first_layer;
        if !(low.is_finite() && high.is_finite() && low < high) {
            return Err(SimError::Recipe(format!(
                "identifier.network.first_layer is [{low}, {high}], but it must be two finite numbers in rising order"
            )));
        }
        if ![UNITS, WIDE].contains(&self.units) {
            return Err(SimError::Recipe(format!(
                "identifier.network.units is {}, but this program is built for {UNITS} or {WIDE}",
                self.units
            )));
        }
        Ok(())
    }

    /// Draws a layer whose signals have the magnitudes `scale`, in the order of [`Input`].
    ///
    /// # Errors
    /// [`BasisError`] if a scale is not positive.
    pub fn layer<const N: usize>(
        &self,
        stream: &mut Stream,
        scale: Signals,
    ) -> Result<SigmoidLayer<f64, SIGNALS, N>, BasisError> {
        let (threshold, weight) = self.draw(stream);
        SigmoidLayer::new(threshold, weight, scale, self.activation())
    }

    pub(crate) fn activation(&self) -> Activation {
        if self.tanh { Activation::Tanh } else { Activation::Logistic }
    }

    pub(crate) fn draw<const N: usize>(&self, stream: &mut Stream) -> ([f64; N], [Signals; N]) {
        let [low, high] = self.first_layer;
        let threshold = std::array::from_fn(|_| stream.uniform(low, high));
        let mut weight = [[0.0; SIGNALS]; N];
        for row in &mut weight {
            for input in &self.inputs {
                row[*input as usize] = stream.uniform(low, high);
            }
        }
        (threshold, weight)
    }
}
