//! What URDF and SDF tell Gazebo in the same words.

use std::f64::consts::FRAC_PI_2;

use crate::contact::{Grip, names, wheels};
use crate::vehicle::Vehicle;
use crate::xml::{Element, element};

/// Torque limits above this are none, N m.
pub(crate) const NO_LIMIT: f64 = 1e5;
/// Width of a wheel, m: seen, not felt.
pub(crate) const WIDTH: f64 = 0.05;
/// Angle that lays a cylinder along the axle, rad.
pub(crate) const LYING: f64 = FRAC_PI_2;

/// What Gazebo's wheel slip knows of a wheel.
pub(crate) struct Slip<'a> {
    pub(crate) link: &'a str,
    /// Slip ratio per share of the load that is used: along the axle and across it.
    pub(crate) compliance: [f64; 2],
    /// Load at rest, N.
    pub(crate) load: f64,
    pub(crate) radius: f64,
}

/// Gazebo's wheel slip: slip ratio = compliance × force/load, the slope of the tyre's law at zero.
pub(crate) fn slip_of<'a>(wheels: impl Iterator<Item = Slip<'a>>) -> Element {
    let wheel = |w: Slip<'_>| {
        element("wheel")
            .with("link_name", w.link)
            .value("slip_compliance_lateral", &[w.compliance[0]])
            .value("slip_compliance_longitudinal", &[w.compliance[1]])
            .value("wheel_normal_force", &[w.load])
            .value("wheel_radius", &[w.radius])
    };
    element("plugin")
        .with("filename", "gz-sim-wheel-slip-system")
        .with("name", "gz::sim::systems::WheelSlip")
        .children(wheels.map(wheel))
}

/// The same of a robot of two or four wheels.
pub(crate) fn slip_plugin(v: &Vehicle, grips: &[Grip; 4]) -> Element {
    let wheel = |i: usize| {
        let compliance = |friction: f64| grips[i].compliance * grips[i].adhesion / friction.max(1e-3);
        Slip {
            link: names(&v.robot)[i],
            compliance: [v.coefficients.lateral[i], v.coefficients.traction[i]]
                .map(|k| compliance(grips[i].adhesion * k)),
            load: grips[i].load,
            radius: v.coefficients.radius[i],
        }
    };
    slip_of(wheels(&v.robot).map(wheel))
}

/// Place of a wheel's shape in its link: at angle zero the axle is `cosine` higher above the ground than its middle.
pub(crate) fn shape_place(v: &Vehicle, wheel: usize) -> [f64; 3] {
    let [cosine, sine] = v.eccentric[wheel];
    [sine, 0.0, -cosine]
}

/// Orientation of an IMU that is turned to the left and whose axes point up a little: roll, pitch, yaw.
pub(crate) fn imu_angles(v: &Vehicle) -> [f64; 3] {
    let s = &v.sensors;
    [s.up[1], -s.up[0], s.left]
}
