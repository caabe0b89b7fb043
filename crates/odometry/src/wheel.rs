//! The robot as a list of wheels.

use crate::error::OdometryError;
use crate::kinematics::Kinematics;
use crate::settings::SETTINGS;
use hierarchical_fit::CaseError;

/// A wheel on the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct Wheel {
    /// Its name in messages.
    pub name: String,
    /// Place of its contact with the ground in the robot: x forward, y left, m.
    pub place: [f64; 2],
    /// Direction in which it rolls when it turns forward, counter-clockwise from x, rad; of a steered wheel at steering zero.
    pub direction: f64,
    /// Angle from the wheel's axle to the axle of its rollers, rad: 0 without rollers, π/2 of an omni wheel, ±π/4 of a
    /// mecanum wheel.
    pub roller: f64,
    /// Radius, m.
    pub radius: f64,
    /// Counts of its encoder per turn of the wheel; `None` where angles or speeds are recorded, or nothing.
    pub counts_per_turn: Option<f64>,
    /// Whether its turning is recorded. One that is not only says that it does not slide sideways.
    pub measured: bool,
    /// Whether it is steered by the recorded steering angle.
    pub steered: bool,
}

impl Wheel {
    /// A plain wheel that rolls forward, with its turning recorded.
    pub fn new(name: &str, place: [f64; 2], radius: f64) -> Self {
        Self {
            name: name.to_owned(),
            place,
            direction: 0.0,
            roller: 0.0,
            radius,
            counts_per_turn: None,
            measured: true,
            steered: false,
        }
    }
}

/// How well the owner knows the robot: one sigma each; `None` takes what is usual.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Sigmas {
    /// Radius of a wheel, relative.
    pub radius: Option<f64>,
    /// Distances across the robot (track), relative.
    pub across: Option<f64>,
    /// Distances along the robot (wheelbase), relative.
    pub along: Option<f64>,
    /// Zero of the steering, rad.
    pub steering: Option<f64>,
    /// Gain of the steering, relative.
    pub steering_gain: Option<f64>,
    /// Direction of the pose's frame in the robot, rad.
    pub mounting: Option<f64>,
    /// Place of the pose's origin in the robot, m.
    pub origin: Option<f64>,
}

/// A robot whose wheels determine its motion on the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct WheeledRobot {
    /// Its name in messages.
    pub name: String,
    /// Its wheels; casters are left out, for they determine nothing.
    pub wheels: Vec<Wheel>,
    /// How well these numbers are known.
    pub sigmas: Sigmas,
}

impl WheeledRobot {
    /// Two driven wheels on one axle, `track` apart: 0 left, 1 right. Casters follow.
    pub fn differential(radius: f64, track: f64) -> Self {
        let half = 0.5 * track;
        Self::of(
            "differential",
            vec![Wheel::new("left", [0.0, half], radius), Wheel::new("right", [0.0, -half], radius)],
        )
    }

    /// A driven and steered front wheel, `wheelbase` before an axle of two free wheels whose middle is the origin.
    pub fn tricycle(radius: f64, wheelbase: f64) -> Self {
        let front = Wheel { steered: true, ..Wheel::new("front", [wheelbase, 0.0], radius) };
        let rear = Wheel { measured: false, ..Wheel::new("rear axle", [0.0, 0.0], radius) };
        Self::of("tricycle", vec![front, rear])
    }

    /// Three omni wheels at −60°, 60° and 180°, `reach` from the centre, that turn the robot clockwise when they turn forward.
    pub fn omni_3(radius: f64, reach: f64) -> Self {
        let quarter = std::f64::consts::FRAC_PI_2;
        let sixth = std::f64::consts::FRAC_PI_3;
        let wheel = |(name, angle): (&str, f64)| Wheel {
            direction: angle - quarter,
            roller: quarter,
            ..Wheel::new(name, [reach * angle.cos(), reach * angle.sin()], radius)
        };
        let wheels = [("wheel 1", -sixth), ("wheel 2", sixth), ("wheel 3", std::f64::consts::PI)];
        Self::of("omni-3", wheels.map(wheel).to_vec())
    }

    /// Four omni wheels at ±45° and ±135°, `reach` from the centre, turning the robot counter-clockwise when they turn
    /// forward: front left, rear left, rear right, front right.
    pub fn omni_4(radius: f64, reach: f64) -> Self {
        let names = ["front left", "rear left", "rear right", "front right"];
        let quarter = std::f64::consts::FRAC_PI_2;
        let wheel = |(k, name): (usize, &&str)| {
            let angle = quarter * (k as f64 + 0.5);
            Wheel {
                direction: angle + quarter,
                roller: quarter,
                ..Wheel::new(name, [reach * angle.cos(), reach * angle.sin()], radius)
            }
        };
        Self::of("omni-4", names.iter().enumerate().map(wheel).collect())
    }

