//! The contact patch: slip, the Kiencke tyre law, and the loads that balance the body.

use crate::scalar::{Scalar, real};

/// Kiencke's law: the share of the peak adhesion at slip `slip`,
/// `K(λ) = 2 λp λ / (λp² + λ²)`, odd in λ, with its peak ±1 at λ = ±λp.
///
/// Source: Hendzel & Trojnacki 2014, the factor in Eq. 8.
#[inline(always)]
pub fn kiencke<T: Scalar>(slip: T, slip_at_peak: T) -> T {
    real::<T>(2.0) * slip_at_peak * slip / (slip_at_peak * slip_at_peak + slip * slip)
}

/// Square of a slip speed below which a wheel does not slip, m²/s².
const NO_SLIP: f64 = 1e-20;

/// Adhesion per slip speed under combined slip: Kiencke's law up to its peak, beyond it a share `sliding` of the peak
/// that no slip takes away, along the slip velocity.
///
/// With slip speed `s = |v_slip|`, reference speed `d` and `λ = s/d`: `K(λ)` for λ ≤ λp, `ρ + (1 − ρ) K(λ)` beyond;
/// ρ = 0 is Kiencke's law, ρ = 1 a plateau. Returned are `K/s` and the longitudinal stiffness `∂(K s_x/s)/∂s_x` for the
/// implicit wheel step, which takes the falling branch as flat.
#[inline(always)]
pub fn combined<T: Scalar>(slip: [T; 2], reference_speed2: T, slip_at_peak: T, sliding: T) -> (T, T) {
    let sx2 = slip[0] * slip[0];
    let (per_speed, slope, inverse_s2) = shape(slip, reference_speed2, slip_at_peak, sliding);
    (per_speed, (per_speed + (slope - per_speed) * sx2 * inverse_s2).max(T::zero()))
}

/// `K/s`, `dK/ds` where it rises, and `1/s²`.
#[inline(always)]
pub(crate) fn shape<T: Scalar>(slip: [T; 2], reference_speed2: T, slip_at_peak: T, sliding: T) -> (T, T, T) {
    let (sx2, d2) = (slip[0] * slip[0], reference_speed2);
    let s2 = sx2 + slip[1] * slip[1] + real(NO_SLIP);
    let peak2 = slip_at_peak * slip_at_peak * d2;
    // K/s = 2 λp d / (λp² d² + s²);  dK/ds = 2 λp d (λp² d² − s²)/(λp² d² + s²)²; one division for 1/(λp² d² + s²) and 1/s².
    let sum = peak2 + s2;
    let inverse = T::one() / (sum * s2);
    let (inverse_sum, inverse_s2) = (s2 * inverse, sum * inverse);
    let rising = real::<T>(2.0) * slip_at_peak * d2.sqrt() * inverse_sum;
    let beyond = sliding * s2.sqrt() * inverse_s2 + (T::one() - sliding) * rising;
    let per_speed = s2.if_less(peak2, rising, beyond);
    let slope = s2.if_less(peak2, rising * (peak2 - s2) * inverse_sum, T::zero());
    (per_speed, slope, inverse_s2)
}

/// What the loads depend on: mass, height of the centre of mass and where the wheels stand relative to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stance<T> {
    /// Mass in kg.
    pub mass: T,
    /// Load of each wheel at rest on level ground, N.
    pub static_load: [T; 4],
    /// Change of load of a wheel per longitudinal specific force, kg: −m h/(4a) in front, + at the rear.
    pub pitch: T,
    /// Change of load of a wheel per lateral specific force, kg: −m h/(4b) on the left, + on the right.
    pub roll: T,
    /// Position of each wheel relative to the centre of mass, m.
    pub wheel: [[T; 2]; 4],
    /// Change of load of each contact per longitudinal and per lateral specific force, kg, where contacts are not at the
    /// corners of a rectangle; `None` where they are, and `pitch` and `roll` say it.
    pub per_force: Option<[[T; 2]; 4]>,
}

/// Signs of the wheels: +1 in front / on the left.
const FRONT: [f64; 4] = [1.0, 1.0, -1.0, -1.0];
const LEFT: [f64; 4] = [1.0, -1.0, 1.0, -1.0];

