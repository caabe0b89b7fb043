//! Numbers that every run has to itself: constants that differ a little from drive to drive, and offsets of sensors.

use robot_model::tunable;

use crate::channel::Channel;
use crate::settings::fit::{Deviations, SETTINGS};

const DEVIATIONS: Deviations = SETTINGS.deviations;

/// A number that every run has to itself.
#[derive(Debug, Clone, Copy)]
pub(crate) enum RunNumber {
    /// How far a constant of ground or drivetrain is off in this run.
    Constant {
        /// Its place in vectors of tunings.
        place: usize,
        /// Relative standard deviation between runs, before the common factor.
        sigma: f64,
    },
    /// What a sensor adds in this run.
    Offset {
        /// What it is added to.
        channel: Channel,
        /// Standard deviation between runs, in the unit of the channel.
        sigma: f64,
    },
}

impl RunNumber {
    /// All of them, in the order of [`RunNumbers`].
    pub(crate) const ALL: [Self; 8] = [
        Self::constant("adhesion", DEVIATIONS.adhesion),
        Self::constant("rolling_resistance", DEVIATIONS.rolling_resistance),
        Self::constant("coulomb_left", DEVIATIONS.dry_friction),
        Self::constant("coulomb_right", DEVIATIONS.dry_friction),
        Self::constant("viscous", DEVIATIONS.viscous_friction),
        Self::offset(Channel::YawRate, DEVIATIONS.gyro),
        Self::offset(Channel::ForwardAcceleration, DEVIATIONS.acceleration),
        Self::offset(Channel::LateralAcceleration, DEVIATIONS.acceleration),
    ];

    const fn constant(id: &str, sigma: f64) -> Self {
        Self::Constant { place: constant(id), sigma }
    }

    const fn offset(channel: Channel, sigma: f64) -> Self {
        Self::Offset { channel, sigma }
    }

    /// Channel and standard deviation of what sensors add.
    pub(crate) fn offsets() -> impl Iterator<Item = (Channel, f64)> {
        Self::ALL.into_iter().filter_map(|number| match number {
            Self::Offset { channel, sigma } => Some((channel, sigma)),
            Self::Constant { .. } => None,
        })
    }
}

/// Place of a tunable constant in vectors of tunings. Of constants only: with a name that does not exist they do not compile.
pub(crate) const fn constant(id: &str) -> usize {
    match tunable::place_of(id) {
        Some(place) => place,
        None => panic!("no tunable constant is called so"),
    }
}

/// A run's own numbers, in standard deviations.
pub(crate) type RunNumbers = [f64; RunNumber::ALL.len()];

/// Those of a run of which nothing is known yet.
pub(crate) const UNKNOWN: RunNumbers = [0.0; RunNumber::ALL.len()];
