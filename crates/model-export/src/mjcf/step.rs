//! The integration step, which delays are counted in.

/// Integration step, s: halving it changed free runs by less than 1 % of their distance from the planar plant.
pub(crate) const STEP: f64 = 0.001;
