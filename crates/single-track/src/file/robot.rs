//! The robot file of `kind = "car"`.

use hierarchical_fit::CaseError as CarError;
use serde::Deserialize;

use crate::car::{Car, Stated};
use crate::constants::Quantity;

/// Cars that are there by name.
pub const BUILT_IN: &[(&str, &str)] =
    &[("car", include_str!("../../robots/car.toml")), ("dart", include_str!("../../robots/dart.toml"))];

/// A car with the columns in which its drives are recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotFile {
    /// The car.
    pub car: Car,
    /// What it is, for people.
    pub description: Option<String>,
    /// Where its drives are recorded.
    pub columns: Columns,
    /// Angle that a steering command of 1 asks for; what the steering makes of it is the car's.
    pub full_asked: f64,
}

/// Columns of a drive.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Columns {
    /// Column of the time.
    pub time: String,
    /// Its unit, and that of the car's clock: s, ms, us or ns.
    pub time_unit: Option<String>,
    /// Throttle, −1 to 1.
    pub throttle: String,
    /// Steering command, positive to the left.
    pub steering: String,
    /// Unit of the steering command: `command` from −1 to 1, or `rad` or `deg` of the angle that is asked for.
    #[serde(default = "command")]
    pub steering_unit: String,
    /// Whether the throttle is passed on.
    pub enabled: Option<String>,
    /// Clock of the car's channels where they are held between its messages.
    pub car_time: Option<String>,
    /// Yaw rate, rad/s.
    pub gyro: Option<String>,
    /// Speed by the encoder, m/s.
    pub encoder: Option<String>,
    /// Place, m; x, y and yaw come together or not at all.
    pub x: Option<String>,
    /// The same, to the left.
    pub y: Option<String>,
    /// Heading, rad.
    pub yaw: Option<String>,
}

fn command() -> String {
    "command".to_owned()
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: String,
    description: Option<String>,
    kind: String,
    wheelbase: Option<Number>,
    mass: Option<Number>,
    front_axle_mass: Option<Number>,
    centre_of_mass: Option<Number>,
    yaw_inertia: Option<Number>,
    yaw_inertia_over_mass: Option<Number>,
    wheel_radius: Option<Number>,
    steering: Option<Steering>,
    #[serde(default)]
    drive: DriveTrain,
    #[serde(default)]
    tyres: Tyres,
    #[serde(default)]
    ground: Ground,
    #[serde(default)]
    point: Point,
    #[serde(default)]
    clock: Clock,
    #[serde(default)]
    gyro: Gyro,
    #[serde(default)]
    encoder: Encoder,
    columns: Option<Columns>,
}

