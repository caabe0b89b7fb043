//! Which parts of a model are wheels, and how they can turn and swivel.

use nalgebra::{Point3, Vector3};

use crate::model::{Form, Joint, Model, Motion, Shape};
use crate::settings::SETTINGS;

/// A wheel on the ground.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Wheel {
    /// Its link's name.
    pub(crate) name: String,
    /// Its axle, by its place among the joints.
    pub(crate) joint: usize,
    /// Links that turn with it, rollers included.
    pub(crate) links: Vec<usize>,
    /// Its middle.
    pub(crate) centre: Point3<f64>,
    pub(crate) radius: f64,
    /// Where the radius was read.
    pub(crate) radius_of: RadiusOf,
    /// Direction of its axle: turning about it is positive.
    pub(crate) axle: Vector3<f64>,
    /// Direction of the axle of its lowest roller.
    pub(crate) roller: Option<Vector3<f64>>,
    pub(crate) hangs: Hangs,
    /// Where what swivels or steers it is hinged.
    pub(crate) pivot: Option<Point3<f64>>,
    /// Friction coefficients of its shapes.
    pub(crate) friction: Vec<f64>,
}

/// Where a radius comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RadiusOf {
    /// A shape that touches.
    Contact,
    /// A shape that is only seen.
    Sight,
    /// Its rollers.
    Rollers,
    /// The user, for shapes that tell none.
    Told,
}

/// How a wheel hangs on the robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Hangs {
    /// It keeps its direction.
    Fixed,
    /// A joint steers it, by its place among the joints.
    Steered(usize),
    /// It swivels and follows.
    Caster,
}

/// A sphere that slides along the ground: a caster, to many models.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Slider {
    /// Its link's name.
    pub(crate) name: String,
    /// Its middle.
    pub(crate) centre: Point3<f64>,
}

/// What stands on the ground.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ground {
    pub(crate) wheels: Vec<Wheel>,
    /// Spheres that slide along.
    pub(crate) sliders: Vec<Slider>,
    /// Joints that turn without end about a level axis, whose radius is not in the file.
    pub(crate) without_radius: Vec<String>,
    /// Height of the ground in the model, m.
    pub(crate) height: f64,
}

/// Finds the wheels: parts that turn without end about a level axle and reach down to the ground. `told` is a radius for
/// wheels whose shapes tell none.
pub(crate) fn wheels(model: &Model, told: Option<f64>) -> Ground {
    let of_robot = model.of_robot();
    let mut is_of_robot = vec![false; model.links.len()];
    for &link in &of_robot {
        is_of_robot[link] = true;
    }
    let is_level = |j: &Joint| j.is_endless() && j.axis.z.abs() < SETTINGS.wheels.level && is_of_robot[j.child];
    // A roller turns on a wheel: its axle hangs on what turns itself.
    let is_roller = |j: &Joint| model.ancestors(j.parent).any(is_level);
    let axles = || (0..model.joints.len()).filter(|&k| is_level(&model.joints[k]) && !is_roller(&model.joints[k]));

    let mut found: Vec<Wheel> = axles().filter_map(|k| wheel(model, k, told)).collect();
    let lowest = |wheels: &[Wheel]| wheels.iter().map(|w| w.centre.z - w.radius).fold(f64::INFINITY, f64::min);
    let height = lowest(&found);
    found.retain(|w| w.centre.z - w.radius - height < SETTINGS.wheels.on_ground * w.radius);
    let without_radius = axles().filter(|k| wheel(model, *k, told).is_none());
    let without_radius = without_radius.map(|k| model.joints[k].name.clone()).collect();

    let of_wheels: Vec<usize> = found.iter().flat_map(|w| w.links.clone()).collect();
    let slides = |shape: &Shape| match shape.form {
        Form::Sphere(radius) => {
            shape.touches && (shape.place.translation.z - radius - height).abs() < SETTINGS.wheels.on_ground * radius
        }
        _ => false,
    };
    let free = of_robot.iter().filter(|k| !of_wheels.contains(k));
    let sliders = free.flat_map(|&k| {
        let of = |shape: &Shape| Slider {
            name: model.links[k].name.clone(),
            centre: Point3::from(shape.place.translation.vector),
        };
        model.links[k].shapes.iter().filter(|shape| slides(shape)).map(of).collect::<Vec<_>>()
    });
    let sliders = sliders.collect();
    Ground { wheels: found, sliders, without_radius, height }
}

