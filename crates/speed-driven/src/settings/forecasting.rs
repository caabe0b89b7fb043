//! The last part of a recording and the law of its torques.

::settings::settings! {
    /// What recordings are forecast with.
    pub(crate) struct Settings;

    /// The last part of a recording, forecast from the parts before it.
    split: Split {
        /// Thirds of a recording that are fitted.
        fitted_thirds: f64 = 2.0, "1", "guess";
        /// Recordings shorter than this are not split.
        least_seconds: f64 = 15.0, "s", "guess";
        /// Recordings that turn less than this in either part are not split.
        least_turning: f64 = 3.0, "s", "guess";
        /// Lags of the body behind its set speeds that are tried.
        lags: [f64; 7] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6], "s", "guess";
    }

    /// Constants of a law: where the fit begins, least, most.
    constants: Bounds {
        /// Straight load over that of the references.
        straight: [f64; 3] = [1.0, 0.2, 6.0], "1", "guess";
        /// Scrub couple over the straight load of the references.
        couple: [f64; 3] = [2.0, 0.1, 8.0], "1", "guess";
        /// Difference over the larger of the speeds at which scrub develops.
        curvature: [f64; 3] = [0.3, 0.02, 2.0], "1", "guess";
        /// Distance over which scrub winds up.
        distance: [f64; 3] = [0.15, 0.01, 2.0], "m", "guess";
        /// Constants of the laws that are wrong for a robot that turns, over the straight load of the references.
        placebo: [f64; 3] = [0.0, -20.0, 20.0], "1", "guess";
        /// Difference of the sides' rolling loads over their sum, right less left.
        asymmetry: [f64; 3] = [0.1, -0.7, 0.7], "1", "guess";
        /// Lag of the drive behind its set speeds.
        lag: [f64; 3] = [0.2, 0.01, 1.0], "s", "guess";
    }

    /// Torques that a law gives, and what the sensor shows of them.
    law: Torques {
        /// Speed below which a side rests.
        rest: f64 = 0.01, "m/s", "guess";
        /// Least speed that a curvature is taken over, and at which rolling loads are soft.
        least_speed: f64 = 0.02, "m/s", "guess";
        /// Torque over which an unsigned current goes from nothing to a reading.
        soft: f64 = 1.0, "N m", "guess";
        /// Decay of a drifting load, per length of the recording.
        decay: f64 = 8.0, "1", "guess";
    }

    /// The fit of a law.
    fit: LawFit {
        /// Residual beyond which a row counts less.
        far_off: f64 = 3.0, "N m", "guess";
        /// Steps at most.
        steps: usize = 25, "1", "guess";
        /// Finite step of a derivative, as a share of the way from bound to bound.
        shift: f64 = 1e-4, "1", "guess";
        /// First damping.
        damping: f64 = 1e-2, "1", "guess";
        /// What holds a constant that shows in no torque.
        ridge: f64 = 1e-6, "1", "numerical guard";
    }
}
