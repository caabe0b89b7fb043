//! Sensors in MJCF.

use robot_model::effect::export::Section;

use super::step::STEP;
use crate::contact::{SIDES, names};
use crate::number::number;
use crate::vehicle::Vehicle;
use crate::xml::{Element, element};

/// Where the sensors sit. The accelerometer has a site of its own: only it shows how the IMU is mounted.
pub(super) fn sites(v: &Vehicle) -> [Element; 2] {
    let site = |name: &'static str| element("site").with("name", name);
    // Axes that point up by a little: turned about y by −up x and about x by up y; then to the left about z.
    let s = &v.sensors;
    let [up_x, up_y] = s.up;
    let (sin, cos) = s.left.sin_cos();
    let mut axes = [[cos, sin, up_x.sin()], [-sin, cos, up_y.sin()]];
    for axis in &mut axes {
        let level = (1.0 - axis[2] * axis[2]).max(0.0).sqrt();
        axis[0] *= level;
        axis[1] *= level;
    }
    let [x, y] = axes;
    [site("imu"), site("accelerometer").nums("xyaxes", &[x[0], x[1], x[2], y[0], y[1], y[2]])]
}

/// Encoders, gyro, accelerometer and pose.
pub(super) fn sensors(v: &Vehicle) -> Element {
    let named = |kind: &'static str, name: String| element(kind).with("name", name);
    let encoder = |side: usize| {
        let name = format!("encoder_{}", SIDES[side]);
        if super::drive::has_encoder_tendon(v, side) {
            return named("tendonvel", name.clone()).with("tendon", name);
        }
        named("jointvel", name).with("joint", names(&v.robot)[2 + side])
    };
    let late = |sensor: Element, delay: f64| {
        if delay <= 0.5 * STEP {
            return sensor;
        }
        let samples = (delay / STEP).ceil() + 2.0;
        sensor.num("delay", delay).with("interp", "linear").with("nsample", number(samples))
    };
    let [imu, pose] = v.sensors.late;
    let frame = |kind: &'static str, name: &str| {
        named(kind, name.to_owned()).with("objtype", "xbody").with("objname", "chassis")
    };
    element("sensor")
        .comments(v.comments(Section::Sensors))
        .children((0..2).map(encoder))
        .child(late(named("gyro", "gyro".to_owned()).with("site", "imu"), imu))
        .child(late(named("accelerometer", "accelerometer".to_owned()).with("site", "accelerometer"), imu))
        .child(late(frame("framepos", "position"), pose))
        .child(late(frame("framequat", "orientation"), pose))
}
