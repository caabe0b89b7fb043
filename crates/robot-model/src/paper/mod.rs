//! The robot of Hendzel & Trojnacki 2014 (JAMRIS 8(4), DOI 10.14313/JAMRIS_4-2014/34).
//!
//! Eq. 8 of the paper gives the wheels' rotation, `2 a1 θ̈ + C(θ̇, λ, a_R) = τ`, but leaves the slip λ and the body's
//! acceleration a_R open. Here they come from planar body dynamics with the same tyre law:
//!
//! * [`Parameters`]: what a robot is made of, sets A, B and C, and the checks;
//! * [`Constants`]: the paper's a1..a8 and Eq. 8 taken literally;
//! * [`PaperRobot`]: the closed plant, [`State`] and torques in, rate and [`Outputs`] out, and steps in time: explicit
//!   ([`PaperRobot::step_rk4`]) and linearly implicit ([`PaperRobot::step_implicit`]);
//! * [`Structured`] and [`terms`]: Eq. 8 as a regressor whose weights are the constants;
//! * [`Variant`]: two flagged departures, the sum over the belt and combined slip.
//!
//! Sides: 0 left (the paper's wheel 3), 1 right (wheel 4). A belt joins the wheels of a side, so both turn alike.
//!
//! ```
//! use robot_model::paper::{PaperRobot, Parameters, State};
//!
//! let robot = PaperRobot::<f64>::new(&Parameters::SET_B)?;
//! let rolling = State { vx: 0.5, speed: [5.0; 2], ..State::default() };
//! // Rolling resistance and bearings are balanced, so nothing accelerates.
//! let rate = robot.rate(&rolling, [1.1886; 2]);
//! assert!(rate.speed[0].abs() < 1e-3 && rate.vx == 0.0);
//! # Ok::<(), robot_model::ModelError>(())
//! ```

mod body;
mod constants;
mod implicit;
mod parameters;
mod rates;
mod step;
mod structured;
#[cfg(test)]
mod tests;
mod variant;

pub use body::{Outputs, PaperRobot, State};
pub use constants::Constants;
pub use parameters::Parameters;
pub use structured::{SideSignals, Structured, TERMS, balance, terms};
pub use variant::{Belt, Tyre, Variant};