impl<T: Scalar> Stance<T> {
    /// The stance of a rigid body on four wheels, roll and pitch transfer split equally over the axles and sides.
    ///
    /// `half_wheelbase` a, `half_track` b, centre of mass `(com_x, com_y, com_height)` from the geometric centre, m.
    pub fn new(mass: T, gravity: T, half_wheelbase: T, half_track: T, com: [T; 3]) -> Self {
        let quarter = real::<T>(0.25);
        let mut static_load = [T::zero(); 4];
        let mut wheel = [[T::zero(); 2]; 4];
        for i in 0..4 {
            let (front, left) = (real::<T>(FRONT[i]), real::<T>(LEFT[i]));
            static_load[i] = mass
                * gravity
                * quarter
                * (T::one() + front * com[0] / half_wheelbase)
                * (T::one() + left * com[1] / half_track);
            wheel[i] = [front * half_wheelbase - com[0], left * half_track - com[1]];
        }
        Self {
            mass,
            static_load,
            pitch: mass * com[2] * quarter / half_wheelbase,
            roll: mass * com[2] * quarter / half_track,
            wheel,
            per_force: None,
        }
    }

    /// The stance of a rigid body on four contacts at these places from its centre of mass, m, as on equal springs:
    /// `N_i = α + β x_i + γ y_i`, of which no part but a tilt of the body makes one load differ from another.
    ///
    /// Two contacts at one place share the load of one. The contacts must not all lie on one line.
    pub(crate) fn on(wheel: [[T; 2]; 4], mass: T, gravity: T, com_height: T) -> Self {
        let plane = Plane::of(wheel.into_iter());
        let (weight, lever) = (mass * gravity, mass * com_height);
        Self {
            mass,
            static_load: wheel.map(|at| plane.share(at, 0) * weight),
            pitch: T::zero(),
            roll: T::zero(),
            wheel,
            per_force: Some(wheel.map(|at| [-(plane.share(at, 1) * lever), -(plane.share(at, 2) * lever)])),
        }
    }

    /// Finds the loads and the specific force of the contacts together.
    ///
    /// Given each wheel's force per unit load `k = F/N`, the loads depend linearly on the specific force
    /// `s = ΣF/m` and the forces linearly on the loads: `m s = Σ (N⁰ + N' s) k`, a 2×2 system, no iteration.
    /// A wheel never pulls on the ground: negative loads are set to zero.
    #[inline(always)]
    pub fn settle(&self, k: &[[T; 2]; 4]) -> Balance<T> {
        match &self.per_force {
            None => self.settle_twisted(k, T::zero()),
            Some(per_force) => self.settle_apart(k, per_force),
        }
    }

    /// The same of four wheels at the corners of a rectangle, on ground or with a frame that is twisted: four wheels are one
    /// more than statics needs, so that a load `twist` may move from each wheel of one diagonal (front left) to each of the
    /// other and change no balance.
    #[inline(always)]
    pub fn settle_twisted(&self, k: &[[T; 2]; 4], twist: T) -> Balance<T> {
        let (m, p, r) = (self.mass, self.pitch, self.roll);
        let [a, b, c, d] = self.static_load;
        let s = [a - twist, b + twist, c + twist, d - twist];
        let mut b = [T::zero(); 2];
        for i in 0..4 {
            b[0] += s[i] * k[i][0];
            b[1] += s[i] * k[i][1];
        }
        let rear = |j: usize| k[2][j] + k[3][j] - k[0][j] - k[1][j];
        let right = |j: usize| k[1][j] + k[3][j] - k[0][j] - k[2][j];
        let (a11, a12) = (m - p * rear(0), -(r * right(0)));
        let (a21, a22) = (-(p * rear(1)), m - r * right(1));
        let inv = T::one() / (a11 * a22 - a12 * a21);
        let (ax, ay) = ((b[0] * a22 - a12 * b[1]) * inv, (a11 * b[1] - a21 * b[0]) * inv);
        let (dp, dr) = (p * ax, r * ay);
        self.balance(k, [s[0] - dp - dr, s[1] - dp + dr, s[2] + dp - dr, s[3] + dp + dr])
    }

