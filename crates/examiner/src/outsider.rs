//! Causes outside the vocabulary: the right answer to them is "unknown".

use serde::{Deserialize, Serialize};

use crate::effect::Sizing;
use crate::hidden::Hidden;
use crate::random::Stream;
use crate::robot::GRAVITY;
use crate::truth::EffectTruth;
use crate::{Setting, random};

/// The id under which truths hold what is outside the vocabulary.
pub(crate) const ID: &str = "out_of_library";

/// Steps of the coarse integrator, seconds: 1.5 ms do not show in a medium robot, 2 ms may blow up.
const EXPLICIT_STEP: f64 = 0.001_75;

/// The kinds of outsiders.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outsider {
    /// Load that swings to the other side when the turning reverses, and stays there.
    ShiftingLoad,
    /// Torque that depends on the position of the gears, strongly nonlinear.
    Cogging,
    /// A wheel that leaves the ground now and then.
    ContactLoss,
    /// A battery whose voltage sags with the power drawn.
    VoltageSag,
    /// Slowly varying random force on the body.
    Gusts,
    /// A delay that changes at random.
    DelayJitter,
    /// Ground with a grain: less friction along one direction.
    Grain,
    /// The drivetrain passes a share of torque that varies with its position.
    Ripple,
    /// Drives that deliver nothing for short times.
    TorqueDropouts,
    /// An elastic cable to a fixed point.
    Cable,
    /// Friction of the drivetrain in one sense of rotation only.
    Ratchet,
    /// A brake of one side that touches for short times.
    TouchingBrake,
    /// Artefact: friction is bounded along and across apart, as in a simulator with a box for the cone.
    FrictionBox,
    /// Artefact: the motion goes on in coarse explicit steps.
    ExplicitSteps,
}

impl Outsider {
    /// Those of the real world, which sets draw from.
    pub const ALL: [Self; 11] = [
        Self::ShiftingLoad,
        Self::Cogging,
        Self::ContactLoss,
        Self::VoltageSag,
        Self::Gusts,
        Self::DelayJitter,
        Self::Grain,
        Self::Ripple,
        Self::TorqueDropouts,
        Self::Cable,
        Self::Ratchet,
    ];

    /// Those that a robot on casters, or on four wheels, may have.
    pub fn of(casters: bool) -> Vec<Self> {
        Self::ALL.into_iter().filter(|kind| !casters || *kind != Self::ContactLoss).collect()
    }

    /// Short, irregular events: sets draw them only when asked for.
    pub const EVENTS: [Self; 3] = [Self::TouchingBrake, Self::TorqueDropouts, Self::ContactLoss];

    /// Artefacts of a simulator: only drawn when asked for.
    pub const ARTEFACTS: [Self; 2] = [Self::FrictionBox, Self::ExplicitSteps];
}

/// Hides an outsider.
pub(crate) fn hide(kind: Outsider, z: &Sizing<'_>, s: &mut Stream, h: &mut Hidden) -> EffectTruth {
    let c = z.robot;
    let scale = c.torque_scale();
    let weight = c.mass * GRAVITY;
    let weak = if z.setting == Setting::Weak { 0.6 } else { 1.0 };
    let grade = [0.7, 1.0, 1.4][usize::from(z.severity.number())];
    let size = grade * weak * z.factor * s.uniform(0.87, 1.15);
    let f = &mut h.foreign;
    f.seed = random::mix((s.unit() * 1e15) as u64);
    match kind {
        Outsider::ShiftingLoad => f.cargo = s.sign() * 0.35 * size * c.half_track,
        Outsider::Cogging => {
            f.cogging = 0.3 * size * scale;
            f.cogging_order = s.uniform(1.3, 2.4);
        }
        Outsider::ContactLoss => f.lifted = Some(s.index(4)),
        Outsider::VoltageSag => {
            f.sag = 0.3 * size;
            f.sag_power = 7.0 * scale;
        }
        Outsider::Gusts => f.gust = 0.07 * size * weight,
        Outsider::DelayJitter => f.jitter = 0.17 * size,
        Outsider::Grain => {
            f.grain = (0.45 * size).min(0.8);
            f.grain_direction = s.uniform(0.0, std::f64::consts::PI);
        }
        Outsider::Ripple => {
            f.ripple = 0.3 * size;
            f.ripple_order = s.uniform(0.25, 0.7);
        }
        Outsider::TorqueDropouts => f.dropout = (0.12 * size).min(0.4),
        Outsider::Cable => {
            let anchor = [s.uniform(-0.8, 0.8), s.uniform(-0.8, 0.8)];
            f.cable = Some((0.04 * size * weight, anchor, s.uniform(0.2, 0.6)));
        }
        Outsider::Ratchet => f.ratchet = 0.16 * size * scale,
        Outsider::TouchingBrake => f.touch = Some((s.index(2), 0.6 * size * scale)),
        Outsider::FrictionBox => f.friction_box = true,
        Outsider::ExplicitSteps => f.explicit_step = EXPLICIT_STEP,
    }
    let mut e = EffectTruth::new(ID.to_owned(), z.severity.number());
    e.kind = serde_json::to_value(kind).ok().and_then(|v| v.as_str().map(str::to_owned));
    e.magnitude = 1.0;
    e
}
