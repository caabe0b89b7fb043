//! A car as its owner states it.

use crate::constants::Quantity;
use crate::settings::{Known as Defaults, SETTINGS};

const DEFAULTS: Defaults = SETTINGS.known;

/// A number with how well it is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stated {
    /// Its value.
    pub value: f64,
    /// One standard deviation, in the unit of the value.
    pub sigma: f64,
    /// Whether the owner states it; otherwise it is the usual value of such cars.
    pub is_stated: bool,
    /// Whether the owner knows more of it than is usual. A number with a sigma as large as usual only says where to begin.
    pub is_known: bool,
}

impl Stated {
    /// A number of the owner.
    pub const fn of(value: f64, sigma: f64) -> Self {
        Self { value, sigma, is_stated: true, is_known: true }
    }

    /// A number of the owner in the place of this one; without a sigma it is known as well as usual.
    pub(crate) fn replaced_by(self, value: f64, sigma: Option<f64>) -> Self {
        let is_size = value != 0.0 && self.value != 0.0;
        let usual = if is_size { self.share() * value.abs() } else { self.sigma };
        let is_known = sigma.is_none_or(|sigma| sigma < SETTINGS.known.as_usual * usual.min(self.sigma));
        Self { value, sigma: sigma.unwrap_or(usual), is_stated: true, is_known }
    }

    /// A usual number.
    pub(crate) const fn usual(value: f64, sigma: f64) -> Self {
        Self { value, sigma, is_stated: false, is_known: false }
    }

    /// The sigma relative to the value.
    pub(crate) fn share(self) -> f64 {
        self.sigma / self.value.abs().max(SETTINGS.model.tiny)
    }
}

/// A car: lengths in m, angles in rad, commands from −1 to 1. x points forward from the middle of the rear axle, y to the left.
#[derive(Debug, Clone, PartialEq)]
pub struct Car {
    /// Its name.
    pub name: String,
    /// Distance of the axles.
    pub wheelbase: Stated,
    /// Distance of the centre of mass from the rear axle.
    pub centre_of_mass: Stated,
    /// Square of the radius of gyration about the vertical axis, m²: yaw inertia over mass.
    pub gyration: Stated,
    /// Steering angle at full command.
    pub full_steering: Stated,
    /// Steering angle at no command.
    pub centre: Stated,
    /// Time from a steering command to the beginning of its motion.
    pub steering_delay: Stated,
    /// Time constant of the steering.
    pub steering_lag: Stated,
    /// Acceleration at full throttle, at rest, m/s².
    pub drive_gain: Stated,
    /// Throttle at which the motor begins to turn.
    pub dead_zone: Stated,
    /// Place of the tracked point, forward of the rear axle.
    pub point_x: Stated,
    /// The same, to the left of the middle.
    pub point_y: Stated,
    /// Direction of the tracked axes in the car.
    pub direction: Stated,
    /// Radius of the wheels that the encoder's speed was computed with.
    pub radius: Stated,
    /// Time over which the encoder counts for a speed, s; 0 of a speed at an instant.
    pub encoder_window: f64,
    /// What its owner states of constants that have no place above, with the sigma where there is one.
    pub more: Vec<(Quantity, f64, Option<f64>)>,
}

impl Car {
    /// A car of a wheelbase, everything else as usual: the centre of mass in the middle, mass spread over the wheelbase and half
    /// its width.
    pub fn new(name: &str, wheelbase: f64) -> Self {
        let share = DEFAULTS.distance;
        let usual = |[value, share]: [f64; 2]| Stated::usual(value, share * value);
        Self {
            name: name.to_owned(),
            wheelbase: Stated::usual(wheelbase, share * wheelbase),
            centre_of_mass: Stated::usual(0.5 * wheelbase, share * wheelbase),
            gyration: usual([DEFAULTS.gyration * wheelbase * wheelbase, DEFAULTS.inertia]),
            full_steering: usual(DEFAULTS.full),
            centre: Stated::usual(0.0, DEFAULTS.centre),
            steering_delay: Stated::usual(0.0, DEFAULTS.delay),
            steering_lag: Stated::usual(0.0, DEFAULTS.delay),
            drive_gain: usual(DEFAULTS.gain),
            dead_zone: Stated::usual(DEFAULTS.dead_zone[0], DEFAULTS.dead_zone[1]),
            point_x: Stated::usual(0.0, DEFAULTS.point),
            point_y: Stated::usual(0.0, DEFAULTS.point),
            direction: Stated::usual(0.0, DEFAULTS.direction),
            radius: usual([1.0, DEFAULTS.radius]),
            encoder_window: 0.0,
            more: Vec::new(),
        }
    }

    /// A constant that has no place of its own: as stated, or as usual.
    pub(crate) fn or_usual(&self, quantity: Quantity, usual: Stated) -> Stated {
        let stated = self.more.iter().find(|more| more.0 == quantity);
        stated.map_or(usual, |&(_, value, sigma)| usual.replaced_by(value, sigma))
    }

    /// Whether its owner says what motor and throttle do: of what is not stated nothing can be wrong.
    pub(crate) fn states_drive(&self) -> bool {
        self.drive_gain.is_known || self.dead_zone.is_known
    }
}
