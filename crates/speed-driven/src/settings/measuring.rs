//! Rows, clocks, loads of steady driving and their comparison with the references'.

use super::changes::degrees;

::settings::settings! {
    /// What a recording is measured with.
    pub(crate) struct Settings;

    /// Rows of a recording: speeds, torques, turning rates.
    rows: Rows {
        /// Shortest recording that is taken, rows.
        least: usize = 20, "1", "rows of three seconds of steady driving";
        /// Share of the rows of the slowest channel whose stamps all channels have, below which these are joined in time.
        shared: f64 = 0.5, "share", "guess; sensors with stamps of their own share hardly any";
        /// Joined readings may be so many times their usual distance apart.
        join_gap: f64 = 3.5, "1", "guess; a reading or two may be lost";
        /// A yaw rate is averaged over this long: wheel vibration is no turning.
        gyro_mean: f64 = 0.31, "s", "guess";
        /// The first and the last value of a gyro count this much longer.
        gyro_edge: f64 = 0.5, "s", "guess";
        /// Length of the steps over which turning rates of the body are averaged.
        rate_step: f64 = 0.1, "s", "guess";
        /// Standing that shows what a gyro reads at rest, in all.
        rest_least: f64 = 1.5, "s", "guess: fifteen steps";
        /// What a gyro reads at rest is an offset from here on: three sigmas of those that are found beside the slope.
        rest_offset: f64 = 0.0026, "rad/s", "three times `attitude.first_offset`; after a stop the open Husky runs rock by 0.002";
        /// The accelerometer is averaged over this long: wheel vibration puts 1 to 5 m/s² on it.
        level_mean: f64 = 2.0, "s", "field study";
        /// Gravity.
        gravity: f64 = 9.81, "m/s²", "standard";
        /// An accelerometer whose upward axis reads gravity within this share stands upright.
        upright: f64 = 0.2, "1", "guess";
        /// Stamps that leave more than this many steps for each sample come from a clock that was set: no rates then.
        sparse: usize = 50, "1", "guess";
        /// Waiting time until a measured speed is steady, as a share of that of a set-point: set-points run ahead.
        measured_patience: f64 = 0.3, "1", "guess";
        /// Measured speeds that scatter by more than this from row to row are averaged.
        speed_noise: f64 = 0.005, "m/s", "guess: a quarter of what a steady speed may differ by";
        /// They are averaged over this long at most.
        speed_mean: f64 = 1.0, "s", "guess: shorter than a steady stretch";
        /// A command that is older is no longer obeyed: drives stop when commands stop.
        command_age: f64 = 1.0, "s", "guess: twice the usual timeout of drive controllers";
        /// Readings up to this much above a dead band count as in it: dead bands are given to two decimals.
        dead_band_slack: f64 = 0.01, "A", "last digit of recorded dead bands";
    }

    /// Signs of torques that no robot can have.
    power: Power {
        /// Speed of a side from which it turns.
        turning: f64 = 0.05, "m/s", "guess: as where the robot drives";
        /// Speeds have been constant for this long: what accelerates may brake.
        held: f64 = 0.5, "s", "guess";
        /// Turning on the spot below which nothing is concluded.
        least: f64 = 2.0, "s", "guess: each way";
        /// Share of the usual torque from which a side does something.
        acts: f64 = 0.5, "1", "guess";
        /// Share of the rows in which a side brakes from which its sign is wrong.
        share: f64 = 0.8, "1", "guess: sides that push brake in no row but for noise";
        /// Pushing backward with torques that are never negative, from which on they are magnitudes.
        backward: f64 = 5.0, "s", "guess: of each side";
    }

    /// How the inertial unit leans in the body.
    mounting: Mounting {
        /// Length of the stretches whose turning is compared with what the other axes show.
        stretch: f64 = 20.0, "s", "guess: longer than a turn";
        /// Standard deviation of the turning rate from which on a stretch says something.
        turning: f64 = 0.1, "rad/s", "guess: above the noise of small gyros";
        /// Stretches that are needed.
        least: usize = 5, "1", "guess: fewer show no scatter";
        /// Sigmas of its error from which on a lean is taken out.
        clear: f64 = 3.0, "1", "guess";
        /// Lean of a unit that was turned upright, one sigma at least.
        known: f64 = degrees(0.1), "rad", "guess: errors of leans by turns";
        /// Lean of a unit that no turn has told, one sigma.
        unknown: f64 = degrees(3.0), "rad", "guess: mounted by eye";
        /// Lean from which on it is told.
        told: f64 = 1.0, "°", "guess: units are seldom mounted better";
    }

    /// Alignment of the gyro's clock with the speeds' by the turns.
    aligning: Aligning {
        /// Time between nodes of the warp.
        node: f64 = 2.0, "s", "guess";
        /// Largest lag that is tried, either way.
        most_lag: f64 = 2.0, "s", "guess";
        /// Step of the grid of lags.
        lag_step: f64 = 0.05, "s", "guess";
        /// Window of a local correlation.
        window: f64 = 8.0, "s", "guess";
        /// Fewest rows that correlate.
        least_rows: usize = 12, "1", "guess";
        /// Least spread of the speed difference in a window: below it there is no turning to align.
        least_turning: f64 = 0.008, "m/s", "guess";
        /// Correlations count as no higher than this: the evidence of a perfect one would be infinite.
        most_correlation: f64 = 0.99, "1", "guess";
        /// Correlations count as if this many windows' worth of samples were independent, per second of window and
        /// node.
        evidence: f64 = 4.0, "1", "guess";
        /// The clocks wander by about this much between nodes.
        wander: f64 = 0.15, "s", "guess";
        /// Weight of the anchors, per second of lag: both files begin together and end together.
        anchor: f64 = 13.3, "1/s", "guess";
        /// Difference of the speeds above which the robot turns.
        turn: f64 = 0.04, "m/s", "guess";
        /// Length of a turn that can be left out, at least.
        turn_seconds: f64 = 0.8, "s", "guess";
        /// Pauses shorter than this do not end a turn.
        turn_pause: f64 = 1.0, "s", "guess";
        /// What is taken before and after a turn.
        turn_margin: f64 = 2.0, "s", "guess";
        /// A turn tells its own lag where both signals correlate this well.
        own_correlation: f64 = 0.9, "1", "guess";
        /// A turn tells its own lag where the speed difference spreads by this share of what counts as turning.
        own_spread: f64 = 0.5, "1", "guess";
        /// Turns left out from which an error of the alignment is reported, at least.
        least_left_out: usize = 3, "1", "guess";
    }

    /// What counts as straight driving.
    straight: Straight {
        /// Least speed: below it a braking side starts to read without sign.
        least_speed: f64 = 0.12, "m/s", "chosen after a look at the open Husky runs";
        /// Largest difference of the sides.
        difference: f64 = 3.5 / 127.0, "m/s", "chosen after a look at the open Husky runs";
        /// How constant the speeds must have been.
        steady: f64 = 2.5 / 127.0, "m/s", "chosen after a look at the open Husky runs";
        /// For how long the drive must have been straight for a single reading: by then a change of speed has passed.
        hold: f64 = 1.0, "s", "chosen after a look at the open Husky runs";
        /// For how long the drive must have been straight for a mean over a stretch: loads wind up after a turn.
        hold_of_means: f64 = 1.5, "s", "chosen after a look at the open Husky runs";
    }

    /// What current sensors read when the robot stands.
    zero: Zero {
        /// Speed of a side below which it stands.
        still: f64 = 0.01, "m/s", "guess: noise of measured wheel speeds";
        /// For how long it must have stood: by then what was commanded has decayed.
        settled: f64 = 1.0, "s", "guess";
        /// Rows of one stretch are at most this far apart.
        gap: f64 = 0.5, "s", "guess";
        /// How long a stretch must be.
        least: f64 = 0.5, "s", "guess";
        /// Stretches agree within this share of what the larger side reads.
        agree: f64 = 0.25, "1", "guess: a drive that holds the robot winds up anew each time";
        /// What is read at rest is an offset from this share of the median of all readings on.
        matters: f64 = 0.02, "1", "guess: less changes no load by as much as it varies";
        /// Half of what one way of driving takes more than the other over an offset that makes it, from and until.
        seen: [f64; 2] = [0.5, 1.5], "1", "guess";
    }

    /// What a gyro reads while the robot stands.
    gyro_zero: GyroZero {
        /// From this on it is taken off, and told.
        matters: f64 = 0.01, "rad/s", "guess: at 0.5 m/s an arc of 50 m; a robot may still sway a little where it came to rest";
        /// Standard errors of it that it has to exceed.
        clear: f64 = 4.0, "1", "guess";
        /// For how long a robot must have stood in all.
        least: f64 = 2.0, "s", "guess";
        /// Stretches agree within this share of it, or of what matters.
        agree: f64 = 0.3, "1", "guess";
    }

    /// A slow speed controller that lets go after a turn, seen by currents without sign.
    unwinding: Unwinding {
        /// For how long it may last after the drive became straight.
        longest: f64 = 12.0, "s", "guess: speed controllers of mobile robots settle within seconds";
        /// The side that brakes reads at most this share of the other.
        sides: f64 = 0.8, "1", "guess";
        /// The sum of both sides falls by this share of their difference at least.
        fall: f64 = 0.3, "1", "guess";
        /// Their difference changes by this share of that fall at most.
        steady: f64 = 0.34, "1", "guess";
    }

    /// What counts as steady turning.
    turns: Turns {
        /// Least difference of the sides.
        difference: f64 = 4.5 / 127.0, "m/s", "chosen after a look at the open Husky runs";
        /// How constant the speeds must have been.
        steady: f64 = 3.5 / 127.0, "m/s", "chosen after a look at the open Husky runs";
        /// For how long the speeds must have been constant.
        hold: f64 = 1.0, "s", "chosen after a look at the open Husky runs";
        /// For how long a turn must go on for its yaw rate to count.
        ahead: f64 = 0.5, "s", "chosen after a look at the open Husky runs";
        /// Difference over sum of the speeds above which scrub is fully developed.
        plateau: f64 = 0.15, "1", "chosen after a look at the open Husky runs";
    }

    /// Means over steady stretches and their errors.
    stretches: Stretches {
        /// Least steady driving for an answer.
        least_seconds: f64 = 3.0, "s", "chosen after a look at the open Husky runs";
        /// Samples further apart belong to different stretches.
        gap: f64 = 1.0, "s", "guess";
        /// A stretch counts as one piece per so many seconds.
        piece: f64 = 5.0, "s", "guess";
        /// Scatter of such a piece on one floor, relative: guards recordings of few pieces.
        piece_scatter: f64 = 0.06, "1", "guess";
        /// Effective number of pieces from which their scatter tells an error.
        least_pieces: f64 = 1.5, "1", "guess";
        /// Limits of the speed classes of straight driving: different speeds are never mixed.
        classes: [f64; 4] = [0.12, 0.30, 0.55, 5.0], "m/s", "chosen after a look at the open Husky runs";
    }

    /// Systematic errors of the effective track.
    track: Track {
        /// Offset of the gyro.
        gyro_offset: f64 = 0.002, "rad/s", "guess";
        /// Error of speeds that are set-points and no encoder's, relative.
        set_point_error: f64 = 0.015, "1", "guess";
    }

    /// Drift in straight driving.
    drift: Drift {
        /// A drift differs where it does so by so many sigmas.
        clear: f64 = 3.0, "1", "guess; its side has to be looked for on the robot";
        /// Least speed of straight driving.
        least_speed: f64 = 0.05, "m/s", "guess; below, a gyro's zero is as large as any drift";
    }

    /// What a mapping may have wrong.
    guesses: Guesses {
        /// A value is negative beyond this share of the largest.
        noise: f64 = 0.02, "1", "guess";
        /// For so long at least.
        seconds: f64 = 2.0, "s", "guess";
        /// Speed from which the robot moves.
        moving: f64 = 0.02, "m/s", "guess";
        /// Set speeds are constant in more than the first share of the rows, measured ones in less than the second.
        constant: [f64; 2] = [0.1, 0.9], "1", "guess: no encoder shows the same speed for seconds, no profile changes all the time";
    }

    /// Scatter of loads from run to run that nothing explains, one sigma of the logarithm (of the asymmetry: of itself). Three or
    /// four runs on one floor show 1 % (straight) and 4 to 5 % (turning); wider, because so few under-estimate it, and narrowed
    /// after 96 % of the 90 % intervals of 400 drawn cases held.
    scatter: Scatter {
        /// Straight load.
        straight: f64 = 0.05, "1", "open Husky runs, widened";
        /// By how much the straight load may differ at twice the speed.
        by_speed: f64 = 0.1, "1", "guess; what bearings add";
        /// Turning load, and sums with the straight load.
        turning: f64 = 0.065, "1", "open Husky runs, widened";
        /// Effective track.
        track: f64 = 0.015, "1", "open Husky runs, widened";
        /// Asymmetry of the straight load.
        asymmetry: f64 = 0.15, "1", "drive trains wind up in turns and keep up to a fifth of the load on one side";
        /// The same of spins, in which both sides push alike.
        spin_asymmetry: f64 = 0.05, "1", "guess: half of what the loads of turns scatter by";
        /// Drift in straight driving.
        drift: f64 = 0.005, "1", "guess; tyres and how they are loaded: half a per cent of the radius";
    }

    /// Loads over those of the references.
    ratios: Ratios {
        /// Steady driving that makes an answer firm.
        firm: f64 = 10.0, "s", "chosen after a look at the open Husky runs";
        /// Recordings whose loads spread by more than this many times the usual scatter are not one load.
        most_spread: f64 = 2.0, "1", "guess";
    }
}
