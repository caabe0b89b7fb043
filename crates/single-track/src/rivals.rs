//! Classical models of cars, fitted to the same drives, with the same drive train and the same starts of forecasts.

use rayon::prelude::*;

use crate::constants::Quantity;
use crate::model::{Lateral, Laws};
use crate::rows::Shown;
use crate::settings::SETTINGS;
use hierarchical_fit::{Data, Fit, Kind, OUTLIER};
use inference::least_squares::{Constant as Free, Loss, Residuals, Settings};

/// Name of a rival, its tyres, and what it fits of its own.
pub(crate) struct Rival {
    pub(crate) name: &'static str,
    lateral: Lateral,
    free: &'static [Quantity],
}

/// The models by the names under which they are known.
pub(crate) const RIVALS: [Rival; 2] = [
    Rival {
        name: "kinematic bicycle with understeer gradient",
        lateral: Lateral::Kinematic,
        free: &[Quantity::FullSteering, Quantity::Centre, Quantity::SteeringDelay, Quantity::FrontCompliance],
    },
    Rival {
        name: "dynamic bicycle with Pacejka tyres",
        lateral: Lateral::Pacejka,
        free: &[
            Quantity::FullSteering,
            Quantity::Centre,
            Quantity::SteeringDelay,
            Quantity::FrontCompliance,
            Quantity::RearCompliance,
            Quantity::FrontInverseGrip,
            Quantity::RearInverseGrip,
            Quantity::Gyration,
        ],
    },
];

impl Rival {
    /// The rival fitted to the drives: its steering is a line with a dead time, the drive train and the tracked point are those
    /// of the fit.
    pub(crate) fn fitted(&self, data: &Data<Shown<'_>>, fit: &Fit) -> Option<Laws> {
        let place = |q: &Quantity| data.model.iter().position(|c| c.quantity == *q);
        let own: Vec<usize> = self.free.iter().filter_map(place).collect();
        let laws = |values: &[f64]| {
            let mut theta = fit.theta.clone();
            for (c, deviation) in data.model.iter().zip(&mut theta) {
                use Quantity as Q;
                if matches!(c.quantity, Q::Curve | Q::Asymmetry | Q::SteeringLag | Q::Slowness | Q::Play) {
                    *deviation = -c.given;
                }
            }
            own.iter().zip(values).for_each(|(&k, v)| theta[k] = *v);
            Laws { lateral: self.lateral, ..Laws::at(&data.model, &theta) }
        };
        let scale = fit.noise.sigma[Kind::Pose as usize];
        let residuals = |values: &[f64]| -> Vec<f64> {
            let laws = laws(values);
            let of = |s: &Shown<'_>| -> Vec<f64> {
                let rows = s.rows.iter().zip(s.errors_of(&laws));
                rows.filter(|(r, _)| r.kind == Kind::Pose).map(|(_, e)| e / scale).collect()
            };
            data.drives.par_iter().flat_map_iter(of).collect()
        };
        let start = |&k: &usize| {
            let c = &data.model[k];
            Free { difference: SETTINGS.windows.difference, longest: 1.0, ..Free::new(fit.theta[k], c.usual) }
        };
        let free: Vec<Free> = own.iter().map(start).collect();
        let problem = Residuals::new(free, residuals).with_loss(Loss::SoftL1(OUTLIER));
        Some(laws(&problem.fit(&Settings::default()).ok()?.values))
    }
}
