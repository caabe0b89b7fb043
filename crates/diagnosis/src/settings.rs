//! The tuned numbers of screening long recordings.

::settings::settings! {
    /// Tuned numbers of screening long recordings.
    pub(crate) struct Settings;

    /// Pieces into which recordings are cut, and how many of them a diagnosis rests on.
    pieces: Pieces {
        /// Length of a piece.
        length: f64 = 60.0, "s", "guess";
        /// Recorded time on which a diagnosis rests at most unless set otherwise.
        budget: f64 = 600.0, "s", "guess";
        /// Pieces that are kept at least, however small the budget.
        least: usize = 3, "1", "guess; one for each reason to keep a piece";
        /// Shortest piece that is worth choosing.
        shortest: f64 = 10.0, "s", "guess";
        /// Pieces at the beginning that stand for the references where there are none.
        beginning: usize = 10, "1", "guess";
        /// Length of a piece of the references: shorter than those of recordings, so that short references leave something
        /// to compare with.
        reference_ns: i64 = 12_000_000_000, "ns", "guess";
    }

    /// Drives of one day, place and load.
    visits: Visits {
        /// Time from the start of one drive to the start of the next from which they are of different visits.
        apart_ns: i64 = 21_600_000_000_000, "ns", "guess; six hours: between the drives of a day lies a meal, between days a night";
    }

    /// Values that no robot on wheels can show.
    possible: Possible {
        /// Fastest drive.
        fastest: f64 = 60.0, "m/s", "guess; twice a fast car of motorways, no robot comes near";
        /// Fastest turn about the upward axis.
        fastest_turn: f64 = 40.0, "rad/s", "gyros of robots end at 2000 °/s = 35 rad/s";
        /// Largest specific force.
        hardest_hit: f64 = 400.0, "m/s²", "accelerometers for hits end at 400 m/s², usual ones at 160 m/s²";
        /// Largest torque of a side, in weights times the wheels' radius: spinning up heavy wheels takes more than tyres hold.
        torque: f64 = 20.0, "1", "guess";
        /// Share of the samples of a channel that may be left out as spikes.
        spikes: f64 = 0.01, "1", "guess";
        /// Time over which angles and places are compared with the turning of the wheels.
        lag: f64 = 0.5, "s", "guess; long beside the noise of a pose";
        /// How much faster than by its wheels a body seems to move where a unit is wrong.
        beyond_wheels: f64 = 10.0, "1", "guess; the factors of wrong units are 9.5 (rpm), 57 (degrees) and 1000 (mm), those of faults below 2";
        /// Largest value that is written with all its digits.
        readable: f64 = 1e9, "1", "guess";
        /// Added to the turn that wheels give: bias and noise of a gyro.
        turn: f64 = 0.05, "rad/s", "guess";
        /// Added to the drive that wheels give: noise of a pose.
        drive: f64 = 0.1, "m/s", "guess";
        /// Factor within which an upward accelerometer shows gravity.
        gravity: f64 = 1.5, "1", "guess; a slope of 45 degrees gives 1.4";
    }

    /// Columns that contradict each other.
    columns: Columns {
        /// Time between rows on which channels are compared.
        step: f64 = 0.2, "s", "guess; two samples of a pose at 10 Hz, and shorter than an acceleration";
        /// Time between samples, in the mean, from which a channel shows no motion: a state every two seconds.
        sparse: f64 = 0.5, "s", "guess; half of the shortest manoeuvre";
        /// Fewest rows that can show a contradiction.
        rows: usize = 25, "1", "guess; 5 s";
        /// Cosine from which two signals are alike.
        alike: f64 = 0.7, "1", "guess";
        /// Cosine beyond which two signals of devices whose clocks wander are alike, or opposite.
        opposite: f64 = 0.5, "1", "guess; clocks that wander by a second leave 0.6 of 1 where the Husky turns every few seconds";
        /// Cosine below which two signals are unlike.
        unlike: f64 = 0.3, "1", "guess";
        /// Yaw rate below which, in the root mean square, nothing is said of turning, and speed of wheels for set speeds.
        turning: f64 = 0.05, "rad/s", "guess; five times the noise of a gyro";
        /// Speed below which nothing is said of directions.
        moving: f64 = 0.05, "m/s", "guess; noise of a pose over two rows";
        /// Specific force below which, in the root mean square, nothing is said of accelerometers.
        pushed: f64 = 0.1, "m/s²", "guess; noise of an accelerometer over a row";
        /// Length of the means in which vibration is none.
        mean: f64 = 1.0, "s", "guess; shorter than a turn";
        /// Errors by which a share has to differ from zero.
        clear: f64 = 5.0, "1", "guess; ten recordings of three axes are looked at";
        /// Share of what is expected of an axis below which it shows none of it; one that shows it, shows more, and less than the inverse.
        little: f64 = 0.5, "1", "guess; sensors aslant by 30 degrees show .5 and .87";
        /// Errors by which a share has to lie below that.
        clear_of_little: f64 = 2.0, "1", "guess";
        /// How much more the sum of the sides would turn the body than it turns, where one side has the wrong sign.
        turned: f64 = 3.0, "1", "guess; wheels that are pushed aside turn up to twice as much as the body";
        /// Factor from which a column is in another unit.
        unit: f64 = 5.0, "1", "guess; the factors of wrong units are 6.3 (turns), 9.5 (rpm), 9.8 (kgf m), 57 (degrees), those of faults below 3";
        /// Factor within which a ratio is that of a unit.
        near: f64 = 1.3, "1", "guess; slip and another radius";
        /// Factor on the torque limit beyond which a torque is in another unit: set-points beyond it are only limited.
        over_limit: f64 = 1.5, "1", "guess";
        /// Factor from which wheels turn in another unit where only a gyro tells: a robot that is stuck turns a tenth of what they ask.
        turned_unit: f64 = 40.0, "1", "guess; degrees per second are 57 times radians";
    }

    /// Recordings with fewer rows.
    thinning: Thinning {
        /// Time between the rows that are left.
        step_ns: i64 = 10_000_000, "ns", "guess";
        /// Channels with fewer samples than this per step stay as they are.
        worth_it: f64 = 2.0, "1", "guess";
        /// Share of these samples above which a channel is thinned all the same.
        complete: f64 = 0.9, "1", "guess";
    }

    /// Signals on a common grid.
    grid: Raster {
        /// Finest grid.
        finest: f64 = 0.01, "s", "guess";
        /// Coarsest grid.
        coarsest: f64 = 0.1, "s", "guess";
        /// Times between samples, at the beginning of a channel, whose median says how finely it was taken.
        spacings: usize = 2000, "1", "guess";
        /// Longest gap that is bridged, rows.
        bridged: usize = 10, "1", "guess";
        /// Wheel speed over which a direction changes its sign.
        at_rest: f64 = 0.3, "rad/s", "guess";
    }

    /// The law among signals that the references follow, by weak form.
    law: Regression {
        /// Rows of a window.
        rows: usize = 49, "1", "guess; half a second on the finest grid";
        /// Rows between the beginnings of windows.
        stride: usize = 12, "1", "guess; a quarter of a window";
        /// Exponent of the bump that weighs the rows of a window.
        exponent: u32 = 4, "1", "guess";
        /// Penalty of the regressions, in squares of each regressor.
        penalty: f64 = 1e-4, "1", "guess";
        /// Fewest windows from which a law is learned.
        least_windows: u64 = 160, "1", "ten for each coefficient";
    }

    /// The pieces whose driving tells most.
    choice: Choice {
        /// Added to the diagonal of the information of the kept pieces, which are in units of the signals' mean squares:
        /// a signal that none of them excites leaves the determinant finite.
        ridge: f64 = 1e-3, "1", "guess";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
