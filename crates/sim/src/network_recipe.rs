//! What the identifier's network sees and how its first layer is drawn.

use nalgebra::{SMatrix, SVector};
use nn_basis::{Activation, BasisError, SigmoidLayer};
use serde::{Deserialize, Serialize};

use crate::recipe::{UNITS, WIDE, positive};
use crate::{SimError, Stream, Trajectory};

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

/// An affine map of the signals that a layer sees, `z = L⁻¹ (s − centre)`.
struct Whitening {
    centre: SVector<f64, SIGNALS>,
    inverse: SMatrix<f64, SIGNALS, SIGNALS>,
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

    /// The layers of both outputs over a run; the same stream and recipe give the same layers.
    ///
    /// # Errors
    /// [`SimError`] if the inputs cannot be whitened because one follows from the others.
    pub fn layers<const N: usize>(
        &self,
        run: &Trajectory,
        stream: &mut Stream,
    ) -> Result<[SigmoidLayer<f64, SIGNALS, N>; 2], SimError> {
        let mut layer = |output| match self.scaling {
            Scaling::APriori => Ok(self.layer(stream, self.scale(run))?),
            Scaling::Raw => Ok(self.layer(stream, [1.0; SIGNALS])?),
            Scaling::Whitened => self.whitened(stream, run, output),
        };
        Ok([layer(0)?, layer(1)?])
    }

    fn activation(&self) -> Activation {
        if self.tanh { Activation::Tanh } else { Activation::Logistic }
    }

    fn draw<const N: usize>(&self, stream: &mut Stream) -> ([f64; N], [Signals; N]) {
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

    fn whitened<const N: usize>(
        &self,
        stream: &mut Stream,
        run: &Trajectory,
        output: usize,
    ) -> Result<SigmoidLayer<f64, SIGNALS, N>, SimError> {
        let Some(Whitening { centre, inverse }) = self.whitening(run, output) else {
            return Err(SimError::Recipe(
                "inputs cannot be whitened: one of them follows from the others in this run".into(),
            ));
        };
        let (mut threshold, mut weight) = self.draw(stream);
        for (row, t) in weight.iter_mut().zip(&mut threshold) {
            let through = SMatrix::<f64, 1, SIGNALS>::from(*row) * inverse;
            *t -= (through * centre)[0];
            *row = std::array::from_fn(|i| through[i]);
        }
        Ok(SigmoidLayer::new(threshold, weight, [1.0; SIGNALS], self.activation())?)
    }

    /// The magnitudes known beforehand, in the order of [`Input`].
    pub(crate) fn scale(&self, run: &Trajectory) -> Signals {
        let p = &run.parameters;
        let speed = self.speed_scale * run.speed / p.wheel_radius;
        let torque = self.torque_scale * p.adhesion * p.mass * p.gravity * p.wheel_radius;
        let angle = speed * run.step * run.torques.len() as f64;
        [angle, angle, speed, speed, torque, torque]
    }

    fn whitening(&self, run: &Trajectory, output: usize) -> Option<Whitening> {
        let n = run.torques.len() as f64;
        let all = || (0..run.torques.len()).map(|k| SVector::from(run.signals(k)[output]));
        let centre = all().sum::<SVector<f64, SIGNALS>>() / n;
        let mut covariance = SMatrix::<f64, SIGNALS, SIGNALS>::identity();
        let used = |i: usize| self.inputs.iter().any(|input| *input as usize == i);
        for i in (0..SIGNALS).filter(|i| used(*i)) {
            for j in (0..SIGNALS).filter(|j| used(*j)) {
                covariance[(i, j)] = all().map(|s| (s[i] - centre[i]) * (s[j] - centre[j])).sum::<f64>() / n;
            }
        }
        let inverse = covariance.cholesky()?.l().try_inverse()?;
        Some(Whitening { centre, inverse })
    }
}
