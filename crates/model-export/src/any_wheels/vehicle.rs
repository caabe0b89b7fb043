//! Parts, loads and friction of a robot of any wheels: all that writers read.

use robot_model::effect::export::Engine;
use robot_model::wheels::{Coupling, Joint as PlantJoint, Robot, Wheel as PlantWheel};

use super::ackermann::is_same;
use super::{AnyWheelsModel, Input};
use crate::gazebo::Slip;
use crate::inertia::{ACROSS, HEAVIEST, LEFT, Part, rest, together};
use crate::model::ExportError;
use crate::number::number;

/// Mass of what turns and has none in the plant, share of the robot's: knuckles. Engines want some (guess: nobody feels it).
const LIGHT: f64 = 1e-4;
/// Rollers this far from lying across their wheel are none that MuJoCo has, rad (guess: a degree).
const ACROSS_THE_WHEEL: f64 = 0.02;
/// Sideways stiffness over that ahead which differs from one by so much is worth telling (guess).
const STIFFER: f64 = 0.01;

/// A wheel.
pub(super) struct Wheel {
    pub(super) name: String,
    /// Its centre in the robot, its inertia in its own axes: y is the axle.
    pub(super) part: Part,
    /// Direction in which it rolls, of a steered wheel beyond that of its joint, rad.
    pub(super) direction: f64,
    pub(super) radius: f64,
    /// Direction in the robot in which the first friction acts; `None` for the axle.
    pub(super) first: Option<[f64; 2]>,
    /// Friction in that direction and across it.
    pub(super) friction: [f64; 2],
    /// Load at rest, N.
    pub(super) load: f64,
    /// Slip ratio per share of the load: across and along the direction in which it rolls.
    pub(super) compliance: [f64; 2],
    /// Force per speed of creep at a rim speed of 1 m/s, N.
    pub(super) slope: f64,
    /// Dry friction, N m, and viscous friction, N m s/rad, of bearings, motor and ground.
    pub(super) dry: f64,
    pub(super) viscous: f64,
    /// Inertia of the motor at it, kg m².
    pub(super) rotor: f64,
    pub(super) motor: Option<usize>,
    pub(super) joint: Option<usize>,
}

impl Wheel {
    /// Whether a direction is that in which it rolls.
    fn is_rolling(&self, [x, y]: [f64; 2]) -> bool {
        let (sin, cos) = self.direction.sin_cos();
        (x * sin - y * cos).abs() < ACROSS_THE_WHEEL
    }

    /// What Gazebo's wheel slip knows of it.
    pub(super) fn slip(&self) -> Slip<'_> {
        Slip { link: &self.name, compliance: self.compliance, load: self.load, radius: self.radius }
    }
}

/// A caster: a sphere that slides as hard as it rolls.
pub(super) struct Caster {
    pub(super) name: String,
    pub(super) centre: [f64; 3],
    pub(super) load: f64,
    pub(super) friction: f64,
}

/// A motor.
pub(super) struct Motor {
    pub(super) name: String,
    pub(super) wheels: Vec<usize>,
    /// Whether its wheels turn at one speed.
    pub(super) is_rigid: bool,
    /// N m per unit of its command.
    pub(super) gain: f64,
    pub(super) lag: f64,
}

/// A steering joint.
pub(super) struct Joint {
    /// Name of its actuator.
    pub(super) name: String,
    pub(super) wheels: Vec<usize>,
    /// Whether one wheel has its angle.
    pub(super) is_of_one: bool,
    pub(super) plant: PlantJoint<f64>,
    /// rad per unit of its command.
    pub(super) gain: f64,
}

impl Joint {
    /// Place of its axis at the height of the wheels, m.
    pub(super) fn centre(&self, wheels: &[Wheel]) -> [f64; 3] {
        let [x, y] = self.plant.place;
        [x, y, wheels[0].radius]
    }
}

/// A robot of any wheels, sorted for an engine.
pub(super) struct Vehicle {
    pub(super) name: String,
    pub(super) robot: Robot<f64>,
    pub(super) chassis: Part,
    pub(super) wheels: Vec<Wheel>,
    pub(super) casters: Vec<Caster>,
    pub(super) motors: Vec<Motor>,
    pub(super) joints: Vec<Joint>,
    /// What turns about the vertical beside wheels: knuckles, then servos.
    pub(super) pivots: Vec<Part>,
    pub(super) point: [f64; 3],
    /// What the engine does not hold.
    pub(super) notes: Vec<String>,
}

