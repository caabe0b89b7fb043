//! Tuned numbers of laws.

::settings::settings! {
    /// Tuned numbers of laws.
    pub(crate) struct Settings;

    /// Shape numbers of factors.
    shapes: Shapes {
        /// Least size of a shape number, in its variable's unit.
        least: f64 = 1e-6, "1", "numerical guard";
        /// Largest shape number.
        most: f64 = 1e6, "1", "numerical guard";
        /// Usual change of a shape number, as a share of it.
        unit: f64 = 0.3, "1", "guess";
        /// Usual change of a phase.
        phase: f64 = 0.3, "rad", "guess";
        /// Usual change of a frequency of time: what a run of 30 s tells apart.
        frequency: f64 = 0.1, "rad/s", "guess";
        /// Usual change of a place on the ground.
        place: f64 = 0.2, "m", "guess";
        /// Exponent below which an exponential is zero.
        deepest: f64 = 60.0, "1", "numerical guard";
        /// Width of the edge of a regime, as a share of where it begins.
        edge: f64 = 0.1, "1", "guess";
        /// Width of the border of a place on the ground.
        border: f64 = 0.05, "m", "guess; a little wider than that of effects with a place";
    }

    /// Largest state that a law sees, so that its value stays finite.
    guard: Guard {
        /// Largest size of a variable, in its unit.
        most: f64 = 1e9, "1", "numerical guard: its third power times three factors is finite";
    }

    /// A law as an effect of the plant.
    effect: Effect {
        /// Least share of a wheel's grip or radius that a law leaves.
        least_share: f64 = 0.05, "1", "numerical guard";
        /// Largest constant of an effect of one's own, in that of its file.
        most: f64 = 50.0, "1", "guess; as of laws that are searched";
        /// Size of an effect of one's own below which nobody would act, as a share of that of its file.
        interest: f64 = 0.25, "1", "guess";
    }

    /// Candidates of the search.
    grammar: Grammar {
        /// Wheel speed over which a dry law changes its sign.
        dry_wheel: f64 = 0.3, "rad/s", "guess; twice that of the plant's own friction";
        /// Speed over the ground over which it does.
        dry_speed: f64 = 0.03, "m/s", "guess";
        /// Yaw rate over which it does.
        dry_yaw: f64 = 0.05, "rad/s", "guess";
        /// Torque over which it does.
        dry_torque: f64 = 0.1, "N m", "guess";
        /// Shapes that are tried, as shares of the variable's usual size.
        sizes: [f64; 2] = [0.5, 1.2], "1", "guess";
        /// Time constants that are tried.
        rises: [f64; 2] = [4.0, 12.0], "s", "guess";
        /// Harmonics of the wheel angle that are tried.
        harmonics: u8 = 4, "1", "guess";
        /// Frequencies of time that are tried.
        frequencies: [f64; 6] = [0.6, 1.2, 2.4, 4.0, 6.3, 9.4], "rad/s", "guess";
        /// Radii of places on the ground that are tried.
        radii: [f64; 2] = [0.8, 1.4], "m", "guess";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
