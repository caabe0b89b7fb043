//! The robot file of `kind = "car"`.

use hierarchical_fit::CaseError as CarError;
use serde::Deserialize;

use crate::car::{Car, Stated};

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
    wheel_radius: Option<Number>,
    steering: Option<Steering>,
    #[serde(default)]
    drive: DriveTrain,
    #[serde(default)]
    point: Point,
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
    centre: Option<Number>,
    delay: Option<Number>,
    lag: Option<Number>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct DriveTrain {
    full_acceleration: Option<Number>,
    dead_zone: Option<Number>,
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
struct Encoder {
    window: Option<f64>,
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
            Some(Number { sigma: Some(sigma), .. }) if sigma.is_nan() || *sigma <= 0.0 => Err(wrong(format!(
                "sigma of {name} is {sigma}; it has to be above 0: give one sigma of how well this is known, or leave it out"
            ))),
            _ => Ok(()),
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
            (&read.wheel_radius, "wheel_radius"),
            (&read.drive.full_acceleration, "full_acceleration of [drive]"),
        ];
        for (number, name) in numbers {
            above_none(number, name)?;
        }
        above_none(&steering.0.full_angle, "full_angle of [steering]")?;
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
                let share = to.share();
                let usual = if n.value == 0.0 || to.value == 0.0 { to.sigma } else { share * n.value.abs() };
                *to = Stated::of(n.value, n.sigma.unwrap_or(usual));
            }
        };
        set(&mut car.wheelbase, &read.wheelbase);
        set(&mut car.full_steering, &steering.0.full_angle);
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
        match (&read.yaw_inertia, &read.mass) {
            (Some(inertia), Some(mass)) => {
                let usual = car.gyration.share() * inertia.value;
                car.gyration = Stated::of(inertia.value / mass.value, inertia.sigma.unwrap_or(usual) / mass.value);
            }
            (Some(_), None) => return Err(wrong("yaw_inertia without mass; add the mass in kg".to_owned())),
            (None, _) => {}
        }
        car.encoder_window = read.encoder.window.unwrap_or(0.0);
        let all =
            [&car.wheelbase, &car.full_steering, &car.centre, &car.point_x, &car.point_y, &car.direction, &car.radius];
        if all.iter().any(|s| !(s.sigma > 0.0 && s.value.is_finite())) {
            return Err(wrong(
                "a sigma is not above 0; write how well the number is known, one standard deviation".to_owned(),
            ));
        }
        Ok(Self { car, description: read.description, columns })
    }
}
