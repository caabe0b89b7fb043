//! Contacts of MuJoCo that slip like tyres do on average.
//!
//! Up to the cone, MuJoCo's friction is viscous: `f = b v / R` with the damping b of `solreffriction` and the regularisation
//! `R = A (1 − d)/d`, A the inverse inertia of the contact and d the impedance of `solimp`. A tyre creeps in proportion to
//! the speed of its rim, `F = 2 μ N s/(λp u)`; MuJoCo's contact knows no rim. So the creep is that at one rim speed.

use crate::contact::{casters, grips, names, wheels};
use crate::inertia::{Part, Parts};
use crate::number::number;
use crate::vehicle::Vehicle;
use crate::xml::{Element, element};

/// Half the width of a wheel's capsule, m.
pub(crate) const HALF_WIDTH: f64 = 0.002;
/// Reference speed `sqrt((ω r)² + v0²)` whose creep the contacts have, m/s: free runs of four drawn robots came closest to
/// the planar plant at 0.7 to 0.8.
pub(crate) const CREEP_AT: f64 = 0.75;
/// Speed over which the friction of a caster builds up, m/s (guess: slow beside any drive).
pub(crate) const SLIDES_AT: f64 = 0.02;
/// Damping b of the friction, 1/s. It must be fast against turning, or friction points the wrong way: MuJoCo balances
/// accelerations in axes that turn with the wheel. More of it changes nothing.
const DAMPING: f64 = 400.0;
/// Time constant of the normal force, s.
const NORMAL: f64 = 0.02;
/// Contacts of a capsule with the ground.
const CONTACTS: f64 = 2.0;

/// Contacts of the wheels with the floor.
pub(super) fn pairs(v: &Vehicle, parts: &Parts) -> Element {
    let inverse = inverse_mass(parts);
    let on_casters = casters(&v.robot);
    let pair = |i: usize| {
        let grip = &grips(v)[i];
        // Dry from the start where nothing rolls: casters.
        let (peak, creeps_at) = if on_casters.contains(&i) { (1.0, SLIDES_AT) } else { (grip.slip_at_peak, CREEP_AT) };
        // One caster stands for two at its place.
        let load = if on_casters == (0..1) && i == 0 { 2.0 * grip.load } else { grip.load };
        let slope = 2.0 * grip.adhesion * load / (peak * creeps_at);
        creeping(names(&v.robot)[i], grip.friction, slope, inverse[i])
    };
    element("contact").comments([told()]).children(casters(&v.robot).chain(wheels(&v.robot)).map(pair))
}

/// What the contacts do, for people.
pub(crate) fn told() -> String {
    format!(
        "Sliding friction along and across the axle; solimp and solreffriction make it creep like the tyre does at {CREEP_AT} m/s.",
    )
}

/// A contact with the floor: friction along the axle and across it, force per speed of creep while little slips, N s/m, and the
/// inverse inertia that MuJoCo reckons with, 1/kg.
pub(crate) fn creeping(name: &str, [along, across]: [f64; 2], slope: f64, inverse: f64) -> Element {
    let impedance = 1.0 / (1.0 + DAMPING / ((slope / CONTACTS).max(1.0) * inverse));
    element("pair")
        .with("name", name)
        .with("geom1", "floor")
        .with("geom2", name)
        .with("condim", "3")
        // Along the axle and across it; the others are not used.
        .nums("friction", &[along.max(MIN_FRICTION), across.max(MIN_FRICTION), 0.0, 0.0, 0.0])
        .nums("solref", &[NORMAL, 1.0])
        .nums("solimp", &[impedance, impedance, 0.001])
        // Negative: stiffness, which friction does not use, and damping, which MuJoCo divides by the impedance.
        .with("solreffriction", format!("-1 {}", number(-DAMPING * impedance)))
}

/// Least friction that MuJoCo's cones take.
const MIN_FRICTION: f64 = 1e-5;

/// Inverse inertia of each wheel's contact as MuJoCo reckons it: the mean over three directions of `1/m + (r × e)ᵀ I⁻¹ (r × e)`
/// at the wheel's centre. A wheel that turns freely takes no part in pitching.
fn inverse_mass(parts: &Parts) -> [f64; 4] {
    let spin: f64 = parts.wheels.iter().map(|w| w.inertia[1]).sum();
    parts.wheels.map(|w| inverse_at(&parts.total(), spin, w.centre))
}

/// The same at a place of a robot whose wheels turn with so much inertia.
pub(crate) fn inverse_at(total: &Part, spin: f64, at: [f64; 3]) -> f64 {
    let [ix, iy, iz] = [total.inertia[0], total.inertia[1] - spin, total.inertia[2]];
    let [x2, y2, z2]: [f64; 3] = std::array::from_fn(|k| (at[k] - total.centre[k]).powi(2));
    1.0 / total.mass + ((y2 + z2) / ix + (x2 + z2) / iy + (x2 + y2) / iz) / 3.0
}