impl Vehicle {
    pub(super) fn new(model: &AnyWheelsModel<'_>, engine: Engine) -> Result<Self, ExportError> {
        let robot = model.robot.checked()?;
        for (part, given, there) in [
            ("wheels", model.wheels.len(), robot.wheels.iter().flatten().count()),
            ("motors", model.motors.len(), robot.motors.iter().flatten().count()),
            ("steering joints", model.joints.len(), robot.joints.iter().flatten().count()),
        ] {
            if given != there {
                return Err(ExportError::Names { part, given, there });
            }
        }
        let names = identifiers(model.wheels.iter().map(String::as_str));
        let loads: Vec<f64> = robot.static_loads().map(|load| load.max(0.0)).collect();
        let plants: Vec<&PlantWheel<f64>> = robot.wheels.iter().flatten().collect();
        let mut wheels: Vec<Wheel> =
            plants.iter().zip(names).zip(&loads).map(|((w, name), load)| wheel(&robot, w, name, *load)).collect();
        if engine == Engine::Mjcf {
            let lies = |w: &PlantWheel<f64>| w.roller.is_none_or(|r| (r.cos()).abs() < ACROSS_THE_WHEEL);
            if let Some((of, _)) = wheels.iter().zip(&plants).find(|(_, w)| !lies(w)) {
                return Err(ExportError::Rollers { wheel: of.name.clone() });
            }
        } else {
            // Joints of URDF and SDF have no rotor.
            for w in &mut wheels {
                let spin = w.part.inertia[1] + w.rotor;
                w.part.inertia = [ACROSS * spin, spin, ACROSS * spin];
            }
        }
        // Actuators share one space of names.
        let steers: Vec<String> = model.joints.iter().map(|j| format!("steer_{}", j.name)).collect();
        let names = identifiers(model.motors.iter().map(|m| m.name).chain(steers.iter().map(String::as_str)));
        let (of_motors, of_joints) = names.split_at(model.motors.len());
        let joints = joints(&robot, model.joints, of_joints);
        let has_servos = engine == Engine::Mjcf;
        let pivots = pivots(&robot, &wheels, if has_servos { &joints } else { &[] });
        let chassis = weigh(&robot, &mut wheels, &pivots);

        let radius = wheels.iter().map(|w| w.radius).fold(f64::INFINITY, f64::min);
        let casters = robot.casters.iter().flatten().zip(&loads[plants.len()..]).enumerate();
        let casters = casters.map(|(k, (c, load))| Caster {
            name: format!("caster_{}", k + 1),
            centre: [c.pivot[0], c.pivot[1], radius],
            load: *load,
            friction: c.rolling,
        });
        let mut out = Self {
            name: model.name.to_owned(),
            chassis,
            casters: casters.collect(),
            motors: motors(&robot, model.motors, of_motors),
            joints,
            pivots,
            wheels,
            point: model.point,
            notes: Vec::new(),
            robot,
        };
        out.notes = out.not_held(engine);
        Ok(out)
    }

    /// What turns with a steering joint beside its wheels.
    pub(super) fn knuckle(&self, centre: [f64; 3]) -> Part {
        light(&self.robot, centre)
    }

    /// All parts together.
    pub(super) fn total(&self) -> Part {
        let wheels: Vec<Part> = self.wheels.iter().map(|w| w.part).collect();
        together(&std::iter::once(&self.chassis).chain(&wheels).chain(&self.pivots))
    }

    /// Gravity in the world, m/s²: along the slope and what is left of it downwards.
    pub(super) fn gravity(&self) -> [f64; 3] {
        let g = &self.robot.ground;
        let [x, y] = g.slope;
        [x, y, -(g.gravity * g.gravity - x * x - y * y).max(0.0).sqrt()]
    }

