//! The constants of a robot of any wheels, checked.

use crate::contact::Plane;
use crate::error::{ModelError, not_negative, positive, within};
use crate::scalar::{Scalar, real};
use crate::wheels::{MOST, MOST_CASTERS};

/// A wheel that stands, is steered, or carries rollers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wheel<T> {
    /// Place of its contact in the robot: x forward, y left, m.
    pub place: [T; 2],
    /// Direction in which it rolls when it turns forward, counter-clockwise from x, rad; of a steered wheel beyond that of its
    /// joint.
    pub direction: T,
    /// Angle from its axle to the axles of its rollers, rad: π/2 of an omni wheel, ±π/4 of a mecanum wheel; `None` without
    /// rollers.
    pub roller: Option<T>,
    /// Radius, m.
    pub radius: T,
    /// Inertia about its axle, kg m².
    pub inertia: T,
    /// The motor that turns it.
    pub motor: Option<usize>,
    /// The joint that steers it.
    pub joint: Option<usize>,
}

/// A wheel that swings behind its pivot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Caster<T> {
    /// Place of its pivot in the robot, m.
    pub pivot: [T; 2],
    /// Distance by which its contact trails the pivot, m.
    pub trail: T,
    /// Rolling resistance, share of its load.
    pub rolling: T,
    /// Dry friction of its pivot, N m.
    pub pivot_friction: T,
}

/// How a motor turns its wheels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Coupling {
    /// All at one speed: one wheel, a belt, a rigid axle.
    #[default]
    Rigid,
    /// Each at its own speed, the torque in equal parts: an open differential.
    Differential,
}

/// A motor with its gear, seen at the wheels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motor<T> {
    /// How it turns its wheels.
    pub coupling: Coupling,
    /// Inertia of rotor and gear, kg m².
    pub inertia: T,
    /// Torque over that which is commanded or measured.
    pub gain: T,
    /// Time constant from command to torque, s.
    pub lag: T,
    /// Dry friction, N m.
    pub coulomb: T,
    /// Viscous friction, N m s/rad.
    pub viscous: T,
}

/// A joint that steers wheels as Ackermann has it: their axles meet on the line of an axle that is not steered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint<T> {
    /// Where a wheel would stand whose angle is that of the joint, m.
    pub place: [T; 2],
    /// x of the axle that is not steered, m; a wheel at the joint's own place does not depend on it.
    pub about: T,
    /// Angle at which wheels point ahead is told as none, rad.
    pub offset: T,
    /// Angle of the wheels over the angle that is commanded or measured.
    pub gain: T,
    /// Time constant from command to angle, s.
    pub lag: T,
}

/// Contact of all wheels with the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ground<T> {
    /// Friction coefficient at the peak.
    pub adhesion: T,
    /// Slip at the peak.
    pub slip_at_peak: T,
    /// Share of the peak that no slip takes away.
    pub sliding_share: T,
    /// Share of the force that follows the brush model; the rest follows Kiencke's law.
    pub brush_share: T,
    /// Stiffness of a wheel without rollers sideways over that ahead.
    pub lateral_stiffness: T,
    /// Speed below which slip is taken as if at this speed, m/s.
    pub rest_speed: T,
    /// Rolling resistance of wheels, share of the load.
    pub rolling: T,
    /// Drag of rollers along the way in which they roll, share of the load.
    pub roller_drag: T,
    /// Gravity along the ground in world axes, m/s²: uphill is negative.
    pub slope: [T; 2],
    /// Gravity, m/s².
    pub gravity: T,
}

