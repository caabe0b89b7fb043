//! SDF: a world with the robot on it, for Gazebo.

use std::io;

use robot_model::effect::export::{Engine, Section};

use crate::added;
use crate::contact::{casters, driven_wheels, grips, motors, names, wheels};
use crate::gazebo::{LYING, NO_LIMIT, WIDTH, imu_angles, shape_place, slip_plugin};
use crate::inertia::{Part, Parts};
use crate::model::Model;
use crate::number::{number, numbers};
use crate::vehicle::Vehicle;
use crate::xml::{Element, element};

/// Friction of the ground where the wheels decide: Gazebo takes the smaller one of both.
pub(crate) const ANY_FRICTION: f64 = 100.0;
/// Height of a disc of other grip, m.
const DISC: f64 = 0.0004;

/// The world as a document.
pub(crate) fn document(model: &Model<'_>, v: &Vehicle) -> io::Result<String> {
    let world = element("world")
        .with("name", "lacuna")
        .child(element("physics").with("name", "steps").with("type", "ode").leaf("max_step_size", "0.001"))
        .comments(v.comments(Section::Ground))
        .value("gravity", &v.gravity())
        .child(ground(v))
        .child(robot(model, v));
    added::comments(element("sdf").with("version", "1.11").child(world), v, Engine::Sdf).document(vec![format!(
        "{}: written by lacuna export. Units SI; x forward, y left, z up; the link chassis has its origin on the ground below \
         the middle of the wheels. {}.",
        model.name,
        driven_wheels(&v.robot)
    )])
}

pub(crate) fn pose(xyz: [f64; 3], rpy: [f64; 3]) -> String {
    format!("{} {}", numbers(&xyz), numbers(&rpy))
}

pub(crate) fn friction(along: f64, across: f64, first: Option<&str>) -> Element {
    let mut ode = element("ode").value("mu", &[along]).value("mu2", &[across]);
    if let Some(direction) = first {
        ode = ode.leaf("fdir1", direction);
    }
    element("surface").child(element("friction").child(ode))
}

fn ground(v: &Vehicle) -> Element {
    let plane = element("geometry").child(element("plane").leaf("normal", "0 0 1").leaf("size", "200 200"));
    let floor =
        element("collision").with("name", "floor").child(plane).child(friction(ANY_FRICTION, ANY_FRICTION, None));
    let mu = v.coefficients.adhesion[0];
    let discs = v.patches.iter().enumerate().map(|(i, [x, y, radius, left])| {
        let shape = element("cylinder").value("radius", &[*radius]).value("length", &[DISC]);
        element("collision")
            .with("name", format!("disc_{i}"))
            .leaf("pose", pose([*x, *y, 0.0], [0.0; 3]))
            .child(element("geometry").child(shape))
            .child(friction(mu * left, mu * left, None))
    });
    let link = element("link").with("name", "ground").child(floor).children(discs);
    element("model").with("name", "ground").leaf("static", "true").child(link)
}

fn robot(model: &Model<'_>, v: &Vehicle) -> Element {
    let parts = Parts::new(v, true);
    let mut out = element("model")
        .with("name", model.name)
        .comments(v.comments(Section::Body))
        .comments(v.comments(Section::Sensors))
        .child(chassis(v, &parts));
    if let Some(load) = &parts.payload {
        let fixed = element("joint").with("name", "payload_joint").with("type", "fixed");
        out = out
            .child(element("link").with("name", "payload").child(inertial(load, [0.0; 3])))
            .child(fixed.leaf("parent", "chassis").leaf("child", "payload"));
    }
    out = out.comments(v.comments(Section::Wheels)).comments(v.comments(Section::Drive));
    for i in wheels(&v.robot) {
        out = out.child(wheel(v, &parts, i)).child(axle(v, i));
    }
    out.child(slip_plugin(v, &grips(v)))
}

pub(crate) fn inertial(part: &Part, link: [f64; 3]) -> Element {
    let [x, y, z] = part.inertia;
    let centre: [f64; 3] = std::array::from_fn(|k| part.centre[k] - link[k]);
    let inertia = element("inertia").value("ixx", &[x]).value("iyy", &[y]).value("izz", &[z]);
    element("inertial").leaf("pose", pose(centre, [0.0; 3])).value("mass", &[part.mass]).child(inertia)
}