    /// What the engine does not hold, as ends of a sentence.
    fn not_held(&self, engine: Engine) -> Vec<String> {
        let mut out = Vec::new();
        let ground = &self.robot.ground;
        if self.robot.casters.iter().flatten().any(|c| c.pivot_friction > 0.0) {
            out.push(
                "the friction of the casters' pivots: a caster is a sphere that slides as hard as it rolls".to_owned(),
            );
        }
        let is_stiffer =
            (ground.lateral_stiffness - 1.0).abs() > STIFFER && self.wheels.iter().any(|w| w.first.is_none());
        if self.robot.drag > 0.0 {
            out.push(format!(
                "the drag of {} N s²/m² over the square of the speed: push the centre of mass by it against its way",
                number(self.robot.drag)
            ));
        }
        if engine == Engine::Mjcf && is_stiffer {
            out.push(format!(
                "that tyres are {:.2} times as stiff sideways as ahead: its contacts creep alike both ways",
                ground.lateral_stiffness
            ));
        }
        if engine == Engine::Mjcf {
            return out;
        }
        if engine == Engine::Urdf && ground.slope != [0.0; 2] {
            let [x, y, z] = self.gravity().map(number);
            out.push(format!("the slope of the ground: set the gravity of the world to {x}, {y}, {z} m/s²"));
        }
        let late = self.motors.iter().filter(|m| m.lag > 0.0);
        let late: Vec<String> = late.map(|m| format!("{} ({} s)", m.name, m.lag)).collect();
        if !late.is_empty() {
            out.push(format!("lags of motors: filter torques where they are commanded, {}", late.join(", ")));
        }
        let scaled = self.motors.iter().filter(|m| (m.gain - 1.0).abs() > ROUNDING);
        out.extend(scaled.map(|m| {
            format!("what a unit of the command of motor {} is: multiply it by {} to have N m", m.name, number(m.gain))
        }));
        let differs = |j: &&Joint| (j.gain - 1.0).abs() > ROUNDING || j.plant.offset.abs() > ROUNDING;
        out.extend(self.joints.iter().filter(differs).map(|j| {
            let (gain, offset) = (number(j.gain), number(j.plant.offset));
            format!("what a unit of the command of {} is: multiply it by {gain} and add {offset} to have rad", j.name)
        }));
        let shared = self.joints.iter().filter(|j| !j.is_of_one);
        out.extend(shared.map(|j| {
            let names: Vec<&str> = j.wheels.iter().map(|k| self.wheels[*k].name.as_str()).collect();
            format!(
                "the linkage of {}: command steer_{} so that the axles of the wheels meet on the axle that does not \
                 steer (Ackermann)",
                j.name,
                names.join(", steer_")
            )
        }));
        let tilted = self.wheels.iter().filter(|w| engine == Engine::Urdf && w.first.is_some_and(|f| !w.is_rolling(f)));
        let tilted: Vec<&str> = tilted.map(|w| w.name.as_str()).collect();
        if !tilted.is_empty() {
            out.push(format!(
                "rollers that lie askew, those of {}: a direction of friction turns with its link there; export it to SDF",
                tilted.join(", ")
            ));
        }
        out
    }
}

/// Factors that differ from one, and angles from zero, by less are rounding.
const ROUNDING: f64 = 1e-9;

/// Names that engines take: letters, digits, underscores, each once.
fn identifiers<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    for name in names {
        let plain: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        let taken = out.contains(&plain);
        let name = if taken { format!("{plain}_{}", out.len() + 1) } else { plain };
        out.push(name);
    }
    out
}

