//! URDF, with what it cannot say in gazebo tags.

use std::io;

use robot_model::effect::export::{Engine, Section};

use crate::added;
use crate::contact::{casters, driven_wheels, grips, motors, names, wheels};
use crate::gazebo::{LYING, NO_LIMIT, WIDTH, imu_angles, shape_place, slip_plugin};
use crate::inertia::{Part, Parts};
use crate::model::Model;
use crate::vehicle::Vehicle;
use crate::xml::{Element, element};

/// URDF asks for a limit of the speed, rad/s: none that matters.
pub(crate) const ANY_SPEED: f64 = 1000.0;

/// The model as a document.
pub(crate) fn document(model: &Model<'_>, v: &Vehicle) -> io::Result<String> {
    let parts = Parts::new(v, true);
    let mut root =
        element("robot").with("name", model.name).comments(v.comments(Section::Body)).child(chassis(v, &parts));
    if let Some(load) = &parts.payload {
        root = root
            .child(element("link").with("name", "payload").child(inertial(load, [0.0; 3])))
            .child(joint("payload", "fixed").child(origin([0.0; 3], [0.0; 3])));
    }
    root = root
        .comments(v.comments(Section::Sensors))
        .child(element("link").with("name", "imu"))
        .child(joint("imu", "fixed").child(origin([0.0; 3], imu_angles(v))))
        .comments(v.comments(Section::Wheels))
        .comments(v.comments(Section::Drive));
    let (on_casters, on_wheels) = (casters(&v.robot), wheels(&v.robot));
    for i in on_casters.clone() {
        root = root
            .child(caster(v, i))
            .child(joint(names(&v.robot)[i], "fixed").child(origin(parts.wheels[i].centre, [0.0; 3])));
    }
    for i in on_wheels.clone() {
        root = root.child(wheel(v, &parts, i)).child(axle(v, &parts, i));
    }
    root = root.comments(v.comments(Section::Ground)).comments(["mu1 is along the axle, mu2 across it.".to_owned()]);
    let all = grips(v);
    for i in on_casters.chain(on_wheels) {
        let [along, across] = all[i].friction;
        root = root.child(
            element("gazebo")
                .with("reference", names(&v.robot)[i])
                .value("mu1", &[along])
                .value("mu2", &[across])
                .leaf("fdir1", "0 1 0"),
        );
    }
    root = root.child(element("gazebo").child(slip_plugin(v, &all)));
    added::comments(root, v, Engine::Urdf).document(vec![format!(
        "{}: written by lacuna export. Units SI; x forward, y left, z up; the link chassis has its origin on the ground below \
         the middle of the wheels. {}.",
        model.name,
        driven_wheels(&v.robot)
    )])
}

pub(crate) fn origin(xyz: [f64; 3], rpy: [f64; 3]) -> Element {
    element("origin").nums("xyz", &xyz).nums("rpy", &rpy)
}

pub(crate) fn inertial(part: &Part, link: [f64; 3]) -> Element {
    let [x, y, z] = part.inertia;
    let centre: [f64; 3] = std::array::from_fn(|k| part.centre[k] - link[k]);
    element("inertial").child(origin(centre, [0.0; 3])).child(element("mass").num("value", part.mass)).child(
        element("inertia").num("ixx", x).num("ixy", 0.0).num("ixz", 0.0).num("iyy", y).num("iyz", 0.0).num("izz", z),
    )
}

/// A joint from the chassis to a link. Simulators that read URDF as SDF want a name of its own for every link and joint.
pub(crate) fn joint(name: &str, kind: &'static str) -> Element {
    element("joint")
        .with("name", format!("{name}_joint"))
        .with("type", kind)
        .child(element("parent").with("link", "chassis"))
        .child(element("child").with("link", name))
}

fn chassis(v: &Vehicle, parts: &Parts) -> Element {
    let r = &v.robot;
    let size = [2.0 * r.half_wheelbase, 1.6 * r.half_track, 0.6 * r.wheel_radius];
    let visual = element("visual")
        .child(origin([0.0, 0.0, r.wheel_radius], [0.0; 3]))
        .child(element("geometry").child(element("box").nums("size", &size)));
    element("link").with("name", "chassis").child(inertial(&parts.chassis, [0.0; 3])).child(visual)
}

fn wheel(v: &Vehicle, parts: &Parts, i: usize) -> Element {
    let shape = |name: &'static str| {
        element(name).child(origin(shape_place(v, i), [LYING, 0.0, 0.0])).child(
            element("geometry").child(element("cylinder").num("radius", v.coefficients.radius[i]).num("length", WIDTH)),
        )
    };
    let part = &parts.wheels[i];
    element("link")
        .with("name", names(&v.robot)[i])
        .child(inertial(part, part.centre))
        .child(shape("visual"))
        .child(shape("collision"))
}

/// A caster: a sphere that slides as hard as it rolls.
fn caster(v: &Vehicle, i: usize) -> Element {
    let sphere = || element("geometry").child(element("sphere").num("radius", v.robot.wheel_radius));
    let shape = |kind: &'static str| element(kind).child(sphere());
    element("link").with("name", names(&v.robot)[i]).child(shape("visual")).child(shape("collision"))
}

fn axle(v: &Vehicle, parts: &Parts, i: usize) -> Element {
    let grip = &grips(v)[i];
    let axle = joint(names(&v.robot)[i], "continuous")
        .child(origin(parts.wheels[i].centre, [0.0; 3]))
        .child(element("axis").with("xyz", "0 1 0"))
        .child(element("dynamics").num("damping", grip.viscous).num("friction", grip.dry));
    let share = motors(&v.robot)[i];
    let limit = share * v.robot.drive.limit;
    if share == 0.0 {
        let rear = format!("{}_joint", names(&v.robot)[i + 2]);
        axle.child(element("mimic").with("joint", rear).num("multiplier", 1.0).num("offset", 0.0))
    } else if limit < NO_LIMIT {
        axle.child(element("limit").num("effort", limit).num("velocity", ANY_SPEED))
    } else {
        axle
    }
}
