//! What the tests of this crate share: a robot, a lively drive, and runs of it.

use robot_model::robot::{Drive, Robot};
use robot_model::{Active, Chassis, Plant, Scalar, State};

/// A 30 kg robot in which no constant is at a special value.
pub(crate) fn robot() -> Robot<f64> {
    Robot {
        mass: 30.0,
        yaw_inertia: 0.9,
        com: [0.01, -0.005, 0.12],
        half_wheelbase: 0.17,
        half_track: 0.2,
        wheel_radius: 0.09,
        wheel_inertia: 0.008,
        motor_inertia: 0.03,
        adhesion: 0.7,
        slip_at_peak: 0.15,
        sliding_share: 0.8,
        rest_speed: 0.3,
        lateral_factor: 0.9,
        rolling_resistance: 0.025,
        coulomb: [0.5, 0.4],
        viscous: [0.03, 0.04],
        stribeck: 0.1,
        chassis: Chassis::SkidSteer,
        casters: [[0.0; 2]; 2],
        caster_trail: 0.0,
        caster_rolling: 0.0,
        hitch_x: -0.25,
        drive: Drive { gain: 1.0, lag: 0.03, extra_lag: 0.0, delay: 0.02, limit: 15.0, dead_band: 0.0 },
        gravity: 9.81,
    }
}

/// A 12 kg robot on two driven wheels, a caster behind and one ahead, in which no constant is at a special value.
pub(crate) fn on_casters() -> Robot<f64> {
    let given = [
        ("mass", 12.0),
        ("yaw_inertia", 0.3),
        ("com_x", -0.03),
        ("com_y", 0.004),
        ("com_height", 0.1),
        ("track", 0.32),
        ("caster_x", -0.18),
        ("caster_y", 0.02),
        ("second_caster_x", 0.15),
        ("second_caster_y", -0.01),
        ("caster_trail", 0.03),
        ("caster_rolling", 0.05),
        ("wheel_radius", 0.07),
        ("wheel_inertia", 0.002),
        ("motor_inertia", 0.01),
        ("adhesion", 0.8),
        ("sliding_share", 0.9),
        ("rolling_resistance", 0.02),
        ("coulomb_left", 0.2),
        ("coulomb_right", 0.25),
        ("viscous", 0.02),
        ("stribeck", 0.05),
        ("motor_lag", 0.02),
        ("torque_limit", 6.0),
    ];
    Robot::on_chassis(Chassis::Differential, &given).expect("a robot")
}

/// A torque command that starts, turns both ways, brakes and reverses; held over 10 ms.
pub(crate) fn command(time: f64) -> [f64; 2] {
    let t = (time * 100.0 + 1e-6).floor() / 100.0;
    let (drive, turn) = (3.5 * (2.8 * t + 0.3).sin(), 4.0 * (4.1 * t).sin());
    [drive - turn, drive + turn]
}

/// A wheel speed command and its rate, rad/s and rad/s².
pub(crate) fn speed_command(time: f64) -> ([f64; 2], [f64; 2]) {
    let (drive, turn) = (6.0 * (1.5 * time).sin(), 2.0 * (2.3 * time).sin());
    let (d_drive, d_turn) = (9.0 * (1.5 * time).cos(), 4.6 * (2.3 * time).cos());
    ([drive - turn, drive + turn], [d_drive - d_turn, d_drive + d_turn])
}

/// The two ways to drive a robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Causality {
    /// Torque in, motion out.
    Torque,
    /// Wheel speeds in, motion and torque out.
    Speed,
}

/// Both of them.
pub(crate) const BOTH: [Causality; 2] = [Causality::Torque, Causality::Speed];

/// Lets `robot` drive the lively command from `start` for `duration` with steps of `h`; calls `see` after each step.
pub(crate) fn run<T: Scalar>(
    robot: &Robot<T>,
    active: &[Active<T>],
    causality: Causality,
    (start, duration, h): (State<T>, f64, f64),
    mut see: impl FnMut(&Plant<T>, &State<T>),
) -> State<T> {
    let plant = Plant::new(robot, active, robot_model::real(h));
    let mut s = start;
    for k in 0..(duration / h).round() as usize {
        let t = k as f64 * h;
        match causality {
            Causality::Torque => plant.step(&mut s, command(t).map(robot_model::real)),
            Causality::Speed => {
                let (speed, rate) = speed_command(t);
                plant.step_at_speed(&mut s, speed.map(robot_model::real), rate.map(robot_model::real));
            }
        }
        see(&plant, &s);
    }
    s
}

/// The state as numbers.
pub(crate) fn numbers<T: Scalar>(s: &State<T>) -> Vec<T> {
    let State { time, position, heading, velocity, yaw_rate, wheel_speed, passive, wheel_angle, .. } = *s;
    let State { torque, lagged, specific, rate, needed, .. } = *s;
    let pairs = [position, heading, velocity, wheel_speed, passive, wheel_angle, torque, lagged, specific, needed];
    [time, yaw_rate].into_iter().chain(pairs.into_iter().flatten()).chain(rate).collect()
}

/// Largest difference of two states, each number relative to its size or one.
pub(crate) fn distance(a: &State<f64>, b: &State<f64>) -> f64 {
    let far = |(a, b): (f64, f64)| (a - b).abs() / a.abs().max(b.abs()).max(1.0);
    numbers(a).into_iter().zip(numbers(b)).map(far).fold(0.0, f64::max)
}
