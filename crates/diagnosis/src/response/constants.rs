//! A constant of a response, and the elements that constants form.

use serde::{Deserialize, Serialize};

/// A fitted constant: what it is called and where it may lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Constant {
    /// Name in JSON.
    pub(crate) id: &'static str,
    pub(crate) unit: &'static str,
    /// Value of the simulation "wheels do what is commanded, the body rolls without slip".
    pub(crate) neutral: f64,
    pub(crate) bounds: [f64; 2],
    /// Size of a usual change, for steps of the fit.
    pub(crate) scale: f64,
}

/// A physical element: constants that stand or fall together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Element {
    /// Command to wheel: dead time.
    DeadTime,
    /// Gains of the commanded forward speed and turning.
    Gain,
    /// Limit of the commanded turning.
    TurnLimit,
    /// Limit of the commanded forward speed.
    ForwardLimit,
    /// Limit of a wheel's speed and how both sides are scaled at it.
    WheelLimit,
    /// Limits of acceleration.
    Ramp,
    /// Lag of the speed control.
    Lag,
    /// Sides that answer with different gains.
    SideGain,
    /// Wheel to body: rolling radius, or a longitudinal slip that is always there.
    Radius,
    /// Effective track.
    Track,
    /// Distance of the centre of rotation from the pose sensor, forward.
    Offset,
    /// Forward speed lost in turns.
    TurnSlip,
    /// Body that follows its wheels late.
    BodyLag,
    /// Sides that roll with different radii.
    SideRadius,
}

impl Element {
    /// Whether it sits between command and wheel.
    pub const fn is_drive(self) -> bool {
        (self as usize) < (Self::Radius as usize)
    }
}
