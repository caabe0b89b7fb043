//! Where a term acts.

use crate::motion::Input;
use crate::unit::Unit;
use crate::variable::Of;

/// Where a term acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Place {
    /// Torque of the left drive.
    TorqueLeft,
    /// Torque of the right drive.
    TorqueRight,
    /// Torque of both drives: one constant, each its own variables.
    TorqueBoth,
    /// Force on the body, fore-aft.
    ForceForward,
    /// Force on the body, to the left.
    ForceLateral,
    /// Force on the body: one constant, each axis its own velocity.
    ForceBoth,
    /// Yaw moment on the body.
    YawMoment,
    /// Grip of the left wheels, as a share of it.
    GripLeft,
    /// Grip of the right wheels.
    GripRight,
    /// Grip of all wheels: one constant, each side its own variables.
    GripAll,
    /// Lateral grip of all wheels.
    LateralGrip,
    /// Radius of the left wheels.
    RadiusLeft,
    /// Radius of the right wheels.
    RadiusRight,
    /// Radius of all wheels.
    RadiusAll,
    /// Slope of the ground along the first axis of the map.
    SlopeX,
    /// Slope of the ground along the second.
    SlopeY,
}

impl Place {
    /// All of them.
    pub const ALL: [Self; 16] = [
        Self::TorqueLeft,
        Self::TorqueRight,
        Self::TorqueBoth,
        Self::ForceForward,
        Self::ForceLateral,
        Self::ForceBoth,
        Self::YawMoment,
        Self::GripLeft,
        Self::GripRight,
        Self::GripAll,
        Self::LateralGrip,
        Self::RadiusLeft,
        Self::RadiusRight,
        Self::RadiusAll,
        Self::SlopeX,
        Self::SlopeY,
    ];

    /// Its symbol in a formula.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::TorqueLeft => "T_left",
            Self::TorqueRight => "T_right",
            Self::TorqueBoth => "T_both",
            Self::ForceForward => "F_x",
            Self::ForceLateral => "F_y",
            Self::ForceBoth => "F_xy",
            Self::YawMoment => "M_z",
            Self::GripLeft => "grip_left",
            Self::GripRight => "grip_right",
            Self::GripAll => "grip_all",
            Self::LateralGrip => "grip_lateral",
            Self::RadiusLeft => "radius_left",
            Self::RadiusRight => "radius_right",
            Self::RadiusAll => "radius_all",
            Self::SlopeX => "slope_x",
            Self::SlopeY => "slope_y",
        }
    }

    /// Its name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::TorqueLeft => "torque on the left side",
            Self::TorqueRight => "torque on the right side",
            Self::TorqueBoth => "torque on both sides",
            Self::ForceForward => "fore-aft force on the body",
            Self::ForceLateral => "lateral force on the body",
            Self::ForceBoth => "force on the body, fore-aft and lateral",
            Self::YawMoment => "yaw moment on the body",
            Self::GripLeft => "grip of the left wheels",
            Self::GripRight => "grip of the right wheels",
            Self::GripAll => "grip of all wheels",
            Self::LateralGrip => "lateral grip of all wheels",
            Self::RadiusLeft => "radius of the left wheels",
            Self::RadiusRight => "radius of the right wheels",
            Self::RadiusAll => "radius of all wheels",
            Self::SlopeX | Self::SlopeY => "slope of the ground",
        }
    }

    /// The side that it is about: 0 left, 1 right.
    pub const fn side(self) -> Option<usize> {
        match self {
            Self::TorqueLeft | Self::GripLeft | Self::RadiusLeft => Some(0),
            Self::TorqueRight | Self::GripRight | Self::RadiusRight => Some(1),
            _ => None,
        }
    }

    /// The same on one side or on both; none where it has no sides.
    pub fn on_other_sides(self) -> Vec<Self> {
        let families = [
            [Self::TorqueLeft, Self::TorqueRight, Self::TorqueBoth],
            [Self::GripLeft, Self::GripRight, Self::GripAll],
            [Self::RadiusLeft, Self::RadiusRight, Self::RadiusAll],
        ];
        let own = families.into_iter().find(|family| family.contains(&self));
        own.map_or_else(Vec::new, |family| family.into_iter().filter(|p| *p != self).collect())
    }

    /// Whether a term here adds to an input.
    pub fn acts_on(self, input: Input) -> bool {
        self.inputs().iter().any(|(own, _)| *own == input)
    }

    /// What a term adds to here, each with the variables that it sees.
    pub(crate) fn inputs(self) -> &'static [(Input, Of)] {
        match self {
            Self::TorqueLeft => &[(Input::Torque(0), Of::Side(0))],
            Self::TorqueRight => &[(Input::Torque(1), Of::Side(1))],
            Self::TorqueBoth => &[(Input::Torque(0), Of::Side(0)), (Input::Torque(1), Of::Side(1))],
            Self::ForceForward => &[(Input::Force(0), Of::Body)],
            Self::ForceLateral => &[(Input::Force(1), Of::Body)],
            Self::ForceBoth => &[(Input::Force(0), Of::Axis(0)), (Input::Force(1), Of::Axis(1))],
            Self::YawMoment => &[(Input::Moment, Of::Difference)],
            Self::GripLeft => &[(Input::Grip(0), Of::Side(0))],
            Self::GripRight => &[(Input::Grip(1), Of::Side(1))],
            Self::GripAll => &[(Input::Grip(0), Of::Side(0)), (Input::Grip(1), Of::Side(1))],
            Self::LateralGrip => &[(Input::LateralGrip, Of::Body)],
            Self::RadiusLeft => &[(Input::Radius(0), Of::Side(0))],
            Self::RadiusRight => &[(Input::Radius(1), Of::Side(1))],
            Self::RadiusAll => &[(Input::Radius(0), Of::Side(0)), (Input::Radius(1), Of::Side(1))],
            Self::SlopeX => &[(Input::Slope(0), Of::Body)],
            Self::SlopeY => &[(Input::Slope(1), Of::Body)],
        }
    }

    /// The unit of what acts here.
    pub fn unit(self) -> Unit {
        match self {
            Self::TorqueLeft | Self::TorqueRight | Self::TorqueBoth | Self::YawMoment => Unit::TORQUE,
            Self::ForceForward | Self::ForceLateral | Self::ForceBoth => Unit::FORCE,
            Self::GripLeft | Self::GripRight | Self::GripAll | Self::LateralGrip => Unit::ONE,
            Self::RadiusLeft | Self::RadiusRight | Self::RadiusAll => Unit::METRE,
            Self::SlopeX | Self::SlopeY => Unit::RADIAN,
        }
    }
}
