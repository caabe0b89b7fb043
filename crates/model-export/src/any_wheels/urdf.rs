//! A robot of any wheels in URDF, with tags for Gazebo.

use std::f64::consts::FRAC_PI_2;
use std::io;

use super::vehicle::{Caster, Vehicle, Wheel};
use crate::gazebo::{LYING, NO_LIMIT, WIDTH, slip_of};
use crate::urdf::{ANY_SPEED, inertial, joint, origin};
use crate::xml::{Element, element};

/// The model as a document.
pub(super) fn document(v: &Vehicle, heading: Vec<String>) -> io::Result<String> {
    let chassis = element("link").with("name", "chassis").child(inertial(&v.chassis, [0.0; 3]));
    let [x, y, yaw] = v.point;
    let pose = joint("pose", "fixed").child(origin([x, y, 0.0], [0.0, 0.0, yaw]));
    let mut root = element("robot")
        .with("name", &*v.name)
        .child(chassis)
        .child(element("link").with("name", "imu"))
        .child(joint("imu", "fixed").child(origin([0.0; 3], [0.0; 3])))
        .child(element("link").with("name", "pose"))
        .child(pose);
    for c in &v.casters {
        root = root.child(caster(c)).child(joint(&c.name, "fixed").child(origin(c.centre, [0.0; 3])));
    }
    for w in &v.wheels {
        root = hung(root, v, w);
    }
    root = root.comments(["mu1 is along fdir1, mu2 across it.".to_owned()]);
    for c in &v.casters {
        root = root.child(friction(&c.name, [c.friction; 2], "0 1 0"));
    }
    for w in &v.wheels {
        // Rollers that lie across their wheel hold where it rolls, and not along its axle.
        let [first, second] = w.friction;
        let along = if w.first.is_some() { [second, first] } else { [first, second] };
        root = root.child(friction(&w.name, along, "0 1 0"));
    }
    root.child(element("gazebo").child(slip_of(v.wheels.iter().map(Wheel::slip)))).document(heading)
}

fn friction(link: &str, [along, across]: [f64; 2], direction: &str) -> Element {
    element("gazebo").with("reference", link).value("mu1", &[along]).value("mu2", &[across]).leaf("fdir1", direction)
}

/// A caster: a sphere that slides as hard as it rolls.
fn caster(c: &Caster) -> Element {
    let shape = |kind: &'static str| {
        element(kind).child(element("geometry").child(element("sphere").num("radius", c.centre[2])))
    };
    element("link").with("name", &*c.name).child(shape("visual")).child(shape("collision"))
}

/// A wheel with its joints.
fn hung(mut root: Element, v: &Vehicle, w: &Wheel) -> Element {
    let place = w.part.centre;
    let steer = format!("steer_{}", w.name);
    if w.joint.is_some() {
        let turns =
            joint(&steer, "revolute").child(origin(place, [0.0; 3])).child(element("axis").with("xyz", "0 0 1")).child(
                element("limit")
                    .num("lower", -FRAC_PI_2)
                    .num("upper", FRAC_PI_2)
                    .num("effort", NO_LIMIT)
                    .num("velocity", ANY_SPEED),
            );
        root = root.child(element("link").with("name", &*steer).child(inertial(&v.knuckle(place), place))).child(turns);
    }
    let shape = |kind: &'static str| {
        let cylinder = element("cylinder").num("radius", w.radius).num("length", WIDTH);
        element(kind).child(origin([0.0; 3], [LYING, 0.0, 0.0])).child(element("geometry").child(cylinder))
    };
    let link = element("link")
        .with("name", &*w.name)
        .child(inertial(&w.part, place))
        .child(shape("visual"))
        .child(shape("collision"));
    root.child(link).child(axle(v, w, &steer))
}

fn axle(v: &Vehicle, w: &Wheel, steer: &str) -> Element {
    let (parent, place) = if w.joint.is_some() { (steer, [0.0; 3]) } else { ("chassis", w.part.centre) };
    let axle = element("joint")
        .with("name", format!("{}_joint", w.name))
        .with("type", "continuous")
        .child(element("parent").with("link", parent))
        .child(element("child").with("link", &*w.name))
        .child(origin(place, [0.0, 0.0, w.direction]))
        .child(element("axis").with("xyz", "0 1 0"))
        .child(element("dynamics").num("damping", w.viscous).num("friction", w.dry));
    let Some(motor) = w.motor.map(|k| &v.motors[k]) else { return axle };
    let first = &v.wheels[motor.wheels[0]].name;
    if motor.is_rigid && *first != w.name {
        let leads = format!("{first}_joint");
        return axle.child(element("mimic").with("joint", leads).num("multiplier", 1.0).num("offset", 0.0));
    }
    axle.child(element("limit").num("effort", NO_LIMIT).num("velocity", ANY_SPEED))
}
