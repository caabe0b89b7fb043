//! A drive as its sensors tell it: smooth motion and noise, so that files have the sizes that real ones have.

use super::ros2::Cdr;

/// Joints of a robot with four wheels.
const JOINTS: [&str; 4] =
    ["front_left_wheel_joint", "front_right_wheel_joint", "rear_left_wheel_joint", "rear_right_wheel_joint"];
/// Bytes of a picture; a camera of 640 by 480 gives some 40 to 60 kB.
const PICTURE: usize = 50_000;

/// Noise that is the same in every run.
pub(super) struct Noise(u64);

impl Noise {
    pub(super) const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// SplitMix64.
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A number about zero.
    fn about(&mut self, size: f64) -> f64 {
        size * (self.bits() as f64 / u64::MAX as f64 - 0.5)
    }
}

/// Yaw rate, rad/s.
fn turning(t: f64) -> f64 {
    0.4 * (0.21 * t).sin()
}

pub(super) fn joint_states(t_ns: u64, noise: &mut Noise) -> Vec<u8> {
    let t = t_ns as f64 * 1e-9;
    let (mean, half) = (6.0 + 2.0 * (0.13 * t).sin(), 1.9 * turning(t));
    let speeds = [mean - half, mean + half, mean - half, mean + half].map(|speed| speed + noise.about(0.1));
    let angles = speeds.map(|speed| speed * t + noise.about(0.01));
    let efforts = speeds.map(|speed| 0.3 * speed + noise.about(0.5));
    Cdr::new().header(t_ns, "").texts(&JOINTS).list(&angles).list(&speeds).list(&efforts).into_bytes()
}

pub(super) fn imu(t_ns: u64, noise: &mut Noise) -> Vec<u8> {
    let t = t_ns as f64 * 1e-9;
    let heading = 0.5 * t.sin() + noise.about(1e-3);
    let rates = [noise.about(0.02), noise.about(0.02), turning(t) + noise.about(0.01)];
    let accelerations = [noise.about(0.3), 0.5 * turning(t) + noise.about(0.3), 9.81 + noise.about(0.2)];
    Cdr::new()
        .header(t_ns, "imu_link")
        .numbers(&[0.0, 0.0, (0.5 * heading).sin(), (0.5 * heading).cos()])
        .numbers(&[0.01; 9])
        .numbers(&rates)
        .numbers(&[0.02; 9])
        .numbers(&accelerations)
        .numbers(&[0.03; 9])
        .into_bytes()
}

pub(super) fn odometry(t_ns: u64, noise: &mut Noise) -> Vec<u8> {
    let t = t_ns as f64 * 1e-9;
    let heading = 0.5 * t.sin();
    Cdr::new()
        .header(t_ns, "odom")
        .text("base_link")
        .numbers(&[t + noise.about(0.01), noise.about(0.01), 0.0])
        .numbers(&[0.0, 0.0, (0.5 * heading).sin(), (0.5 * heading).cos()])
        .numbers(&[0.001; 36])
        .numbers(&[0.9 + noise.about(0.05), 0.0, 0.0, 0.0, 0.0, turning(t)])
        .numbers(&[0.001; 36])
        .into_bytes()
}

/// A picture that was compressed before, so that zstd finds nothing in it.
pub(super) fn picture(t_ns: u64, noise: &mut Noise) -> Vec<u8> {
    let octets: Vec<u8> = (0..PICTURE / 8).flat_map(|_| noise.bits().to_le_bytes()).collect();
    Cdr::new().header(t_ns, "camera").text("jpeg").octets(&octets).into_bytes()
}
