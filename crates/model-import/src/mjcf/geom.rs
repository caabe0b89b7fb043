//! Shapes of MJCF, and the masses that follow from them.

use nalgebra::{Matrix3, Vector3};
use roxmltree::Node;

use super::frame::{Reading, along};
use crate::error::ImportError;
use crate::model::{Form, Shape};
use crate::solid::Solid;
use crate::source::Place;

/// Density of a geom that states neither mass nor density, kg/m³: MuJoCo's default.
const DENSITY: f64 = 1000.0;

/// A geom.
pub(super) struct Geom<'a> {
    pub(super) name: Option<&'a str>,
    pub(super) shape: Shape,
    /// `None` of meshes and planes, whose volume is not in the file.
    pub(super) solid: Option<Solid>,
}

/// Reads a geom of a body that lies at `body`.
pub(super) fn read<'a>(reading: &Reading<'_, 'a>, node: Node<'a, '_>, body: &Place) -> Result<Geom<'a>, ImportError> {
    let kind = reading.defaults.attribute(node, "type").unwrap_or("sphere");
    let size = reading.list(node, "size")?.unwrap_or_default();
    let mut place = reading.place(node)?;
    let mut half = size.get(1).copied().unwrap_or_default();
    if let Some([a, b, c, d, e, f]) = reading.array(node, "fromto")? {
        let (from, to) = (Vector3::new(a, b, c), Vector3::new(d, e, f));
        let axis = (to - from).try_normalize(0.0).unwrap_or_else(Vector3::z);
        place = Place::from_parts((0.5 * (from + to)).into(), along(axis));
        half = 0.5 * (to - from).norm();
    }
    let radius = size.first().copied().unwrap_or_default();
    let (volume, moments) = volume(kind, radius, half, &size);
    let mass = match reading.number(node, "mass")? {
        Some(mass) => mass,
        None => reading.number(node, "density")?.unwrap_or(DENSITY) * volume,
    };

    let form = match kind {
        "sphere" => Form::Sphere(radius),
        "cylinder" | "capsule" => Form::Round(radius),
        _ => Form::Other,
    };
    let whole = body * place;
    let solid = (volume > 0.0 && mass > 0.0)
        .then(|| Solid::at(&whole, mass, Matrix3::from_diagonal(&(Vector3::from(moments) * mass))));
    let collides = |name: &str| reading.defaults.attribute(node, name) != Some("0");
    let friction = reading.list(node, "friction")?.and_then(|f| f.first().copied());
    let shape = Shape {
        form,
        place: whole,
        touches: collides("contype") || collides("conaffinity"),
        friction: friction.into_iter().collect(),
    };
    Ok(Geom { name: node.attribute("name"), shape, solid })
}

/// Volume, m³, and moments of inertia per mass about the middle, m², of a solid body of even density.
fn volume(kind: &str, r: f64, half: f64, size: &[f64]) -> (f64, [f64; 3]) {
    use std::f64::consts::PI;
    let at = |k: usize| size.get(k).copied().unwrap_or_default();
    let [x, y, z] = [at(0), at(1), at(2)];
    match kind {
        "sphere" => (4.0 / 3.0 * PI * r.powi(3), [0.4 * r * r; 3]),
        "ellipsoid" => (4.0 / 3.0 * PI * x * y * z, [y * y + z * z, x * x + z * z, x * x + y * y].map(|s| s / 5.0)),
        "box" => (8.0 * x * y * z, [y * y + z * z, x * x + z * z, x * x + y * y].map(|s| s / 3.0)),
        "cylinder" => {
            let across = r * r / 4.0 + half * half / 3.0;
            (2.0 * PI * r * r * half, [across, across, 0.5 * r * r])
        }
        "capsule" => {
            // A cylinder and two half spheres, by their shares of the volume.
            let (tube, balls) = (2.0 * PI * r * r * half, 4.0 / 3.0 * PI * r.powi(3));
            let share = |of: f64| of / (tube + balls);
            let across = share(tube) * (r * r / 4.0 + half * half / 3.0)
                + share(balls) * (0.4 * r * r + half * half + 0.75 * half * r);
            let about = share(tube) * 0.5 * r * r + share(balls) * 0.4 * r * r;
            (tube + balls, [across, across, about])
        }
        _ => (0.0, [0.0; 3]),
    }
}
