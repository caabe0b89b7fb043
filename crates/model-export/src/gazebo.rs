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

/// Gazebo's wheel slip: slip ratio = compliance × force/load, the slope of the tyre's law at zero.
pub(crate) fn slip_plugin(v: &Vehicle, grips: &[Grip; 4]) -> Element {
    let wheel = |i: usize| {
        let compliance = |friction: f64| [grips[i].compliance * grips[i].adhesion / friction.max(1e-3)];
        let [along, across] =
            [v.coefficients.lateral[i], v.coefficients.traction[i]].map(|k| compliance(grips[i].adhesion * k));
        element("wheel")
            .with("link_name", names(&v.robot)[i])
            .value("slip_compliance_lateral", &along)
            .value("slip_compliance_longitudinal", &across)
            .value("wheel_normal_force", &[grips[i].load])
            .value("wheel_radius", &[v.coefficients.radius[i]])
    };
    element("plugin")
        .with("filename", "gz-sim-wheel-slip-system")
        .with("name", "gz::sim::systems::WheelSlip")
        .children(wheels(&v.robot).map(wheel))
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
