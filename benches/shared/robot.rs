//! The robot of the examples that are timed, and how it is driven.

use robot_model::Robot;
use robot_model::robot::Drive;

/// About 20 kg, wheels of 19 cm, Kiencke's law, an ideal drive.
pub(crate) fn robot() -> Robot<f64> {
    Robot {
        mass: 20.0,
        yaw_inertia: 0.9,
        com: [0.0, 0.0, 0.12],
        half_wheelbase: 0.175,
        half_track: 0.215,
        wheel_radius: 0.0965,
        wheel_inertia: 0.02,
        motor_inertia: 0.02,
        adhesion: 0.6,
        slip_at_peak: 0.2,
        sliding_share: 0.0,
        rest_speed: 0.15,
        lateral_factor: 1.0,
        rolling_resistance: 0.02,
        coulomb: [0.3; 2],
        viscous: [0.12; 2],
        stribeck: 0.0,
        chassis: robot_model::Chassis::SkidSteer,
        casters: [[0.0; 2]; 2],
        caster_trail: 0.0,
        caster_rolling: 0.0,
        hitch_x: -0.3,
        drive: Drive { gain: 1.0, lag: 0.0, extra_lag: 0.0, delay: 0.0, limit: 1e3, dead_band: 0.0 },
        gravity: 9.81,
    }
}

/// Torque of each side at a time, N m: drives, turns, spins, stops.
pub(crate) fn torque(t: f64) -> [f64; 2] {
    let both = 2.2 + 1.2 * (0.7 * t).sin();
    let turn = if (1.1 * t).sin() > -0.3 { 2.6 * (0.31 * t + 0.4).sin() } else { 0.0 };
    [both - turn, both + turn]
}
