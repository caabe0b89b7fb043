//! The tuned numbers of this crate.

::settings::settings! {
    /// Tuned numbers of the diagnosis of command-driven robots.
    pub(crate) struct Settings;

    /// Recordings on one grid, cut where a channel is silent.
    recording: Recording {
        /// Grid on which commands, wheels and pose are compared.
        step: f64 = 0.05, "s",
            "drives answer within tenths of a second, and the open data sets of this kind are sampled so";
        /// A channel that is silent for longer cuts the recording.
        gap: f64 = 1.0, "s", "guess";
        /// Stamps are rounded: a sample this much later than a row still counts as of that row.
        stamp: f64 = 1e-3, "s", "guess";
        /// A wheel speed that repeats for as long stands still; what repeats for less is sample-held.
        standstill: f64 = 1.0, "s", "guess";
        /// Wheel speeds that repeat for longer are worth telling.
        telling_hold: f64 = 0.04, "s", "guess";
    }

    /// Sizes of interest of what is hidden in rehearsals.
    rehearsed: Rehearsed {
        /// Gains of forward speed and turning.
        gain: f64 = 0.1, "share", "guess; a drive that misses its set speed by less is within usual tuning";
        /// Dead times and lags.
        delay: f64 = 0.1, "s", "guess; at 0.5 m/s a robot goes 5 cm meanwhile";
        /// Effective track.
        track: f64 = 0.1, "share", "guess; floors change it by more";
        /// Rolling radius.
        radius: f64 = 0.03, "share", "guess; 30 cm in 10 m";
        /// Forward speed lost at 1 rad/s.
        lost: f64 = 0.1, "share", "guess";
        /// Centre of rotation from the pose sensor.
        offset: f64 = 0.05, "m", "guess; a hand's breadth";
        /// Difference of a side's radius from the mean.
        side_radius: f64 = 0.01, "share", "guess; it bends a straight line of 10 m by a metre";
    }

    /// Windows that are forecast, and folds in which they are left out.
    windows: Windows {
        /// Rows of a window, which is 2 s; the row that would close it opens the next one.
        rows: usize = 40, "1", "guess";
        /// Folds in which windows are left out of a fit.
        folds: usize = 5, "1", "guess";
        /// Command steps in each fold, fewer than which nothing can be left out.
        steps_per_fold: usize = 2, "1", "guess";
    }

    /// The controller and the lag of the wheels, run forward.
    integration: Integration {
        /// Integration steps per row.
        substeps: usize = 2, "1", "guess";
        /// Squarings of the matrix exponential of a second-order lag.
        squarings: i32 = 12, "1", "the largest frequency and damping give a norm below 0.03 after as many halvings";
    }

    /// Residuals of a fit.
    residuals: Residual {
        /// Errors of a wheel beyond this share of the rms wheel speed count linearly only.
        wheel: f64 = 0.2, "1", "chosen after a look at the open data";
        /// Errors of the pose beyond this count linearly only.
        pose: f64 = 0.1, "m; rad", "guess; lidar poses jump";
    }

    /// Where the fit of wheel speeds to commands starts.
    drive_starts: DriveStarts {
        /// Dead times from each of which a fit begins, for the cost has several valleys.
        dead_times: [f64; 3] = [0.05, 0.15, 0.3], "s", "guess";
        /// Dead time.
        dead_time: f64 = 0.15, "s", "guess; a usual one";
        /// Time constant of a lag of first order.
        lag: f64 = 0.15, "s", "guess; a usual one";
        /// Natural frequency of a lag of second order.
        frequency: f64 = 10.0, "rad/s", "guess; a usual one";
        /// Damping of a lag of second order.
        damping: f64 = 0.9, "1", "guess; a usual one";
        /// Quantile of the measured turning at which its limit starts.
        turn_limit: f64 = 0.95, "1", "guess";
        /// Quantile of the measured forward speed at which its limit starts.
        forward_limit: f64 = 0.98, "1", "guess";
        /// Quantile of the faster wheel's measured speed at which the limit of a wheel starts.
        wheel_limit: f64 = 0.97, "1", "guess";
        /// Quantile of the measured change of forward speed at which its ramp, and that of a side, starts.
        forward_ramp: f64 = 0.98, "1", "guess";
        /// Quantile of the measured change of turning at which its ramp starts.
        turn_ramp: f64 = 0.98, "1", "guess";
        /// Rows over which a change is measured.
        change_rows: usize = 5, "1", "guess; longer than a sample-hold";
        /// Least limit or ramp at which a fit starts.
        least: f64 = 0.1, "rad/s; rad/s²", "guess";
    }

    /// Where the fit of the body's motion to wheel speeds starts.
    ground_starts: GroundStarts {
        /// Factors of the track from each of which a fit begins, for the cost has several valleys.
        tracks: [f64; 2] = [1.0, 2.0], "1", "guess";
        /// Factor of the track.
        track: f64 = 1.5, "1", "guess; skid-steer robots turn less than their track says";
        /// Forward speed lost in turns.
        turn_slip: f64 = 0.1, "s²/rad²", "guess";
        /// Lag of the body.
        body_lag: f64 = 0.1, "s", "guess";
    }

    /// The fit of constants.
    fit: Fit {
        /// Iterations of a fit at most.
        iterations: usize = 25, "1", "guess";
        /// Iterations at most of a fit that starts beside its optimum: without a fold.
        iterations_beside: usize = 10, "1", "guess";
        /// A fit has converged when its cost falls by less than this share.
        converged: f64 = 1e-6, "1", "guess";
        /// Damping of the first step, share of each diagonal.
        first_damping: f64 = 1e-2, "1", "guess";
        /// Longest step, share of a constant (of its scale where that is more).
        longest: f64 = 0.7, "1", "guess";
        /// Points on each side at which the cost of a constant is looked up that rows may not tell.
        profile: usize = 10, "1", "guess; 5 ms of a dead time";
        /// Step of finite differences, share of a constant (of its scale where that is more).
        difference: f64 = 1e-3, "1", "guess";
    }

    /// Which elements earn their place.
    evidence: Weighing {
        /// Log odds against an element before anything was seen, one in twenty: an element stays when z²/2 exceeds it.
        prior: f64 = 3.0, "nats", "guess";
        /// What raises the left-out loss by less than this share is not worth a constant.
        relevant: f64 = 0.005, "1", "guess";
    }

    /// What differs between references and recordings.
    common: Common {
        /// Share by which one response for both may forecast them worse than fits of their own, both together.
        rise: f64 = 0.5, "1", "a look at 29 sound robots of another hand, whose motors saturate: up to 0.37";
        /// The same of one of them where that is clear.
        clear_rise: f64 = 0.1, "1", "guess";
        /// Log odds from which on it is clear.
        clear: f64 = 3.0, "nats", "guess: as much again as against an element";
    }

    /// Intervals of fitted constants, and which causes are listed.
    answer: Answer {
        /// Factor by which sandwich intervals are widened: every window starts from a noisy measurement,
        /// which a short lag forgets sooner.
        wider: f64 = 1.5, "1",
            "of 100 made-up robots, 90 % intervals then held the truth in 90 to 99, a lag's in 81";
        /// Error of gains, limits, ramps and times of the drive where the law leaves more than noise, one sigma.
        law_error: f64 = 0.003, "share",
            "a look at 15 sizes of another hand and 39 drawn ones: errors of 0.1 to 0.6 % where half widths were 0.1 %";
        /// What a cause costs more than an error of the robot file.
        cause: f64 = 3.0, "nats", "guess: one in twenty, as for an element";
        /// Radius and track change by about so much where tyres or ground are others, one sigma.
        change: f64 = 0.3, "1", "guess: tyres by a tenth, effective tracks by a half";
        /// The centre of rotation moves from drive to drive by this share of the track, one sigma.
        centre: f64 = 0.05, "1", "guess; of robots of another hand that skid it seemed to move by up to 0.1 m";
        /// Radius and track move between references and recordings by this share of the robot file's sigma.
        between_visits: f64 = 0.6, "1", "equal to that of torque-driven robots";
        /// A dead time or lag below this is no finding.
        least_delay: f64 = 0.04, "s",
            "rows of 0.05 s tell no better when a wheel changed; chosen after a look at 120 drawn cases";
        /// Time after a step of the command over which two answers are compared.
        answered: f64 = 3.0, "s", "guess; ten times a long lag";
        /// Wheels have settled that change by less than this share of the unit of residuals in `settles`.
        settled: f64 = 0.05, "1", "guess; 1 % of the usual wheel speed";
        /// Time over which they do.
        settles: f64 = 0.5, "s", "guess; what changes slowest in a usual drive is over";
        /// Share of the rows in which wheels have settled, from which on gains and limits are those that these rows show, too.
        least_settled: f64 = 0.1, "1", "guess";
        /// A lag of the other order leaves open how long the dead time is where its left-out loss is at most so many times as large.
        near: f64 = 2.0, "1", "guess; three robots of another hand with a control loop that overshoots had 1.2 to 1.5";
        /// The same where the law leaves more than so many times the noise.
        inexact: f64 = 2.0, "1", "guess";
        /// Error of forecasts of what was left out over that with re-tuned constants, from which on it confirms no cause.
        confirmed: f64 = 0.95, "1",
            "guess: 5 % are as little as nothing; of 40 robots of another hand true causes left 0.04 to 0.74, and false ones 0.89 and more";
        /// Root of the fall of the mean square of wheel speeds, over their root mean square, from which on it confirms a cause of the drive.
        closed: f64 = 0.0125, "1", "guess; of 75 robots of another hand causes that are there closed 0.018 and more, others up to 0.009";
        /// Error of the forecast heading over that before, from which on a cause of the drive that forecasts wheel speeds better is
        /// doubted all the same.
        contradicted: f64 = 1.5, "1", "guess; of 75 robots of another hand causes that are there had 1.1 and less, invented laws 1.9 to 6";
        /// Probability of a dead time that a lag of the other order, which is as good, does not need.
        needless: f64 = 0.5, "1", "one of two laws that fit alike";
        /// Share that probabilities keep then.
        unconfirmed: f64 = 0.3, "1", "guess";
        /// Causes below this probability are not listed.
        listed: f64 = 0.1, "1", "above the 0.05 that what left-out windows say nothing about keeps of its prior";
        /// Beyond this probability the way from command to ground orders causes.
        sure: f64 = 0.999, "1", "guess";
    }

    /// The best wrong cause.
    placebo: Placebo {
        /// Up to this many constants a placebo takes nothing that was named.
        few: usize = 4, "1", "guess";
        /// Bounds of the coefficients of odd powers of a side's own command, which is in units of the largest command.
        power_bounds: [f64; 2] = [-50.0, 50.0], "1", "guess";
        /// Scale of these coefficients.
        power_scale: f64 = 0.3, "1", "guess";
    }

    /// A response that is another one from an instant on.
    onset: Onset {
        /// Shares of each recording at which the search for the instant begins.
        starts: [f64; 3] = [0.3, 0.5, 0.7], "1", "guess";
        /// Rounds of fitting both responses and moving the instants, at most.
        rounds: usize = 4, "1", "guess";
        /// Command steps before and after, fewer than which tell no response.
        steps: usize = 5, "1", "guess; as many as folds";
        /// Least rise of the left-out loss without the onset, relative: what changes little was there all the time.
        relevant: f64 = 0.1, "1", "guess; a robot's response is never quite the same all day";
        /// Log odds against an onset before anything was seen.
        prior: f64 = 6.0, "nats", "guess; twice that against an element, since its instants are searched";
        /// Sigmas by which a constant must differ to have changed.
        changed: f64 = 3.0, "1", "guess";
    }

    /// What the best answer leaves, and when that has no known cause.
    left: Remaining {
        /// Rows apart of which second differences tell the noise of a signal.
        apart: usize = 2, "1", "guess; longer than the sample-hold of the open recordings";
        /// Slope of the logistics of the logarithms of what is left over its floor, and over what matters.
        slope: f64 = 10.0, "1", "that of torque-driven robots";
        /// Centre of that over the floor: what is left has three times the energy of noise.
        centre: f64 = 1.1, "1", "guess; half as much again as the start of a window with a slow lag may add";
        /// An error of this share of the motion matters, rms.
        interest: f64 = 0.05, "1", "guess";
        /// Slope of the logistic of the share of the mismatch that is left.
        left_slope: f64 = 12.0, "1", "that of torque-driven robots";
        /// Centre of that logistic.
        left_centre: f64 = 0.5, "1", "that of torque-driven robots";
        /// Centre of that logistic where a wrong cause, or re-tuned constants, forecast left-out windows as well.
        objected_centre: f64 = 0.25, "1", "guess; half of the other";
        /// Beyond this probability a cause is said to be unknown.
        likely: f64 = 0.5, "1", "formula: likelier than not";
        /// Share of one side's error beyond which that of the other is the same finding.
        alike: f64 = 0.5, "1", "guess; that of torque-driven robots";
        /// A window stands out with so many times the mean square of its floor.
        stands_out: f64 = 4.0, "1", "guess; twice the rms of noise";
        /// Stretches that are told at most.
        spans: usize = 8, "1", "guess";
        /// An error of this share of the motion, rms, is large.
        large: f64 = 0.5, "1", "guess";
        /// For so long it is no jump.
        lasting: f64 = 4.0, "s", "guess: two windows";
    }

    /// Responses among which the next drive is to decide.
    rivals: Rivals {
        /// Odds against the response that was found, below which a rival is none.
        least: f64 = 0.1, "1", "above the 0.05 that an element keeps of its prior where the recordings say nothing of it";
        /// Rivals at most.
        most: usize = 8, "1", "guess";
        /// Least variance of residuals, in squares of their unit: what is below is rounding.
        least_variance: f64 = 1e-6, "1", "guess";
    }

    /// Drives among which to advise.
    menu: Menu {
        /// Quantile of what was commanded that a drive asks at most.
        reached: f64 = 0.98, "1", "guess";
        /// A robot has never driven straight, or turned, that reached less than this share of what its wheels could.
        never: f64 = 0.05, "1", "guess";
        /// Share of what its wheels could that it is then asked.
        slow: f64 = 0.3, "1", "guess";
        /// Slow, medium and fast, shares of what was reached.
        levels: [f64; 3] = [0.3, 0.6, 1.0], "1", "guess";
        /// Times that steps are made there and back.
        times: usize = 2, "1", "guess";
        /// Yaw rate of circles, share of what was reached.
        circle: f64 = 0.6, "1", "guess";
        /// Times that the direction is reversed there and back.
        reversals: usize = 5, "1", "guess";
        /// Speed and yaw rate of weaving, share of what was reached.
        weaving: f64 = 0.6, "1", "guess";
        /// Period of weaving.
        period: f64 = 5.0, "s", "guess";
        /// Time between the points of a curve.
        drawn: f64 = 0.2, "s", "guess";
    }

    /// Usual sizes of an error, in units of which traces show how far forecasts are off.
    traces: Usual {
        /// Of a wheel's speed.
        wheel: f64 = 0.3, "rad/s", "guess";
        /// Of a pose.
        pose: f64 = 0.1, "m; rad", "guess";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
