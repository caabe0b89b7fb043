//! The plane body that Eq. 8 leaves open: slip, loads, forces, motion.

use super::rates::Rates;
use super::{Belt, Constants, Parameters, Tyre, Variant};
use crate::ModelError;
use crate::contact::{Balance, Stance, kiencke};
use crate::scalar::{Scalar, real};

/// The state of the robot; as a rate, each field holds its own time derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State<T> {
    /// Position of the centre of mass R in the plane, m.
    pub x: T,
    /// Position of the centre of mass R in the plane, m.
    pub y: T,
    /// Heading φ, rad, not wrapped.
    pub yaw: T,
    /// Forward velocity of R in body axes, m/s.
    pub vx: T,
    /// Leftward velocity of R in body axes, m/s.
    pub vy: T,
    /// Yaw rate ω, rad/s.
    pub yaw_rate: T,
    /// Wheel angles θ3 (left), θ4 (right), rad.
    pub angle: [T; 2],
    /// Wheel speeds, rad/s.
    pub speed: [T; 2],
}

impl<T: Scalar> Default for State<T> {
    fn default() -> Self {
        Self::from_array([T::zero(); 10])
    }
}

impl<T: Scalar> State<T> {
    /// Names of the entries of [`State::to_array`].
    pub const NAMES: [&'static str; 10] =
        ["x", "y", "yaw", "vx", "vy", "yaw rate", "wheel angle 3", "wheel angle 4", "wheel speed 3", "wheel speed 4"];

    /// The state as numbers, in the order of [`State::NAMES`].
    #[inline(always)]
    pub fn to_array(&self) -> [T; 10] {
        let ([a3, a4], [s3, s4]) = (self.angle, self.speed);
        [self.x, self.y, self.yaw, self.vx, self.vy, self.yaw_rate, a3, a4, s3, s4]
    }

    /// The state from numbers in the order of [`State::NAMES`].
    #[inline(always)]
    pub fn from_array(v: [T; 10]) -> Self {
        let [x, y, yaw, vx, vy, yaw_rate, a3, a4, s3, s4] = v;
        Self { x, y, yaw, vx, vy, yaw_rate, angle: [a3, a4], speed: [s3, s4] }
    }
}

/// What the plant computes on the way to the rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outputs<T> {
    /// Load of each wheel, N. A wheel about to lift has zero.
    pub load: [T; 4],
    /// Longitudinal and lateral slip (λ_x, λ_y) of each wheel.
    pub slip: [[T; 2]; 4],
    /// Acceleration a_R of the centre of mass in body axes, m/s².
    pub acceleration: [T; 2],
}

/// The closed plant: Eq. 8 for the wheels, planar dynamics for the body.
///
/// `m a_R = Σ F`, `I_z ω̇ = Σ (x F_y − y F_x)`, `v̇_x = a_x + ω v_y`, `v̇_y = a_y − ω v_x`, with
/// `F_i = N_i μ_p (K(λ_ix), K(λ_iy))`, K Kiencke's law in each direction by itself; a [`Variant`] may take another
/// belt or tyre. Loads depend linearly on a_R and
/// forces linearly on loads, so a 2×2 system closes them without iteration.
///
/// Unlike Eq. 5 of the paper the body may move sideways: a skid-steered robot does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaperRobot<T> {
    parameters: Parameters,
    pub(super) variant: Variant,
    constants: Constants<T>,
    stance: Stance<T>,
    mass: T,
    yaw_inertia: T,
    radius: T,
    adhesion: T,
    rolling_resistance: T,
    floor2: T,
    pub(super) rates: Rates<T>,
}

impl<T: Scalar> PaperRobot<T> {
    /// Builds the plant from checked parameters.
    ///
    /// # Errors
    /// [`ModelError`] names the first quantity that no robot can have.
    pub fn new(parameters: &Parameters) -> Result<Self, ModelError> {
        Self::with_variant(parameters, Variant::default())
    }

    /// Builds a variant of the plant from checked parameters.
    ///
    /// # Errors
    /// [`ModelError`] names the first quantity that no robot can have.
    pub fn with_variant(parameters: &Parameters, variant: Variant) -> Result<Self, ModelError> {
        parameters.check()?;
        let p = parameters;
        let com_x = 0.5 * p.wheelbase - p.com_to_front_axle;
        let constants = Constants::new(p);
        let stance = Stance::new(
            real(p.mass),
            real(p.gravity),
            real(0.5 * p.wheelbase),
            real(0.5 * p.track),
            [real(com_x), T::zero(), real(p.com_height)],
        );
        Ok(Self {
            parameters: *p,
            variant,
            rates: Rates::new(p, &constants, &stance),
            constants,
            stance,
            mass: real(p.mass),
            yaw_inertia: real(p.yaw_inertia),
            radius: real(p.wheel_radius),
            adhesion: real(p.adhesion),
            rolling_resistance: real(p.rolling_resistance),
            floor2: real(p.slip_floor * p.slip_floor),
        })
    }

