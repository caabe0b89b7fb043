//! Numbers that decide what in a model is a wheel, and what stands in for numbers that models lack. All are guesses unless
//! they say otherwise.

/// Largest vertical part of a wheel's axle (a direction of length one): camber and rounding.
pub(crate) const LEVEL: f64 = 0.3;
/// Least vertical part of the axis of a steering joint or a caster's swivel: caster angles of up to 25 degrees.
pub(crate) const UPRIGHT: f64 = 0.9;
/// A wheel stands on the ground when its lowest point is above it by at most this share of its radius.
pub(crate) const ON_GROUND: f64 = 0.25;
/// A shape is a wheel's when its middle is off the axle by at most this share of its radius.
pub(crate) const CENTRED: f64 = 0.3;
/// A swivel is that of a caster when the wheel trails behind it by more than this share of its radius.
pub(crate) const TRAIL: f64 = 0.1;
/// Directions (of length one) whose cross product is shorter are parallel.
pub(crate) const PARALLEL: f64 = 0.05;
/// Wheels whose places along the robot differ by less than this share of their radius are of one axle.
pub(crate) const ONE_AXLE: f64 = 0.5;
/// Friction coefficients outside are no measurements: simulators are given large ones so that nothing slides.
pub(crate) const FRICTION: [f64; 2] = [0.02, 3.0];
/// Largest torque of a joint that means "no limit", N m: a common filler.
pub(crate) const NO_EFFORT: f64 = 1e4;
/// Share by which the wheels of a side may differ in inertia before the surplus is that of the motors.
pub(crate) const MOTOR_SURPLUS: f64 = 0.05;

/// One sigma of a number that a model states, as a share: models are drawn by people.
pub(crate) const STATED: f64 = 0.02;
/// The same of an inertia, which models often take from a box.
pub(crate) const STATED_INERTIA: f64 = 0.15;
/// The same of friction and damping, which are often tuned until the simulation drives.
pub(crate) const STATED_FRICTION: f64 = 0.5;
/// One sigma of a number that no model states, as a share: known to a factor of two.
pub(crate) const LACKING: f64 = 0.7;
/// One sigma of the track that sides which skid turn by, as a share: it is 1.1 to 2 times as wide as the robot (Mandow et
/// al. 2007, Martinez et al. 2005).
pub(crate) const SKIDDING: f64 = 0.3;
/// Usual effective track over the measured one (the same sources).
pub(crate) const WIDER: f64 = 1.4;
/// One sigma of the steering's zero, rad.
pub(crate) const CENTRE: f64 = 0.02;
/// One sigma of the tracked point's place, m.
pub(crate) const POINT: f64 = 0.01;
/// One sigma of the direction of its axes, rad.
pub(crate) const DIRECTION: f64 = 0.02;