    /// The same where each contact's load depends on the specific force in a way of its own.
    #[inline(always)]
    fn settle_apart(&self, k: &[[T; 2]; 4], per_force: &[[T; 2]; 4]) -> Balance<T> {
        let m = self.mass;
        let (mut b, mut a) = ([T::zero(); 2], [[m, T::zero()], [T::zero(), m]]);
        for i in 0..4 {
            for j in 0..2 {
                b[j] += self.static_load[i] * k[i][j];
                a[j][0] -= per_force[i][0] * k[i][j];
                a[j][1] -= per_force[i][1] * k[i][j];
            }
        }
        let inv = T::one() / (a[0][0] * a[1][1] - a[0][1] * a[1][0]);
        let (ax, ay) = ((b[0] * a[1][1] - a[0][1] * b[1]) * inv, (a[0][0] * b[1] - a[1][0] * b[0]) * inv);
        let mut load = self.static_load;
        for i in 0..4 {
            load[i] += per_force[i][0] * ax + per_force[i][1] * ay;
        }
        self.balance(k, load)
    }

    /// What the contacts do under these loads, none of which pulls.
    #[inline(always)]
    fn balance(&self, k: &[[T; 2]; 4], load: [T; 4]) -> Balance<T> {
        let load = load.map(|n| n.max(T::zero()));
        let mut out = Balance { load, force: [[T::zero(); 2]; 4], total: [T::zero(); 2], yaw_moment: T::zero() };
        for i in 0..4 {
            let f = [load[i] * k[i][0], load[i] * k[i][1]];
            out.total[0] += f[0];
            out.total[1] += f[1];
            out.yaw_moment += self.wheel[i][0] * f[1] - self.wheel[i][1] * f[0];
            out.force[i] = f;
        }
        out
    }
}

/// Loads of a rigid body on equal springs: a plane over the places of its contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plane<T> {
    minors: [[T; 3]; 3],
    inverse: T,
}

impl<T: Scalar> Plane<T> {
    /// Of contacts at these places, which must not all lie on one line.
    pub(crate) fn of(contacts: impl Iterator<Item = [T; 2]>) -> Self {
        let (mut s, mut m, mut n) = ([T::zero(); 3], [T::zero(); 2], T::zero());
        for [x, y] in contacts {
            s = [s[0] + x * x, s[1] + x * y, s[2] + y * y];
            m = [m[0] + x, m[1] + y];
            n += T::one();
        }

        // Sum of loads, and of their moments: Σ [1, x, y]ᵀ [1, x, y] (α, β, γ) = (m g, −m h s_x, −m h s_y).
        let minors = [
            [s[0] * s[2] - s[1] * s[1], s[1] * m[1] - m[0] * s[2], m[0] * s[1] - s[0] * m[1]],
            [s[1] * m[1] - m[0] * s[2], n * s[2] - m[1] * m[1], m[0] * m[1] - n * s[1]],
            [m[0] * s[1] - s[0] * m[1], m[0] * m[1] - n * s[1], n * s[0] - m[0] * m[0]],
        ];
        let inverse = T::one() / (n * minors[0][0] + m[0] * minors[0][1] + m[1] * minors[0][2]);
        Self { minors, inverse }
    }

    /// Load at a place per unit of the sum of all loads (0), of their moment along x (1), and along y (2).
    #[inline(always)]
    pub(crate) fn share(&self, [x, y]: [T; 2], k: usize) -> T {
        let [zero, one, two] = &self.minors;
        let pick = |row: &[T; 3]| row.get(k).copied().unwrap_or(T::zero());
        (pick(zero) + x * pick(one) + y * pick(two)) * self.inverse
    }
}

/// Loads and forces in the four contact patches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Balance<T> {
    /// Normal load of each wheel, N.
    pub load: [T; 4],
    /// Force of the ground on each wheel in body axes, N.
    pub force: [[T; 2]; 4],
    /// Sum of the contact forces, N.
    pub total: [T; 2],
    /// Yaw moment of the contact forces about the centre of mass, N m.
    pub yaw_moment: T,
}
