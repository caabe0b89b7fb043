//! A robot of any wheels in MJCF.

use std::io;

use super::ackermann::{FARTHEST, polynomial};
use super::vehicle::{Caster, Joint, Motor, Vehicle, Wheel};
use crate::inertia::Part;
use crate::mjcf::contact::{CREEP_AT, HALF_WIDTH, SLIDES_AT, creeping, inverse_at, told};
use crate::mjcf::{STEP, inertial, invisible};
use crate::number::{number, numbers};
use crate::xml::{Element, element};

/// Inertia of what turns a steered wheel, of the wheel's about its axle: a servo with its gear (guess).
const SERVO: f64 = 10.0;
/// How fast a steered wheel follows its joint, rad/s: fast beside any steering (guess).
const FOLLOWS: f64 = 100.0;
/// Shortest time constant that is worth a filter, s.
const LEAST_LAG: f64 = 1e-5;

/// The model as a document.
pub(super) fn document(v: &Vehicle, heading: Vec<String>) -> io::Result<String> {
    let floor = invisible(element("geom").with("name", "floor").with("type", "plane").with("size", "0 0 1"));
    let option = element("option")
        .num("timestep", STEP)
        .with("integrator", "implicitfast")
        .with("cone", "elliptic")
        .nums("gravity", &v.gravity());
    let root = element("mujoco")
        .with("model", &*v.name)
        .child(option)
        .child(element("worldbody").child(floor).child(chassis(v)))
        .child(contacts(v));
    couplings(root, v).child(actuators(v)).child(sensors(v)).document(heading)
}

fn chassis(v: &Vehicle) -> Element {
    let [x, y, yaw] = v.point;
    let shape = element("geom").with("name", "chassis").with("type", "box");
    let shape = shape.nums("size", &half_size(v)).nums("pos", &[v.chassis.centre[0], 0.0, v.wheels[0].radius]);
    let pose = element("site").with("name", "pose").nums("pos", &[x, y, 0.0]).nums("quat", &turned(yaw));
    let servos = v.joints.iter().filter(|j| !j.is_of_one);
    element("body")
        .with("name", "chassis")
        .child(element("freejoint").with("name", "chassis"))
        .child(inertial(&v.chassis, [0.0; 3]))
        .child(invisible(shape))
        .child(element("site").with("name", "imu"))
        .child(pose)
        .children(v.casters.iter().map(caster))
        .children(servos.map(|joint| servo(v, joint)))
        .children(v.wheels.iter().map(|w| hung(v, w)))
}

/// Half the size of a box between the wheels, m: seen, not felt.
fn half_size(v: &Vehicle) -> [f64; 3] {
    let most = |axis: usize| v.wheels.iter().map(move |w| (w.part.centre[axis] - v.chassis.centre[axis]).abs());
    let half = |axis: usize| 0.8 * most(axis).fold(v.wheels[0].radius, f64::max);
    [half(0), half(1), 0.3 * v.wheels[0].radius]
}

/// Turned about the vertical, as a quaternion.
fn turned(yaw: f64) -> [f64; 4] {
    let (sin, cos) = (0.5 * yaw).sin_cos();
    [cos, 0.0, 0.0, sin]
}

fn caster(c: &Caster) -> Element {
    let sphere = element("geom").with("name", &*c.name).with("type", "sphere");
    invisible(sphere.num("size", c.centre[2]).nums("pos", &c.centre))
}

/// Inertia of what steers a wheel, kg m².
fn servo_inertia(v: &Vehicle) -> f64 {
    SERVO * v.wheels.iter().map(|w| w.part.inertia[1]).fold(0.0, f64::max)
}

/// A body that turns about the vertical as a steering joint does.
fn pivot(v: &Vehicle, name: String, place: [f64; 3]) -> Element {
    let hinge = element("joint").with("name", &*name).with("axis", "0 0 1").num("armature", servo_inertia(v));
    let part = Part { centre: place, ..v.knuckle(place) };
    element("body").with("name", name).nums("pos", &place).child(hinge).child(inertial(&part, place))
}

/// The joint itself where several wheels follow it.
fn servo(v: &Vehicle, joint: &Joint) -> Element {
    pivot(v, hinge(joint), joint.centre(&v.wheels))
}

/// Name of the hinge that several wheels follow.
fn hinge(joint: &Joint) -> String {
    format!("servo_{}", joint.name)
}

/// A wheel, at its knuckle where it is steered.
fn hung(v: &Vehicle, w: &Wheel) -> Element {
    match w.joint {
        Some(_) => pivot(v, format!("steer_{}", w.name), w.part.centre).child(wheel(w, [0.0; 3])),
        None => wheel(w, w.part.centre),
    }
}

/// A wheel: a capsule so short that it is a disc, because the contacts of capsules lie along their axis and so tell
/// friction along the axle from friction across it.
fn wheel(w: &Wheel, place: [f64; 3]) -> Element {
    let shape = element("geom")
        .with("name", &*w.name)
        .with("type", "capsule")
        .with("size", format!("{} {}", number(w.radius), number(HALF_WIDTH)))
        .with("zaxis", "0 1 0");
    let joint = element("joint")
        .with("name", &*w.name)
        .with("axis", "0 1 0")
        .num("damping", w.viscous)
        .num("frictionloss", w.dry)
        .num("armature", w.rotor);
    element("body")
        .with("name", &*w.name)
        .nums("pos", &place)
        .nums("quat", &turned(w.direction))
        .child(joint)
        .child(inertial(&w.part, w.part.centre))
        .child(invisible(shape))
}

