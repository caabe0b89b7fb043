//! The desired motion: straight, one loop, straight.

use nn_basis::{Scalar, real};

use crate::ControllerError;
use crate::error::positive;

/// Which way the loop turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Turn {
    /// Counter-clockwise, positive yaw rate.
    #[default]
    Left,
    /// Clockwise.
    Right,
}

/// How the desired speed rises from rest and falls back to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Profile {
    /// Constant acceleration, `ρ(s) = s`: it jumps where a ramp begins and ends.
    #[default]
    Trapezoid,
    /// `ρ(s) = s² (3 − 2 s)`: the acceleration is continuous, and at most 1.5 times the trapezoid's.
    Smoothstep,
}

/// What the loop is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loop {
    /// Cruising speed v, m/s.
    pub speed: f64,
    /// Radius of the circle R, m.
    pub radius: f64,
    /// Duration of the acceleration from rest, s.
    pub accelerate: f64,
    /// Duration of the straight before the circle, s.
    pub lead_in: f64,
    /// Duration over which the yaw rate goes linearly to its value at entry, and back at exit, s.
    pub blend: f64,
    /// Duration of the straight after the circle, s.
    pub lead_out: f64,
    /// Duration of the deceleration to rest, s.
    pub brake: f64,
    /// Which way the loop turns.
    pub turn: Turn,
    /// Shape of the ramps of the speed; the yaw rate's blends stay linear.
    pub profile: Profile,
}

impl Default for Loop {
    /// 0.5 m/s after 1 s, 3 s straight, a circle of 1.5 m with blends of 0.5 s, 3 s straight, braking in 2 s.
    fn default() -> Self {
        Self {
            speed: 0.5,
            radius: 1.5,
            accelerate: 1.0,
            lead_in: 3.0,
            blend: 0.5,
            lead_out: 3.0,
            brake: 2.0,
            turn: Turn::Left,
            profile: Profile::Trapezoid,
        }
    }
}

/// Times at which something begins, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Events {
    /// The yaw rate begins to rise.
    pub entry: f64,
    /// The yaw rate begins to fall.
    pub exit: f64,
    /// Braking begins.
    pub brake: f64,
    /// The robot stands.
    pub rest: f64,
}

/// A checked loop: desired speed, yaw rate and heading in closed form at any time.
///
/// Both blends shift the yaw rate's ramps equally, so the heading changes by exactly 2π:
/// `ω_d(t) = (v/R) [ρ(t − t_entry) − ρ(t − t_exit)]`, `t_exit − t_entry = 2πR/v`, ρ a ramp from 0 to 1 over the blend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopPath<T> {
    events: Events,
    profile: Profile,
    speed: T,
    yaw_rate: T,
    accelerate: T,
    blend: T,
    brake: T,
    entry_at: T,
    exit_at: T,
    brake_at: T,
}

impl<T: Scalar> LoopPath<T> {
    /// Checks and prepares a loop.
    ///
    /// # Errors
    /// [`ControllerError::NotPositive`] names the first quantity that is not a finite number above zero.
    pub fn new(path: &Loop) -> Result<Self, ControllerError> {
        positive("speed of the path", path.speed)?;
        positive("radius of the loop", path.radius)?;
        positive("duration of the acceleration", path.accelerate)?;
        positive("duration of the straight before the loop", path.lead_in)?;
        positive("duration of the blend", path.blend)?;
        positive("duration of the straight after the loop", path.lead_out)?;
        positive("duration of the braking", path.brake)?;
        let entry = path.accelerate + path.lead_in;
        let exit = entry + core::f64::consts::TAU * path.radius / path.speed;
        let brake = exit + path.blend + path.lead_out;
        let sign = match path.turn {
            Turn::Left => 1.0,
            Turn::Right => -1.0,
        };
        Ok(Self {
            events: Events { entry, exit, brake, rest: brake + path.brake },
            profile: path.profile,
            speed: real(path.speed),
            yaw_rate: real(sign * path.speed / path.radius),
            accelerate: real(path.accelerate),
            blend: real(path.blend),
            brake: real(path.brake),
            entry_at: real(entry),
            exit_at: real(exit),
            brake_at: real(brake),
        })
    }

    /// When things happen.
    pub fn events(&self) -> &Events {
        &self.events
    }

