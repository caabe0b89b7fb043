//! What is compared in every window of a recording, by name.

use std::ops::{Index, IndexMut};

/// What is compared in every window.
///
/// Wheel speeds are angle differences over the window, so hardly any encoder quantisation is left; the others are
/// means over it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Channel {
    LeftWheel,
    RightWheel,
    YawRate,
    ForwardVelocity,
    LateralVelocity,
    ForwardAcceleration,
    LateralAcceleration,
}

impl Channel {
    /// Every channel, in the order of its declaration.
    pub(crate) const ALL: [Self; 7] = [
        Self::LeftWheel,
        Self::RightWheel,
        Self::YawRate,
        Self::ForwardVelocity,
        Self::LateralVelocity,
        Self::ForwardAcceleration,
        Self::LateralAcceleration,
    ];

    /// Wheel speeds of the left and the right side.
    pub(crate) const WHEELS: [Self; 2] = [Self::LeftWheel, Self::RightWheel];

    /// Its name for people.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::LeftWheel => "left wheel speed",
            Self::RightWheel => "right wheel speed",
            Self::YawRate => "yaw rate",
            Self::ForwardVelocity => "forward velocity",
            Self::LateralVelocity => "lateral velocity",
            Self::ForwardAcceleration => "forward acceleration",
            Self::LateralAcceleration => "lateral acceleration",
        }
    }

    /// Its unit.
    pub(crate) const fn unit(self) -> &'static str {
        match self {
            Self::LeftWheel | Self::RightWheel | Self::YawRate => "rad/s",
            Self::ForwardVelocity | Self::LateralVelocity => "m/s",
            Self::ForwardAcceleration | Self::LateralAcceleration => "m/s²",
        }
    }

    /// The side whose wheels it is about: 0 left, 1 right.
    pub(crate) const fn side(self) -> Option<usize> {
        match self {
            Self::LeftWheel => Some(0),
            Self::RightWheel => Some(1),
            _ => None,
        }
    }
}

// A channel stands in `ALL` where its declaration does: only then are `Channels` what `from_fn` made of them.
const _: () = {
    let mut place = 0;
    while place < Channel::ALL.len() {
        assert!(Channel::ALL[place] as usize == place, "`Channel::ALL` is not in the order of the declaration");
        place += 1;
    }
};

/// One of something for each channel; of numbers, a window of a recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Channels<T>([T; Channel::ALL.len()]);

impl<T> Channels<T> {
    /// What `of` gives for each channel.
    #[inline]
    pub(crate) fn from_fn(of: impl FnMut(Channel) -> T) -> Self {
        Self(Channel::ALL.map(of))
    }

    /// The same with each changed.
    #[inline]
    pub(crate) fn map<U>(self, of: impl FnMut(T) -> U) -> Channels<U> {
        Channels(self.0.map(of))
    }

    /// All of them, in the order of [`Channel::ALL`].
    #[inline]
    pub(crate) fn iter(&self) -> std::slice::Iter<'_, T> {
        self.0.iter()
    }
}

impl<T: Copy> Channels<T> {
    /// The same for all channels.
    #[inline]
    pub(crate) fn all(value: T) -> Self {
        Self([value; Channel::ALL.len()])
    }
}

impl<T> Index<Channel> for Channels<T> {
    type Output = T;

    #[inline]
    fn index(&self, channel: Channel) -> &T {
        &self.0[channel as usize]
    }
}

impl<T> IndexMut<Channel> for Channels<T> {
    #[inline]
    fn index_mut(&mut self, channel: Channel) -> &mut T {
        &mut self.0[channel as usize]
    }
}

/// A number for each channel, the same for the wheels of both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ByQuantity {
    pub(crate) wheel_speed: f64,
    pub(crate) yaw_rate: f64,
    pub(crate) forward_velocity: f64,
    pub(crate) lateral_velocity: f64,
    pub(crate) forward_acceleration: f64,
    pub(crate) lateral_acceleration: f64,
}

impl From<ByQuantity> for Channels<f64> {
    fn from(of: ByQuantity) -> Self {
        Self::from_fn(|channel| match channel {
            Channel::LeftWheel | Channel::RightWheel => of.wheel_speed,
            Channel::YawRate => of.yaw_rate,
            Channel::ForwardVelocity => of.forward_velocity,
            Channel::LateralVelocity => of.lateral_velocity,
            Channel::ForwardAcceleration => of.forward_acceleration,
            Channel::LateralAcceleration => of.lateral_acceleration,
        })
    }
}
