//! Masses and inertias, and their sums.

use nalgebra::{Matrix3, Point3, Vector3};

use crate::source::Place;

/// A rigid part: mass in kg, centre of mass in m, inertia about it in kg m², in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Solid {
    pub(crate) mass: f64,
    pub(crate) centre: Point3<f64>,
    pub(crate) inertia: Matrix3<f64>,
}

/// A symmetric matrix of moments: about the axes x, y and z, then the products xy, xz and yz.
pub(crate) fn moments([xx, yy, zz]: [f64; 3], [xy, xz, yz]: [f64; 3]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

impl Solid {
    /// A part whose frame of inertia lies at `place`.
    pub(crate) fn at(place: &Place, mass: f64, inertia: Matrix3<f64>) -> Self {
        let turn = place.rotation.to_rotation_matrix();
        let turn = turn.matrix();
        Self { mass, centre: place.translation.vector.into(), inertia: turn * inertia * turn.transpose() }
    }

    /// The same, seen from the frame in which its own lies at `place`.
    pub(crate) fn seen_from(self, place: &Place) -> Self {
        let turn = place.rotation.to_rotation_matrix();
        let turn = turn.matrix();
        Self { mass: self.mass, centre: place * self.centre, inertia: turn * self.inertia * turn.transpose() }
    }

    /// Inertia about another point (Steiner): `J + m (|d|² 1 − d dᵀ)`.
    fn about(&self, point: &Point3<f64>) -> Matrix3<f64> {
        let d = self.centre - point;
        self.inertia + self.mass * (Matrix3::identity() * d.norm_squared() - d * d.transpose())
    }

    /// Inertia about an axis of direction `along` through a point.
    pub(crate) fn about_axis(&self, point: &Point3<f64>, along: &Vector3<f64>) -> f64 {
        (along.transpose() * self.about(point) * along)[0]
    }

    /// All parts as one; `None` without any mass.
    pub(crate) fn sum(parts: &[Self]) -> Option<Self> {
        let mass: f64 = parts.iter().map(|p| p.mass).sum();
        if mass <= 0.0 {
            return None;
        }
        let centre = Point3::from(parts.iter().map(|p| p.mass * p.centre.coords).sum::<Vector3<f64>>() / mass);
        Some(Self { mass, centre, inertia: parts.iter().map(|p| p.about(&centre)).sum() })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Point3, Vector3};

    use super::Solid;
    use crate::source::place;

    #[test]
    fn two_masses_on_a_rod_turn_about_their_middle() {
        let point = |x: f64, mass: f64| Solid { mass, centre: Point3::new(x, 0.0, 0.0), inertia: Matrix3::zeros() };
        let both = Solid::sum(&[point(0.0, 1.0), point(3.0, 2.0)]).expect("a mass");
        approx::assert_relative_eq!(both.centre.x, 2.0);
        // Reduced mass 2/3 kg at 3 m.
        approx::assert_relative_eq!(both.about_axis(&both.centre, &Vector3::z()), 6.0, epsilon = 1e-12);
        assert!(Solid::sum(&[]).is_none());
    }

    #[test]
    fn a_turned_part_takes_its_inertia_along() {
        let lying = place([1.0, 0.0, 0.0], [std::f64::consts::FRAC_PI_2, 0.0, 0.0]);
        let disc = Solid::at(&lying, 2.0, Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 3.0)));
        // Its z axis lies along −y now.
        approx::assert_relative_eq!(disc.about_axis(&disc.centre, &Vector3::y()), 3.0, epsilon = 1e-12);
        approx::assert_relative_eq!(disc.about_axis(&Point3::origin(), &Vector3::z()), 1.0 + 2.0, epsilon = 1e-12);
    }
}
