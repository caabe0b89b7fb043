//! The accelerations of the plant, arranged for speed: the same physics as [`PaperRobot::evaluate`].

use super::{Constants, PaperRobot, Parameters};
use crate::contact::Stance;
use crate::scalar::{Scalar, real};

/// The velocities of the plant: v_x, v_y, ω, θ̇3, θ̇4.
pub(super) type Velocities<T> = [T; 5];

/// What the accelerations need, with all that does not change taken out of the loop.
///
/// Per side one division serves all four force components: with `d_i² = max((r θ̇)², |v_i|²) + v_0²`, the slip velocity
/// `(s_x, s_y)` and uncoupled slip, `μ K(λ_x) = 2 μ λp s_x d/(λp² d² + s_x²)`, and all four denominators are multiplied.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rates<T> {
    radius: T,
    half_track: T,
    /// Places of the axles, m before the centre of mass.
    axle: [T; 2],
    /// λp² and 2 μ λp.
    peak2: T,
    pull: T,
    floor2: T,
    /// Loads of a front and a rear wheel at rest, N.
    static_load: [T; 2],
    pitch: T,
    roll: T,
    mass: T,
    inverse_mass: T,
    /// Lever arms of front, rear and side over the yaw inertia, 1/(kg m).
    lever: [T; 3],
    inverse_inertia: T,
    inverse_sign_width: T,
    /// Dry friction of a side, lever of the rolling resistance and radius, over the inertia of a side.
    coulomb: T,
    rolling: T,
    traction: T,
}

impl<T: Scalar> Rates<T> {
    pub(super) fn new(p: &Parameters, constants: &Constants<T>, stance: &Stance<T>) -> Self {
        let inertia = 2.0 * p.wheel_inertia;
        let lever = |arm: T| arm / real(p.yaw_inertia);
        Self {
            radius: real(p.wheel_radius),
            half_track: real(0.5 * p.track),
            axle: [stance.wheel[0][0], stance.wheel[2][0]],
            peak2: constants.slip_at_peak * constants.slip_at_peak,
            pull: real(2.0 * p.adhesion * p.slip_at_peak),
            floor2: real(p.slip_floor * p.slip_floor),
            static_load: [stance.static_load[0], stance.static_load[2]],
            pitch: stance.pitch,
            roll: stance.roll,
            mass: stance.mass,
            inverse_mass: T::one() / stance.mass,
            lever: [lever(stance.wheel[0][0]), lever(stance.wheel[2][0]), real(0.5 * p.track / p.yaw_inertia)],
            inverse_inertia: real(1.0 / inertia),
            inverse_sign_width: real(1.0 / p.sign_width),
            coulomb: real(2.0 * p.coulomb_torque / inertia),
            rolling: real(p.wheel_radius * p.rolling_resistance / inertia),
            traction: real(p.wheel_radius / inertia),
        }
    }

    /// Forces per unit load of the front and the rear wheel of a side, `[[x, y]; 2]`; `rim` and `wx` are the speeds of
    /// the rim and of the wheels' centres along x, `wy` those along y.
    #[inline(always)]
    fn pulls<const COMBINED: bool>(&self, rim: T, wx: T, wy: [T; 2]) -> [[T; 2]; 2] {
        let sx = rim - wx;
        let (rim2, wx2, sx2) = (rim * rim, wx * wx, sx * sx);
        let wy2 = [wy[0] * wy[0], wy[1] * wy[1]];
        let d2 = wy2.map(
            #[inline(always)]
            |w| rim2.max(wx2 + w) + self.floor2,
        );
        let d = d2.map(T::sqrt);
        let peak = [self.peak2 * d2[0], self.peak2 * d2[1]];
        if COMBINED {
            let sum = [peak[0] + (sx2 + wy2[0]), peak[1] + (sx2 + wy2[1])];
            let inverse = self.pull / (sum[0] * sum[1]);
            let (front, rear) = (d[0] * sum[1], d[1] * sum[0]);
            [[(sx * front) * inverse, -(wy[0] * front) * inverse], [(sx * rear) * inverse, -(wy[1] * rear) * inverse]]
        } else {
            let along = [peak[0] + sx2, peak[1] + sx2];
            let across = [peak[0] + wy2[0], peak[1] + wy2[1]];
            let both = [along[0] * across[0], along[1] * across[1]];
            let inverse = self.pull / (both[0] * both[1]);
            // Roots and products are done while the division runs.
            let (front, rear) = (d[0] * both[1], d[1] * both[0]);
            [
                [(sx * across[0]) * front * inverse, -((wy[0] * along[0]) * front) * inverse],
                [(sx * across[1]) * rear * inverse, -((wy[1] * along[1]) * rear) * inverse],
            ]
        }
    }

