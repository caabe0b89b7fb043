//! Tuned numbers: limits of shapes, sizes of what is held at once.

::settings::settings! {
    /// What weak forms are computed with.
    pub(crate) struct Settings;

    /// Limits of a shape.
    limits: Limits {
        /// Most signals: they make 5150 columns.
        signals: usize = 100, "1", "their Gram matrix takes 0.2 GB";
        /// Widest window and longest stride, rows.
        rows: usize = 1 << 20, "1", "guess";
        /// Largest exponent of the bump.
        exponent: usize = 64, "1", "guess";
    }

    /// Rows and windows on their way into the Gram matrix.
    stream: Stream {
        /// Rows whose columns are held at once, at most.
        rows: usize = 48, "1", "a block stays in the nearest cache";
        /// Windows that go into the Gram matrix at once.
        windows: usize = 32, "1", "guess";
        /// Numbers beyond this size count as missing, in the unit of their signal.
        largest: f64 = 1e70, "1", "their products would leave the numbers";
    }

    /// Regression from the Gram matrix.
    ridge: Ridge {
        /// Share of a regressor that the regressors before it must leave unexplained, in squares, for its coefficient to
        /// have a meaning.
        least_pivot: f64 = 1e-12, "1", "squares are known to some 1e-16 of themselves";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
