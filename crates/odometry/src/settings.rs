//! The tuned numbers of this crate.

::settings::settings! {
    /// Tuned numbers of the comparison of wheel motion with a measured pose.
    pub(crate) struct Settings;

    /// Drives that would tell the remaining answers apart.
    next_drive: NextDrive {
        /// Distance of their rows.
        period: f64 = 0.05, "s", "guess; usual rows of counts";
    }

    /// Wheels and what they determine.
    wheels: Wheels {
        /// Wheels at most.
        most: usize = 8, "1", "no robot of the open data has more";
        /// Smallest singular value over the largest, below which the wheels do not determine the motion.
        least_rank: f64 = 1e-4, "1", "guess; rounding of places to millimetres gives more";
        /// Roller angle from which a robot has no along and across, only a distance from centre to wheel.
        omni: f64 = 1.2, "rad", "between 45 degrees of a mecanum wheel and 90 degrees of an omni wheel";
        /// Steering angles at which the rank is looked at beside straight ahead.
        steering: [f64; 3] = [-0.6, 0.3, 0.9], "rad", "guess; any but right angles";
    }

    /// Poses that jump.
    pose_jumps: PoseJumps {
        /// Quantile of speeds from row to row that counts as the fastest.
        quantile: f64 = 0.99, "1", "guess; a pose that jumps more often is one of such rows";
        /// So many times as fast is no motion.
        times: f64 = 5.0, "1", "equal to that of counters and poses that begin anew";
        /// Jumps below these are left to the noise of windows: of the place, and of yaw.
        least: [f64; 2] = [0.05, 0.1], "m, rad", "guess; several times the noise of usual trackers";
        /// Rows in which a pose that comes back is taken as not seen.
        lone: usize = 3, "1", "guess; longer ones are continued";
        /// Share of a jump by which a pose may be elsewhere than the robot moved, for it to be the way back of the rows before.
        back: f64 = 0.5, "1", "guess; half of it is the way back, or none";
        /// Jumps of a pose of which more are how it is, each second.
        most: f64 = 0.2, "1/s", "guess; a map that is matched anew each second moves as often";
        /// Steps before a jump that say how the robot moved.
        before: usize = 5, "1", "guess; a tenth of a second of usual trackers";
    }

    /// Drives that can be compared.
    drive: DriveRules {
        /// Rows below which a drive is refused.
        rows: usize = 40, "1", "guess; two seconds at 20 Hz";
        /// Time between two rows beyond which a drive is refused: times in milliseconds look like that.
        apart: f64 = 0.9, "s", "a thousand rows per second with times in milliseconds are 1 apart";
        /// Way below which nothing is compared.
        way: f64 = 0.1, "m", "guess; a hundred times the noise of a good pose";
        /// Share of a counter's range by which it jumps where it wraps around.
        wrap: f64 = 0.5, "1", "a wheel cannot turn by half the range of its counter between two rows";
        /// Quantile of the steps of a counter, or of a pose, that counts as its fastest.
        usual_step: f64 = 0.99, "1", "guess; a counter begins anew in few rows";
        /// So many of these steps are no motion: a counter that jumps by more, and to less than that, has begun anew, and a pose that is farther from
        /// the origin does not pass it.
        reset: f64 = 5.0, "1", "guess";
        /// Ranges of counters that are known: 8, 16 and 32 bits.
        ranges: [f64; 3] = [256.0, 65_536.0, 4_294_967_296.0], "1", "widths of integers";
        /// Time without a pose from which on turns between are those of the wheels.
        unseen: f64 = 0.25, "s", "guess; no robot turns by half a turn in less";
        /// Stretches over which the turning of wheels and pose is compared.
        turning: f64 = 1.0, "s", "guess; single counts do not matter then";
        /// Share of the turning that both must have in common (squared correlation).
        agree: f64 = 0.9, "share", "guess; a wheel that is dead or reversed leaves none";
        /// Rates are those of this stretch about a row: single counts are too coarse.
        rate: f64 = 0.25, "s", "guess; longer than the period of usual encoders' logs";
        /// Poses farther apart than this get rows of the wheels between them, so that a bend between two poses is seen.
        dense: f64 = 0.07, "s", "guess; a robot turns by a tenth of a radian meanwhile, whose chord is its arc to a part in \
            two thousand";
        /// Way of the pose over that of the counts, beyond which the unit is doubted.
        unit: f64 = 30.0, "1", "guess; no radius is wrong by as much";
        /// Factor of millimetres to metres.
        milli: f64 = 1000.0, "1", "SI";
        /// A factor of units is told when the pose's way is within this factor of it.
        unit_tolerance: f64 = 3.0, "1", "guess";
        /// Stretches over which motions of wheels and pose are added up to tell units.
        stretch: f64 = 1.0, "s", "guess; noise of a pose is little beside a second's motion";
        /// Turning of the wheels' motion below which the unit of yaw is not guessed.
        turned: f64 = 0.5, "rad", "guess; a turn into a side road";
        /// Columns are taken to be in degrees when they are within this factor of 57.3 times what they should be.
        degrees_tolerance: f64 = 2.0, "1", "guess; no radius, track or gear is wrong by as much";
        /// Columns are taken to be in turns when they are within this factor of what turns would be.
        turns_tolerance: f64 = 1.15, "1", "guess; gears of 5 and 8 are not taken for 2 pi";
    }

    /// A heading by a gyro, where no pose was measured.
    heading: Heading {
        /// Rate of every wheel below which the robot stands.
        still: f64 = 0.01, "rad/s", "guess; a wheel of 5 cm creeps by half a millimetre per second";
        /// Time at rest from which the bias is measured.
        least: f64 = 1.0, "s", "guess; noise of 0.005 rad/s at 50 Hz leaves a bias of 0.0007 rad/s";
        /// Least error of a window, as a share of the usual turning in one: a gyro's scale is no better known from turn to turn,
        /// nor where a tyre touches the ground.
        error: f64 = 0.01, "1", "data sheets of usual MEMS gyros, with their non-linearity; real wheels and a real gyro of one \
            robot disagree by 1 to 2 per cent once constants are set";
        /// Turning of a wheel in a window from which it is in motion.
        rolled: f64 = 0.4, "rad", "equal to 0.02 m of a wheel of 5 cm: windows in motion by a pose";
    }

    /// Causes that evidence names and that explain little.
    doubt: Doubt {
        /// Error with causes that grow with rate, speed or acceleration, over that without them, beyond which they are not named: such laws
        /// stand for each other and a little for everything.
        leaves: f64 = 0.8, "1", "guess; a fifth";
        /// Root mean square that they have to take off the errors of windows, as a share of the motion: less is there and matters to nobody.
        least: f64 = 0.003, "share", "guess; 3 mm of a metre; after a look at seven robots of another hand, of which a real slip that takes less was told beside larger causes";
        /// Probability at which such a cause is then listed at most.
        listed: f64 = 0.3, "1", "guess";
        /// Standard errors of the mean over sessions by which left-out sessions have to be forecast better with such a cause than without.
        errors: f64 = 1.5, "1", "93 of 100 normal errors do not reach it; after a look at a real robot with three omni wheels, whose slip in curves is 1.7 of them, and \
            whose left-out drives are forecast 1.15 times better with it; of 48 drawn robots no answer changes between 1.5 and 2";
        /// Error of forecasts of left-out sessions with the named causes over that of the robot as stated, from which on they are refuted
        /// where they leave most of the error.
        refuted: f64 = 1.25, "1", "equal to that of cars and robots under torque";
        /// The same error, from which on they confirm nothing, however much they leave.
        confirmed: f64 = 0.95, "1", "equal to that of robots of any wheels; of 30 named answers about robots of another hand true ones left 0.00 to 0.46, one of four false ones 1.22";
        /// The same over that of re-tuned constants.
        worse: f64 = 1.1, "1", "equal to that of robots of any wheels";
        /// Share of the re-tuned error from which on most is left.
        leaves_most: f64 = 0.5, "1", "guess";
    }

    /// Windows over which the pose and the wheels' motion are compared.
    windows: Windows {
        /// Length of a window.
        length: f64 = 4.0, "s", "2 to 15 s forecast left-out sessions of four open robots equally well";
        /// Error of heading that weighs as much as one metre: a heading costs its lever in forecasts.
        lever: f64 = 1.5, "rad/m", "0.8 and 1.5 forecast left-out sessions of four open robots equally well";
        /// Windows farther off than this many sigmas count less.
        outlier: f64 = 8.0, "1", "guess; occlusions and lost counts lie farther out";
        /// Quantile of the errors from which their scale is taken.
        quantile: f64 = 0.95, "1", "guess; the rest may be outliers";
        /// Sigmas within which that share of a normal distribution lies.
        quantile_sigmas: f64 = 1.96, "1", "mathematics: the quantile of the normal distribution";
        /// Least noise of a pose.
        floor: f64 = 2e-4, "m", "guess; good motion capture";
        /// Windows with less way and turning than this do not tell the noise.
        moving: f64 = 0.02, "m; rad", "guess";
        /// Windows below which nothing is fitted.
        least: usize = 4, "1", "guess";
        /// Step of finite differences, shares of a cause's usual size.
        difference: f64 = 1e-3, "1", "guess";
    }

    /// Fits of all constants.
    fitting: Fitting {
        /// Rounds in which scale of errors and scatter of sessions are estimated anew.
        rounds: usize = 4, "1", "guess; two are enough where nothing is an outlier";
        /// Logarithm of the change of the scale below which it is at rest.
        same_scale: f64 = 0.01, "1", "guess; a hundredth";
        /// Remaining error with the named causes, over that with all, beyond which they are fitted anew from there.
        astray: f64 = 1.5, "1", "guess; equations that hold leave as much";
    }

    /// Turning at which slip is half of what it becomes.
    slip: Slip {
        /// Turning rate at which slip in turns has half its size, as long as no drive says otherwise.
        turning: f64 = 0.05, "rad/s", "guess; dry friction does not grow with the rate";
        /// Share by which that rate and the power, as they are told, may be off because slip has another law, one sigma.
        form: f64 = 0.6, "share", "guess; rates over a quarter of a second smear slow turns: 0.032 for 0.015 in a drawn robot";
    }

    /// How well constants are known where the robot file does not say so: one sigma.
    known: Known {
        /// Radius of a wheel, relative.
        radius: f64 = 0.01, "1", "a tape measure on small wheels";
        /// Direction of a wheel with rollers.
        direction: f64 = 0.005, "rad", "guess; a third of a degree of a bracket";
        /// Distances between wheels, relative.
        distance: f64 = 0.02, "1", "a tape measure; the contact is not the middle of a wheel";
        /// Zero of the steering.
        steering: f64 = 0.01, "rad", "guess; half a degree";
        /// Gain of the steering, relative.
        steering_gain: f64 = 0.005, "1", "guess";
        /// Direction of the pose's frame in the robot.
        mounting: f64 = 0.01, "rad", "guess; half a degree by eye";
        /// Place of the pose's origin in the robot.
        origin: f64 = 0.01, "m", "a tape measure";
        /// Share of slip that belongs to every drive.
        slip: f64 = 0.001, "1", "guess";
        /// Slip that grows, per rate, speed or acceleration, that belongs to every drive.
        growing: f64 = 2e-4, "s/rad; s/m; s", "guess; a fifth of the share";
        /// Logarithms of the turning rate and the power of slip in turns: known only as part of such a slip.
        slip_shape: f64 = 1e-3, "1", "guess; without such a slip it changes nothing";
        /// Clock of the counts against that of the pose.
        offset: f64 = 0.02, "s", "guess; a few periods of usual logs";
        /// Rate of the clocks.
        rate: f64 = 1e-4, "1", "quartz, with its temperature";
        /// Scale of a gyro that stands for the pose, relative.
        gyro_scale: f64 = 0.01, "1", "data sheets of usual MEMS gyros: 1 to 3 per cent over temperature";
        /// Its bias, where it was not measured at rest.
        gyro_bias: f64 = 0.01, "rad/s", "data sheets of usual MEMS gyros: 0.3 to 3 degrees per second, mostly calibrated at the start";
    }

    /// Usual sizes of causes: one sigma about none.
    usual: Usual {
        /// Times its usual size beyond which a constant's own distance is taken as usual.
        far: f64 = 2.0, "1", "guess; two sigmas";
        /// Radius, relative.
        radius: f64 = 0.1, "1", "guess";
        /// Direction of a wheel with rollers.
        direction: f64 = 0.05, "rad", "guess; three degrees";
        /// Distances between wheels, relative.
        distance: f64 = 0.2, "1", "guess";
        /// Zero of the steering.
        steering: f64 = 0.1, "rad", "guess";
        /// Gain of the steering, relative.
        steering_gain: f64 = 0.1, "1", "guess";
        /// Direction of the pose's frame.
        mounting: f64 = 0.05, "rad", "guess; three degrees";
        /// Place of the pose's origin.
        origin: f64 = 0.05, "m", "guess";
        /// Share of the way that is lost.
        slip: f64 = 0.05, "1", "guess";
        /// Logarithm of the turning rate at which slip in turns has half its size.
        slip_rate: f64 = 1.0, "1", "guess; a factor of e";
        /// Logarithm of the power with which slip in turns grows in slow turns.
        slip_power: f64 = 0.7, "1", "guess; a factor of two";
        /// Share of turning that is lost, per rad/s.
        turning: f64 = 0.1, "s/rad", "guess";
        /// Share of the way that is lost, per m/s.
        speed: f64 = 0.1, "s/m", "guess";
        /// Slip velocity per sideways acceleration.
        cornering: f64 = 0.1, "s; s/m", "guess";
        /// Offset of the clocks.
        offset: f64 = 0.2, "s", "guess";
        /// Rate of the clocks.
        rate: f64 = 0.02, "1", "sampling by a timer that is a per cent off";
        /// Scale of a gyro, relative.
        gyro_scale: f64 = 0.1, "1", "guess; a range or a mounting that is wrong";
        /// Bias of a gyro.
        gyro_bias: f64 = 0.05, "rad/s", "guess; three degrees per second, never calibrated";
    }

    /// By how much constants differ from session to session although nothing is changed: one sigma, before the sessions
    /// themselves are asked.
    scatter: Scatter {
        /// Direction of the pose's frame.
        mounting: f64 = 1e-3, "rad", "guess; motion capture is set up anew";
        /// Place of the pose's origin.
        origin: f64 = 1e-3, "m", "guess; motion capture is set up anew";
        /// Slip in turns and of rollers.
        slip: f64 = 1e-3, "1", "guess; floors differ";
        /// Slips that grow with a rate, a speed or an acceleration: less, or they would scatter with slip once more.
        growing: f64 = 2e-4, "s/rad; s/m; s", "guess; floors differ";
        /// Logarithms of the turning rate and the power of slip in turns.
        slip_shape: f64 = 1e-3, "1", "guess; less than the slip itself";
        /// Radius, relative.
        radius: f64 = 4e-4, "1", "guess; temperature and wear";
        /// Direction of a wheel with rollers.
        direction: f64 = 2e-4, "rad", "nothing moves but what gives way";
        /// Distances between wheels, relative.
        distance: f64 = 1e-3, "1", "guess; contact points move";
        /// Steering.
        steering: f64 = 1e-3, "rad; 1", "guess";
        /// Offset of the clocks, from drive to drive.
        offset: f64 = 0.02, "s", "guess; started by hand";
        /// Rate of the clocks.
        rate: f64 = 1e-5, "1", "quartz";
        /// Scale of a gyro, relative.
        gyro_scale: f64 = 1e-3, "1", "guess; temperature";
        /// Bias of a gyro.
        gyro_bias: f64 = 2e-3, "rad/s", "guess; a tenth of a degree per second from start to start";
        /// Factors on all of these that are tried.
        factors: [f64; 6] = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0], "1", "guess";
        /// Factors on the scatter of the clocks' offset, and on that of their rate, that are tried: logs that are matched by hand differ in both.
        clocks: [f64; 4] = [1.0, 5.0, 25.0, 125.0], "1", "guess; up to a tenth of a per cent";
        /// Sigma of the logarithms of these two factors.
        clock_width: f64 = 2.0, "1", "guess; by hand or by wire";
        /// Sigma of the logarithm of that factor.
        width: f64 = 1.0, "1", "guess; a factor of e";
    }

    /// When something is left that no cause accounts for.
    unexplained: Unexplained {
        /// Remaining error over the way, beyond which what is left asks for a cause.
        share: f64 = 0.05, "1", "guess; a robot that loses a metre in twenty";
        /// Share of the re-tuned error that has to be left then.
        of_retuned: f64 = 0.8, "1", "guess";
        /// Remaining error over the way, beyond which nothing is explained, however much more was left before.
        most: f64 = 0.3, "1", "guess; wrong columns, signs and units leave half of the motion and more";
        /// The same from which on something unknown is likelier where nothing is called missing and no reference says what is usual.
        doubted: f64 = 0.025, "1", "a look at sound robots of five other hands: up to 0.019";
        /// Sigmas of the pose's noise beyond which what is left is more than noise.
        noise: f64 = 4.0, "1", "guess";
    }

    /// Encoders that lose counts.
    dropout: Dropout {
        /// Sigmas from which a window is looked at.
        outlier: f64 = 6.0, "1", "guess";
        /// Share of such windows' misfit that one wheel has to account for.
        share: f64 = 0.7, "1", "guess";
        /// Share of the counts that has to be lost in a window.
        lost: f64 = 0.1, "1", "guess";
        /// Windows that show it at least.
        windows: usize = 2, "1", "guess";
        /// Least half width of the 90 % interval of that share.
        least_width: f64 = 0.01, "1", "guess; where a span begins and ends is known to a row";
        /// Share of a drive's windows that show it at most: what shows in all is no dropout.
        most: f64 = 0.5, "1", "guess";
        /// Share of a loss that its linearisation gets wrong in a window.
        linear: f64 = 0.15, "1", "guess; a body that turns by 0.3 rad in a window";
        /// Share of the counts that can be lost at most in a window of the fit: beyond, its motion is another one.
        linear_most: f64 = 0.52, "1", "a look at a real tricycle, whose outliers would be lost counts otherwise";
        /// By how much counts of a window may be late or early at most.
        late: f64 = 1.0, "s", "guess; what clocks are apart beyond what is known of them before";
        /// Length of windows in which counts are looked for that were lost often.
        length: f64 = 0.5, "s", "guess; a share of the counts lost for a second is one in some of them";
        /// Scale of the errors over the usual one, from which counts may have been lost often.
        widened: f64 = 2.0, "1", "guess; of normal errors both are the same";
        /// Factor by which the scale has to fall without them.
        falls: f64 = 5.0, "1",
            "8 and 46 in two drawn robots that lost counts often, 0.8 to 1.04 in real drives of four robots where any were suspected";
        /// Times that such a fit is made anew.
        rounds: usize = 3, "1", "guess";
    }

    /// Encoders whose column stands still while their wheel rolls.
    standing: Standing {
        /// Least time that it stands.
        least: f64 = 0.4, "s", "guess; counts of a slow wheel come more often";
        /// What is left off at both ends, for the clock of the pose is not known better.
        edge: f64 = 0.1, "s", "guess";
        /// Time between rows of the pose whose motions are added.
        step: f64 = 0.1, "s", "guess; a body hardly turns meanwhile";
        /// Ways over the pose's noise from which on the wheel rolled.
        noises: f64 = 8.0, "1", "guess";
        /// Ways in counts from which on some are missing.
        counts: f64 = 4.0, "1", "guess";
        /// Share that its way has at least of that of the wheel that rolls farthest, and that the others' counts have of its way.
        share: f64 = 0.3, "1", "guess; what a distance between wheels may be off by is less";
        /// Evidence of each span that counts were lost.
        nats: f64 = 3.0, "nats", "guess; a wheel that is blocked and slides stands still as well";
    }

    /// When a cause begins or ends.
    onset: Onsets {
        /// How far about an instant that is known to a window others are tried.
        reach: f64 = 8.0, "s", "two windows";
        /// Step of these.
        step: f64 = 0.25, "s", "guess; a body hardly moves in less";
    }

    /// Clocks of counts and pose before any fit.
    clock: Clock {
        /// Largest rate that is tried, and its step.
        rate: [f64; 2] = [0.04, 0.0025], "1", "timers are a few per cent off at most";
        /// Largest offset that is tried, and its step.
        offset: [f64; 2] = [25.0, 0.1], "s", "guess; logs are started by hand, one after the other";
        /// Grid of the speeds by counts, which are looked up at any instant.
        fine: f64 = 0.02, "s", "guess; a hundredth of a second is the finest offset that is looked for";
        /// Times that the steps are halved about the best of the grid.
        halvings: usize = 4, "1", "guess; to a hundredth of a second";
        /// Difference of a drive's offset from that of most beyond which its counts are moved first.
        apart: f64 = 0.15, "s", "guess; beyond it a fit about the common offset is not linear";
        /// Grid on which rates are compared.
        step: f64 = 0.2, "s", "guess";
        /// Clocks are looked at where speeds differ by more than this share of their mean.
        wrong: f64 = 0.2, "1", "guess; radii and tracks are known better";
        /// Share to which the misfit has to fall.
        fall: f64 = 0.6, "1", "guess";
    }

    /// Forecasts from counts alone.
    forecast: Forecast {
        /// Lengths of forecasts.
        lengths: [f64; 3] = [2.0, 10.0, 30.0], "s", "what users ask: a manoeuvre, a room, a lap";
        /// Distance of their beginnings.
        every: f64 = 1.0, "s", "guess";
        /// Sigma of a turn of 90 degrees that the calibration of squares takes for one.
        corner: f64 = 0.6, "rad", "guess; a corner is more than half a right angle";
        /// Return to the start that makes a loop of a drive: share of its way.
        loop_share: f64 = 0.05, "1", "guess";
    }

    /// Drives beside their simulations, on pages and in pictures.
    traces: Traces {
        /// Time over which a simulation runs free.
        free: f64 = 10.0, "s", "equal to the second length of forecasts: a room";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
