//! What the paper's robot is made of.

use crate::ModelError;
use crate::error::{not_negative, positive, within};

/// Physical parameters of the paper's robot, in SI units.
///
/// The paper publishes none of them; the sets are round numbers for robots of 20, 40 and 90 kg.
/// Front and rear, left and right are symmetric except for the place of the centre of mass on the long axis.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, rename_all = "snake_case")
)]
pub struct Parameters {
    /// Mass m, kg.
    pub mass: f64,
    /// Moment of inertia about the vertical axis through the centre of mass, I_z, kg m².
    pub yaw_inertia: f64,
    /// Wheel radius r, m.
    pub wheel_radius: f64,
    /// Distance of the axles L, m.
    pub wheelbase: f64,
    /// Distance of the left from the right wheels W, m.
    pub track: f64,
    /// Height of the centre of mass h, m.
    pub com_height: f64,
    /// Distance of the centre of mass behind the front axle l_f, m.
    pub com_to_front_axle: f64,
    /// Inertia of one wheel with half of the reflected motor inertia, a1, kg m².
    pub wheel_inertia: f64,
    /// Coulomb friction torque per wheel, a2, N m.
    pub coulomb_torque: f64,
    /// Peak adhesion μ_p, dimensionless.
    pub adhesion: f64,
    /// Slip at the peak of the adhesion λ_p, dimensionless.
    pub slip_at_peak: f64,
    /// Rolling resistance f_r, dimensionless: moment per load and radius.
    pub rolling_resistance: f64,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Speed v_0 that keeps the slip finite at rest, m/s.
    pub slip_floor: f64,
    /// Wheel speed over which the sign turns over, `sgn → tanh(θ̇ / width)`, rad/s.
    pub sign_width: f64,
}

impl Parameters {
    /// The 40 kg robot, the default of the reproduction.
    pub const SET_B: Self = Self {
        mass: 40.0,
        yaw_inertia: 1.2,
        wheel_radius: 0.10,
        wheelbase: 0.35,
        track: 0.40,
        com_height: 0.15,
        com_to_front_axle: 0.175,
        wheel_inertia: 0.03,
        coulomb_torque: 0.3,
        adhesion: 0.8,
        slip_at_peak: 0.2,
        rolling_resistance: 0.03,
        gravity: 9.81,
        slip_floor: 0.02,
        sign_width: 0.05,
    };

    /// A 20 kg robot.
    pub const SET_A: Self = Self {
        mass: 20.0,
        yaw_inertia: 0.45,
        wheel_radius: 0.09,
        wheelbase: 0.30,
        track: 0.35,
        com_height: 0.12,
        com_to_front_axle: 0.15,
        wheel_inertia: 0.01,
        coulomb_torque: 0.1,
        ..Self::SET_B
    };

    /// A 90 kg robot.
    pub const SET_C: Self = Self {
        mass: 90.0,
        yaw_inertia: 5.0,
        wheel_radius: 0.15,
        wheelbase: 0.60,
        track: 0.60,
        com_height: 0.25,
        com_to_front_axle: 0.30,
        wheel_inertia: 0.12,
        coulomb_torque: 1.0,
        ..Self::SET_B
    };

    /// Refuses a robot that cannot be.
    ///
    /// # Errors
    /// [`ModelError`] names the first quantity that is not finite, not positive or out of range.
    pub fn check(&self) -> Result<(), ModelError> {
        positive("mass", self.mass)?;
        positive("yaw inertia", self.yaw_inertia)?;
        positive("wheel radius", self.wheel_radius)?;
        positive("wheelbase", self.wheelbase)?;
        positive("track", self.track)?;
        not_negative("height of the centre of mass", self.com_height)?;
        within("distance of the centre of mass behind the front axle", self.com_to_front_axle, 0.0, self.wheelbase)?;
        positive("wheel inertia", self.wheel_inertia)?;
        not_negative("Coulomb torque", self.coulomb_torque)?;
        positive("adhesion", self.adhesion)?;
        within("slip at the peak", self.slip_at_peak, 1e-6, 1.0)?;
        not_negative("rolling resistance", self.rolling_resistance)?;
        positive("gravity", self.gravity)?;
        positive("slip floor", self.slip_floor)?;
        positive("width of the sign", self.sign_width)
    }
}
