//! The inner loop: a sliding variable per side and a network that learns the load.

use nn_basis::{Basis, LinearNet, Scalar, dot, real};
use robot_model::paper::Parameters;

use crate::error::{not_negative, positive};
use crate::{ControllerError, Kinematic, PathReference, Pose, Reference};

/// Gains of the controller and what it knows of the robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gains {
    /// Gain along the path k_x, 1/s.
    pub kx: f64,
    /// Gain across the path k_y, 1/m².
    pub ky: f64,
    /// Gain of the heading k_φ, 1/s.
    pub k_yaw: f64,
    /// Slope Λ of the sliding variable `s = ė + Λ e`, 1/s.
    pub slope: f64,
    /// Damping K_D, N m s per side.
    pub damping: f64,
    /// Adaptation gain Γ of the network, N m s/rad.
    pub adaptation: f64,
    /// Leak κ of the e-modification, 1/(N m): keeps the weights bounded.
    pub leak: f64,
    /// Robust term k_r, N m.
    pub robust: f64,
    /// Width δ over which the robust term saturates, rad/s.
    pub boundary: f64,
    /// Effective track χ W of a skid-steered robot, m.
    pub effective_track: f64,
    /// Wheel radius r, m.
    pub wheel_radius: f64,
}

impl Gains {
    /// The gains of the reproduction for a robot, with a wheel loop of `bandwidth` ω_b (1/s).
    ///
    /// `k_x = 1`, `k_y = 4`, `k_φ = 2`, `Λ = 4`, `K_D = ω_b (m r²/2 + 2 a1)`, `Γ = 20`, `κ = 0.05`, `k_r = 0`, `χ = 1.5`.
    pub fn for_robot(robot: &Parameters, bandwidth: f64) -> Self {
        let r = robot.wheel_radius;
        Self {
            kx: 1.0,
            ky: 4.0,
            k_yaw: 2.0,
            slope: 4.0,
            damping: bandwidth * (0.5 * robot.mass * r * r + 2.0 * robot.wheel_inertia),
            adaptation: 20.0,
            leak: 0.05,
            robust: 0.0,
            boundary: 0.1,
            effective_track: 1.5 * robot.track,
            wheel_radius: r,
        }
    }

    fn check(&self) -> Result<(), ControllerError> {
        not_negative("gain along the path", self.kx)?;
        not_negative("gain across the path", self.ky)?;
        not_negative("gain of the heading", self.k_yaw)?;
        not_negative("slope of the sliding variable", self.slope)?;
        positive("damping", self.damping)?;
        not_negative("adaptation gain", self.adaptation)?;
        not_negative("leak", self.leak)?;
        not_negative("robust gain", self.robust)?;
        positive("width of the robust term", self.boundary)?;
        positive("effective track", self.effective_track)?;
        positive("wheel radius", self.wheel_radius)
    }
}

/// What the controller measures. Sides: 0 left (wheel 3), 1 right (wheel 4).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelState<T> {
    /// Position, m.
    pub x: T,
    /// Position, m.
    pub y: T,
    /// Heading, rad, not wrapped.
    pub yaw: T,
    /// Wheel angles, rad.
    pub angle: [T; 2],
    /// Wheel speeds, rad/s.
    pub speed: [T; 2],
}

/// What the controller does, and why.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Action<T> {
    /// Torques τ3, τ4 of the sides, N m.
    pub torque: [T; 2],
    /// Sliding variables s, rad/s.
    pub sliding: [T; 2],
    /// Desired wheel speeds, rad/s.
    pub desired_speed: [T; 2],
    /// The reference that was followed.
    pub reference: Reference<T>,
}

/// The tracking controller of one robot on one path.
///
/// Wheels: `θ̇_d = (v_c ∓ ω_c χW/2)/r`, − on the left. Per side, with `e = θ_d − θ` and `s = ė + Λ e`:
/// `τ = K_D s + Ŵᵀφ + k_r sat(s/δ)`, `d/dt Ŵ = Γ (φ s − κ |s| Ŵ)`.
/// Closed, `2 a1 ṡ = −K_D s + W̃ᵀφ + ε − k_r sat(s/δ)`: s and Ŵ are uniformly ultimately bounded.
///
/// The basis sees own speed, other speed, own desired speed and other desired speed, rad/s, so both sides share it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tracking<T, B, const N: usize> {
    kinematic: Kinematic<T>,
    slope: T,
    damping: T,
    adaptation: T,
    leak: T,
    robust: T,
    boundary: T,
    half_track: T,
    radius: T,
    basis: B,
    net: LinearNet<T, N, 2>,
    reference: PathReference<T>,
    desired_angle: [T; 2],
}

impl<T: Scalar, B: Basis<T, 4, N>, const N: usize> Tracking<T, B, N> {
    /// A controller at the start of the path with zero weights.
    ///
    /// # Errors
    /// [`ControllerError`] names the first gain that cannot be used.
    pub fn new(gains: &Gains, basis: B, reference: PathReference<T>) -> Result<Self, ControllerError> {
        gains.check()?;
        Ok(Self {
            kinematic: Kinematic { kx: real(gains.kx), ky: real(gains.ky), k_yaw: real(gains.k_yaw) },
            slope: real(gains.slope),
            damping: real(gains.damping),
            adaptation: real(gains.adaptation),
            leak: real(gains.leak),
            robust: real(gains.robust),
            boundary: real(gains.boundary),
            half_track: real(0.5 * gains.effective_track),
            radius: real(gains.wheel_radius),
            basis,
            net: LinearNet::default(),
            reference,
            desired_angle: [T::zero(); 2],
        })
    }

    /// The torques to hold for the next `h` seconds.
    ///
    /// Never panics; a state that is not finite gives torques that are not finite.
    #[inline(always)]
    pub fn step(&mut self, state: &WheelState<T>, h: T) -> Action<T> {
        let reference = self.reference.now();
        let pose = Pose { x: state.x, y: state.y, yaw: state.yaw };
        let command = self.kinematic.command(&pose, &reference);
        let spread = command.yaw_rate * self.half_track;
        let desired_speed = [(command.speed - spread) / self.radius, (command.speed + spread) / self.radius];
        let mut torque = [T::zero(); 2];
        let mut sliding = [T::zero(); 2];
        for i in 0..2 {
            let other = 1 - i;
            let phi =
                self.basis.regressor(&[state.speed[i], state.speed[other], desired_speed[i], desired_speed[other]]);
            let error = self.desired_angle[i] - state.angle[i];
            let s = desired_speed[i] - state.speed[i] + self.slope * error;
            let saturated = (s / self.boundary).max(-T::one()).min(T::one());
            torque[i] = self.damping * s + dot(&self.net.weight[i], &phi) + self.robust * saturated;
            let rate = h * self.adaptation;
            self.net.adapt(i, &phi, rate * s, rate * self.leak * s.abs());
            self.desired_angle[i] += h * desired_speed[i];
            sliding[i] = s;
        }
        self.reference.advance(h);
        Action { torque, sliding, desired_speed, reference }
    }

    /// The network: one output per side.
    pub fn net(&self) -> &LinearNet<T, N, 2> {
        &self.net
    }
}
