//! Drives of robots as the plant has them, at finer steps, with noise and something changed.

use odometry::file::Series;
use robot_model::wheels::{MOST, Plant, Robot, State};
use wheeled::file::{BUILT_IN, RobotFile};
use wheeled::{AnyWheels, Case, Drive, Measured};

/// A uniform number from −1 to 1 of a linear congruential generator (Knuth's constants).
pub(crate) struct Noise(pub(crate) u64);

impl Noise {
    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Of unit variance: a sum of three.
    pub(crate) fn unit(&mut self) -> f64 {
        self.uniform() + self.uniform() + self.uniform()
    }
}

pub(crate) fn robot(name: &str) -> AnyWheels {
    let (_, text) = BUILT_IN.iter().find(|b| b.0 == name).expect("built in");
    RobotFile::parse(name, text).expect("a robot").robot
}

/// What is recorded beside torques and wheels.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum With {
    Pose,
    Gyro,
}

const STEP: f64 = 1e-3;
const SECONDS: f64 = 20.0;

/// Torques that keep the robot moving: friction, and changes of it.
fn torques(plant: &Robot<f64>, t: f64, phase: f64) -> [f64; MOST] {
    let mut out = [0.0; MOST];
    for (k, (to, motor)) in out.iter_mut().zip(plant.motors.iter().flatten()).enumerate() {
        let wheel = plant.wheels.iter().flatten().find(|w| w.motor == Some(k)).expect("a wheel");
        let count = plant.motors.iter().flatten().count() as f64;
        let push = plant.mass * wheel.radius / count;
        let own = 0.35 * (0.5 * t + phase).sin() + 0.25 * (1.3 * t + 2.0 * phase + 1.1 * k as f64).sin();
        *to = push * own + (motor.coulomb + 0.15 * push) * (0.5 * t + phase).sin().signum();
    }
    out
}

/// A drive of a robot that may be another than the one that is stated.
pub(crate) fn drive(stated: &AnyWheels, truth: &Robot<f64>, seed: u64, with: With) -> Drive {
    changing(stated, [truth; 2], 0.0, (seed, with))
}

/// The same of a robot that becomes another one at an instant, s.
fn changing(stated: &AnyWheels, [before, after]: [&Robot<f64>; 2], from: f64, (seed, with): (u64, With)) -> Drive {
    let mut noise = Noise(seed * 7919 + 13);
    let plants = [before, after].map(|robot| Plant::new(robot, STEP));
    let mut s = State::default();
    let phase = noise.uniform() * 3.0;
    let mut of = Measured {
        torque: vec![Series::default(); stated.motors.len()],
        steering: vec![Series::default(); stated.joints.len()],
        wheels: vec![Series::default(); stated.measured.len()],
        is_speed: true,
        ..Measured::default()
    };
    let put = |series: &mut Series, time: f64, value: f64| {
        series.time.push(time);
        series.value.push(value);
    };
    for k in 0..(SECONDS / STEP) as usize {
        let t = STEP * k as f64;
        let row = t - t % 0.02;
        let torque = torques(after, row, phase);
        let mut steering = [0.0; MOST];
        for angle in &mut steering {
            *angle = 0.35 * (0.6 * t + 2.0 * phase).sin();
        }
        if k % 20 == 0 {
            for (series, x) in of.torque.iter_mut().zip(torque) {
                put(series, t, x);
            }
            for (series, x) in of.steering.iter_mut().zip(steering) {
                put(series, t, x);
            }
            for (series, &i) in of.wheels.iter_mut().zip(&stated.measured) {
                put(series, t, s.wheel_speed[i] + 0.02 * noise.unit());
            }
            put(&mut of.gyro, t, s.yaw_rate + 0.004 * noise.unit());
            if with == With::Pose {
                let at = [s.position[0], s.position[1], s.turned];
                for (series, x) in of.pose.iter_mut().zip(at) {
                    put(series, t, x + 0.0005 * noise.unit());
                }
            }
        }
        plants[usize::from(t >= from)].step(&mut s, &torque, &steering);
    }
    Drive::new(&format!("drive {seed}"), stated, &of, false).expect("a drive")
}

/// A case of three recordings, without references.
pub(crate) fn case(name: &str, with: With, change: impl Fn(&mut Robot<f64>)) -> Case {
    let stated = robot(name);
    let mut truth = stated.plant;
    change(&mut truth);
    let recordings = [1, 2, 3].map(|seed| drive(&stated, &truth, seed, with)).to_vec();
    Case { robot: stated, references: Vec::new(), recordings }
}

/// The same with a change that begins in the second recording, s from its start.
pub(crate) fn beginning(name: &str, from: f64, change: impl Fn(&mut Robot<f64>)) -> Case {
    let stated = robot(name);
    let (sound, mut truth) = (stated.plant, stated.plant);
    change(&mut truth);
    let drive = |seed: u64, from: f64| changing(&stated, [&sound, &truth], from, (seed, With::Pose));
    let recordings = vec![drive(1, SECONDS), drive(2, from), drive(3, 0.0)];
    Case { references: Vec::new(), recordings, robot: stated.clone() }
}
