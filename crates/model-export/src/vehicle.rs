//! The robot with its effects, sorted into what an engine holds and what must be added.

use robot_model::Robot;
use robot_model::effect::{Situation, World};

use crate::at::At;
use crate::engine::{Engine, Way};
use crate::model::{ExportError, Model};
use crate::origin::{self, Section};
use crate::residual::Residual;
use crate::table::{Hold, Lines, row};

/// A belt that passes any torque has this limit or more, N m.
const ANY_TORQUE: f64 = 1e8;

/// All that the writers of models read.
pub(crate) struct Vehicle {
    /// Constants, effects included.
    pub(crate) robot: Robot<f64>,
    /// Ground and drivetrain with the effects that are always the same.
    pub(crate) world: World<f64>,
    /// A load that is a body of its own; part of `robot` too.
    pub(crate) payload: Option<Payload>,
    /// How far the axle of each side's wheels is off their middle: cosine and sine, m.
    pub(crate) eccentric: [[f64; 2]; 2],
    /// Discs of other grip: x, y, radius, share of the adhesion that is left.
    pub(crate) patches: Vec<[f64; 4]>,
    /// Quadratic drag, N s²/m².
    pub(crate) drag: f64,
    pub(crate) sensors: Sensors,
    /// Where values come from.
    pub(crate) origins: Vec<(Section, String)>,
    /// What the engine does not hold.
    pub(crate) residuals: Vec<Residual>,
}

/// A load.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Payload {
    pub(crate) mass: f64,
    /// Height of its centre, m.
    pub(crate) height: f64,
    /// About the vertical through its centre, kg m².
    pub(crate) yaw_inertia: f64,
}

/// Faults of sensors.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sensors {
    /// The accelerometer's x and y axis point up by, rad.
    pub(crate) up: [f64; 2],
    /// The accelerometer is turned to the left by, rad.
    pub(crate) left: f64,
    /// Shown over true wheel speed of each side.
    pub(crate) encoder: [f64; 2],
    /// Delay of the IMU and of the pose, s.
    pub(crate) late: [f64; 2],
    /// Constant error of the gyro, rad/s.
    pub(crate) gyro: f64,
    /// Constant error of the accelerometer, m/s².
    pub(crate) accel: [f64; 2],
}

impl Vehicle {
    /// Sorts the effects of a model for an engine.
    pub(crate) fn new(model: &Model<'_>, engine: Engine) -> Result<Self, ExportError> {
        let effects = model.effects.iter().map(At::new).collect::<Result<Vec<_>, _>>()?;
        let mut v = Self {
            robot: *model.robot,
            world: level(model.robot),
            payload: None,
            eccentric: [[0.0; 2]; 2],
            patches: Vec::new(),
            drag: 0.0,
            sensors: Sensors { up: [0.0; 2], left: 0.0, encoder: [1.0; 2], late: [0.0; 2], gyro: 0.0, accel: [0.0; 2] },
            origins: origin::retuned(model),
            residuals: Vec::new(),
        };
        let mut laws = Vec::new();
        for at in &effects {
            let row = row(at.card().id).ok_or(ExportError::NoTranslation(at.card().id))?;
            let way = row.way(engine, at);
            v.origins.push((row.section, origin::of_effect(at, model.causes, way)));
            if matches!(way, Way::Held(_)) || matches!(row.lines, Lines::OfConstants) {
                match row.hold {
                    Hold::Law => {
                        at.law().robot(at.values(), &mut v.robot);
                        laws.push(at);
                    }
                    Hold::Special(hold) => hold(at, &mut v),
                }
            }
        }
        v.robot = v.robot.checked()?;
        v.world = level(&v.robot);
        for at in laws {
            v.act(at);
        }
        for at in &effects {
            let row = row(at.card().id).ok_or(ExportError::NoTranslation(at.card().id))?;
            if let (Way::Added(why), Lines::Of(lines)) = (row.way(engine, at), row.lines) {
                v.residuals.push(lines(at, &v).titled(at, why));
            }
        }
        v.residuals.extend(Residual::of_constants(&v, engine));
        Ok(v)
    }

    /// Takes over what an effect does to the world of a robot at rest at the origin, on the sides that have it.
    fn act(&mut self, at: &At<'_>) {
        let r = &self.robot;
        let situation = Situation {
            time: 0.0,
            position: [0.0; 2],
            heading: [1.0, 0.0],
            velocity: [0.0; 2],
            yaw_rate: 0.0,
            wheel_speed: [0.0; 2],
            wheel_angle: [0.0; 2],
            mass: r.mass,
            gravity: r.gravity,
            hitch: self.hitch(),
            half_base: [r.half_wheelbase, r.half_track],
            torque: [0.0; 2],
        };
        let before = self.world;
        at.law().act(at.values(), &situation, &mut self.world);
        for (side, _) in at.sides().iter().enumerate().filter(|(_, has)| !**has) {
            let w = &mut self.world;
            for i in [side, side + 2] {
                w.adhesion[i] = before.adhesion[i];
                w.slip_at_peak[i] = before.slip_at_peak[i];
                w.lateral[i] = before.lateral[i];
                w.rolling[i] = before.rolling[i];
                w.radius[i] = before.radius[i];
                w.traction[i] = before.traction[i];
            }
            w.coulomb[side] = before.coulomb[side];
            w.viscous[side] = before.viscous[side];
            w.stribeck[side] = before.stribeck[side];
            w.belt_limit[side] = before.belt_limit[side];
        }
    }

    /// The hitch from the centre of mass, m.
    pub(crate) fn hitch(&self) -> [f64; 2] {
        [self.robot.hitch_x - self.robot.com[0], -self.robot.com[1]]
    }

    /// Largest torque that a side's belt passes, if any is too much for it.
    pub(crate) fn belt(&self, side: usize) -> Option<f64> {
        Some(self.world.belt_limit[side]).filter(|most| *most < ANY_TORQUE)
    }

    /// Gravity in the world, m/s²: along the slope and what is left of it downwards.
    pub(crate) fn gravity(&self) -> [f64; 3] {
        let [x, y] = self.world.tilt;
        let g = self.robot.gravity;
        [x, y, -(g * g - x * x - y * y).max(0.0).sqrt()]
    }

    /// Comments for a section of the model.
    pub(crate) fn comments(&self, section: Section) -> impl Iterator<Item = String> + '_ {
        self.origins.iter().filter(move |(s, _)| *s == section).map(|(_, text)| text.clone())
    }
}

/// The world of a robot without effects.
fn level(robot: &Robot<f64>) -> World<f64> {
    World {
        adhesion: [robot.adhesion; 4],
        slip_at_peak: [robot.slip_at_peak; 4],
        lateral: [robot.lateral_factor; 4],
        rolling: [robot.rolling_resistance; 4],
        radius: [robot.wheel_radius; 4],
        traction: [1.0; 4],
        twist: 0.0,
        coulomb: robot.coulomb,
        viscous: robot.viscous,
        stribeck: [robot.stribeck; 2],
        torque: [0.0; 2],
        belt_limit: [f64::MAX; 2],
        force: [0.0; 2],
        moment: 0.0,
        tilt: [0.0; 2],
    }
}