fn chassis(v: &Vehicle, parts: &Parts) -> Element {
    let r = &v.robot;
    let size = [2.0 * r.half_wheelbase, 1.6 * r.half_track, 0.6 * r.wheel_radius];
    let visual = element("visual")
        .with("name", "chassis")
        .leaf("pose", pose([0.0, 0.0, r.wheel_radius], [0.0; 3]))
        .child(element("geometry").child(element("box").value("size", &size)));
    let link = element("link").with("name", "chassis").child(inertial(&parts.chassis, [0.0; 3])).child(visual);
    link.children(casters(r).map(|i| caster(v, parts, i))).child(imu(v))
}

/// A caster: a sphere that slides as hard as it rolls.
fn caster(v: &Vehicle, parts: &Parts, i: usize) -> Element {
    let [along, across] = grips(v)[i].friction;
    let sphere = element("sphere").value("radius", &[v.robot.wheel_radius]);
    element("collision")
        .with("name", names(&v.robot)[i])
        .leaf("pose", pose(parts.wheels[i].centre, [0.0; 3]))
        .child(element("geometry").child(sphere))
        .child(friction(along, across, None))
}

/// The IMU; a constant error is the mean of the noise, because Gazebo flips the sign of a bias at random.
fn imu(v: &Vehicle) -> Element {
    let axis = |name: &'static str, mean: f64| {
        let noise = element("noise").with("type", "gaussian").value("mean", &[mean]).leaf("stddev", "0");
        element(name).child(noise)
    };
    let [x, y] = v.sensors.accel;
    let rates = element("angular_velocity").child(axis("z", v.sensors.gyro));
    let forces = element("linear_acceleration").child(axis("x", x)).child(axis("y", y));
    element("sensor")
        .with("name", "imu")
        .with("type", "imu")
        .leaf("pose", pose([0.0; 3], imu_angles(v)))
        .leaf("update_rate", "100")
        .child(element("imu").child(rates).child(forces))
}

fn wheel(v: &Vehicle, parts: &Parts, i: usize) -> Element {
    let part = &parts.wheels[i];
    let [along, across] = grips(v)[i].friction;
    let shape = |kind: &'static str| {
        let cylinder = element("cylinder").value("radius", &[v.coefficients.radius[i]]).value("length", &[WIDTH]);
        element(kind)
            .with("name", kind)
            .leaf("pose", pose(shape_place(v, i), [LYING, 0.0, 0.0]))
            .child(element("geometry").child(cylinder))
    };
    element("link")
        .with("name", names(&v.robot)[i])
        .leaf("pose", pose(part.centre, [0.0; 3]))
        .child(inertial(part, part.centre))
        .child(shape("visual"))
        // The cylinder lies: its z is the axle.
        .child(shape("collision").child(friction(along, across, Some("0 0 1"))))
}

fn axle(v: &Vehicle, i: usize) -> Element {
    let grip = &grips(v)[i];
    let dynamics = element("dynamics").value("damping", &[grip.viscous]).value("friction", &[grip.dry]);
    let mut axis = element("axis").leaf("xyz", "0 1 0").child(dynamics);
    let share = motors(&v.robot)[i];
    let limit = share * v.robot.drive.limit;
    if share == 0.0 {
        let rear = element("mimic").with("joint", format!("{}_joint", names(&v.robot)[i + 2])).with("axis", "axis");
        axis = axis.child(rear.leaf("multiplier", "1").leaf("offset", "0").leaf("reference", "0"));
    } else if limit < NO_LIMIT {
        axis = axis.child(element("limit").leaf("effort", number(limit)));
    }
    // Links, joints and frames of a model share one space of names from SDF 1.7 on.
    element("joint")
        .with("name", format!("{}_joint", names(&v.robot)[i]))
        .with("type", "revolute")
        .leaf("parent", "chassis")
        .leaf("child", names(&v.robot)[i])
        .child(axis)
}
