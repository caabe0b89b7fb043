//! Which wheels a motor turns.

use crate::any_wheels::rows::MotorRow;
use crate::layout::{Layout, Robot};
use crate::model::Joint;
use crate::rounded::digits;
use crate::settings::SETTINGS;
use crate::wheels::Wheel;

/// A motor with the joints of the wheels that it turns.
pub(crate) struct Group {
    /// The joint that leads.
    pub(crate) name: String,
    /// Joints by their place in the model, the first of them with a column.
    pub(crate) wheels: Vec<usize>,
}

/// Motors: every driven joint of a wheel is one, and turns the wheels whose joints follow it.
pub(crate) fn motors(robot: &Robot<'_>, notes: &mut Vec<String>) -> Vec<Group> {
    let joint = |w: &Wheel| &robot.model.joints[w.joint];
    let is_driven = |w: &&Wheel| robot.model.joints[lead(robot, w)].is_driven();
    let mut driven: Vec<&Wheel> = robot.wheels.iter().filter(is_driven).collect();
    if driven.is_empty() {
        // A car's and a tricycle's motor usually sits at the axle that is not steered.
        let behind = matches!(robot.layout, Layout::Car | Layout::Tricycle);
        driven = if behind { robot.steered(false).collect() } else { robot.wheels.iter().collect() };
        let names: Vec<&str> = driven.iter().map(|w| w.name.as_str()).collect();
        notes.push(format!(
            "the model does not say which wheels are driven (by an effort or an actuator of their joints): a motor was written for {}; \
             move motor = to the wheels that have one",
            names.join(", ")
        ));
    }
    let mut out: Vec<Group> = Vec::new();
    for wheel in driven {
        let name = &robot.model.joints[lead(robot, wheel)].name;
        match out.iter_mut().find(|m| m.name == *name) {
            Some(group) => group.wheels.push(wheel.joint),
            None => out.push(Group { name: name.clone(), wheels: vec![wheel.joint] }),
        }
    }
    let free = robot.wheels.iter().filter(|w| out.iter().all(|m| !m.wheels.contains(&w.joint)));
    let drags: Vec<&str> = free
        .filter(|w| [joint(w).friction, joint(w).damping].iter().flatten().any(|x| *x > 0.0))
        .map(|w| w.name.as_str())
        .collect();
    if !drags.is_empty() {
        notes.push(format!(
            "friction of wheels without a motor has no place in a robot file; it shows as rolling resistance: {}",
            drags.join(", ")
        ));
    }
    out
}

/// The joint of a wheel, or the one that it follows in the end.
fn lead(robot: &Robot<'_>, wheel: &Wheel) -> usize {
    let joints = &robot.model.joints;
    let mut at = wheel.joint;
    // No chain is longer than all joints, but a ring is.
    for _ in 0..joints.len() {
        let followed = joints[at].follows.as_ref().and_then(|name| joints.iter().position(|j| j.name == *name));
        match followed {
            Some(next) => at = next,
            None => return at,
        }
    }
    wheel.joint
}

impl Group {
    /// Its row; `rolling` is the torque that rolling takes of the friction of one joint.
    pub(crate) fn row(&self, robot: &Robot<'_>, rolling: f64) -> MotorRow {
        let joints = || self.wheels.iter().map(|&k| &robot.model.joints[k]);
        let sum = |of: fn(&Joint) -> Option<f64>| {
            let stated: Vec<f64> = joints().filter_map(of).collect();
            (!stated.is_empty()).then(|| stated.iter().sum::<f64>()).filter(|total| *total > 0.0)
        };
        let coulomb = sum(|j| j.friction)
            .map(|all| digits((all - rolling * joints().filter(|j| j.friction.is_some()).count() as f64).max(0.0)));
        let viscous = sum(|j| j.damping).map(digits);
        let spread = |value: &f64| digits(SETTINGS.spreads.stated_friction * value);
        let names: Vec<&str> = joints().map(|j| j.name.as_str()).collect();
        MotorRow {
            name: self.name.clone(),
            column: format!("torque_{}", self.name),
            inertia: sum(|j| j.armature).map(digits),
            coulomb,
            coulomb_sigma: coulomb.as_ref().map(spread).filter(|s| *s > 0.0),
            viscous,
            viscous_sigma: viscous.as_ref().map(spread),
            source: format!("{}: joint {}, friction less rolling resistance", robot.model.form, names.join(", ")),
        }
    }
}
