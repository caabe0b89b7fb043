//! First layers of the identifier's network over a run, whose signals scale them.

use nalgebra::{SMatrix, SVector};
use nn_basis::SigmoidLayer;

use crate::{NetworkRecipe, SIGNALS, Scaling, Signals, SimError, Stream, Trajectory};

/// An affine map of the signals that a layer sees, `z = L⁻¹ (s − centre)`.
struct Whitening {
    centre: SVector<f64, SIGNALS>,
    inverse: SMatrix<f64, SIGNALS, SIGNALS>,
}

impl NetworkRecipe {
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