fn wheel(robot: &Robot<f64>, w: &PlantWheel<f64>, name: String, load: f64) -> Wheel {
    let g = &robot.ground;
    // Engines have one coefficient where the law has a peak and a share of it that remains: the middle of both.
    let mu = g.adhesion * 0.5 * (1.0 + g.sliding_share);
    let compliance = g.slip_at_peak / (2.0 * g.adhesion);
    let of_motor = w.motor.and_then(|k| robot.motors[k].map(|m| (k, m)));
    let share = of_motor.map_or(0.0, |(k, _)| {
        1.0 / robot.wheels.iter().flatten().filter(|other| other.motor == Some(k)).count().max(1) as f64
    });
    let motor = of_motor.map(|(_, m)| m);
    let part = |inertia: fn(&robot_model::wheels::Motor<f64>) -> f64| share * motor.as_ref().map_or(0.0, inertia);
    // Of rollers the axle, counter-clockwise from x.
    let first = w.roller.map(|r| {
        let (sin, cos) = (w.direction + std::f64::consts::FRAC_PI_2 + r).sin_cos();
        [cos, sin]
    });
    Wheel {
        name,
        part: Part {
            mass: 0.0,
            centre: [w.place[0], w.place[1], w.radius],
            inertia: [ACROSS * w.inertia, w.inertia, ACROSS * w.inertia],
        },
        direction: w.direction,
        radius: w.radius,
        first,
        friction: if first.is_some() { [mu, g.roller_drag] } else { [mu; 2] },
        load,
        compliance: [compliance / g.lateral_stiffness, compliance],
        slope: 2.0 * g.adhesion * load / g.slip_at_peak,
        dry: part(|m| m.coulomb) + g.rolling * load * w.radius,
        viscous: part(|m| m.viscous),
        rotor: part(|m| m.inertia),
        motor: w.motor,
        joint: w.joint,
    }
}

/// Something that turns and hardly weighs, at a place.
fn light(robot: &Robot<f64>, centre: [f64; 3]) -> Part {
    let mass = LIGHT * robot.mass;
    Part { mass, centre, inertia: [0.4 * mass * centre[2] * centre[2]; 3] }
}

/// Knuckles of steered wheels, and servos of joints that several wheels follow where an engine has these.
fn pivots(robot: &Robot<f64>, wheels: &[Wheel], joints: &[Joint]) -> Vec<Part> {
    let knuckles = wheels.iter().filter(|w| w.joint.is_some()).map(|w| light(robot, w.part.centre));
    let servos = joints.iter().filter(|j| !j.is_of_one).map(|j| light(robot, j.centre(wheels)));
    knuckles.chain(servos).collect()
}

/// Gives wheels their mass, as solid discs by their inertia unless that makes them too heavy for the robot, and the chassis the rest.
fn weigh(robot: &Robot<f64>, wheels: &mut [Wheel], pivots: &[Part]) -> Part {
    let mut share = 1.0;
    loop {
        for (w, plant) in wheels.iter_mut().zip(robot.wheels.iter().flatten()) {
            let disc = 2.0 * plant.inertia / (plant.radius * plant.radius);
            w.part.mass = share * disc.min(HEAVIEST * robot.mass);
        }
        let parts: Vec<Part> = wheels.iter().map(|w| w.part).chain(pivots.iter().copied()).collect();
        let chassis = rest((robot.mass, robot.com, robot.yaw_inertia), parts.iter());
        let fits = chassis.inertia[2] > LEFT * robot.yaw_inertia && chassis.centre[2] > 0.0;
        if fits || share < 1e-6 {
            return chassis;
        }
        share *= 0.5;
    }
}

fn motors(robot: &Robot<f64>, inputs: &[Input<'_>], names: &[String]) -> Vec<Motor> {
    let motors = robot.motors.iter().flatten().zip(names).zip(inputs).enumerate();
    motors
        .map(|(k, ((m, name), input))| Motor {
            name: name.clone(),
            wheels: (0..robot.wheels.iter().flatten().count())
                .filter(|w| robot.wheels[*w].is_some_and(|w| w.motor == Some(k)))
                .collect(),
            is_rigid: m.coupling == Coupling::Rigid,
            gain: m.gain * input.per_unit,
            lag: m.lag,
        })
        .collect()
}

fn joints(robot: &Robot<f64>, inputs: &[Input<'_>], names: &[String]) -> Vec<Joint> {
    let joints = robot.joints.iter().flatten().zip(names).zip(inputs).enumerate();
    joints
        .map(|(k, ((plant, name), input))| {
            let own = |w: &&PlantWheel<f64>| w.joint == Some(k);
            let wheels: Vec<usize> = (0..robot.wheels.iter().flatten().count())
                .filter(|w| robot.wheels[*w].as_ref().is_some_and(|w| own(&w)))
                .collect();
            let is_of_one = wheels.len() == 1 && robot.wheels.iter().flatten().filter(own).all(|w| is_same(plant, w));
            Joint { name: name.clone(), wheels, is_of_one, plant: *plant, gain: plant.gain * input.per_unit }
        })
        .collect()
}
