//! A robot of any wheels, driven by torques: up to eight wheels that stand, are steered, carry rollers or are dragged along as
//! casters, and motors that turn one wheel, several by a belt, or an axle through a differential.
//!
//! Wheel `i` at `p_i` from the centre of mass rolls along `e_i` and turns at `Ω_i`. Its contact slips by
//! `s_i = r_i Ω_i e_i − (v + ω × p_i)`, and the ground pushes it by `F_i = μ N_i K(|s_i|/d_i) s_i/|s_i|` with a law `K`
//! between Kiencke's ([`crate::contact::combined`]) and the brush model; of a wheel with rollers only the part of `s_i` along the axles of its rollers counts, and the
//! rollers drag a little. Loads are those of a rigid body on equal springs, `N_i = α + β x_i + γ y_i`.
//! `m (v̇ + ω × v) = Σ F_i + m g_∥`, `I ω̇ = Σ p_i × F_i`, `J Ω̇ = T − r e·F − friction`.
//!
//! Steps are implicit in all speeds together, so that neither stiff tyres nor a light wheel ask for short ones. Forces enter as
//! what they are over the slip or the speed that makes them, held over the step: a tyre that holds less the more it slips, and dry
//! friction, then never push beyond where they vanish, as their tangents would. With `B_i = F_i/s_i` and `G_i` from the body's
//! speeds to those of a contact, wheels are eliminated from `(M + h Σ Gᵀ B G) Δu − h Σ Gᵀ B r e ΔΩ = h Σ Gᵀ F`, which leaves three
//! equations.
//!
//! Sources: Campion, Bastin & D'Andréa-Novel 1996, IEEE Trans. Robot. Autom. 12(1) (fixed, steered, off-centred and Swedish
//! wheels); Kiencke & Nielsen, Automotive Control Systems (tyres); Pacejka 2012, Tire and Vehicle Dynamics
//! (brush model); Muir & Neuman 1987 (rollers); Gillespie, Fundamentals of
//! Vehicle Dynamics (Ackermann steering).
//!
//! The plant of four wheels by side ([`crate::Plant`]) stays beside it: its steps and bits are those of all results so far.
//! Where both can simulate a robot they agree, which a test holds.

mod plant;
mod robot;
mod rolling;
mod state;
mod tyre;

pub use plant::Plant;
pub use robot::{Caster, Coupling, Ground, Joint, Motor, Robot, Wheel};
pub use state::State;

/// Wheels, motors and steering joints at most.
pub const MOST: usize = 8;
/// Casters at most.
pub const MOST_CASTERS: usize = 4;

#[cfg(test)]
mod tests;