    /// Time derivatives of the velocities under the torques of the sides.
    #[inline(always)]
    pub(super) fn of<const SIDE_SUM: bool, const COMBINED: bool>(
        &self,
        v: &Velocities<T>,
        torque: &[T; 2],
    ) -> Velocities<T> {
        let [vx, vy, w, left, right] = *v;
        let wy = [vy + w * self.axle[0], vy + w * self.axle[1]];
        let around = w * self.half_track;
        let l = self.pulls::<COMBINED>(self.radius * left, vx - around, wy);
        let r = self.pulls::<COMBINED>(self.radius * right, vx + around, wy);

        // Loads depend linearly on the specific force and forces on the loads: a 2×2 system with one division.
        let (front, rear) = ([l[0][0] + r[0][0], l[0][1] + r[0][1]], [l[1][0] + r[1][0], l[1][1] + r[1][1]]);
        let (sum_left, sum_right) = ([l[0][0] + l[1][0], l[0][1] + l[1][1]], [r[0][0] + r[1][0], r[0][1] + r[1][1]]);
        let [load_f, load_r] = self.static_load;
        let b = [load_f * front[0] + load_r * rear[0], load_f * front[1] + load_r * rear[1]];
        let a11 = self.mass - self.pitch * (rear[0] - front[0]);
        let a12 = self.roll * (sum_left[0] - sum_right[0]);
        let a21 = self.pitch * (front[1] - rear[1]);
        let a22 = self.mass - self.roll * (sum_right[1] - sum_left[1]);
        let inverse = T::one() / (a11 * a22 - a12 * a21);
        let pitch = (self.pitch * (b[0] * a22 - a12 * b[1])) * inverse;
        let roll = (self.roll * (a11 * b[1] - a21 * b[0])) * inverse;
        let zero = T::zero();
        let (light, heavy) = (load_f - pitch, load_r + pitch);
        // A wheel never pulls on the ground.
        let load_left = [(light - roll).max(zero), (heavy - roll).max(zero)];
        let load_right = [(light + roll).max(zero), (heavy + roll).max(zero)];

        let fx_left = [load_left[0] * l[0][0], load_left[1] * l[1][0]];
        let fx_right = [load_right[0] * r[0][0], load_right[1] * r[1][0]];
        let fy_front = load_left[0] * l[0][1] + load_right[0] * r[0][1];
        let fy_rear = load_left[1] * l[1][1] + load_right[1] * r[1][1];
        let (pull_left, pull_right) = (fx_left[0] + fx_left[1], fx_right[0] + fx_right[1]);
        let ax = (pull_left + pull_right) * self.inverse_mass;
        let ay = (fy_front + fy_rear) * self.inverse_mass;
        let [front_lever, rear_lever, side_lever] = self.lever;
        let turning = (front_lever * fy_front + rear_lever * fy_rear) + side_lever * (pull_right - pull_left);

        let sign = T::tanh_of_both([left * self.inverse_sign_width, right * self.inverse_sign_width]);
        let resisting = if SIDE_SUM {
            let dry = [load_left[0] + load_left[1], load_right[0] + load_right[1]];
            [
                (self.coulomb + self.rolling * dry[0]) * sign[0] + self.traction * pull_left,
                (self.coulomb + self.rolling * dry[1]) * sign[1] + self.traction * pull_right,
            ]
        } else {
            // Eq. 8 takes the rear wheel twice, its load linear in a_R even if a wheel lifts.
            let (pitch, roll) = (load_r + self.pitch * ax, self.roll * ay);
            let load = [pitch - roll, pitch + roll];
            let twice = [load[0] + load[0], load[1] + load[1]];
            [
                (self.coulomb + self.rolling * twice[0]) * sign[0] + self.traction * (twice[0] * l[1][0]),
                (self.coulomb + self.rolling * twice[1]) * sign[1] + self.traction * (twice[1] * r[1][0]),
            ]
        };
        [
            ax + w * vy,
            ay - w * vx,
            turning,
            torque[0] * self.inverse_inertia - resisting[0],
            torque[1] * self.inverse_inertia - resisting[1],
        ]
    }
}

impl<T: Scalar> PaperRobot<T> {
    /// Accelerations of the velocities v_x, v_y, ω, θ̇3, θ̇4 under the torques τ3, τ4 in N m: those of [`PaperRobot::rate`] to
    /// rounding, arranged for speed.
    ///
    /// Four squares of speeds are multiplied: beyond 10³⁰ m/s (in single precision 10⁴) what comes out is not a number.
    #[inline(always)]
    pub fn accelerations(&self, velocities: &[T; 5], torque: [T; 2]) -> [T; 5] {
        use super::{Belt, Tyre};
        let rates = &self.rates;
        match (self.variant.belt, self.variant.tyre) {
            (Belt::Literal, Tyre::Uncoupled) => rates.of::<false, false>(velocities, &torque),
            (Belt::SideSum, Tyre::Uncoupled) => rates.of::<true, false>(velocities, &torque),
            (Belt::Literal, Tyre::Combined) => rates.of::<false, true>(velocities, &torque),
            (Belt::SideSum, Tyre::Combined) => rates.of::<true, true>(velocities, &torque),
        }
    }
}
