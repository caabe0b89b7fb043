//! The little dense algebra the diagnosis needs: that of the inference.

pub(crate) use inference::algebra::{eliminate, select, solve_spd};
