//! Constants of a robot from recordings in free run.

::settings::settings! {
    /// What the output-error fit was tuned with.
    pub(crate) struct Settings;

    /// Constants that are free.
    constants: Constants {
        /// A usual change of a factor.
        factor: f64 = 0.1, "1", "guess";
        /// Finite step of a constant, in its scale: small enough to be linear, large enough to be told from rounding.
        step: f64 = 1e-5, "1", "guess";
        /// Longest step of a fit in one constant, in its scale.
        longest: f64 = 5.0, "1", "guess: half a factor e for factors";
    }

    /// Jacobians.
    equations: Jacobian {
        /// Vectors of robots that are run before their columns are summed and forgotten.
        vectors: usize = 8, "1", "guess";
    }

    /// Steps of a fit, and what the data determine.
    iteration: Iteration {
        /// A fit has arrived when the cost falls by less than this share of itself.
        least_fall: f64 = 1e-7, "1", "guess";
        /// A fit has arrived when all constants move by less than this share of their scale.
        least_move: f64 = 1e-4, "1", "guess";
        /// Steps at most.
        most_steps: usize = 60, "1", "guess";
        /// Smallest eigenvalue of the columns' correlations from which on they are told apart.
        least_eigenvalue: f64 = 1e-9, "1", "guess: finite steps are known to 1e-5 or so";
        /// A constant that is known to no better than this many scales is not determined.
        most_sigma: f64 = 10.0, "1", "guess";
        /// A constant has a part in an undetermined combination from this share on.
        part: f64 = 0.2, "1", "guess";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
