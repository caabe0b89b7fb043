//! The table of the constants of a car: name, unit, what is known, usual size, scatter and cause.

use catalogue::car as spec;

use crate::car::{Car, Stated};
use crate::constants::{Constant, Quantity};
use crate::settings::SETTINGS;

/// All constants of a car.
#[expect(clippy::too_many_lines, reason = "a table")]
pub fn constants(car: &Car) -> Vec<Constant> {
    use Quantity as Q;
    let (known, usual, scatter, form) = (SETTINGS.known, SETTINGS.usual, SETTINGS.scatter, SETTINGS.form);
    // Of a drive of which nothing is stated nothing can be wrong; finer laws only make its numbers uncertain.
    let has_finer = |quantity| car.states_drive() || car.more.iter().any(|more| more.0 == quantity);
    let mut out = Vec::new();
    let mut add = |quantity, name, unit, is_factor: bool, stated: Stated, usual, scatter, cause| {
        let sigma = if is_factor { stated.share() } else { stated.sigma };
        let Stated { value: given, is_stated, .. } = stated;
        out.push(Constant { quantity, name, unit, given, is_stated, is_factor, sigma, usual, scatter, cause });
    };
    let none = |quantity, sigma: f64| car.or_usual(quantity, Stated::usual(0.0, sigma));
    let flat = |quantity, [value, sigma]: [f64; 2]| car.or_usual(quantity, Stated::usual(value, sigma));
    let one = |quantity, share: f64| car.or_usual(quantity, Stated::usual(1.0, share));
    // What is stated is a number of another law than the model's.
    let and = |stated: Stated, sigma: f64| Stated { sigma: stated.sigma.hypot(sigma), ..stated };
    let and_share = |stated: Stated, share: f64| and(stated, share * stated.value);

    add(
        Q::FullSteering,
        "steering angle at full command",
        "rad",
        true,
        and_share(car.full_steering, form.full),
        usual.gain,
        scatter.gain,
        &spec::STEERING_COMMAND_GAIN,
    );
    add(
        Q::Centre,
        "steering angle at no command",
        "rad",
        false,
        car.centre,
        usual.centre,
        scatter.centre,
        &spec::STEERING_CENTRE,
    );
    add(
        Q::Curve,
        "bend of the steering map, odd",
        "rad",
        false,
        none(Q::Curve, known.curve),
        usual.curve,
        scatter.curve,
        &spec::STEERING_MAP,
    );
    add(
        Q::Asymmetry,
        "bend of the steering map, even",
        "rad",
        false,
        none(Q::Asymmetry, known.curve),
        usual.curve,
        scatter.curve,
        &spec::STEERING_MAP,
    );
    add(
        Q::SteeringDelay,
        "dead time of the steering",
        "s",
        false,
        and(car.steering_delay, form.time),
        usual.delay,
        scatter.delay,
        &spec::STEERING_DELAY,
    );
    add(
        Q::SteeringLag,
        "time constant of the steering",
        "s",
        false,
        and(car.steering_lag, form.time),
        usual.delay,
        scatter.delay,
        &spec::STEERING_LAG,
    );
    add(
        Q::Slowness,
        "time of the steering for a radian",
        "s/rad",
        false,
        none(Q::Slowness, known.slowness),
        usual.slowness,
        scatter.delay,
        &spec::STEERING_RATE,
    );
    add(
        Q::Play,
        "half of the play of the steering",
        "rad",
        false,
        none(Q::Play, known.play),
        usual.play,
        scatter.curve,
        &spec::STEERING_PLAY,
    );
    add(Q::Wheelbase, "wheelbase", "m", true, car.wheelbase, usual.distance, scatter.geometry, &spec::WHEELBASE);
    add(
        Q::CentreOfMass,
        "centre of mass ahead of the rear axle",
        "m",
        true,
        car.centre_of_mass,
        usual.centre_of_mass,
        scatter.geometry,
        &spec::CENTRE_OF_MASS,
    );
    add(
        Q::Gyration,
        "yaw inertia over mass",
        "m²",
        true,
        car.gyration,
        usual.inertia,
        scatter.geometry,
        &spec::YAW_INERTIA,
    );
    add(
        Q::FrontCompliance,
        "compliance of the front tyres",
        "rad s²/m",
        false,
        none(Q::FrontCompliance, known.compliance),
        usual.compliance,
        scatter.compliance,
        &spec::TYRE_SLIP,
    );
    add(
        Q::RearCompliance,
        "compliance of the rear tyres",
        "rad s²/m",
        false,
        none(Q::RearCompliance, known.compliance),
        usual.compliance,
        scatter.compliance,
        &spec::TYRE_SLIP,
    );
    add(
        Q::FrontInverseGrip,
        "inverse of the grip of the front",
        "s²/m",
        false,
        none(Q::FrontInverseGrip, known.inverse_grip),
        usual.inverse_grip,
        scatter.inverse_grip,
        &spec::GRIP_LIMIT,
    );
    add(
        Q::RearInverseGrip,
        "inverse of the grip of the rear",
        "s²/m",
        false,
        none(Q::RearInverseGrip, known.inverse_grip),
        usual.inverse_grip,
        scatter.inverse_grip,
        &spec::GRIP_LIMIT,
    );
    add(
        Q::DriveGain,
        "acceleration at full throttle",
        "m/s²",
        true,
        and_share(car.drive_gain, form.drive_gain),
        usual.drive_gain,
        scatter.drive_gain,
        &spec::DRIVE_GAIN,
    );
    add(
        Q::DeadZone,
        "dead zone of the throttle",
        "1",
        false,
        and(car.dead_zone, form.dead_zone),
        usual.dead_zone,
        scatter.dead_zone,
        &spec::THROTTLE_DEAD_ZONE,
    );
    add(
        Q::BackEmf,
        "acceleration lost per speed and throttle",
        "1/s",
        false,
        flat(Q::BackEmf, known.back_emf),
        usual.back_emf,
        scatter.viscous,
        &spec::TOP_SPEED,
    );
    add(
        Q::Friction,
        "dry friction of the drive",
        "m/s²",
        false,
        flat(Q::Friction, known.friction),
        usual.friction,
        scatter.friction,
        &spec::DRIVE_FRICTION,
    );
    add(
        Q::Viscous,
        "viscous friction of the drive",
        "1/s",
        false,
        flat(Q::Viscous, known.viscous),
        usual.viscous,
        scatter.viscous,
        &spec::DRIVE_FRICTION,
    );
    if has_finer(Q::MotorBraking) {
        add(
            Q::MotorBraking,
            "acceleration lost per speed while there is throttle",
            "1/s",
            false,
            flat(Q::MotorBraking, known.motor_braking),
            usual.motor_braking,
            scatter.viscous,
            &spec::TOP_SPEED,
        );
    }
    if has_finer(Q::Drag) {
        add(
            Q::Drag,
            "deceleration per square of the speed",
            "1/m",
            false,
            flat(Q::Drag, known.drag),
            usual.drag,
            scatter.drag,
            &spec::DRIVE_FRICTION,
        );
    }
    add(
        Q::DriveLag,
        "time constant of the drive",
        "s",
        false,
        flat(Q::DriveLag, known.drive_lag),
        usual.delay,
        scatter.delay,
        &spec::DRIVE_LAG,
    );
    if has_finer(Q::DriveDelay) {
        add(
            Q::DriveDelay,
            "dead time of the drive",
            "s",
            false,
            flat(Q::DriveDelay, known.drive_delay),
            usual.drive_delay,
            scatter.delay,
            &spec::DRIVE_LAG,
        );
    }
    let slopes = [(Q::SlopeX, "slope along x of the pose's frame"), (Q::SlopeY, "slope along y of the pose's frame")];
    for (quantity, name) in slopes {
        add(quantity, name, "rad", false, none(quantity, known.slope), usual.slope, scatter.slope, &spec::GROUND_SLOPE);
    }
    add(
        Q::PointX,
        "place of the tracked point, forward",
        "m",
        false,
        car.point_x,
        usual.point,
        scatter.point,
        &spec::TRACKED_POINT,
    );
    add(
        Q::PointY,
        "place of the tracked point, left",
        "m",
        false,
        car.point_y,
        usual.point,
        scatter.point,
        &spec::TRACKED_POINT,
    );
    add(
        Q::Direction,
        "direction of the tracked axes",
        "rad",
        false,
        car.direction,
        usual.direction,
        scatter.direction,
        &spec::TRACKED_AXES,
    );
    add(
        Q::Clock,
        "the car's channels come late by",
        "s",
        false,
        none(Q::Clock, known.delay),
        usual.delay,
        scatter.delay,
        &spec::CAR_CLOCK_DELAY,
    );
    add(
        Q::GyroScale,
        "scale of the gyro",
        "1",
        true,
        one(Q::GyroScale, known.gyro_scale),
        usual.gyro_scale,
        scatter.scale,
        &spec::GYRO_SCALE,
    );
    add(
        Q::GyroBias,
        "bias of the gyro",
        "rad/s",
        false,
        none(Q::GyroBias, known.gyro_bias),
        usual.gyro_bias,
        scatter.bias,
        &spec::GYRO_BIAS,
    );
    add(
        Q::GyroDelay,
        "delay of the gyro",
        "s",
        false,
        none(Q::GyroDelay, known.delay),
        usual.delay,
        scatter.delay,
        &spec::GYRO_DELAY,
    );
    add(
        Q::EncoderScale,
        "encoder speed over ground speed",
        "1",
        true,
        one(Q::EncoderScale, car.radius.share()),
        usual.encoder,
        scatter.scale,
        &spec::ENCODER_SCALE,
    );
    add(
        Q::WheelSlip,
        "slip of the driven wheels in bends",
        "s⁴/m²",
        false,
        none(Q::WheelSlip, known.wheel_slip),
        usual.wheel_slip,
        scatter.wheel_slip,
        &spec::WHEEL_SLIP_IN_BENDS,
    );
    add(
        Q::EncoderDelay,
        "delay of the encoder",
        "s",
        false,
        none(Q::EncoderDelay, known.delay),
        usual.delay,
        scatter.delay,
        &spec::ENCODER_DELAY,
    );
    out
}
