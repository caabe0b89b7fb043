//! Soft ground as one cause: wheels sink and push material before them, and in turns the ground shears under them.
//!
//! It rolls harder, turning costs no more beyond that or less, and the body turns less than the same wheel speeds turn it
//! on hard ground: bulldozing, sinkage and shear of soil after Bekker (*Introduction to Terrain-Vehicle Systems*, 1969)
//! and Wong (*Theory of Ground Vehicles*, chapter 2). No tyre law of the plant makes all three, so the effective track
//! speaks for itself: by how much it differs, not by which law.

use inference::hypothesis::{Dose, Place, Variant, variants};
use robot_model::Robot;
use robot_model::effects::{rolling_resistance, turning_resistance};
use verdict::Quantity;

use crate::compare::scatter;
use crate::model::{Operating, predicted};
use crate::name::Difference;
use crate::settings::NAMING;
use crate::settings::naming::SoftGround;

const SOFT_GROUND: SoftGround = NAMING.soft_ground;

/// Rolling resistance, and what turning costs beside it.
pub(crate) fn parts() -> Option<[Variant; 2]> {
    let all = variants(true);
    let whole = |id: &str| all.iter().find(|v| v.spec().id == id && v.place == Place::Whole).copied();
    Some([whole(rolling_resistance::SPEC.id)?, whole(turning_resistance::SPEC.id)?])
}

/// By how much the effective track of the recordings differs from the references'.
pub(crate) struct Track {
    /// Logarithm of the ratio, weighted mean of the recordings.
    difference: f64,
    /// One sigma of it, with what the plant's laws err.
    sigma: f64,
    /// Where it was measured: here and on the references.
    at: Vec<[Operating; 2]>,
}

impl Track {
    /// From the differences that are tracks; `None` without any.
    pub(crate) fn of(differences: &[&Difference]) -> Option<Self> {
        let scatter = scatter(Quantity::EffectiveTrack);
        let weight = |d: &Difference| 1.0 / (d.here.error.powi(2) + scatter.powi(2));
        let total: f64 = differences.iter().map(|d| weight(d)).sum();
        if differences.is_empty() {
            return None;
        }
        let sum: f64 = differences.iter().map(|d| weight(d) * (d.here.value - d.reference.value)).sum();
        // Recordings share their references, so these errors do not average out.
        let shared = differences.iter().map(|d| d.reference.error).fold(0.0, f64::max);
        Some(Self {
            difference: sum / total,
            sigma: (1.0 / total + shared.powi(2) + SOFT_GROUND.by_law.powi(2)).sqrt(),
            at: differences.iter().map(|d| [d.here.at, d.reference.at]).collect(),
        })
    }

    /// What it says without any cause, nats.
    pub(crate) fn plain(&self) -> f64 {
        self.nats(self.difference)
    }

    /// What effects leave unexplained of it, nats: never more than no effect does, for laws of rigid ground say little of
    /// how far a turn slips.
    pub(crate) fn misfit(&self, robot: &Robot<f64>, doses: &[Dose]) -> f64 {
        let change = |[here, there]: &[Operating; 2]| predicted(robot, doses, *here) - predicted(robot, &[], *there);
        let expected = self.at.iter().map(change).sum::<f64>() / self.at.len() as f64;
        self.nats(self.difference - expected).min(self.plain())
    }

    /// What soft ground leaves of it, whose factor is free but never shortens the track, and what that factor costs: nats.
    pub(crate) fn on_soft_ground(&self) -> f64 {
        let price = (SOFT_GROUND.plausible / self.sigma).ln().max(0.0);
        self.nats(self.difference.min(0.0)) + price
    }

    fn nats(&self, left: f64) -> f64 {
        (0.5 * (left / self.sigma).powi(2)).min(SOFT_GROUND.most)
    }
}