    /// Four mecanum wheels whose upper rollers form an X seen from above: front left, front right, rear left, rear right.
    /// Muir & Neuman (1987), "Kinematic modeling for feedback control of an omnidirectional wheeled mobile robot".
    pub fn mecanum_4(radius: f64, wheelbase: f64, track: f64) -> Self {
        let (x, y) = (0.5 * wheelbase, 0.5 * track);
        let eighth = std::f64::consts::FRAC_PI_4;
        let wheel = |name: &str, place: [f64; 2], roller: f64| Wheel { roller, ..Wheel::new(name, place, radius) };
        Self::of(
            "mecanum-4",
            vec![
                wheel("front left", [x, y], eighth),
                wheel("front right", [x, -y], -eighth),
                wheel("rear left", [-x, y], -eighth),
                wheel("rear right", [-x, -y], eighth),
            ],
        )
    }

    /// Sides that are driven as a whole and turn the robot by skidding, with the effective track between them: as a
    /// differential drive whose wheels are those of the sides. Mandow et al. (2007).
    pub fn skid_steer(radius: f64, effective_track: f64) -> Self {
        Self { name: "skid-steer-4".to_owned(), ..Self::differential(radius, effective_track) }
    }

    fn of(name: &str, wheels: Vec<Wheel>) -> Self {
        Self { name: name.to_owned(), wheels, sigmas: Sigmas::default() }
    }

    /// The same with every wheel changed.
    #[must_use]
    pub fn with_wheels(mut self, change: impl Fn(usize, Wheel) -> Wheel) -> Self {
        self.wheels = self.wheels.into_iter().enumerate().map(|(k, w)| change(k, w)).collect();
        self
    }

    /// Indices of the wheels whose turning is recorded, in the order of a drive's turns.
    pub fn measured(&self) -> Vec<usize> {
        (0..self.wheels.len()).filter(|&k| self.wheels[k].measured).collect()
    }

    /// Whether a wheel is steered.
    pub fn is_steered(&self) -> bool {
        self.wheels.iter().any(|w| w.steered)
    }

    /// Whether rollers let it move sideways.
    pub fn has_rollers(&self) -> bool {
        self.wheels.iter().any(|w| w.roller != 0.0)
    }

    /// Whether all wheels roll on rollers at a right angle, so that only their distance from the centre counts.
    pub(crate) fn is_omni(&self) -> bool {
        self.wheels.iter().all(|w| w.roller.abs() > SETTINGS.wheels.omni)
    }

    /// The robot, if its numbers can be and its wheels determine its motion.
    ///
    /// # Errors
    /// What is wrong with which wheel, or which motion is left open.
    pub fn checked(&self) -> Result<&Self, OdometryError> {
        let wrong = |wheel: &Wheel, what: String| OdometryError::Wheel {
            robot: self.name.clone(),
            wheel: wheel.name.clone(),
            what,
        };
        let whole = |what: String| OdometryError::Case(CaseError::Robot { robot: self.name.clone(), what });
        if self.measured().is_empty() {
            return Err(whole(
                "no wheel's turning is recorded; give one [[wheel]] per wheel with an encoder".to_owned(),
            ));
        }
        let most = SETTINGS.wheels.most;
        if self.wheels.len() > most {
            return Err(whole(format!(
                "{} wheels, but {most} are the most that are compared; give the wheels of a side that turn together as one",
                self.wheels.len()
            )));
        }
        for (k, wheel) in self.wheels.iter().enumerate() {
            if self.wheels[..k].iter().any(|w| w.name == wheel.name) {
                return Err(wrong(wheel, "two wheels have this name; answers go by it: give each its own".to_owned()));
            }
        }
        for wheel in &self.wheels {
            if !(wheel.radius > 0.0 && wheel.radius.is_finite()) {
                return Err(wrong(
                    wheel,
                    format!("radius {} m; a radius is a positive length in metres", wheel.radius),
                ));
            }
            if let Some(counts) = wheel.counts_per_turn.filter(|c| !(*c > 0.0 && c.is_finite())) {
                return Err(wrong(
                    wheel,
                    format!("counts_per_turn {counts}; give the counts of one turn of the wheel"),
                ));
            }
            let numbers = [wheel.place[0], wheel.place[1], wheel.direction, wheel.roller];
            if numbers.iter().any(|x| !x.is_finite()) {
                return Err(wrong(wheel, "place, direction and roller angle have to be finite numbers".to_owned()));
            }
        }
        let axle = |wheel: &Wheel| wheel.direction + wheel.roller;
        let is_of_first =
            |wheel: &Wheel| (axle(wheel) - axle(&self.wheels[0])).sin().abs() < SETTINGS.wheels.least_rank;
        if self.wheels.iter().all(|w| w.roller != 0.0) && self.wheels.iter().all(is_of_first) {
            return Err(whole(
                "the axles of all rollers point one way, so no wheel can drive the robot across them; correct roller_deg or \
                 direction_deg: neighbours of a mecanum robot have 45 and -45, omni wheels point in different directions"
                    .to_owned(),
            ));
        }
        Kinematics::determines(self)?;
        Ok(self)
    }
}
