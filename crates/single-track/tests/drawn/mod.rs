//! Simulated drives of a car by formulas of their own: small steps of the kinematic car with what is hidden.

use single_track::{Car, Case, Columns, Drive, Stated};

/// What the recorded car has beside what its owner states.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Hidden {
    pub(crate) centre: f64,
    pub(crate) gain: f64,
    /// Share by which the axles are farther apart.
    pub(crate) wheelbase: f64,
    pub(crate) encoder: f64,
    pub(crate) gyro_scale: f64,
    pub(crate) gyro_bias: f64,
    pub(crate) lag: f64,
    /// Time of the steering for a radian at its largest rate, s.
    pub(crate) slowness: f64,
    /// Share by which the driven wheels are ahead, over the square of the sideways acceleration, s⁴/m².
    pub(crate) wheel_slip: f64,
    /// Slope of the ground along y, rad.
    pub(crate) slope: f64,
}

/// The car as its owner states it.
pub(crate) fn car() -> Car {
    let mut car = Car::new("drawn", 0.25);
    car.wheelbase = Stated::of(0.25, 0.001);
    car.full_steering = Stated::of(0.4, 0.008);
    car.centre = Stated::of(0.0, 0.005);
    car.point_x = Stated::of(0.1, 0.003);
    car.point_y = Stated::of(0.0, 0.003);
    car.direction = Stated::of(0.0, 0.005);
    car.radius = Stated::of(0.05, 0.0005);
    car
}

fn noise(seed: &mut u64) -> f64 {
    let mut sum = 0.0;
    for _ in 0..12 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        sum += (*seed >> 11) as f64 / (1_u64 << 53) as f64;
    }
    sum - 6.0
}

/// A drive of 40 s.
fn drive(name: &str, hidden: Hidden, seed: u64) -> Drive {
    Drive::new(name, &columns(hidden, seed)).expect("a drive")
}

/// Columns of a drive of 40 s: throttle in steps, steering in steps and sweeps.
pub(crate) fn columns(hidden: Hidden, seed: u64) -> Columns {
    let mut random = seed;
    let (mut x, mut y, mut yaw, mut v, mut angle) = (0.0_f64, 0.0_f64, 0.3_f64, 0.0_f64, 0.0_f64);
    let mut out = Columns::default();
    let phase = 0.7 * seed as f64;
    let command = |t: f64| {
        let level = (t / 3.0).floor();
        let throttle = 0.25 + 0.1 * (1.3 * level + phase).sin();
        let sweep = if level as i64 % 2 == 0 { 0.0 } else { 0.3 * (2.0 * t).sin() };
        (throttle, (0.6 * (2.1 * level + phase).cos() + sweep).clamp(-1.0, 1.0))
    };
    for k in 0..40_000_u32 {
        let t = 1e-3 * f64::from(k);
        let (throttle, steering) = command(t);
        let wanted = hidden.centre + 0.4 * (1.0 + hidden.gain) * steering;
        let turned = (wanted - angle) * if hidden.lag > 0.0 { 1e-3 / hidden.lag } else { 1.0 };
        let most = if hidden.slowness > 0.0 { 1e-3 / hidden.slowness } else { f64::INFINITY };
        angle += turned.clamp(-most, most);
        let rate = v * angle.tan() / (0.25 * (1.0 + hidden.wheelbase));
        v += 1e-3 * (8.0 * (throttle - 0.05) - 0.6 * v - 0.4 - 9.81 * hidden.slope * yaw.sin());
        v = v.max(0.0);
        x += 1e-3 * v * yaw.cos();
        y += 1e-3 * v * yaw.sin();
        yaw += 1e-3 * rate;
        if k % 20 == 0 {
            out.time.push(t);
            let place = [x + 0.1 * yaw.cos(), y + 0.1 * yaw.sin(), yaw];
            out.pose.push([
                place[0] + 5e-4 * noise(&mut random),
                place[1] + 5e-4 * noise(&mut random),
                place[2] + 1e-3 * noise(&mut random),
            ]);
            out.throttle.push(throttle);
            out.steering.push(steering);
            out.gyro.push((1.0 + hidden.gyro_scale) * rate + hidden.gyro_bias + 0.02 * noise(&mut random));
            out.encoder.push(
                (1.0 + hidden.encoder) * v * (1.0 + hidden.wheel_slip * (v * rate).powi(2)) + 0.02 * noise(&mut random),
            );
        }
    }
    out
}

/// Three drives of a car.
pub(crate) fn case(hidden: Hidden, seed: u64) -> Case {
    let drives = (0..3).map(|k| drive(&format!("run-{k}"), hidden, seed + k)).collect();
    Case { car: car(), references: Vec::new(), recordings: drives }
}