fn contacts(v: &Vehicle) -> Element {
    let total = v.total();
    let spin: f64 = v.wheels.iter().map(|w| w.part.inertia[1]).sum();
    let of_wheel = |w: &Wheel| {
        // Along the axle and across it: of rollers that lie across their wheel the first is the way in which it rolls.
        let [first, second] = w.friction;
        let friction = if w.first.is_some() { [second, first] } else { [first, second] };
        creeping(&w.name, friction, w.slope / CREEP_AT, inverse_at(&total, spin, w.part.centre))
    };
    let of_caster = |c: &Caster| {
        let slope = 2.0 * c.friction * c.load / SLIDES_AT;
        creeping(&c.name, [c.friction; 2], slope, inverse_at(&total, spin, c.centre))
    };
    let pairs = v.casters.iter().map(of_caster).chain(v.wheels.iter().map(of_wheel));
    element("contact").comments([told()]).children(pairs)
}

/// Wheels of one motor, and wheels that follow a steering joint.
fn couplings(mut root: Element, v: &Vehicle) -> Element {
    let equal = |name: String, [first, second]: [&str; 2], polynomial: &[f64]| {
        element("joint")
            .with("name", name)
            .with("joint1", first)
            .with("joint2", second)
            .with("polycoef", numbers(polynomial))
            .with("solref", "0.004 1")
            .with("solimp", "0.99 0.999 0.001")
    };
    let mut equalities = Vec::new();
    for motor in v.motors.iter().filter(|m| m.is_rigid) {
        let names: Vec<&str> = motor.wheels.iter().map(|k| v.wheels[*k].name.as_str()).collect();
        let rest = names.iter().skip(1);
        equalities.extend(rest.map(|n| equal(format!("belt_{n}"), [n, names[0]], &[0.0, 1.0, 0.0, 0.0, 0.0])));
    }
    for joint in v.joints.iter().filter(|j| !j.is_of_one) {
        for w in joint.wheels.iter().map(|k| (&v.wheels[*k], v.robot.wheels[*k])) {
            let (wheel, Some(plant)) = w else { continue };
            let name = format!("steer_{}", wheel.name);
            equalities.push(equal(
                format!("linkage_{}", wheel.name),
                [&name, &hinge(joint)],
                &polynomial(&joint.plant, &plant),
            ));
        }
    }
    let over = |motor: &Motor| {
        let each = motor
            .wheels
            .iter()
            .map(|k| element("joint").with("joint", &*v.wheels[*k].name).num("coef", 1.0 / motor.wheels.len() as f64));
        element("fixed").with("name", tendon(motor)).children(each)
    };
    let tendons: Vec<Element> = v.motors.iter().filter(|m| m.wheels.len() > 1).map(over).collect();
    if !tendons.is_empty() {
        root = root.child(element("tendon").children(tendons));
    }
    if !equalities.is_empty() {
        let comment = format!(
            "Wheels of one motor turn by equal angles; steered wheels have the angles at which their axles meet on the axle that does \
             not steer, as a polynomial of the joint's angle, good up to {FARTHEST} rad."
        );
        root = root.child(element("equality").comments([comment]).children(equalities));
    }
    root
}

fn tendon(motor: &Motor) -> String {
    format!("drive_{}", motor.name)
}

fn filtered(actuator: Element, lag: f64) -> Element {
    if lag > LEAST_LAG { actuator.with("dyntype", "filterexact").num("dynprm", lag) } else { actuator }
}

fn actuators(v: &Vehicle) -> Element {
    let motor = |m: &Motor| {
        let (kind, turned) =
            if m.wheels.len() > 1 { ("tendon", tendon(m)) } else { ("joint", v.wheels[m.wheels[0]].name.clone()) };
        filtered(element("general").with("name", &*m.name).with(kind, turned).num("gainprm", m.gain), m.lag)
    };
    // A stiff servo, critically damped: angle = offset + gain × command.
    let inertia = servo_inertia(v);
    let (stiffness, damping) = (inertia * FOLLOWS * FOLLOWS, 2.0 * inertia * FOLLOWS);
    let steering = |j: &Joint| {
        let turned = if j.is_of_one { format!("steer_{}", v.wheels[j.wheels[0]].name) } else { hinge(j) };
        let servo = element("general")
            .with("name", &*j.name)
            .with("joint", turned)
            .num("gainprm", stiffness * j.gain)
            .with("biastype", "affine")
            .nums("biasprm", &[stiffness * j.plant.offset, -stiffness, -damping]);
        filtered(servo, j.plant.lag)
    };
    let steers = v.joints.iter().filter(|j| !j.wheels.is_empty());
    let turns = v.motors.iter().filter(|m| !m.wheels.is_empty());
    element("actuator").children(turns.map(motor)).children(steers.map(steering))
}

fn sensors(v: &Vehicle) -> Element {
    let named = |kind: &'static str, name: String| element(kind).with("name", name);
    let speed = |w: &Wheel| named("jointvel", format!("speed_{}", w.name)).with("joint", &*w.name);
    let site =
        |kind: &'static str, name: &str| named(kind, name.to_owned()).with("objtype", "site").with("objname", "pose");
    element("sensor")
        .children(v.wheels.iter().map(speed))
        .child(named("gyro", "gyro".to_owned()).with("site", "imu"))
        .child(named("accelerometer", "accelerometer".to_owned()).with("site", "imu"))
        .child(site("framepos", "position"))
        .child(site("framequat", "orientation"))
}
