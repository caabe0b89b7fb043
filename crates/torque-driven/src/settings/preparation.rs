//! From a recording to segments of windows.

::settings::settings! {
    /// What recordings are turned into before any force law.
    pub(crate) struct Settings;

    /// Headings of recordings without a pose.
    headings: Headings {
        /// Sigmas by which a recording must show by itself that the ground falls.
        sure: f64 = 6.0, "1", "guess; other laws than a slope look like one for a few sigmas";
        /// Turn below which recordings are taken to begin alike.
        least: f64 = 0.35, "rad", "guess; twenty degrees, as well as a drive shows a direction";
    }

    /// Telling a simulator's log from a recording, and what it was simulated on.
    logs: Logs {
        /// Samples of a standing robot that tell noise from none, of each sensor at least.
        least_samples: usize = 10, "1", "guess";
        /// Spread within which samples are the same.
        same: f64 = 1e-7, "rad/s, m/s²", "numerical guard: far below the resolution of any inertial sensor";
        /// Rows with gyro, accelerometer and pose that are compared, at least.
        least_rows: usize = 100, "1", "guess";
        /// Most by which the gyro of a simulator's log is off the slope of its yaw, median.
        same_yaw_rate: f64 = 3e-3, "rad/s",
            "logs of `lacuna simulate` at 100 Hz: 4e-5, 25 times that at 20 Hz; a yaw with an error of 0.1 mrad at 100 Hz: 1e-2";
        /// Most by which the accelerometer of a simulator's log is off the curvature of its path, median.
        same_acceleration: f64 = 0.1, "m/s²",
            "logs of `lacuna simulate` at 100 Hz: 2e-3, 25 times that at 20 Hz; a position with an error of 0.1 mm at 100 Hz: 2";
        /// How much wider than the robot file's sigmas a simulator's constants may lie about the file's.
        wider: f64 = 5.0, "1", "guess";
        /// Gauss–Newton steps of a fit to a simulator's logs, at most.
        steps: usize = 60, "1", "guess";
        /// Share of a simulator's constant that other laws than the plant's may feign, one sigma.
        form_error: f64 = 0.02, "1", "equal to the model error of an effect's size";
        /// Half widths of its 90 % interval by which a simulator's constant differs from the file when it is told.
        told: f64 = 1.5, "1", "guess";
        /// Mean squared errors of free runs, over those of a fit of all constants, with which a few explain as well.
        as_well: f64 = 2.0, "1", "a look at eight robots whose simulator had another mass";
        /// Mean squared errors of one constant over those of another that logs do not tell from it.
        not_told_apart: f64 = 1.5, "1", "a look at eight robots whose simulator had another mass";
        /// Most constants that a simulator is taken to have otherwise than the robot file, each by itself.
        most_constants: usize = 2, "1", "guess";
        /// Prior information of a constant that is held, in its sigmas.
        held: f64 = 1e12, "1", "numerical guard: it moves by nothing";
        /// One sigma of a factor of a robot of which only size and mass are known, at least.
        unknown_factor: f64 = 0.1, "1", "guess; fits in turn go farther than one of them";
        /// One sigma of what a simulator's logs hold exactly: the torque that it was given.
        exact: f64 = 1e-4, "1", "formula: next to nothing";
        /// Errors of free runs of a robot that is alike, as a share of the motion, at most.
        alike: f64 = 0.05, "1", "guess";
        /// Errors of free runs that usual sensors would not show: of wheel speeds, of the yaw rate.
        invisible: [f64; 2] = [0.03, 0.01], "rad/s", "guess; the usual residual of fault-free drives";
        /// Most by which the rows of a log and of its recording are apart unlike, as a share.
        same_period: f64 = 0.01, "1", "guess";
        /// Most by which their torques differ, as a share of the largest.
        same_torque: f64 = 0.01, "1", "guess; logs round";
        /// Most by which their lengths differ.
        same_length: f64 = 1.0, "s", "guess";
    }

    /// Laying a recording on a grid of rows.
    runs: Runs {
        /// Fewest rows of a recording.
        least_rows: usize = 201, "1", "guess";
        /// Time between samples from which on one is missing, in usual ones.
        missing: f64 = 1.75, "1", "guess; stamps tremble by less than half of it";
        /// Most rows of the grid per sample of the torque: more are gaps, not a recording.
        most_rows_per_sample: usize = 100, "1", "guess";
    }

    /// Telling a frozen wheel angle from a wheel that stands.
    freezing: Freezing {
        /// Fewest equal angles in a row that are a freeze.
        least_rows: usize = 3, "1", "guess";
        /// Jump at the end of a freeze, in usual increments of the angle.
        jump: f64 = 3.0, "1", "guess";
        /// Increments to each side of a freeze that tell the usual one.
        around: usize = 5, "1", "guess";
    }

    /// Smoothing of poses.
    smoothing: Smoothing {
        /// Distance of the nodes of the pose smoother.
        node: f64 = 0.05, "s", "guess";
        /// Fewest samples, and nodes, that are smoothed at all.
        least_samples: usize = 8, "1", "guess";
        /// Decimal logarithms between which the weight of roughness is looked for, over that of the samples of a node.
        log_weights: [f64; 2] = [-3.0, 9.0], "1", "guess";
        /// Steps of that range.
        tried: usize = 48, "1", "guess: a step changes the width of a path by a tenth";
        /// Error, in sigmas of the poses, beyond which a pose weighs less.
        outlier: f64 = 2.0, "1", "usual for robust weights: 1.5 to 2.5";
        /// Rows between poses, above which a pose is written in the first row after its instant.
        every_row: f64 = 1.5, "1", "formula: between one row and two";
        /// Poses to each side from which the speed at one is taken.
        beside: usize = 2, "1", "guess";
        /// Times that the weights are found anew.
        rounds: usize = 3, "1", "guess";
        /// Poses beyond which the integrated gyro's drift against them is reported as well as its offset.
        least_for_drift: f64 = 10.0, "1", "guess";
    }

    /// Windows and segments.
    windows: Windows {
        /// Length of a window.
        length: f64 = 0.1, "s", "guess";
        /// Parts of a segment in which a local presence is resolved.
        parts: usize = 4, "1", "guess";
        /// Rows to each side of a window's border that may not be frozen.
        beside_frozen: usize = 2, "1", "guess";
        /// Mean yaw rate by which kinds of driving differ by one.
        turning: f64 = 0.3, "rad/s", "guess";
        /// Mean forward velocity by which kinds of driving differ by one.
        speed: f64 = 0.3, "m/s", "guess";
        /// Range of the wheel speeds by which kinds of driving differ by one.
        range: f64 = 4.0, "rad/s", "guess";
    }

    /// The state from which a segment runs free.
    starts: Starts {
        /// Times to each side over which the wheel angle is fitted, each tried when the one before holds too few rows.
        wheel: [f64; 3] = [0.05, 0.15, 0.4], "s", "guess";
        /// Fewest rows of such a fit.
        least_rows: usize = 5, "1", "guess";
        /// Time to each side over which the yaw rate is fitted.
        gyro: f64 = 0.07, "s", "guess";
        /// First angles that tell whether a robot stands at the beginning.
        standing_rows: usize = 3, "1", "guess";
        /// Change of the wheel angle below which it stands.
        standing: f64 = 1e-3, "rad", "guess";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
