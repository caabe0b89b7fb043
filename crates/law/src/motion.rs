//! The values of an instant, and what a law does to the robot there.

use scalar::Scalar;

/// What a law may depend on at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion<T> {
    /// Time since the start of the recording, s.
    pub time: T,
    /// Geometric centre on the ground, m.
    pub position: [T; 2],
    /// Cosine and sine of the heading.
    pub heading: [T; 2],
    /// Forward and lateral velocity, m/s.
    pub velocity: [T; 2],
    /// Yaw rate, rad/s.
    pub yaw_rate: T,
    /// Wheel speed of each side, rad/s.
    pub wheel_speed: [T; 2],
    /// Wheel angle of each side, rad.
    pub wheel_angle: [T; 2],
    /// Torque of each side's drive, N m.
    pub torque: [T; 2],
    /// Speed at which the rim of each side slips forward over the ground, m/s.
    pub slip: [T; 2],
}

impl<T: Scalar> Default for Motion<T> {
    /// At rest at the origin.
    fn default() -> Self {
        let (o, both) = (T::zero(), [T::zero(); 2]);
        Self {
            time: o,
            position: both,
            heading: [T::one(), o],
            velocity: both,
            yaw_rate: o,
            wheel_speed: both,
            wheel_angle: both,
            torque: both,
            slip: both,
        }
    }
}

/// One number by which a law acts on the robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// Torque at the driven wheel of a side, N m.
    Torque(usize),
    /// Force on the centre of mass along a body axis, N.
    Force(usize),
    /// Yaw moment, N m.
    Moment,
    /// Share by which the grip of a side's wheels rises.
    Grip(usize),
    /// Share by which the lateral grip of all wheels rises.
    LateralGrip,
    /// Length by which the radius of a side's wheels grows, m.
    Radius(usize),
    /// Slope of the ground along a fixed axis, rad, small.
    Slope(usize),
}

impl Input {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Torque(0),
        Self::Torque(1),
        Self::Force(0),
        Self::Force(1),
        Self::Moment,
        Self::Grip(0),
        Self::Grip(1),
        Self::LateralGrip,
        Self::Radius(0),
        Self::Radius(1),
        Self::Slope(0),
        Self::Slope(1),
    ];
}

/// All that a law does to the robot at an instant; units as in [`Input`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Action<T> {
    /// Torque at the driven wheel of each side, N m.
    pub torque: [T; 2],
    /// Force on the centre of mass, N.
    pub force: [T; 2],
    /// Yaw moment, N m.
    pub moment: T,
    /// Share by which each side's grip rises.
    pub grip: [T; 2],
    /// Share by which lateral grip rises.
    pub lateral_grip: T,
    /// Length by which each side's radius grows, m.
    pub radius: [T; 2],
    /// Slope along each fixed axis, rad.
    pub slope: [T; 2],
}

impl<T: Scalar> Default for Action<T> {
    /// Nothing.
    fn default() -> Self {
        let (o, both) = (T::zero(), [T::zero(); 2]);
        Self { torque: both, force: both, moment: o, grip: both, lateral_grip: o, radius: both, slope: both }
    }
}

impl<T: Scalar> Action<T> {
    /// One of its numbers.
    #[inline(always)]
    pub fn get(&self, input: Input) -> T {
        match input {
            Input::Torque(j) => self.torque[j.min(1)],
            Input::Force(k) => self.force[k.min(1)],
            Input::Moment => self.moment,
            Input::Grip(j) => self.grip[j.min(1)],
            Input::LateralGrip => self.lateral_grip,
            Input::Radius(j) => self.radius[j.min(1)],
            Input::Slope(k) => self.slope[k.min(1)],
        }
    }

    /// Adds to one of its numbers.
    #[inline(always)]
    pub fn add(&mut self, input: Input, value: T) {
        *match input {
            Input::Torque(j) => &mut self.torque[j.min(1)],
            Input::Force(k) => &mut self.force[k.min(1)],
            Input::Moment => &mut self.moment,
            Input::Grip(j) => &mut self.grip[j.min(1)],
            Input::LateralGrip => &mut self.lateral_grip,
            Input::Radius(j) => &mut self.radius[j.min(1)],
            Input::Slope(k) => &mut self.slope[k.min(1)],
        } += value;
    }
}
