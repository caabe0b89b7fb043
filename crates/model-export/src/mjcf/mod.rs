//! MJCF: the model of MuJoCo.

use std::io;

use robot_model::effect::export::{Engine, Section};

use crate::added;
use crate::contact::{casters, motors, names, wheels};
use crate::inertia::{Part, Parts};
use crate::model::Model;
use crate::number::number;
use crate::vehicle::Vehicle;
use crate::xml::{Element, element};

pub(crate) mod contact;
mod drive;
mod sensors;
mod step;

pub(crate) use step::STEP;

/// Density of a medium in which nothing but the sphere of the drag feels anything, kg/m³.
const THIN: f64 = 1e-6;
/// Radius of that sphere, m.
const SPHERE: f64 = 0.1;

/// The model as a document.
pub(crate) fn document(model: &Model<'_>, v: &Vehicle) -> io::Result<String> {
    let parts = Parts::new(v, false);
    let mut option = element("option")
        .num("timestep", STEP)
        .with("integrator", "implicitfast")
        .with("cone", "elliptic")
        .nums("gravity", &v.gravity());
    if v.drag != 0.0 {
        option = option.num("density", THIN);
    }
    let root = element("mujoco")
        .with("model", model.name)
        .child(option)
        .child(
            element("worldbody")
                .comments(v.comments(Section::Ground))
                .child(invisible(element("geom").with("name", "floor").with("type", "plane").with("size", "0 0 1")))
                .child(chassis(v, &parts)),
        )
        .child(contact::pairs(v, &parts));
    let root = drive::couplings(root, v).child(drive::actuators(v)).child(sensors::sensors(v));
    added::comments(root, v, Engine::Mjcf).document(vec![heading(model)])
}

fn heading(model: &Model<'_>) -> String {
    format!(
        "{}: written by lacuna export. Units SI; x forward, y left, z up; the frame of the chassis is on the ground below the \
         middle of the wheels. Actuators left and right take the torque command of a side in N m.",
        model.name
    )
}

/// Collides by its contact pair only, and weighs nothing: masses are told apart.
pub(crate) fn invisible(geom: Element) -> Element {
    geom.with("contype", "0").with("conaffinity", "0").with("mass", "0")
}

pub(crate) fn inertial(part: &Part, origin: [f64; 3]) -> Element {
    let centre: [f64; 3] = std::array::from_fn(|k| part.centre[k] - origin[k]);
    element("inertial").nums("pos", &centre).num("mass", part.mass).nums("diaginertia", &part.inertia)
}

fn chassis(v: &Vehicle, parts: &Parts) -> Element {
    let r = &v.robot;
    let half = [r.half_wheelbase, 0.8 * r.half_track, 0.3 * r.wheel_radius];
    let site = |name: &'static str, at: [f64; 3]| element("site").with("name", name).nums("pos", &at);
    let mut body = element("body")
        .with("name", "chassis")
        .comments(v.comments(Section::Body))
        .child(element("freejoint").with("name", "chassis"))
        .child(inertial(&parts.chassis, [0.0; 3]))
        .child(invisible(
            element("geom")
                .with("name", "chassis")
                .with("type", "box")
                .nums("size", &half)
                .nums("pos", &[0.0, 0.0, r.wheel_radius]),
        ))
        .children(sensors::sites(v));
    if v.coefficients.force[0] != 0.0 {
        body = body.child(site("hitch", [r.hitch_x, 0.0, r.com[2]]));
    }
    if v.drag != 0.0 {
        body = body.child(drag(v));
    }
    if let Some(load) = &parts.payload {
        body = body.child(element("body").with("name", "payload").child(inertial(load, [0.0; 3])));
    }
    let casters = casters(r).map(|i| caster(v, parts, i));
    body.comments(v.comments(Section::Wheels)).children(casters).children(wheels(r).map(|i| wheel(v, parts, i)))
}

/// A sphere whose blunt drag in the thin medium is `F = ρ C π R² v²` (MuJoCo has no factor of one half there).
fn drag(v: &Vehicle) -> Element {
    let blunt = v.drag / (THIN * std::f64::consts::PI * SPHERE * SPHERE);
    let sphere = element("geom").with("name", "drag").with("type", "sphere").num("size", SPHERE);
    invisible(sphere.nums("pos", &v.robot.com))
        .with("fluidshape", "ellipsoid")
        .nums("fluidcoef", &[blunt, 0.0, 0.0, 0.0, 0.0])
        .with("rgba", "0 0 0 0")
}

/// A caster: a sphere that slides as hard as it rolls.
fn caster(v: &Vehicle, parts: &Parts, i: usize) -> Element {
    let sphere = element("geom").with("name", names(&v.robot)[i]).with("type", "sphere");
    invisible(sphere.num("size", v.robot.wheel_radius).nums("pos", &parts.wheels[i].centre))
}

/// A wheel: a capsule so short that it is a disc, because the contacts of capsules lie along their axis and so tell
/// friction along the axle from friction across it.
fn wheel(v: &Vehicle, parts: &Parts, i: usize) -> Element {
    let (part, grip) = (&parts.wheels[i], crate::contact::grips(v)[i]);
    let [cosine, sine] = v.eccentric[i];
    // At angle zero the axle is `cosine` higher above the ground than the middle of the wheel.
    let shape = element("geom")
        .with("name", names(&v.robot)[i])
        .with("type", "capsule")
        .with("size", format!("{} {}", number(v.coefficients.radius[i]), number(contact::HALF_WIDTH)))
        .with("zaxis", "0 1 0")
        .nums("pos", &[sine, 0.0, -cosine]);
    let mut joint = element("joint")
        .with("name", names(&v.robot)[i])
        .with("axis", "0 1 0")
        .num("damping", grip.viscous)
        .num("frictionloss", grip.dry);
    let share = motors(&v.robot)[i];
    if share > 0.0 {
        joint = joint.num("armature", share * v.robot.motor_inertia);
    }
    element("body")
        .with("name", names(&v.robot)[i])
        .nums("pos", &part.centre)
        .child(joint)
        .child(inertial(part, part.centre))
        .child(invisible(shape))
}
