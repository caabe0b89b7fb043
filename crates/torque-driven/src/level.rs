//! How much of a mismatch is left.

/// How much is left of a mismatch.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Level {
    /// Cost of the simulation before anything is re-tuned, nats.
    pub(crate) as_it_is: f64,
    /// The same of the simulation that is told: with the best hypothesis, or re-tuned alone.
    pub(crate) fitted: f64,
    /// The same of drives in which nothing is missing.
    pub(crate) fault_free: f64,
    /// Probability, by this, that the cause is not in the catalogue.
    pub(crate) is_unknown: f64,
}

impl Level {
    /// Share of the mismatch that is left.
    pub(crate) fn share(self) -> f64 {
        ((self.fitted - self.fault_free) / (self.as_it_is - self.fault_free).max(1.0)).clamp(0.0, 1.0)
    }

    /// How many times as large, by its rms, what is left is as in drives in which nothing is missing.
    pub(crate) fn times(self) -> f64 {
        (self.fitted / self.fault_free.max(1.0)).max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::Level;

    #[test]
    fn what_is_left_is_a_share_of_what_there_was_above_a_drive_in_which_nothing_is_missing() {
        let level = Level { as_it_is: 500.0, fitted: 140.0, fault_free: 100.0, is_unknown: 0.8 };
        assert!((level.share() - 0.1).abs() < 1e-12, "40 of 400 nats");
        assert!((level.times() - 1.4_f64.sqrt()).abs() < 1e-12, "costs are mean squares");
        assert_eq!(Level { fitted: 90.0, ..level }.share(), 0.0, "less than usual is nothing");
    }
}