/// A robot of any wheels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Robot<T> {
    /// Mass, kg.
    pub mass: T,
    /// Inertia about the vertical axis through the centre of mass, kg m².
    pub yaw_inertia: T,
    /// Centre of mass in the robot, and its height, m.
    pub com: [T; 3],
    /// Its wheels, in front of what is not there.
    pub wheels: [Option<Wheel<T>>; MOST],
    /// Its casters.
    pub casters: [Option<Caster<T>>; MOST_CASTERS],
    /// Its motors.
    pub motors: [Option<Motor<T>>; MOST],
    /// Its steering joints.
    pub joints: [Option<Joint<T>>; MOST],
    /// Drag against its way, at its centre of mass, over the square of the speed, N s²/m²: air, water, a brush that it pushes.
    pub drag: T,
    /// What it stands on.
    pub ground: Ground<T>,
}

/// Least area of the triangle of three contacts over the square of the longest distance between two, below which they lie on one
/// line.
const ON_A_LINE: f64 = 1e-3;

impl<T: Scalar> Robot<T> {
    /// Places where it touches the ground: wheels, then pivots of casters.
    pub fn contacts(&self) -> impl Iterator<Item = [T; 2]> + Clone + '_ {
        let wheels = self.wheels.iter().flatten().map(|w| w.place);
        wheels.chain(self.casters.iter().flatten().map(|c| c.pivot))
    }

    /// The same robot with every number changed into another scalar.
    pub fn cast<U: Scalar>(&self, mut to: impl FnMut(T) -> U) -> Robot<U> {
        let mut wheels = [None; MOST];
        for (out, wheel) in wheels.iter_mut().zip(&self.wheels) {
            *out = wheel.map(|w| Wheel {
                place: w.place.map(&mut to),
                direction: to(w.direction),
                roller: w.roller.map(&mut to),
                radius: to(w.radius),
                inertia: to(w.inertia),
                motor: w.motor,
                joint: w.joint,
            });
        }
        let mut casters = [None; MOST_CASTERS];
        for (out, caster) in casters.iter_mut().zip(&self.casters) {
            *out = caster.map(|c| Caster {
                pivot: c.pivot.map(&mut to),
                trail: to(c.trail),
                rolling: to(c.rolling),
                pivot_friction: to(c.pivot_friction),
            });
        }
        let mut motors = [None; MOST];
        for (out, motor) in motors.iter_mut().zip(&self.motors) {
            *out = motor.map(|m| Motor {
                coupling: m.coupling,
                inertia: to(m.inertia),
                gain: to(m.gain),
                lag: to(m.lag),
                coulomb: to(m.coulomb),
                viscous: to(m.viscous),
            });
        }
        let mut joints = [None; MOST];
        for (out, joint) in joints.iter_mut().zip(&self.joints) {
            *out = joint.map(|j| Joint {
                place: j.place.map(&mut to),
                about: to(j.about),
                offset: to(j.offset),
                gain: to(j.gain),
                lag: to(j.lag),
            });
        }
        let g = &self.ground;
        Robot {
            mass: to(self.mass),
            yaw_inertia: to(self.yaw_inertia),
            com: self.com.map(&mut to),
            wheels,
            casters,
            motors,
            joints,
            drag: to(self.drag),
            ground: Ground {
                adhesion: to(g.adhesion),
                slip_at_peak: to(g.slip_at_peak),
                sliding_share: to(g.sliding_share),
                brush_share: to(g.brush_share),
                lateral_stiffness: to(g.lateral_stiffness),
                rest_speed: to(g.rest_speed),
                rolling: to(g.rolling),
                roller_drag: to(g.roller_drag),
                slope: g.slope.map(&mut to),
                gravity: to(g.gravity),
            },
        }
    }
}