    /// The same robot on ground of another rolling resistance f_r: a6, a7 and a8 change together.
    ///
    /// The paper's disturbance at 12 s is `f_r + 0.3`.
    ///
    /// # Errors
    /// [`ModelError`] if `rolling_resistance` is negative or not finite.
    pub fn with_rolling_resistance(&self, rolling_resistance: f64) -> Result<Self, ModelError> {
        Self::with_variant(&Parameters { rolling_resistance, ..self.parameters }, self.variant)
    }

    /// The parameters that the plant was built from.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// The variant of the plant.
    pub fn variant(&self) -> Variant {
        self.variant
    }

    /// The constants of Eq. 8.
    pub fn constants(&self) -> &Constants<T> {
        &self.constants
    }

    /// Longitudinal and lateral slip of each wheel.
    ///
    /// With the velocity of the wheel's centre `v_i = (v_x − ω y_i, v_y + ω x_i)`:
    /// `λ_ix = (r θ̇_i − v_ix)/d_i`, `λ_iy = −v_iy/d_i`, `d_i = √(max(|r θ̇_i|, |v_i|)² + v_0²)`.
    /// Below v_0 the slip fades to zero instead of becoming 0/0.
    #[inline(always)]
    pub fn slip(&self, state: &State<T>) -> [[T; 2]; 4] {
        core::array::from_fn(|i| {
            let [px, py] = self.stance.wheel[i];
            let (vx, vy) = (state.vx - state.yaw_rate * py, state.vy + state.yaw_rate * px);
            let rim = self.radius * state.speed[i % 2];
            let d = ((rim * rim).max(vx * vx + vy * vy) + self.floor2).sqrt();
            [(rim - vx) / d, -vy / d]
        })
    }

    /// The share K of the peak adhesion in both directions.
    #[inline(always)]
    fn share(&self, slip: [T; 2]) -> [T; 2] {
        let peak = self.constants.slip_at_peak;
        match self.variant.tyre {
            Tyre::Uncoupled => slip.map(|s| kiencke(s, peak)),
            Tyre::Combined => {
                let total2 = slip[0] * slip[0] + slip[1] * slip[1];
                let per_slip = real::<T>(2.0) * peak / (peak * peak + total2);
                slip.map(|s| per_slip * s)
            }
        }
    }

    /// What the torques of the two sides must overcome besides inertia, N m.
    #[inline(always)]
    fn resisting_torque(
        &self,
        speed: [T; 2],
        share: &[[T; 2]; 4],
        balance: &Balance<T>,
        acceleration: [T; 2],
    ) -> [T; 2] {
        let c = &self.constants;
        match self.variant.belt {
            Belt::Literal => c.resisting_torque_at(speed, [share[2][0], share[3][0]], acceleration),
            Belt::SideSum => core::array::from_fn(|i| {
                let (front, rear) = (i, i + 2);
                let traction = balance.force[front][0] + balance.force[rear][0];
                let rolling = self.rolling_resistance * (balance.load[front] + balance.load[rear]);
                let sign = c.sign(speed[i]);
                real::<T>(2.0) * c.a2 * sign + self.radius * (traction + rolling * sign)
            }),
        }
    }

    #[inline(always)]
    fn balance(&self, share: &[[T; 2]; 4]) -> Balance<T> {
        self.stance.settle(&share.map(|s| s.map(|s| self.adhesion * s)))
    }

    /// Load of each wheel, N: [`Outputs::load`] alone. It does not depend on the torques.
    #[inline(always)]
    pub fn loads(&self, state: &State<T>) -> [T; 4] {
        self.balance(&self.slip(state).map(|s| self.share(s))).load
    }

    /// Rate of the state and what was computed on the way; [`PaperRobot::accelerations`] is the same arranged for speed.
    ///
    /// `torque`: τ3 (left), τ4 (right) of the sides at the wheels, N m.
    /// Neither fails nor panics; a state that is not finite gives a rate that is not finite.
    #[inline(always)]
    pub fn evaluate(&self, state: &State<T>, torque: [T; 2]) -> (State<T>, Outputs<T>) {
        let slip = self.slip(state);
        let share = slip.map(|s| self.share(s));
        let balance = self.balance(&share);
        let acceleration = balance.total.map(|f| f / self.mass);
        let [ax, ay] = acceleration;
        let resisting = self.resisting_torque(state.speed, &share, &balance, acceleration);
        let (sin, cos) = state.yaw.sin_cos();
        let rate = State {
            x: state.vx * cos - state.vy * sin,
            y: state.vx * sin + state.vy * cos,
            yaw: state.yaw_rate,
            vx: ax + state.yaw_rate * state.vy,
            vy: ay - state.yaw_rate * state.vx,
            yaw_rate: balance.yaw_moment / self.yaw_inertia,
            angle: state.speed,
            speed: self.constants.accelerated(torque, resisting),
        };
        (rate, Outputs { load: balance.load, slip, acceleration })
    }

    /// Rate of the state under the torques τ3, τ4 in N m.
    #[inline(always)]
    pub fn rate(&self, state: &State<T>, torque: [T; 2]) -> State<T> {
        self.evaluate(state, torque).0
    }
}
