//! Where elements of MJCF lie in their bodies.

use nalgebra::{Matrix3, Quaternion, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};
use roxmltree::Node;

use super::defaults::Defaults;
use crate::error::ImportError;
use crate::source::{Place, Source, unit};

/// How a model writes angles, and what its elements inherit.
pub(super) struct Reading<'s, 'a> {
    pub(super) source: &'s Source<'s>,
    pub(super) defaults: Defaults<'a>,
    /// Radians per unit of angle.
    pub(super) angle: f64,
    /// Order of Euler angles, as `eulerseq`.
    pub(super) order: &'a str,
}

impl<'a> Reading<'_, 'a> {
    /// Numbers of an attribute, its own or inherited.
    pub(super) fn list(&self, node: Node<'a, '_>, name: &str) -> Result<Option<Vec<f64>>, ImportError> {
        self.defaults.attribute(node, name).map(|text| self.source.list(node, name, text)).transpose()
    }

    /// As many numbers as are asked for.
    pub(super) fn array<const N: usize>(
        &self,
        node: Node<'a, '_>,
        name: &str,
    ) -> Result<Option<[f64; N]>, ImportError> {
        self.defaults.attribute(node, name).map(|text| self.source.array(node, name, text)).transpose()
    }

    /// One number.
    pub(super) fn number(&self, node: Node<'a, '_>, name: &str) -> Result<Option<f64>, ImportError> {
        Ok(self.array::<1>(node, name)?.map(|[x]| x))
    }

    /// The frame of an element: `pos` and one of `quat`, `axisangle`, `xyaxes`, `zaxis`, `euler`.
    pub(super) fn place(&self, node: Node<'a, '_>) -> Result<Place, ImportError> {
        let [x, y, z] = self.array(node, "pos")?.unwrap_or_default();
        Ok(Place::from_parts(Translation3::new(x, y, z), self.turn(node)?))
    }

    fn turn(&self, node: Node<'a, '_>) -> Result<UnitQuaternion<f64>, ImportError> {
        if let Some([w, i, j, k]) = self.array(node, "quat")? {
            return Ok(UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k)));
        }
        if let Some([x, y, z, angle]) = self.array(node, "axisangle")? {
            let axis = unit([x, y, z]).map(|axis| UnitQuaternion::new(axis * (self.angle * angle)));
            return Ok(axis.unwrap_or_default());
        }
        if let Some([a, b, c, d, e, f]) = self.array(node, "xyaxes")? {
            let x = unit([a, b, c]).unwrap_or_else(Vector3::x);
            let y = (Vector3::new(d, e, f) - x * x.dot(&Vector3::new(d, e, f))).normalize();
            let matrix = Matrix3::from_columns(&[x, y, x.cross(&y)]);
            return Ok(UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(matrix)));
        }
        if let Some(axis) = self.array(node, "zaxis")? {
            return Ok(along(unit(axis).unwrap_or_else(Vector3::z)));
        }
        let Some(angles) = self.array::<3>(node, "euler")? else { return Ok(UnitQuaternion::identity()) };
        // Small letters turn about axes that turn along, capitals about fixed ones.
        let mut out = UnitQuaternion::identity();
        for (letter, angle) in self.order.chars().zip(angles) {
            let axis = match letter.to_ascii_lowercase() {
                'x' => Vector3::x_axis(),
                'y' => Vector3::y_axis(),
                _ => Vector3::z_axis(),
            };
            let one: UnitQuaternion<f64> = UnitQuaternion::from_axis_angle(&axis, self.angle * angle);
            out = if letter.is_lowercase() { out * one } else { one * out };
        }
        Ok(out)
    }
}

/// The shortest turn of z into a direction.
pub(super) fn along(direction: Vector3<f64>) -> UnitQuaternion<f64> {
    let half_turn = || UnitQuaternion::from_axis_angle(&Unit::new_unchecked(Vector3::x()), std::f64::consts::PI);
    UnitQuaternion::rotation_between(&Vector3::z(), &direction).unwrap_or_else(half_turn)
}