fn wheel(model: &Model, k: usize, told: Option<f64>) -> Option<Wheel> {
    let joint = &model.joints[k];
    let rigid = model.rigid(joint.child);
    let links = model.group(joint.child, |_| true);
    // What hangs on a wheel are rollers, which turn across its axle without end; what else moves there makes it a leg.
    let is_part = |j: &Joint| {
        let across = j.axis.cross(&joint.axis).norm() > SETTINGS.wheels.level;
        j.child == joint.child || j.motion == Motion::Fixed || (j.is_endless() && across)
    };
    if !model.joints.iter().filter(|j| links.contains(&j.child)).all(is_part) {
        return None;
    }
    let shapes =
        |links: &[usize]| -> Vec<Shape> { links.iter().flat_map(|&k| model.links[k].shapes.iter().cloned()).collect() };

    let own = shapes(&rigid);
    let of = |touches: bool| {
        let round = own.iter().filter(|s| s.touches == touches).filter_map(|s| Some((s, radius(s, joint)?)));
        round.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(shape, radius)| (shape.place.translation.vector.into(), radius))
    };
    let with = |found: Option<(Point3<f64>, f64)>, of: RadiusOf| found.map(|(centre, radius)| (centre, radius, of));
    let roller = lowest_roller(model, joint, &links);
    let on_axle = Point3::from(model.links[joint.child].place.translation.vector);
    let by_roller = roller.map(|(_, radius)| (on_axle, radius));
    let (centre, radius, radius_of) = with(by_roller, RadiusOf::Rollers)
        .or_else(|| with(of(true), RadiusOf::Contact))
        .or_else(|| with(of(false), RadiusOf::Sight))
        .or_else(|| with(told.map(|radius| (on_axle, radius)), RadiusOf::Told))?;

    Some(Wheel {
        name: model.links[joint.child].name.clone(),
        joint: k,
        centre,
        radius,
        radius_of,
        axle: joint.axis,
        roller: roller.map(|(axle, _)| axle),
        hangs: hangs(model, joint, &centre, radius),
        pivot: swivel(model, joint).map(|swivel| swivel.at),
        friction: shapes(&links).into_iter().filter(|s| s.touches).flat_map(|s| s.friction).collect(),
        links,
    })
}

/// Radius of a shape about an axle; `None` of one that is no wheel on it.
fn radius(shape: &Shape, joint: &Joint) -> Option<f64> {
    let radius = match shape.form {
        Form::Sphere(radius) => radius,
        Form::Round(radius) => {
            let along = shape.place.rotation * Vector3::z();
            (along.cross(&joint.axis).norm() < SETTINGS.wheels.level).then_some(radius)?
        }
        Form::Other => return None,
    };
    let from = shape.place.translation.vector - joint.at.coords;
    let off = from - joint.axis * from.dot(&joint.axis);
    (radius > 0.0 && off.norm() < SETTINGS.wheels.centred * radius).then_some(radius)
}

/// Axle of the lowest roller of a wheel, and the wheel's radius over it.
fn lowest_roller(model: &Model, axle: &Joint, links: &[usize]) -> Option<(Vector3<f64>, f64)> {
    let is_roller = |j: &&Joint| j.child != axle.child && links.contains(&j.child) && j.is_endless();
    let lowest = model.joints.iter().filter(is_roller).min_by(|a, b| a.at.z.total_cmp(&b.at.z))?;
    let from = lowest.at - axle.at;
    let reach = (from - axle.axis * from.dot(&axle.axis)).norm();
    let shapes = model.rigid(lowest.child).into_iter().flat_map(|k| model.links[k].shapes.iter());
    let own = shapes.filter_map(|s| radius(s, lowest)).fold(0.0, f64::max);
    (reach + own > 0.0).then_some((lowest.axis, reach + own))
}

/// What above an axle turns about an upright axis.
fn swivel<'a>(model: &'a Model, axle: &Joint) -> Option<&'a Joint> {
    let is_swivel = |j: &&Joint| j.motion == Motion::Turn && j.axis.z.abs() > SETTINGS.wheels.upright;
    model.ancestors(axle.parent).find(is_swivel)
}

/// Whether something above an axle turns about an upright axis.
fn hangs(model: &Model, axle: &Joint, centre: &Point3<f64>, radius: f64) -> Hangs {
    let Some(swivel) = swivel(model, axle) else { return Hangs::Fixed };
    // Along the way it rolls: a wheel beside its steering axis is none that follows.
    let ahead = axle.axis.cross(&Vector3::z()).normalize();
    let trail = (centre - swivel.at).dot(&ahead).abs();
    if swivel.is_endless() && trail > SETTINGS.wheels.trail * radius {
        return Hangs::Caster;
    }
    Hangs::Steered(model.joints.iter().position(|j| j.child == swivel.child).unwrap_or_default())
}
