//! The tuned numbers that all kinds of robots share. Those of the solver are the defaults of
//! `least_squares::Settings`.

::settings::settings! {
    /// Tuned numbers that all kinds of robots share.
    pub(crate) struct Settings;

    /// Settings of a diagnosis unless set otherwise.
    options: Usual {
        /// Integration step.
        step: f64 = 1e-3, "s", "the plant's error is then a quarter of the fault-free residual; with 2 ms a patch of other grip was invented beside a law of one's own";
        /// Length of a segment over which the model runs free.
        segment: f64 = 2.0, "s", "guess";
        /// Share of the log-likelihood that counts: a segment's numbers are correlated, about one in seven is new.
        likelihood_power: f64 = 0.15, "1", "the recipe that this method started from, tuned on the 72 development cases";
        /// Saturation of outliers, in expected misfits of a segment.
        outlier_scale: f64 = 3.0, "1", "the recipe that this method started from, tuned on the 72 development cases";
    }

    /// Effects in a disc on the ground, as a fit changes them.
    disc: Ground {
        /// Where the fit of each coordinate of the centre, and of the radius, starts.
        start: f64 = 1.2, "m", "guess";
        /// Unit of its steps.
        unit: f64 = 0.3, "m", "guess";
        /// Least and largest radius.
        radius: [f64; 2] = [0.3, 6.0], "m", "guess";
        /// Farthest coordinate of a centre.
        farthest: f64 = 1e3, "m", "guess";
    }

    /// Forecasts of recordings that were left out of the fit.
    forecasts: Forecasts {
        /// Error with re-tuned constants over that as stated, beyond which they are not to be adopted.
        worse: f64 = 1.1, "1", "guess; fault-free robots of another hand have 1.09 at most, one whose tyres scrub by a third more had 1.49";
        /// Error of one quantity with the named cause over that with the best wrong cause, beyond which that is told.
        worse_quantity: f64 = 1.1, "1", "guess; equal to the other";
    }

    /// A gyro beside the heading of a pose.
    gyro_beside_pose: GyroAndPose {
        /// Length of the windows over which turning adds up.
        window: f64 = 4.0, "s", "guess; long beside delays, short beside the drift of a zero";
        /// Windows that tell something, at least.
        windows: usize = 8, "1", "guess; three numbers are fitted";
        /// Times that a late clock is set right.
        rounds: usize = 3, "1", "guess; its lateness is told by a straight line";
        /// Turning of a window, root mean square, below which nothing is told.
        least: f64 = 0.1, "rad", "guess; noise of poses is a tenth of it";
        /// Turning that the wheels leave of a heading, as a share, below which it is reckoned from them.
        reckoned: f64 = 0.003, "1", "simulated: a robot's own odometry beside 50 and 20 rows of wheel speeds a second leaves 0.001 and 0.002, a pose of a skid-steer robot 0.005 to 0.01";
        /// The same over the time between rows.
        reckoned_of_rows: f64 = 0.1, "1/s", "simulated: 0.006 and 0.010 of 10 and 6.5 rows a second";
        /// Least and largest share of the turning that a gyro may show; beyond it is another unit or another way up.
        one_turning: [f64; 2] = [0.5, 1.5], "1", "guess";
        /// Longest gap of either signal in a window.
        gap: f64 = 0.5, "s", "guess; poses of 2 Hz and more";
        /// Deviations beyond so many sigmas are outliers.
        outlier: f64 = 4.0, "1", "guess";
        /// One sigma of the scale from which on nothing is told.
        surest: f64 = 0.02, "1", "guess; what matters is as much";
        /// One sigma by which the scale differs from drive to drive.
        drive: f64 = 0.003, "1", "guess; temperature, mounting";
        /// One sigma of the scale of a gyro that nobody calibrated.
        of_sheets: f64 = 0.01, "1", "data sheets of MEMS gyros: 1 to 3 % at most";
        /// A scale is off where it differs by so many sigmas.
        clear: f64 = 3.0, "1", "guess";
        /// Probability of one that is off, at most.
        surely: f64 = 0.99, "1", "guess; a pose may be wrong, too";
    }

    /// A constant of a fit by residuals unless set otherwise.
    constant: Fitting {
        /// Step of finite differences, in scales of the constant.
        difference: f64 = 1e-4, "1", "guess; halves the digits of an f64";
        /// Added to its diagonal, per square of its scale.
        ridge: f64 = 1e-9, "1", "guess; nothing beside what is determined at all";
    }

    /// Expected information of a drive.
    information: Information {
        /// Points of the quasi-random sum.
        points: usize = 256, "1", "guess";
        /// A gain below this is none.
        least: f64 = 0.005, "bit", "guess";
        /// Answers less probable than this are no rivals.
        least_rival: f64 = 0.01, "1", "guess";
        /// Rivals at most.
        rivals: usize = 6, "1", "guess";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
