//! Where and when the calibrated model fails, and what is left after the verdict.

use crate::locate::INPUTS;

::settings::settings! {
    /// What the locators were tuned with.
    pub(crate) struct Settings;

    /// Fault-free driving: each reference seen by a calibration without it.
    fault_free: FaultFreeDriving {
        /// Gauss–Newton steps of a calibration without one reference, from the one with all.
        steps: usize = 2, "1", "guess";
        /// Windows to each side over which the growth of the residual since the restart is averaged.
        smooth: usize = 2, "1", "guess";
        /// Least energy of a segment.
        least_energy: f64 = 0.02, "1", "guess";
    }

    /// The fault-free distribution of a level.
    nulls: Nulls {
        /// Reference runs that the prior of the scatter between runs is worth.
        prior_runs: f64 = 4.0, "1", "guess";
        /// Fewest values, beyond one for each run, that tell a scatter.
        least_values: f64 = 4.0, "1", "guess";
        /// Longest lag of the autocorrelation: one part in so many of the longest run.
        lags: usize = 4, "1", "guess";
    }

    /// Levels of segments against the references'.
    levels: Levels {
        /// Usual scatter of ln(energy) between fault-free runs.
        between: f64 = 0.35, "1", "guess";
        /// Least scatter of ln(energy) within a run.
        least_within: f64 = 0.3, "1", "guess";
        /// ln(energy) below which a fault-free block is as good as any.
        floor: f64 = -3.0, "1", "guess";
        /// False discoveries among what is reported.
        discoveries: f64 = 0.05, "1", "guess";
        /// Blocks of all cells that a cell's own fault-free mean begins with.
        pseudo_blocks: f64 = 6.0, "1", "guess";
    }

    /// Kinds of driving and places in which the mismatch is shown.
    cells: Cells {
        /// Borders of the size of the forward velocity.
        speeds: [f64; 5] = [0.0, 0.1, 0.4, 0.8, 5.0], "m/s", "guess";
        /// Borders of the yaw rate.
        turns: [f64; 6] = [-10.0, -0.5, -0.1, 0.1, 0.5, 10.0], "rad/s", "guess";
        /// Borders of the larger slip speed of both sides.
        slips: [f64; 5] = [0.0, 0.03, 0.1, 0.3, 10.0], "m/s", "guess";
        /// Sectors of the heading.
        sectors: i32 = 8, "1", "guess";
        /// Cells along the longer side of the driven ground, at most.
        ground: f64 = 6.0, "1", "guess";
        /// Edges of a cell on the ground that are tried.
        edges: [f64; 6] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0], "m", "guess";
        /// Edge of a cell where all of these are too short.
        longest_edge: f64 = 100.0, "m", "guess";
        /// Least driving in a cell that is reported.
        least_seconds: f64 = 1.0, "s", "guess";
        /// Least driving of a segment in a cell for it to count there, windows.
        least_windows: usize = 3, "1", "guess";
    }

    /// Changes of a level for a while.
    changes: Changes {
        /// Pseudo-runs from which the threshold is taken.
        pseudo_runs: usize = 200, "1", "guess";
        /// Share of fault-free runs that may exceed it.
        false_alarms: f64 = 0.03, "1", "guess";
        /// Stretches of one series at most.
        most: usize = 3, "1", "guess";
        /// Factor of the scatter of resampled segments, for what so few references have not shown yet.
        unseen: f64 = 1.2, "1", "guess";
        /// Factors of the threshold with one reference, two, and more, which have not seen every kind of driving.
        few: [f64; 3] = [3.0, 1.8, 1.25], "1",
            "fault-free development drives: without it 95 % stay below 1.54 times the threshold beside two references (72 \
             drives), 1.24 beside three (36); 1.6 beside two lets 5 of 72 others through; the first is a guess";
        /// Seed of the pseudo-runs: the same recordings give the same answer.
        seed: u64 = 7, "1", "arbitrary";
        /// Least root mean square that Student's t is divided by.
        least_root: f64 = 1e-3, "1", "numerical guard";
    }

    /// When the mismatch of a signal begins and ends.
    spans: Spans {
        /// Windows that are averaged, for runs of usual length.
        windows: usize = 5, "1", "guess";
        /// Bins of a series at most: longer runs get wider ones.
        most_bins: usize = 72, "1", "guess";
    }

    /// The identifier's residual torque in the band of the references.
    bands: Bands {
        /// Windows that are averaged, for runs of usual length.
        windows: usize = 5, "1", "guess";
        /// Bins of a series at most: longer runs get wider ones.
        most_bins: usize = 72, "1", "guess";
        /// Usual scatter of a fault-free run's mean, in fault-free standard deviations.
        between: f64 = 0.4, "1", "guess";
        /// Least scatter within a run, in fault-free standard deviations.
        least_within: f64 = 0.5, "1", "guess";
        /// Least fault-free standard deviation.
        least_sigma: f64 = 0.02, "N m", "guess";
        /// Fewest bins of the references that tell a band.
        least_bins: f64 = 4.0, "1", "guess";
        /// Bins at the overall variance that the kernel mean begins with.
        pseudo_bins: f64 = 2.0, "1", "guess";
        /// Time in which the identifier's weights grow from zero: left out.
        settled: f64 = 1.0, "s", "guess";
    }

    /// The identifier over recorded wheel speeds.
    identifier: Identifying {
        /// Rows to each side over which a wheel speed is the slope of the angle.
        half: usize = 4, "1", "guess";
        /// Integration step of the body that the wheels carry along.
        step: f64 = 5e-4, "s", "guess";
        /// Seed of the first layers.
        seed: u64 = 1, "1", "that of `lacuna identify`";
        /// Least fastest wheel speed that scales the inputs.
        least_speed: f64 = 1.0, "rad/s", "guess";
        /// Least largest torque that scales the inputs.
        least_torque: f64 = 1e-3, "N m", "numerical guard";
    }

    /// On which side the mismatch sits.
    sides: Sides {
        /// A side holds the mismatch when its excess is this many times the other's.
        clear: f64 = 2.0, "1", "guess";
    }

    /// What the best answer leaves.
    remainder: Remaining {
        /// Limits of the size of the yaw rate that split the driving in two.
        turning: [f64; 3] = [0.1, 0.3, 0.6], "rad/s", "guess";
        /// Limits of the size of the forward velocity that split the driving in two.
        speed: [f64; 3] = [0.1, 0.3, 0.6], "m/s", "guess";
        /// A kind of driving is reported when it holds this much of what is left.
        most: f64 = 0.6, "1", "guess";
        /// A kind of driving is reported when it holds this much more than its share of the time.
        beyond_time: f64 = 0.15, "1", "guess";
        /// Probability below which a remainder stands out from fault-free driving, for all signals together.
        stands_out: f64 = 0.05, "1", "guess";
        /// Sides within this ratio are alike.
        alike: f64 = 0.6, "1", "guess";
    }

    /// A network for what is left.
    network: Network {
        /// Share of the mismatch beyond which what is left is given to a network.
        left: f64 = 0.2, "1", "guess";
        /// Sigmoid units.
        units: usize = 12, "1", "guess";
        /// First-layer weights lie between minus and plus this.
        range: f64 = 2.0, "1", "guess";
        /// Seed of the first layer.
        seed: u64 = 1, "1", "arbitrary";
        /// Least scale of each input.
        least_scale: [f64; INPUTS] = [1.0, 1.0, 0.2, 0.5, 0.5], "rad/s, rad/s, rad/s, N m, N m", "guess";
        /// Ridge penalties that are tried, per window.
        ridges: [f64; 4] = [1e-3, 1e-2, 0.1, 1.0], "1", "guess";
        /// Ridge penalty of a lone recording, per window.
        lone_ridge: f64 = 0.1, "1", "guess";
        /// Rounds of relaxation.
        rounds: usize = 3, "1", "guess";
        /// A network is reported when it lowers the wheel-speed error by this share.
        lowers: f64 = 0.03, "1", "guess";
        /// A network is reported when it does not raise the yaw-rate error by more than this share.
        raises: f64 = 0.02, "1", "guess";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