impl Robot<f64> {
    /// Loads at rest on level ground, N: of wheels, then of casters, as [`Self::contacts`]; below zero where it would lift.
    pub fn static_loads(&self) -> impl Iterator<Item = f64> + '_ {
        let from_com = self.contacts().map(|[x, y]| [x - self.com[0], y - self.com[1]]);
        let (plane, weight) = (Plane::of(from_com.clone()), self.mass * self.ground.gravity);
        from_com.map(move |at| plane.share(at, 0) * weight)
    }

    /// Checks every constant, and that the robot stands.
    ///
    /// # Errors
    /// The first constant that no robot can have; contacts that all lie on a line; motors and joints that are not there.
    pub fn checked(self) -> Result<Self, ModelError> {
        let g = &self.ground;
        let above = [
            ("mass", self.mass),
            ("yaw_inertia", self.yaw_inertia),
            ("adhesion", g.adhesion),
            ("slip_at_peak", g.slip_at_peak),
            ("lateral_stiffness", g.lateral_stiffness),
            ("rest_speed", g.rest_speed),
            ("gravity", g.gravity),
        ];
        for (name, value) in above {
            positive(name, value)?;
        }
        let rest = [
            ("com_height", self.com[2]),
            ("drag", self.drag),
            ("rolling_resistance", g.rolling),
            ("roller_drag", g.roller_drag),
            ("sliding_share", g.sliding_share),
        ];
        for (name, value) in rest {
            not_negative(name, value)?;
        }
        within("brush_share", g.brush_share, 0.0, 1.0)?;
        for wheel in self.wheels.iter().flatten() {
            positive("radius of a wheel", wheel.radius)?;
            positive("inertia of a wheel", wheel.inertia)?;
            let is_there = |at: Option<usize>, has: &dyn Fn(usize) -> bool| at.is_none_or(has);
            if !is_there(wheel.motor, &|k| self.motors.get(k).is_some_and(Option::is_some)) {
                return Err(ModelError::NotThere { what: "motor of a wheel" });
            }
            if !is_there(wheel.joint, &|k| self.joints.get(k).is_some_and(Option::is_some)) {
                return Err(ModelError::NotThere { what: "steering joint of a wheel" });
            }
        }
        for caster in self.casters.iter().flatten() {
            positive("trail of a caster", caster.trail)?;
            not_negative("rolling resistance of a caster", caster.rolling)?;
            not_negative("friction of a caster's pivot", caster.pivot_friction)?;
        }
        for motor in self.motors.iter().flatten() {
            not_negative("inertia of a motor", motor.inertia)?;
            not_negative("lag of a motor", motor.lag)?;
            not_negative("coulomb friction of a motor", motor.coulomb)?;
            not_negative("viscous friction of a motor", motor.viscous)?;
        }
        for joint in self.joints.iter().flatten() {
            not_negative("lag of a steering joint", joint.lag)?;
        }
        if self.wheels.iter().flatten().next().is_none() {
            Err(ModelError::NotThere { what: "wheel" })
        } else {
            self.stands()
        }
    }

    /// Refuses contacts on a line.
    fn stands(self) -> Result<Self, ModelError> {
        let (mut area, mut length2) = (0.0_f64, 0.0_f64);
        for a in self.contacts() {
            for b in self.contacts() {
                let d = [b[0] - a[0], b[1] - a[1]];
                length2 = length2.max(d[0] * d[0] + d[1] * d[1]);
                for c in self.contacts() {
                    area = area.max(d[0] * (c[1] - a[1]) - d[1] * (c[0] - a[0]));
                }
            }
        }
        if area > ON_A_LINE * length2 { Ok(self) } else { Err(ModelError::OnALine) }
    }
}

impl<T: Scalar> Ground<T> {
    /// Level ground of usual grip under usual wheels: what a robot file that says nothing of it gets.
    pub fn usual() -> Self {
        Self {
            adhesion: real(0.7),
            slip_at_peak: real(0.15),
            sliding_share: real(crate::robot::USUAL_SLIDING_SHARE),
            brush_share: real(crate::robot::USUAL_BRUSH_SHARE),
            lateral_stiffness: T::one(),
            rest_speed: real(crate::robot::USUAL_REST_SPEED),
            rolling: real(0.015),
            roller_drag: real(0.01),
            slope: [T::zero(); 2],
            gravity: real(9.806_65),
        }
    }
}
