//! A robot of any wheels in SDF: a world with the robot on it, for Gazebo.

use std::f64::consts::FRAC_PI_2;
use std::io;

use super::vehicle::{Caster, Vehicle, Wheel};
use crate::gazebo::{LYING, NO_LIMIT, WIDTH, slip_of};
use crate::number::{number, numbers};
use crate::sdf::{ANY_FRICTION, friction, inertial, pose};
use crate::xml::{Element, element};

/// The world as a document.
pub(super) fn document(v: &Vehicle, heading: Vec<String>) -> io::Result<String> {
    let plane = element("geometry").child(element("plane").leaf("normal", "0 0 1").leaf("size", "200 200"));
    let floor =
        element("collision").with("name", "floor").child(plane).child(friction(ANY_FRICTION, ANY_FRICTION, None));
    let ground = element("model")
        .with("name", "ground")
        .leaf("static", "true")
        .child(element("link").with("name", "ground").child(floor));
    let world = element("world")
        .with("name", "lacuna")
        .child(element("physics").with("name", "steps").with("type", "ode").leaf("max_step_size", "0.001"))
        .value("gravity", &v.gravity())
        .child(ground)
        .child(robot(v));
    // Directions of friction are an extension of Gazebo.
    let root = element("sdf").with("version", "1.11").with("xmlns:gz", "http://gazebosim.org/schema");
    root.child(world).document(heading)
}

fn robot(v: &Vehicle) -> Element {
    let imu = element("sensor").with("name", "imu").with("type", "imu").leaf("update_rate", "100");
    let chassis = element("link")
        .with("name", "chassis")
        .child(inertial(&v.chassis, [0.0; 3]))
        .children(v.casters.iter().map(caster))
        .child(imu);
    let [x, y, yaw] = v.point;
    let point = element("frame").with("name", "pose").with("attached_to", "chassis");
    let mut out = element("model")
        .with("name", &*v.name)
        .child(chassis)
        .child(point.leaf("pose", pose([x, y, 0.0], [0.0, 0.0, yaw])));
    for w in &v.wheels {
        if w.joint.is_some() {
            out = out.child(knuckle(v, w)).child(steering(w));
        }
        out = out.child(wheel(w)).child(axle(v, w));
    }
    out.child(slip_of(v.wheels.iter().map(Wheel::slip)))
}

/// A caster: a sphere that slides as hard as it rolls.
fn caster(c: &Caster) -> Element {
    element("collision")
        .with("name", &*c.name)
        .leaf("pose", pose(c.centre, [0.0; 3]))
        .child(element("geometry").child(element("sphere").value("radius", &[c.centre[2]])))
        .child(friction(c.friction, c.friction, None))
}

fn steer(w: &Wheel) -> String {
    format!("steer_{}", w.name)
}

fn knuckle(v: &Vehicle, w: &Wheel) -> Element {
    let place = w.part.centre;
    let link = element("link").with("name", steer(w)).leaf("pose", pose(place, [0.0; 3]));
    link.child(inertial(&v.knuckle(place), place))
}

fn steering(w: &Wheel) -> Element {
    let limit =
        element("limit").value("lower", &[-FRAC_PI_2]).value("upper", &[FRAC_PI_2]).leaf("effort", number(NO_LIMIT));
    element("joint")
        .with("name", format!("{}_joint", steer(w)))
        .with("type", "revolute")
        .leaf("parent", "chassis")
        .leaf("child", steer(w))
        .child(element("axis").leaf("xyz", "0 0 1").child(limit))
}

fn wheel(w: &Wheel) -> Element {
    let place = w.part.centre;
    let shape = |kind: &'static str| {
        let cylinder = element("cylinder").value("radius", &[w.radius]).value("length", &[WIDTH]);
        element(kind)
            .with("name", kind)
            .leaf("pose", pose([0.0; 3], [LYING, 0.0, 0.0]))
            .child(element("geometry").child(cylinder))
    };
    element("link")
        .with("name", &*w.name)
        .leaf("pose", pose(place, [0.0, 0.0, w.direction]))
        .child(inertial(&w.part, place))
        .child(shape("visual"))
        .child(shape("collision").child(held(w)))
}

/// Friction along the axle and across it; of rollers along their axles, whose direction in the robot stays, and across them.
fn held(w: &Wheel) -> Element {
    let [first, second] = w.friction;
    let Some([x, y]) = w.first else {
        // The cylinder lies: its z is the axle.
        return friction(first, second, Some("0 0 1"));
    };
    let direction = element("fdir1").with("gz:expressed_in", "chassis").text(numbers(&[x, y, 0.0]));
    let ode = element("ode").value("mu", &[first]).value("mu2", &[second]).child(direction);
    element("surface").child(element("friction").child(ode))
}

fn axle(v: &Vehicle, w: &Wheel) -> Element {
    let dynamics = element("dynamics").value("damping", &[w.viscous]).value("friction", &[w.dry]);
    let mut axis = element("axis").leaf("xyz", "0 1 0").child(dynamics);
    if let Some(motor) = w.motor.map(|k| &v.motors[k]) {
        let first = &v.wheels[motor.wheels[0]].name;
        axis = if motor.is_rigid && *first != w.name {
            let leads = element("mimic").with("joint", format!("{first}_joint")).with("axis", "axis");
            axis.child(leads.leaf("multiplier", "1").leaf("offset", "0").leaf("reference", "0"))
        } else {
            axis.child(element("limit").leaf("effort", number(NO_LIMIT)))
        };
    }
    let parent = if w.joint.is_some() { steer(w) } else { "chassis".to_owned() };
    element("joint")
        .with("name", format!("{}_joint", w.name))
        .with("type", "revolute")
        .leaf("parent", parent)
        .leaf("child", &*w.name)
        .child(axis)
}
