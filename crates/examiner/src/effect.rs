//! The vocabulary of effects: how large each is drawn and what it does to the plant.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use crate::hidden::{Disc, Hidden};
use crate::random::Stream;
use crate::robot::{Constants, GRAVITY};
use crate::truth::EffectTruth;
use crate::{Place, Setting, Severity};

/// The ids of the vocabulary, as they stand in `effects.json`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "effects.json says what each means")]
pub enum EffectId {
    ViscousFriction,
    Stiction,
    CoulombSide,
    Payload,
    ComOffset,
    Grade,
    AdhesionPatch,
    RollingResistance,
    QuadraticDrag,
    ConstantPull,
    WheelRadiusMismatch,
    TorqueConstant,
    MotorLag,
    TorqueSaturation,
    TransportDelay,
    BacklashDeadZone,
    BeltLoss,
    TurningResistance,
    WheelEccentricity,
    ThermalDrift,
    GyroBias,
    GyroScale,
    EncoderDropout,
    CasterDrag,
}

impl EffectId {
    /// Those of a robot on four wheels.
    pub const ALL: [Self; 23] = [
        Self::ViscousFriction,
        Self::Stiction,
        Self::CoulombSide,
        Self::Payload,
        Self::ComOffset,
        Self::Grade,
        Self::AdhesionPatch,
        Self::RollingResistance,
        Self::QuadraticDrag,
        Self::ConstantPull,
        Self::WheelRadiusMismatch,
        Self::TorqueConstant,
        Self::MotorLag,
        Self::TorqueSaturation,
        Self::TransportDelay,
        Self::BacklashDeadZone,
        Self::BeltLoss,
        Self::TurningResistance,
        Self::WheelEccentricity,
        Self::ThermalDrift,
        Self::GyroBias,
        Self::GyroScale,
        Self::EncoderDropout,
    ];

    /// Those that a robot on casters, or on four wheels, may have. Wheels that do not skid show next to nothing of
    /// another lateral grip.
    pub fn of(casters: bool) -> Vec<Self> {
        let of_four = [Self::BeltLoss, Self::TurningResistance];
        let on_casters = Self::ALL.into_iter().filter(|e| !of_four.contains(e)).chain([Self::CasterDrag]);
        if casters { on_casters.collect() } else { Self::ALL.to_vec() }
    }

    /// Whether it changes only what a sensor says.
    pub fn is_sensor(self) -> bool {
        matches!(self, Self::GyroBias | Self::GyroScale | Self::EncoderDropout)
    }

    /// Its id.
    pub fn id(self) -> String {
        serde_json::to_value(self).ok().and_then(|v| v.as_str().map(str::to_owned)).unwrap_or_default()
    }
}

/// What sizes depend on.
pub(crate) struct Sizing<'a> {
    pub robot: &'a Constants,
    pub severity: Severity,
    pub setting: Setting,
    /// Further factor on the size.
    pub factor: f64,
    /// A torque that a side reaches now and then.
    pub peak_torque: f64,
    pub place: Option<Place>,
}

impl Sizing<'_> {
    /// One of three sizes, spread by 15 %, for this setting.
    pub(crate) fn draw(&self, s: &mut Stream, sizes: [f64; 3], weak: f64) -> f64 {
        let setting = match self.setting {
            Setting::Normal => 1.0,
            Setting::Weak => weak,
        };
        let size = sizes[usize::from(self.severity.number())];
        size * setting * self.factor * s.uniform(0.87, 1.15)
    }
}