    /// Desired speed `v_d(t) = v [ρ(t / T_acc) − ρ((t − t_brake) / T_br)]`, m/s, ρ the ramp of the [`Profile`].
    #[inline(always)]
    pub fn speed(&self, t: T) -> T {
        let (up, down) = (ramp(t, self.accelerate), ramp(t - self.brake_at, self.brake));
        self.speed * (shape(self.profile, up) - shape(self.profile, down))
    }

    /// Desired yaw rate ω_d, rad/s.
    #[inline(always)]
    pub fn yaw_rate(&self, t: T) -> T {
        self.yaw_rate * (ramp(t - self.entry_at, self.blend) - ramp(t - self.exit_at, self.blend))
    }

    /// Desired heading φ_d, the integral of the yaw rate, rad.
    #[inline(always)]
    pub fn yaw(&self, t: T) -> T {
        self.yaw_rate * (ramp_area(t - self.entry_at, self.blend) - ramp_area(t - self.exit_at, self.blend))
    }
}

/// 0 before zero, 1 after `duration`, linear between.
#[inline(always)]
fn ramp<T: Scalar>(t: T, duration: T) -> T {
    (t / duration).max(T::zero()).min(T::one())
}

/// The profile's ρ over a linear ramp `s` from 0 to 1.
#[inline(always)]
fn shape<T: Scalar>(profile: Profile, s: T) -> T {
    match profile {
        Profile::Trapezoid => s,
        Profile::Smoothstep => s * s * (real::<T>(3.0) - real::<T>(2.0) * s),
    }
}

/// Area under [`ramp`] up to `t`.
#[inline(always)]
fn ramp_area<T: Scalar>(t: T, duration: T) -> T {
    let half = real::<T>(0.5);
    let risen = t.if_less(duration, half * t * t / duration, t - half * duration);
    T::zero().if_less(t, risen, T::zero())
}

/// The desired pose and velocity, Eq. 6 and 7 of the paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference<T> {
    /// Desired position, m.
    pub x: T,
    /// Desired position, m.
    pub y: T,
    /// Desired heading, rad, not wrapped.
    pub yaw: T,
    /// Desired speed, m/s.
    pub speed: T,
    /// Desired yaw rate, rad/s.
    pub yaw_rate: T,
}

/// The velocity in the plane, m/s.
#[inline(always)]
fn along<T: Scalar>(yaw: T, speed: T) -> [T; 2] {
    let (sin, cos) = yaw.sin_cos();
    [speed * cos, speed * sin]
}

/// A point that moves along the path in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathReference<T> {
    path: LoopPath<T>,
    time: T,
    now: Reference<T>,
    /// Where it moves to, m/s.
    velocity: [T; 2],
}

impl<T: Scalar> PathReference<T> {
    /// A reference at the start of the path, in the origin with heading zero.
    pub fn new(path: LoopPath<T>) -> Self {
        let start = T::zero();
        let (yaw, speed) = (path.yaw(start), path.speed(start));
        let now = Reference { x: start, y: start, yaw, speed, yaw_rate: path.yaw_rate(start) };
        Self { path, time: start, now, velocity: along(yaw, speed) }
    }

    /// The path.
    pub fn path(&self) -> &LoopPath<T> {
        &self.path
    }

    /// Where the reference is now.
    #[inline(always)]
    pub fn now(&self) -> Reference<T> {
        self.now
    }

    /// Moves on by `h` seconds; the position is integrated by Simpson's rule from the closed-form heading and speed.
    #[inline(always)]
    pub fn advance(&mut self, h: T) {
        let path = &self.path;
        let (middle, end) = (self.time + real::<T>(0.5) * h, self.time + h);
        let (yaw, speed) = (path.yaw(end), path.speed(end));
        let (a, b, c) = (self.velocity, along(path.yaw(middle), path.speed(middle)), along(yaw, speed));
        let (four, sixth) = (real::<T>(4.0), h / real::<T>(6.0));
        let x = self.now.x + sixth * (a[0] + four * b[0] + c[0]);
        let y = self.now.y + sixth * (a[1] + four * b[1] + c[1]);
        self.now = Reference { x, y, yaw, speed, yaw_rate: path.yaw_rate(end) };
        self.velocity = c;
        self.time = end;
    }
}
