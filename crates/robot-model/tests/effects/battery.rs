//! What the tests of this battery share.

use robot_model::effect::Scopes;
use robot_model::{
    Chassis, Coefficients, Disc, EffectSpec, OperatingPoint, Presence, Robot, Scalar, State, effects, real,
};

use crate::common::{on_casters, robot};

pub(crate) const H: f64 = 1e-3;

pub(crate) fn at_rest<T: Scalar>(duration: f64) -> (State<T>, f64, f64) {
    (State::default(), duration, H)
}

/// A presence for each way to which an effect may be limited; discs and onsets are met during the drive.
pub(crate) fn presences<T: Scalar>(scopes: Scopes) -> Vec<Presence<T>> {
    let always = Presence::default();
    let mut all = vec![always];
    if scopes.onset {
        all.push(Presence { from: real(0.7), until: real(1.4), ..always });
    }
    if scopes.disc {
        all.push(Presence { disc: Some(Disc { centre: [real(0.3), real(0.1)], radius: real(0.3) }), ..always });
    }
    if scopes.side {
        all.extend([0, 1].map(|side| Presence { side: Some(side), ..always }));
    }
    all
}

/// All ways at once, whatever the specification says: a limit must not change what is neutral.
pub(crate) const ANY: Scopes = Scopes { everywhere: true, onset: true, disc: true, side: true };

/// A sane part of a parameter's bounds, for limits that stand for "none".
pub(crate) fn sane(p: &robot_model::Parameter) -> [f64; 2] {
    p.bounds.map(|b| b.clamp(-1e3, 1e3))
}

pub(crate) fn linear_strengths() -> impl Iterator<Item = (usize, usize, &'static EffectSpec)> {
    effects::catalogue::<f64>()
        .into_iter()
        .enumerate()
        .filter(|(_, e)| e.spec().is_linear())
        .flat_map(|(i, e)| e.spec().strengths().map(move |k| (i, k, e.spec())))
}

/// States at which every smooth law is active: driving and turning, slow, and sliding sideways.
pub(crate) fn moving() -> [State<f64>; 3] {
    let state = |velocity, yaw_rate, speed: [f64; 2], time| State {
        time,
        velocity,
        yaw_rate,
        position: [0.4, -0.2],
        heading: [0.8, 0.6],
        wheel_speed: speed,
        passive: speed.map(|w| 0.97 * w),
        wheel_angle: [1.0, 2.5],
        torque: [1.0, 1.5],
        lagged: [1.0, 1.5],
        ..State::default()
    };
    [
        state([0.8, 0.03], 0.4, [8.0, 10.0], 3.0),
        state([0.02, 0.0], 0.05, [0.2, 0.35], 1.0),
        state([-0.5, 0.3], -1.0, [-4.0, -9.0], 9.0),
    ]
}

/// A robot that drives askew, and an instant of its surroundings.
pub(crate) fn instant(heading: f64) -> (OperatingPoint<f64>, Coefficients<f64>) {
    let at = OperatingPoint {
        chassis: Chassis::SkidSteer,
        time: 3.0,
        position: [1.0, -2.0],
        heading: [heading.cos(), heading.sin()],
        velocity: [0.7, -0.2],
        yaw_rate: 0.5,
        wheel_speed: [6.0, 9.0],
        wheel_angle: [0.3, 2.0],
        mass: 30.0,
        gravity: 9.81,
        hitch: [-0.25, 0.1],
        half_base: [0.17, 0.2],
        torque: [1.0, -1.5],
    };
    let coefficients = Coefficients {
        adhesion: [0.7; 4],
        slip_at_peak: [0.12; 4],
        lateral: [0.9; 4],
        rolling: [0.025; 4],
        radius: [0.09; 4],
        traction: [1.0; 4],
        twist: 0.0,
        coulomb: [0.5, 0.4],
        viscous: [0.03, 0.04],
        stribeck: [0.1; 2],
        torque: [0.0; 2],
        belt_limit: [1e9; 2],
        force: [0.0; 2],
        moment: 0.0,
        tilt: [0.0; 2],
    };
    (at, coefficients)
}

/// All numbers of an instant, in a fixed order.
pub(crate) fn numbers_of(c: &Coefficients<f64>) -> Vec<f64> {
    let Coefficients { adhesion, slip_at_peak, lateral, rolling, radius, coulomb, viscous, stribeck, .. } = *c;
    let Coefficients { traction, twist, torque, belt_limit, force, moment, tilt, .. } = *c;
    let wheels = [adhesion, slip_at_peak, lateral, rolling, radius, traction].into_iter().flatten();
    let sides = [coulomb, viscous, stribeck, torque, belt_limit, force, tilt].into_iter().flatten();
    wheels.chain(sides).chain([moment, twist]).collect()
}

/// A robot on each chassis that an effect may be on.
pub(crate) fn robots_of(spec: &EffectSpec) -> Vec<Robot<f64>> {
    let four_motors = Robot { chassis: Chassis::FourMotors, ..robot() };
    [robot(), four_motors, on_casters()].into_iter().filter(|robot| spec.is_of(robot.chassis)).collect()
}
