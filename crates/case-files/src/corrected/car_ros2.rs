//! The ROS 2 controller of a car: a single track has no track width, so the bicycle's.

use anyhow::Result;
use model_export::ros2::{Controllers, Geometry, Length};
use single_track::file::RobotFile;
use single_track::{Car, Constant, Quantity, constants};

use super::ColumnsRobot;
use super::car::unheld;

/// Parameters of the controller.
pub(super) fn controllers(robot: &ColumnsRobot) -> Result<Controllers> {
    let car = RobotFile::parse(&robot.name, &robot.text)?.car;
    let tuning = robot.tuning();
    let found = |quantity: Quantity| {
        let name = constants(&car).into_iter().find(|c| c.quantity == quantity).map(|c| c.name);
        name.and_then(|name| tuning.get(name).copied())
    };
    let corrected = found(Quantity::Wheelbase).unwrap_or(car.wheelbase.value);
    let wheelbase = Length { stated: car.wheelbase.value, corrected };
    // The encoder's speed was computed with the stated radius; it is too large where the wheels are smaller.
    let scale = found(Quantity::EncoderScale).filter(|scale| *scale > 0.0).unwrap_or(1.0);
    let radius = Length { stated: car.radius.value, corrected: car.radius.value / scale };
    let radii = car.radius.is_stated.then_some([radius; 2]);
    let geometry = Geometry::Bicycle {
        rear: "rear_wheel_joint".to_owned(),
        steering: "front_steering_joint".to_owned(),
        wheelbase,
        radii,
    };

    let told = told(&car, robot, radii.is_some());
    let mut not_held = Vec::new();
    if let Some(diagnosis) = robot.correction() {
        let held = |constant: &Constant| match constant.quantity {
            Quantity::Wheelbase => true,
            Quantity::EncoderScale => radii.is_some(),
            _ => false,
        };
        not_held.extend(unheld(&car, diagnosis, held).iter().map(|u| u.sentence(geometry.controller())));
    }
    Ok(Controllers { robot: car.name, geometry, scatter: None, told, not_held })
}

fn told(car: &Car, robot: &ColumnsRobot, has_radius: bool) -> Vec<String> {
    let mut out = vec![
        "rear_wheel_joint and front_steering_joint stand for the joints of your URDF: the robot file names no wheels."
            .to_owned(),
        "front_steering: the file of a car has one steered axle, the front one.".to_owned(),
    ];
    out.push(if has_radius {
        "Both wheels get the stated wheel_radius, over the encoder's speed over ground speed where a verdict tells it."
            .to_owned()
    } else {
        format!(
            "front_wheel_radius and rear_wheel_radius are left out, for the file of '{}' states no wheel_radius: add \
             wheel_radius = {{ value = ..., source = \"tape measure\" }}, m, and export again.",
            car.name
        )
    });
    if robot.diagnosis.is_some() {
        out.push(
            "Forecasts of the verdict are from throttle and steering, not from wheels: they say nothing of the errors \
             of this odometry."
                .to_owned(),
        );
    }
    out
}
