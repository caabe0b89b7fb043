//! The robot, the ground, and a drive in rows of a hundredth of a second.

use crate::random::Stream;

/// A hundredth of a second, s.
pub(super) const STEP: f64 = 0.01;
const GRAVITY: f64 = 9.81;
/// Time in which a side follows its set speed, s.
const FOLLOWS: f64 = 0.15;
/// Yaw rate at which half of the scrub couple is there, rad/s.
const SCRUBS: f64 = 0.05;
/// Time in which a drive train warms up, s.
const WARMS: f64 = 240.0;

/// A skid-steer robot by its steady torques.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Robot {
    /// Mass, kg.
    pub mass: f64,
    /// Wheel radius, track and wheelbase, m.
    pub radius: f64,
    /// Distance of the sides, m.
    pub track: f64,
    /// Distance of the axles, m.
    pub base: f64,
    /// Rolling resistance on hard ground.
    pub rolling: f64,
    /// Dry friction of each side's drive train when warm, N m.
    pub dry: [f64; 2],
    /// Viscous friction of a side, N m s/m at the tyre.
    pub viscous: f64,
    /// Lateral friction that scrubs.
    pub scrub: f64,
    /// Effective track on hard ground over the geometric one.
    pub slip: f64,
    /// Torque per current of a side, N m/A.
    pub per_current: f64,
}

/// What the ground does otherwise than the references'.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ground {
    /// Factor of the rolling resistance.
    pub rolling: f64,
    /// Factor of the scrub couple.
    pub scrub: f64,
    /// Factor of the effective track.
    pub track: f64,
}

impl Ground {
    /// The references' ground.
    pub const HARD: Self = Self { rolling: 1.0, scrub: 1.0, track: 1.0 };
}

impl Robot {
    /// Steady torque of straight driving on the level, both sides: at rest, and per m/s.
    pub(super) fn straight(&self, ground: Ground) -> [f64; 2] {
        let rolling = ground.rolling * self.rolling * self.mass * GRAVITY * self.radius;
        [rolling + self.dry[0] + self.dry[1], 2.0 * self.viscous]
    }
}

/// One stretch with the same set speeds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leg {
    /// Set speeds at the tyres, left and right, m/s.
    pub(super) speed: [f64; 2],
    pub(super) seconds: f64,
    pub(super) ground: Ground,
    /// Uphill along the robot, degrees.
    pub(super) degrees: f64,
    /// Share of its motion that the body takes.
    pub(super) moves: f64,
}

/// A row of a drive.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    pub(super) set: [f64; 2],
    /// Torque of each side, N m.
    pub(super) torque: [f64; 2],
    /// Turning rates about x, y, z, rad/s.
    pub(super) rates: [f64; 3],
    /// Specific force along x, y, z without vibration, m/s².
    pub(super) force: [f64; 3],
}

/// How cold the drive train is at the start, as a share by which its friction is larger, and the share of the day.
#[derive(Debug, Clone, Copy)]
pub(super) struct Warmth {
    pub(super) cold: f64,
    pub(super) day: f64,
}

/// Drives the legs.
pub(super) fn drive(robot: &Robot, legs: &[Leg], warmth: Warmth) -> Vec<Row> {
    let mut rows = Vec::new();
    let (mut speed, mut pitch) = ([0.0_f64; 2], 0.0_f64);
    let mut before = 0.0;
    for leg in legs {
        for _ in 0..(leg.seconds / STEP).round() as usize {
            let t = rows.len() as f64 * STEP;
            let friction = warmth.day * (1.0 + warmth.cold * (-t / WARMS).exp());
            for (v, set) in speed.iter_mut().zip(leg.speed) {
                *v += STEP / FOLLOWS * (set - *v);
            }
            // A ramp is entered with one axle after the other.
            let forward = 0.5 * (speed[0] + speed[1]);
            let nose = (STEP * forward.abs() * leg.moves / robot.base).min(1.0);
            let rises = nose * (leg.degrees.to_radians() - pitch);
            pitch += rises;

            let yaw = leg.moves * (speed[1] - speed[0]) / (robot.slip * leg.ground.track * robot.track);
            let weight = robot.mass * GRAVITY;
            let couple = leg.ground.scrub * robot.scrub * weight * robot.base / 4.0 * (yaw / SCRUBS).tanh();
            // Wheels that spin in a hole shear what they touch.
            let digs = (1.0 - leg.moves) * 0.3 * weight * robot.radius;
            let acceleration = (forward - before) / STEP;
            before = forward;
            let torque = std::array::from_fn(|j| {
                let (v, way) = (speed[j], (speed[j] / 0.02).tanh());
                let rolls = 0.5 * leg.ground.rolling * robot.rolling * weight * robot.radius * way;
                let train = friction * (robot.dry[j] * way + robot.viscous * v);
                let pull = 0.5 * weight * robot.radius * pitch.sin();
                let inertia = 0.6 * robot.mass * acceleration * robot.radius;
                let turns = if j == 1 { couple } else { -couple } * robot.radius / robot.track;
                rolls + train + pull + inertia + turns + digs * way
            });
            rows.push(Row {
                set: leg.speed,
                torque,
                rates: [0.0, -rises / STEP, yaw],
                force: [acceleration * leg.moves + GRAVITY * pitch.sin(), forward * yaw, GRAVITY * pitch.cos()],
            });
        }
    }
    rows
}

/// Straight drives, arcs and spins both ways in a drawn order, on the level; about `seconds` long.
pub(super) fn course(robot: &Robot, seconds: f64, s: &mut Stream) -> Vec<Leg> {
    let fast = s.uniform(0.35, 0.7);
    let leg = |speed: [f64; 2], seconds: f64| Leg { speed, seconds, ground: Ground::HARD, degrees: 0.0, moves: 1.0 };
    let spin = 0.3 * robot.track;
    let mut legs = vec![leg([0.0; 2], s.uniform(2.0, 4.0))];
    let mut driven = 0.0;
    while driven < seconds {
        // A round holds all of them, so that no drive lacks one.
        let slow = s.uniform(0.4, 0.7) * fast;
        let mut round = vec![
            leg([fast; 2], s.uniform(12.0, 20.0)),
            leg([slow; 2], s.uniform(12.0, 18.0)),
            leg([0.35 * fast, fast], s.uniform(7.0, 11.0)),
            leg([fast, 0.35 * fast], s.uniform(7.0, 11.0)),
            leg([-spin, spin], s.uniform(6.0, 9.0)),
            leg([spin, -spin], s.uniform(6.0, 9.0)),
        ];
        s.shuffle(&mut round);
        driven += round.iter().map(|l| l.seconds).sum::<f64>();
        legs.extend(round);
    }
    legs.push(leg([0.0; 2], 2.0));
    legs
}
