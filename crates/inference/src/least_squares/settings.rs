//! The tuned numbers of the solver.

/// The tuned numbers of the solver. Every engine states those in which it differs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Linearisations at most. Default 50; a guess: fits in use take 3 to 15.
    pub iterations: usize,
    /// Damping λ of the first step, share of each diagonal. Default 1e-3 (Marquardt 1963 begins at 1e-2,
    /// MINPACK at about 1e-4); 0 begins with Gauss–Newton.
    pub first_damping: f64,
    /// Factor of the damping after a step that lowers the cost. Default 0.1 (Marquardt 1963); 0 begins every
    /// iteration with Gauss–Newton.
    pub lower: f64,
    /// Factor of the damping after a step that does not. Default 10 (Marquardt 1963).
    pub raise: f64,
    /// Damping below which there is none, and with which damping begins after none. Default 1e-9; a guess:
    /// a thousandth of what rounding leaves of a diagonal of finite differences.
    pub least_damping: f64,
    /// Damping beyond which no step is tried. Default 1e6; a guess: steps are then a millionth of a gradient
    /// step in scales.
    pub most_damping: f64,
    /// Fall of the cost by which a fit has arrived, nats. Default 0; a guess: the share below is enough.
    pub least_fall: f64,
    /// The same as a share of the cost. Default 1e-9; a guess: far below what a size is told to.
    pub least_relative_fall: f64,
    /// Move in scales below which a fit has arrived. Default 1e-9; a guess: finite differences err by more.
    pub least_move: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            iterations: 50,
            first_damping: 1e-3,
            lower: 0.1,
            raise: 10.0,
            least_damping: 1e-9,
            most_damping: 1e6,
            least_fall: 0.0,
            least_relative_fall: 1e-9,
            least_move: 1e-9,
        }
    }
}

impl Settings {
    /// Every iteration begins with an undamped step and raises damping from 0.1 to 100 only if that fails:
    /// for problems close to linear whose trials are dear. The ladder is a guess.
    #[must_use]
    pub fn gauss_newton() -> Self {
        Self { first_damping: 0.0, lower: 0.0, least_damping: 0.1, most_damping: 100.0, ..Self::default() }
    }

    /// Damping after a step that lowered the cost.
    pub(super) fn lowered(&self, damping: f64) -> f64 {
        let damping = damping * self.lower;
        if damping < self.least_damping { 0.0 } else { damping }
    }

    /// Damping after a step that did not.
    pub(super) fn raised(&self, damping: f64) -> f64 {
        (damping * self.raise).max(self.least_damping)
    }
}
