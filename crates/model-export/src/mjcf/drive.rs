//! Belts and drives in MJCF.

use robot_model::Chassis;
use robot_model::effect::export::Section;

use super::step::STEP;
use crate::contact::{SIDES, driven, names};
use crate::number::number;
use crate::vehicle::Vehicle;
use crate::xml::{Element, element};

/// Torque limits above this are none, N m.
const NO_LIMIT: f64 = 1e5;
/// Shortest time constant that is worth a filter, s.
const LEAST_LAG: f64 = 1e-5;

/// Whether an encoder shows something else than the speed of one joint: by another gain, or as the mean of two.
pub(super) fn has_encoder_tendon(v: &Vehicle, side: usize) -> bool {
    v.sensors.encoder[side] != 1.0 || driven(&v.robot, side).count() > 1
}

/// A tendon over the driven wheels of a side, with their shares times `gain` as coefficients.
fn over_driven(v: &Vehicle, side: usize, name: String, gain: f64) -> Element {
    let wheels: Vec<&'static str> = driven(&v.robot, side).collect();
    let coefficient = gain / wheels.len() as f64;
    let joint = |name: &'static str| element("joint").with("joint", name).num("coef", coefficient);
    element("fixed").with("name", name).children(wheels.into_iter().map(joint))
}

/// Front wheels that turn with the rear ones: an equality of joints, or a tendon whose dry friction is the belt's limit. Where each
/// wheel has a motor, a tendon over those of a side halves its torque.
pub(super) fn couplings(mut root: Element, v: &Vehicle) -> Element {
    let wheels = |side: usize| (names(&v.robot)[side], names(&v.robot)[2 + side]);
    let has_belts = v.robot.chassis == Chassis::SkidSteer;
    let mut tendons = Vec::new();
    let mut equalities = Vec::new();
    for side in 0..2 {
        let (front, rear) = wheels(side);
        let joint = |name: &str, coefficient: f64| element("joint").with("joint", name).num("coef", coefficient);
        if has_encoder_tendon(v, side) {
            tendons.push(over_driven(v, side, format!("encoder_{}", SIDES[side]), v.sensors.encoder[side]));
        }
        if driven(&v.robot, side).count() > 1 {
            tendons.push(over_driven(v, side, format!("drive_{}", SIDES[side]), 1.0));
        }
        if !has_belts {
            continue;
        }
        if let Some(most) = v.belt(side) {
            let belt = element("fixed")
                .with("name", format!("belt_{}", SIDES[side]))
                .num("frictionloss", most)
                .with("solreffriction", "0.004 1")
                .with("solimpfriction", "0.99 0.999 0.001");
            tendons.push(belt.child(joint(front, 1.0)).child(joint(rear, -1.0)));
        } else {
            equalities.push(
                element("joint")
                    .with("name", format!("belt_{}", SIDES[side]))
                    .with("joint1", front)
                    .with("joint2", rear)
                    .with("solref", "0.004 1")
                    .with("solimp", "0.99 0.999 0.001"),
            );
        }
    }
    if !tendons.is_empty() {
        root = root.child(element("tendon").children(tendons));
    }
    if !equalities.is_empty() {
        let comment = "A belt couples the wheels of a side: equal angles. The motor sits on the rear wheel.".to_owned();
        root = root.child(element("equality").comments([comment]).children(equalities));
    }
    root
}

/// The motor of each side: delay, limit, lag and gain, in this order.
pub(super) fn actuators(v: &Vehicle) -> Element {
    let d = &v.robot.drive;
    // To first order a small lag is a delay, and a negative delay (a lead) takes from the lag.
    let (slow, quick) = (d.lag.max(d.extra_lag), d.lag.min(d.extra_lag));
    let delay = (d.delay + quick).max(0.0);
    let lag = slow + (d.delay + quick).min(0.0);
    let motor = |side: usize| {
        let several = driven(&v.robot, side).count() > 1;
        let (kind, turned) = if several {
            ("tendon", format!("drive_{}", SIDES[side]))
        } else {
            ("joint", names(&v.robot)[2 + side].to_owned())
        };
        let mut motor = element("general").with("name", SIDES[side]).with(kind, turned).num("gainprm", d.gain);
        if d.limit < NO_LIMIT {
            // What is limited is the torque before the lag: the command times the gain.
            motor = motor.nums("ctrlrange", &[-d.limit / d.gain, d.limit / d.gain]);
        }
        if lag > LEAST_LAG {
            motor = motor.with("dyntype", "filterexact").num("dynprm", lag);
        }
        if delay > 0.5 * STEP {
            let samples = (delay / STEP).ceil() + 2.0;
            motor = motor.num("delay", delay).with("interp", "linear").with("nsample", number(samples));
        }
        motor
    };
    let out = element("actuator").comments(v.comments(Section::Drive)).children((0..2).map(motor));
    if v.coefficients.force[0] == 0.0 {
        return out;
    }
    out.comments(["A constant force at the hitch; it takes no command.".to_owned()]).child(
        element("general")
            .with("name", "pull")
            .with("site", "hitch")
            .with("gear", "1 0 0 0 0 0")
            .with("gainprm", "0")
            .with("biastype", "affine")
            .num("biasprm", v.coefficients.force[0]),
    )
}
