//! Everything a case may hide, as plain numbers; the neutral value hides nothing.

use crate::law::ForeignLaw;
use crate::random::Stream;

/// A disc of the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Disc {
    pub x: f64,
    pub y: f64,
    pub radius: f64,
}

impl Disc {
    /// Whether a point is inside.
    #[inline]
    pub(crate) fn holds(&self, x: f64, y: f64) -> bool {
        (x - self.x).powi(2) + (y - self.y).powi(2) < self.radius * self.radius
    }
}

/// Physics and sensor faults of the vocabulary. Sides are left then right.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Hidden {
    pub viscous: f64,
    pub stiction: f64,
    pub stribeck_speed: f64,
    pub coulomb: [f64; 2],
    pub payload: f64,
    pub payload_inertia: f64,
    pub payload_height: f64,
    pub centre: [f64; 2],
    /// Downhill direction times the sine of the slope, world axes.
    pub slope: [f64; 2],
    pub ice: Option<(Disc, f64)>,
    pub mud: Option<(Disc, f64)>,
    /// Added rolling resistance from an instant of the run on.
    pub onset: Option<(f64, f64)>,
    pub drag: f64,
    pub pull: f64,
    pub radius: [f64; 2],
    pub torque_gain: f64,
    pub lag: f64,
    pub limit: f64,
    pub delay: f64,
    pub dead_zone: f64,
    pub belt: [f64; 2],
    pub lateral: f64,
    pub runout: [f64; 2],
    /// Angle of the runout at the index mark, front and rear wheel.
    pub runout_phase: [f64; 2],
    pub drift: f64,
    pub drift_time: f64,
    pub gyro_bias: f64,
    pub gyro_scale: f64,
    /// Rolling resistance added to the casters.
    pub caster_drag: f64,
    /// Fraction of rows with a frozen encoder.
    pub frozen: [f64; 2],
    pub laws: Laws,
    pub foreign: Foreign,
}

/// Exponents and courses of laws that another hand would write otherwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Laws {
    /// Exponent of the speed in the exponential of stiction.
    pub stribeck: f64,
    /// Exponent of the speed in the drag.
    pub drag: f64,
    /// Whether a drift rises in proportion to time until twice its time constant, not by an exponential.
    pub linear_drift: bool,
    /// Angle between the run-outs of the front and the rear wheel of a side, rad; near zero if not given.
    pub between_wheels: Option<f64>,
    /// Share of its load by which a wheel out of true presses harder for each metre that it rises, 1/m.
    pub load_per_rise: f64,
}

impl Default for Laws {
    fn default() -> Self {
        Self { stribeck: 2.0, drag: 2.0, linear_drift: false, between_wheels: None, load_per_rise: 0.0 }
    }
}

impl Laws {
    /// Laws of another hand.
    pub(crate) fn draw(s: &mut Stream) -> Self {
        Self {
            stribeck: s.uniform(0.5, 2.0),
            drag: s.uniform(1.0, 2.5),
            linear_drift: s.unit() < 0.5,
            between_wheels: Some(s.uniform(0.0, std::f64::consts::TAU)),
            load_per_rise: s.uniform(0.0, 100.0),
        }
    }

    /// Share of a drift that has come up at time `t` with this time constant, s.
    pub(crate) fn drift(&self, t: f64, time_constant: f64) -> f64 {
        if self.linear_drift { (0.5 * t / time_constant).min(1.0) } else { 1.0 - (-t / time_constant).exp() }
    }
}

impl Default for Hidden {
    fn default() -> Self {
        Self {
            viscous: 0.0,
            stiction: 0.0,
            stribeck_speed: 0.5,
            coulomb: [0.0; 2],
            payload: 0.0,
            payload_inertia: 0.0,
            payload_height: 0.0,
            centre: [0.0; 2],
            slope: [0.0; 2],
            ice: None,
            mud: None,
            onset: None,
            drag: 0.0,
            pull: 0.0,
            radius: [0.0; 2],
            torque_gain: 0.0,
            lag: 0.0,
            limit: f64::INFINITY,
            delay: 0.0,
            dead_zone: 0.0,
            belt: [f64::INFINITY; 2],
            lateral: 0.0,
            runout: [0.0; 2],
            runout_phase: [0.0; 2],
            drift: 0.0,
            drift_time: 6.0,
            gyro_bias: 0.0,
            gyro_scale: 0.0,
            caster_drag: 0.0,
            frozen: [0.0; 2],
            laws: Laws::default(),
            foreign: Foreign::default(),
        }
    }
}

/// Causes that are not in the vocabulary.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Foreign {
    /// Sideways shift of the centre of mass that follows the turning with hysteresis, metres.
    pub cargo: f64,
    /// Cogging torque per side and its periods per wheel turn.
    pub cogging: f64,
    pub cogging_order: f64,
    /// Relative ripple of the transmitted torque and its periods per wheel turn.
    pub ripple: f64,
    pub ripple_order: f64,
    /// Wheel (FL, RL, FR, RR) that loses contact, and when, by run.
    pub lifted: Option<usize>,
    /// Share of torque lost at the power `sag_power`.
    pub sag: f64,
    pub sag_power: f64,
    /// Largest gust, newtons.
    pub gust: f64,
    /// Largest delay of a delay that changes at random, seconds.
    pub jitter: f64,
    /// Loss of friction when slipping along a direction of the ground.
    pub grain: f64,
    pub grain_direction: f64,
    /// Torque dropouts of the drives, share of the time.
    pub dropout: f64,
    /// Side whose brake touches now and then, and its torque, N m.
    pub touch: Option<(usize, f64)>,
    /// Elastic cable: stiffness, anchor and slack length.
    pub cable: Option<(f64, [f64; 2], f64)>,
    /// Extra dry friction per side when rolling backwards.
    pub ratchet: f64,
    /// A law of another grammar.
    pub law: Option<ForeignLaw>,
    /// Length of the explicit steps of an artefact, seconds; zero for none.
    pub explicit_step: f64,
    /// Whether friction is bounded along and across apart.
    pub friction_box: bool,
    /// Key of what happens at random within runs.
    pub seed: u64,
}