/// A number with its sigma and where it comes from.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Number {
    value: f64,
    sigma: Option<f64>,
    /// Read by people.
    #[serde(rename = "source")]
    _source: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Steering {
    full_angle: Option<Number>,
    gain: Option<Number>,
    centre: Option<Number>,
    bend: Option<Number>,
    asymmetry: Option<Number>,
    delay: Option<Number>,
    lag: Option<Number>,
    seconds_per_radian: Option<Number>,
    half_play: Option<Number>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct DriveTrain {
    full_acceleration: Option<Number>,
    dead_zone: Option<Number>,
    back_emf: Option<Number>,
    friction: Option<Number>,
    viscous_friction: Option<Number>,
    motor_braking: Option<Number>,
    drag: Option<Number>,
    lag: Option<Number>,
    delay: Option<Number>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Tyres {
    front_compliance: Option<Number>,
    rear_compliance: Option<Number>,
    front_inverse_grip: Option<Number>,
    rear_inverse_grip: Option<Number>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Ground {
    slope_x: Option<Number>,
    slope_y: Option<Number>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Point {
    x: Option<Number>,
    y: Option<Number>,
    yaw: Option<Number>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Clock {
    delay: Option<Number>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Gyro {
    scale: Option<Number>,
    bias: Option<Number>,
    delay: Option<Number>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Encoder {
    window: Option<f64>,
    scale: Option<Number>,
    slip_in_bends: Option<Number>,
    delay: Option<Number>,
}

impl File {
    /// What is stated of constants that have no place of their own in [`Car`].
    fn more(&self) -> Vec<(Quantity, &Number)> {
        use Quantity as Q;
        let steering = self.steering.as_ref();
        let of_steering = |of: fn(&Steering) -> Option<&Number>| steering.and_then(of);
        let (tyres, drive) = (&self.tyres, &self.drive);
        let all = [
            (Q::Curve, of_steering(|s| s.bend.as_ref())),
            (Q::Asymmetry, of_steering(|s| s.asymmetry.as_ref())),
            (Q::Slowness, of_steering(|s| s.seconds_per_radian.as_ref())),
            (Q::Play, of_steering(|s| s.half_play.as_ref())),
            (Q::FrontCompliance, tyres.front_compliance.as_ref()),
            (Q::RearCompliance, tyres.rear_compliance.as_ref()),
            (Q::FrontInverseGrip, tyres.front_inverse_grip.as_ref()),
            (Q::RearInverseGrip, tyres.rear_inverse_grip.as_ref()),
            (Q::BackEmf, drive.back_emf.as_ref()),
            (Q::Friction, drive.friction.as_ref()),
            (Q::Viscous, drive.viscous_friction.as_ref()),
            (Q::MotorBraking, drive.motor_braking.as_ref()),
            (Q::Drag, drive.drag.as_ref()),
            (Q::DriveLag, drive.lag.as_ref()),
            (Q::DriveDelay, drive.delay.as_ref()),
            (Q::SlopeX, self.ground.slope_x.as_ref()),
            (Q::SlopeY, self.ground.slope_y.as_ref()),
            (Q::Clock, self.clock.delay.as_ref()),
            (Q::GyroScale, self.gyro.scale.as_ref()),
            (Q::GyroBias, self.gyro.bias.as_ref()),
            (Q::GyroDelay, self.gyro.delay.as_ref()),
            (Q::EncoderScale, self.encoder.scale.as_ref()),
            (Q::WheelSlip, self.encoder.slip_in_bends.as_ref()),
            (Q::EncoderDelay, self.encoder.delay.as_ref()),
        ];
        all.into_iter().filter_map(|(quantity, number)| Some((quantity, number?))).collect()
    }
}

impl RobotFile {
    /// Whether a robot file is one of this kind.
    pub fn is_one(text: &str) -> bool {
        odometry::file::is_of_kind(text, "car")
    }

    /// Reads a robot file.
    ///
    /// # Errors
    /// Syntax, unknown keys, and numbers that are missing or cannot be, with what to do.
    #[expect(clippy::too_many_lines, reason = "one check after the other")]
    pub fn parse(file: &str, text: &str) -> Result<Self, CarError> {
        let wrong = |what: String| CarError::Robot { robot: file.to_owned(), what };
        let read: File = toml::from_str(text).map_err(|e| wrong(e.message().to_owned()))?;
        if read.kind != "car" {
            return Err(wrong(format!("kind = \"{}\"; wheelbase and steering belong to kind = \"car\"", read.kind)));
        }
        let above_none = |number: &Option<Number>, name: &str| match number {
            Some(n) if n.value.is_nan() || n.value <= 0.0 => {
                Err(wrong(format!("{name} is {}; it has to be above 0", n.value)))
            }
            Some(n) => check_sigma(name, n.sigma).map_err(wrong),
            None => Ok(()),
        };
        let wheelbase = read.wheelbase.as_ref().ok_or_else(|| {
            wrong(
                "no wheelbase; add wheelbase = { value = 0.25, sigma = 0.002 } with the distance of the axles in m"
                    .to_owned(),
            )
        })?;
        let steering = read.steering.as_ref().and_then(|s| s.full_angle.as_ref().map(|f| (s, f))).ok_or_else(|| {
            wrong(
                "the steering has no limits; add [steering] with full_angle, the angle at full command in rad"
                    .to_owned(),
            )
        })?;
        let numbers = [
            (&read.wheelbase, "wheelbase"),
            (&read.mass, "mass"),
            (&read.front_axle_mass, "front_axle_mass"),
            (&read.centre_of_mass, "centre_of_mass"),
            (&read.yaw_inertia, "yaw_inertia"),
            (&read.yaw_inertia_over_mass, "yaw_inertia_over_mass"),
            (&read.wheel_radius, "wheel_radius"),
            (&read.drive.full_acceleration, "full_acceleration of [drive]"),
        ];
        for (number, name) in numbers {
            above_none(number, name)?;
        }
        above_none(&steering.0.full_angle, "full_angle of [steering]")?;
        above_none(&steering.0.gain, "gain of [steering]")?;
        above_none(&read.gyro.scale, "scale of [gyro]")?;
        above_none(&read.encoder.scale, "scale of [encoder]")?;
        for (quantity, number) in read.more() {
            check_more(quantity, number).map_err(wrong)?;
        }
        if steering.1.value >= std::f64::consts::FRAC_PI_2 {
            let what = format!("full_angle is {} rad; write radians below 1.57, not degrees", steering.1.value);
            return Err(wrong(what));
        }
        let Some(columns) = read.columns.clone() else {
            return Err(wrong("no [columns]; say which columns hold time, throttle and steering".to_owned()));
        };
        let pose = [&columns.x, &columns.y, &columns.yaw].iter().filter(|c| c.is_some()).count();
        if pose % 3 != 0 {
            return Err(wrong("[columns] names a part of the pose; give x, y and yaw, or none of them: a position without a heading is not compared".to_owned()));
        }
        odometry::file::seconds_in(columns.time_unit.as_deref()).map_err(wrong)?;
        if !["command", "rad", "deg"].contains(&columns.steering_unit.as_str()) {
            let unit = &columns.steering_unit;
            return Err(wrong(format!("steering_unit = \"{unit}\"; write command, rad or deg")));
        }

        let mut car = Car::new(&read.name, wheelbase.value);
        let set = |to: &mut Stated, number: &Option<Number>| {
            if let Some(n) = number {
                *to = to.replaced_by(n.value, n.sigma);
            }
        };
        set(&mut car.wheelbase, &read.wheelbase);
        set(&mut car.full_steering, &steering.0.full_angle);
        if let Some(gain) = &steering.0.gain {
            let full = &mut car.full_steering;
            (full.value, full.sigma) = (full.value * gain.value, full.sigma * gain.value);
            full.sigma = full.sigma.hypot(gain.sigma.unwrap_or(0.0) * full.value);
        }
        set(&mut car.centre, &steering.0.centre);
        set(&mut car.steering_delay, &steering.0.delay);
        set(&mut car.steering_lag, &steering.0.lag);
        set(&mut car.drive_gain, &read.drive.full_acceleration);
        set(&mut car.dead_zone, &read.drive.dead_zone);
        set(&mut car.point_x, &read.point.x);
        set(&mut car.point_y, &read.point.y);
        set(&mut car.direction, &read.point.yaw);
        set(&mut car.radius, &read.wheel_radius);
        set(&mut car.centre_of_mass, &read.centre_of_mass);
        if let (None, Some(front), Some(mass)) = (&read.centre_of_mass, &read.front_axle_mass, &read.mass) {
            let share = front.value / mass.value;
            if share >= 1.0 {
                let what = format!(
                    "front_axle_mass is {} kg of a mass of {} kg; correct one of them",
                    front.value, mass.value
                );
                return Err(wrong(what));
            }
            let sigma = car.centre_of_mass.sigma;
            car.centre_of_mass = Stated::of(share * wheelbase.value, sigma);
        }
        if car.centre_of_mass.value >= wheelbase.value {
            let what = format!(
                "centre_of_mass is {} m ahead of the rear axle; it has to be between the axles",
                car.centre_of_mass.value
            );
            return Err(wrong(what));
        }
        set(&mut car.gyration, &read.yaw_inertia_over_mass);
        match (&read.yaw_inertia, &read.mass) {
            (Some(_), _) if read.yaw_inertia_over_mass.is_some() => {
                return Err(wrong("yaw_inertia and yaw_inertia_over_mass; leave one of them out".to_owned()));
            }
            (Some(inertia), Some(mass)) => {
                let usual = car.gyration.share() * inertia.value;
                car.gyration = Stated::of(inertia.value / mass.value, inertia.sigma.unwrap_or(usual) / mass.value);
            }
            (Some(_), None) => return Err(wrong("yaw_inertia without mass; add the mass in kg".to_owned())),
            (None, _) => {}
        }
        car.encoder_window = read.encoder.window.unwrap_or(0.0);
        car.more = read.more().into_iter().map(|(quantity, n)| (quantity, n.value, n.sigma)).collect();
        let all =
            [&car.wheelbase, &car.full_steering, &car.centre, &car.point_x, &car.point_y, &car.direction, &car.radius];
        if all.iter().any(|s| !(s.sigma > 0.0 && s.value.is_finite())) {
            return Err(wrong(
                "a sigma is not above 0; write how well the number is known, one standard deviation".to_owned(),
            ));
        }
        Ok(Self { car, description: read.description, columns, full_asked: steering.1.value })
    }
}

/// Refuses a number that no car can have.
fn check_more(quantity: Quantity, number: &Number) -> Result<(), String> {
    let (table, key) = quantity.key();
    let name = table.map_or_else(|| key.to_owned(), |table| format!("{key} of [{table}]"));
    let value = number.value;
    if !value.is_finite() {
        return Err(format!("{name} is {value}; it has to be a number"));
    }
    if quantity.is_size() && value < 0.0 {
        return Err(format!("{name} is {value}; it has to be 0 or above"));
    }
    check_sigma(&name, number.sigma)
}

/// Refuses a sigma that is none.
fn check_sigma(name: &str, sigma: Option<f64>) -> Result<(), String> {
    match sigma {
        Some(sigma) if sigma.is_nan() || sigma <= 0.0 => Err(format!(
            "sigma of {name} is {sigma}; it has to be above 0: give one sigma of how well this is known, or leave it out"
        )),
        _ => Ok(()),
    }
}