/// Hides an effect and says what was hidden.
#[expect(clippy::too_many_lines, reason = "one arm per effect reads best in one place")]
pub(crate) fn hide(id: EffectId, z: &Sizing<'_>, s: &mut Stream, h: &mut Hidden) -> EffectTruth {
    let c = z.robot;
    let scale = c.torque_scale();
    let mut e = EffectTruth::new(id.id(), z.severity.number());
    let side = s.index(2);
    let sided = |e: &mut EffectTruth| e.side = Some(["left", "right"][side].to_owned());
    let sign = s.sign();
    e.magnitude = match id {
        EffectId::ViscousFriction => {
            h.viscous = z.draw(s, [0.35, 0.65, 1.0].map(|k| k * c.viscous[0]), 0.4);
            h.viscous
        }
        EffectId::Stiction => {
            h.stribeck_speed = s.uniform(0.5, 0.9);
            h.stiction = z.draw(s, [0.08, 0.12, 0.18].map(|k| k * scale), 0.75);
            h.stiction
        }
        EffectId::CoulombSide => {
            sided(&mut e);
            h.coulomb[side] = z.draw(s, [0.035, 0.07, 0.11].map(|k| k * scale), 0.4);
            h.coulomb[side]
        }
        EffectId::Payload => {
            h.payload = z.draw(s, [0.12, 0.24, 0.42].map(|k| k * c.mass), 0.4);
            h.payload_inertia = h.payload * c.yaw_inertia / c.mass * s.uniform(0.6, 0.9);
            h.payload_height = 0.25 * c.height;
            e.izz_added = Some(h.payload_inertia);
            e.height_rise_m = Some(h.payload_height);
            h.payload
        }
        EffectId::ComOffset => {
            let axis = s.index(2);
            // On casters the room between what bears the robot is smaller.
            let room = if c.casters.is_some() { 0.5 } else { 1.0 };
            let size = room * z.draw(s, [0.15, 0.26, 0.46].map(|k| k * c.half_base), 0.5);
            h.centre[axis] = sign * size;
            e.axis = Some(["x", "y"][axis].to_owned());
            sign * size
        }
        EffectId::Grade => {
            let slope = z.draw(s, [0.025, 0.05, 0.08], 0.4);
            let direction = s.uniform(-PI, PI);
            h.slope = [slope.sin() * direction.cos(), slope.sin() * direction.sin()];
            e.downhill_direction_rad = Some(direction);
            slope
        }
        EffectId::AdhesionPatch => {
            let lost = z.draw(s, [0.38, 0.55, 0.7], 0.55).min(0.85);
            h.ice = Some((disc(c, s, &mut e), lost));
            lost
        }
        EffectId::RollingResistance => {
            let added = z.draw(s, [0.032, 0.055, 0.09], 0.45);
            let drawn = if s.unit() < 0.5 { Place::Patch } else { Place::Time };
            if z.place.unwrap_or(drawn) == Place::Patch {
                e.place = Some("patch".to_owned());
                h.mud = Some((disc(c, s, &mut e), added));
            } else {
                e.place = Some("time".to_owned());
                h.onset = Some((0.0, added));
            }
            added
        }
        EffectId::QuadraticDrag => {
            let usual = 0.21 * c.mass * (0.097 / c.radius).powi(2);
            h.drag = z.draw(s, [0.9, 1.8, 3.2].map(|k| k * usual), 0.4);
            h.drag
        }
        EffectId::ConstantPull => {
            let weight = c.mass * GRAVITY;
            h.pull = z.draw(s, [0.024, 0.047, 0.075].map(|k| k * weight), 0.4);
            h.pull
        }
        EffectId::WheelRadiusMismatch => {
            sided(&mut e);
            h.radius[side] = sign * z.draw(s, [0.02, 0.035, 0.055], 0.6);
            h.radius[side]
        }
        EffectId::TorqueConstant => {
            h.torque_gain = sign * z.draw(s, [0.12, 0.2, 0.3], 0.5);
            h.torque_gain
        }
        EffectId::MotorLag => {
            h.lag = z.draw(s, [0.08, 0.13, 0.2], 0.6);
            h.lag
        }
        EffectId::TorqueSaturation => {
            let loss = z.draw(s, [0.12, 0.2, 0.3], 0.6).min(0.6);
            h.limit = z.peak_torque * (1.0 - loss);
            h.limit
        }
        EffectId::TransportDelay => {
            h.delay = z.draw(s, [0.05, 0.09, 0.13], 0.55);
            h.delay
        }
        EffectId::BacklashDeadZone => {
            h.dead_zone = z.draw(s, [0.022, 0.042, 0.066].map(|k| k * scale), 0.45);
            h.dead_zone
        }
        EffectId::BeltLoss => {
            sided(&mut e);
            // Belts pass up to about a tenth of the torque scale in ordinary driving.
            let passed = [0.065, 0.04, 0.014][usize::from(z.severity.number())];
            let weak = if z.setting == Setting::Weak { 1.5 } else { 1.0 };
            h.belt[side] = passed * scale * weak * s.uniform(0.87, 1.15) / z.factor;
            h.belt[side]
        }
        EffectId::TurningResistance => {
            h.lateral = sign * z.draw(s, [0.17, 0.29, 0.42], 0.5);
            h.lateral
        }
        EffectId::WheelEccentricity => {
            sided(&mut e);
            h.runout[side] = z.draw(s, [0.035, 0.055, 0.085].map(|k| k * c.radius), 0.6);
            h.runout_phase = [s.uniform(0.0, TAU), 0.0];
            let usual = s.normal(0.25);
            h.runout_phase[1] = h.runout_phase[0] + h.laws.between_wheels.unwrap_or(usual);
            e.phase_front_rad = Some(h.runout_phase[0]);
            e.phase_rear_rad = Some(h.runout_phase[1]);
            h.runout[side]
        }
        EffectId::ThermalDrift => {
            // A falling drift cannot take away more than there is.
            let usual = z.draw(s, [0.033, 0.055, 0.1].map(|k| k * scale), 0.45);
            let least = -0.7 * c.coulomb[0];
            h.drift = (sign * usual).max(least);
            h.drift_time = s.uniform(4.5, 9.0);
            e.tau_s = Some(h.drift_time);
            h.drift
        }
        EffectId::GyroBias => {
            h.gyro_bias = sign * z.draw(s, [0.024, 0.045, 0.075], 0.6);
            h.gyro_bias
        }
        EffectId::GyroScale => {
            h.gyro_scale = sign * z.draw(s, [0.055, 0.1, 0.17], 0.5);
            h.gyro_scale
        }
        EffectId::EncoderDropout => {
            sided(&mut e);
            h.frozen[side] = z.draw(s, [0.035, 0.07, 0.125], 0.6);
            h.frozen[side]
        }
        EffectId::CasterDrag => {
            h.caster_drag = z.draw(s, [0.12, 0.2, 0.35], 0.45);
            h.caster_drag
        }
    };
    e
}

/// A disc near the middle of where the drives stay.
fn disc(c: &Constants, s: &mut Stream, e: &mut EffectTruth) -> Disc {
    let room = (c.radius / 0.097).clamp(0.55, 1.4);
    let disc =
        Disc { x: room * s.uniform(-1.2, 1.2), y: room * s.uniform(-1.2, 1.2), radius: room * s.uniform(0.9, 1.7) };
    (e.x, e.y, e.radius) = (Some(disc.x), Some(disc.y), Some(disc.radius));
    disc
}
