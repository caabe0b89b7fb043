//! Slopes, jumps of the load, turning and standstills inside recordings.

pub(super) const fn degrees(x: f64) -> f64 {
    x * std::f64::consts::PI / 180.0
}

::settings::settings! {
    /// What is looked for inside recordings, and how.
    pub(crate) struct Settings;

    /// What the searches for changes share.
    pieces: Pieces {
        /// Rows that show the same change are at most this far apart.
        apart: f64 = 8.0, "s", "chosen after a look at the open Husky runs";
        /// Speed from which the robot drives.
        driving: f64 = 0.05, "m/s", "guess";
        /// The load of a level stretch is known after so much of it.
        known: f64 = 10.0, "s", "guess";
        /// So much of it must be there where most of a recording is ground that no drive train explains.
        little: f64 = 5.0, "s", "guess";
        /// Loads within this factor of the references' are the usual ground's; loads at several speeds are one ground's.
        alike: f64 = 1.25, "1", "guess, as for turning";
    }

    /// A side that takes another torque from an instant on.
    one_side: OneSide {
        /// Length of the stretches of straight driving that are compared.
        stretch: f64 = 2.0, "s", "guess: longer than what a current is filtered by";
        /// Straight driving before and after at least.
        least: f64 = 8.0, "s", "guess: four of these stretches";
        /// Scatters of the difference of both sides by which it has to change.
        clear: f64 = 5.0, "1", "guess: a steady drift of the same size has 3.5";
        /// Least scatter, as a share of the straight load.
        floor: f64 = 0.02, "1", "guess";
        /// The same in shares of the straight load.
        share: f64 = 0.2, "1", "guess: less is a matter of the ground";
        /// Share of that by which the other side may change.
        other: f64 = 0.4, "1", "guess: other speeds change both";
    }

    /// The slope under the robot from its turning rates and loads.
    attitude: Filter {
        /// Tilt at the beginning, one sigma.
        first_tilt: f64 = degrees(6.0), "rad", "guess";
        /// Offsets of the gyro at the beginning, one sigma.
        first_offset: f64 = degrees(0.05), "rad/s", "guess";
        /// The same where the robot did not stand long enough to show them.
        unknown_offset: f64 = degrees(0.5), "rad/s", "data sheets of small gyros: a zero of 0.2 to 1 °/s";
        /// Random walk of the tilt: vibration, aliasing.
        tilt_walk: f64 = degrees(0.15), "rad/√s", "one of about ten settings tried on the open Husky runs";
        /// What is turned in windows of two lengths shows the noise of a rate: the tilt walks by that, if that is faster.
        noise_windows: [f64; 2] = [1.0, 4.0], "s", "guess: longer than a vibration, shorter than a ramp";
        /// The longer windows that there have to be: of a short drive ramps are most.
        noise_least: f64 = 8.0, "1", "guess";
        /// Random walk of the gyro's offsets.
        offset_walk: f64 = degrees(0.001), "rad/s/√s", "one of about ten settings tried on the open Husky runs";
        /// Ground is level within this.
        level: f64 = degrees(3.0), "rad", "one of about ten settings tried on the open Husky runs";
        /// Ground counts as if it were seen to be level once in this time.
        level_every: f64 = 20.0, "s", "one of about ten settings tried on the open Husky runs";
        /// The rolling load wanders by this share: drive trains warm up.
        rolling: f64 = 0.3, "1", "one of about ten settings tried on the open Husky runs";
        /// Time over which the rolling load wanders.
        rolling_time: f64 = 60.0, "s", "one of about ten settings tried on the open Husky runs";
        /// Where the load is another from end to end the ground may be, too: this share of the excess is one sigma.
        excess: f64 = 0.7, "1", "one of about ten settings tried on the open Husky runs";
        /// Error of the slope from one second of straight driving.
        from_load: f64 = degrees(2.0), "rad", "one of about ten settings tried on the open Husky runs";
        /// Error of the accelerometer's mean at least.
        from_level: f64 = degrees(0.4), "rad", "steps between means of 2 s on the open floor runs are 0.3°";
        /// Miss of a reading beyond which it counts less.
        far_off: f64 = degrees(2.5), "rad", "guess";
    }

    /// Slopes that gyro and load show together.
    slopes: Slopes {
        /// Least slope that is reported.
        least: f64 = 1.6, "°", "one of about ten settings tried on the open Husky runs";
        /// Slope from which on it is a cause beside loads that differ.
        steep: f64 = 3.0, "°", "guess: it pulls as much as most wheels resist rolling";
        /// For how long at least.
        least_seconds: f64 = 3.0, "s", "one of about ten settings tried on the open Husky runs";
        /// Without an accelerometer the turning rates must see the ramp: from and until, before and after its ends.
        ramp: [f64; 2] = [0.5, 4.0], "s", "guess";
        /// Share of the slope by which they must see the nose rise or fall there.
        ramp_share: f64 = 0.5, "1", "guess";
        /// A robot that turned by this much at the end of a slope may have turned into it.
        turned: f64 = 0.35, "rad", "guess: 20°";
        /// A slope's angle is that of its middle: so much at either end is ramp.
        flank: f64 = 2.0, "s", "guess: a robot's length at walking pace, and the mean of the accelerometer";
        /// A drive train loses this share of what a slope pulls, one sigma.
        losses: f64 = 0.1, "1", "guess: gears of 85 to 95 % efficiency";
        /// Gaps in the sight of a slope that do not end it.
        gap: f64 = 2.0, "s", "guess";
        /// Clocks are aligned to about this: taken off and added where a slope begins and ends.
        clock: f64 = 0.35, "s", "guess";
    }

    /// One slope under all driving, by loads and directions of travel.
    plane: Plane {
        /// Straight driving that counts as a stretch.
        stretch: f64 = 1.5, "s", "guess, as for changes";
        /// Rows of one stretch are at most this far apart.
        gap: f64 = 0.5, "s", "guess";
        /// Stretches of all recordings below which nothing is looked for.
        least_stretches: usize = 5, "1", "guess: one more than a recording's numbers";
        /// Scatter of a stretch's load, as a share of the usual.
        scatter: f64 = 0.12, "1", "guess: as of the straight load along one floor, less what a mean over a stretch takes away";
        /// Miss beyond which a stretch counts no more, in its sigmas.
        far_off: f64 = 4.0, "1", "guess";
        /// Levels of a drive train that are tried to each side of the usual.
        levels: i32 = 6, "1", "numerical";
        /// How far out, in the factor within which loads of one ground differ.
        widest: f64 = 2.0, "1", "guess";
        /// Directions uphill that are tried.
        directions: usize = 48, "1", "numerical: 7.5 degrees";
        /// Distance of the slopes that are tried.
        step: f64 = 0.2, "°", "numerical";
        /// Steepest slope that is tried.
        steepest: f64 = 20.0, "°", "guess: few robots drive steeper";
        /// Least slope that is told.
        least: f64 = 1.0, "°", "guess: a pavement's";
        /// Ratios of two grounds that are tried, to each side of 1.
        ratios: usize = 16, "1", "numerical";
        /// Largest of them.
        most_ratio: f64 = 4.0, "1", "guess: soft ground against firm";
        /// Pulls of a rope that are tried to each way, up to that of the steepest slope.
        ropes: usize = 20, "1", "numerical";
        /// Share of the mean square of the tilts that an accelerometer shows which a slope under all driving leaves at most.
        tilt_left: f64 = 0.4, "1", "guess: beyond two thirds of the tilts it is no longer the same slope";
        /// Stretches of a recording from which on its accelerometer may lean.
        leans_from: usize = 3, "1", "guess: two do not tell a lean from a slope";
        /// Price of a number that is chosen: a slope, a direction, a ratio.
        per_number: f64 = 2.5, "nats", "guess: half the logarithm of some hundred choices";
        /// How much better the slope must explain the loads than either rival.
        least_gain: f64 = 4.5, "nats", "a look at six robots of another hand that went there and back: 4.7 to 5.7, each with the right angle";
    }

    /// A pull along the body under all driving.
    pull: Pull {
        /// Stretches forward, and backward, at least.
        least_stretches: usize = 2, "1", "guess: one may be another ground";
        /// Distance of the pulls that are tried, over the usual straight load.
        step: f64 = 0.05, "1", "numerical";
        /// The largest of them.
        most: f64 = 4.0, "1", "guess: as the largest ratio of two grounds";
        /// Least pull that is told, over the usual straight load, beside references that were driven both ways.
        least: f64 = 0.25, "1", "guess: as much as cold drive trains change it";
        /// The same where nothing says how the robot rolls backward.
        unknown: f64 = 0.5, "1", "guess: gears run unlike both ways";
        /// Share of the probability that goes to a slope where drives do not tell it from a pull.
        slope: f64 = 0.67, "1", "guess: ground slopes twice as often as something is tied to a robot";
    }

    /// The piecewise constant course of a load.
    levels: Levels {
        /// Lowest and highest level of the grid, as multiples of the usual load.
        range: [f64; 2] = [-2.2, 5.5], "1", "guess: from a steep descent to five times the usual";
        /// Steps of the grid.
        steps: usize = 170, "1", "guess";
        /// What a jump costs.
        jump: f64 = 7.0, "nats", "chosen after a look at the open Husky runs";
        /// Readings follow one another closely: one second counts as so many independent ones.
        per_second: f64 = 1.6, "1/s", "chosen after a look at the open Husky runs";
        /// Scatter of a reading at least, as a share of the usual load.
        least_scatter: f64 = 0.09, "1", "guess";
        /// Scatter where too few readings tell it, as a share of the usual load.
        usual_scatter: f64 = 0.18, "1", "guess";
        /// Readings that are too few to tell their scatter, at most.
        few: usize = 10, "1", "guess";
        /// Degrees of freedom of Student's t: a reading far off is no Gaussian.
        freedom: f64 = 4.0, "1", "guess";
        /// Weight of a bound beside a reading: a side winds up for a while, so that a bound says less.
        bound: f64 = 0.5, "1", "guess";
    }

    /// Jumps of the straight load, by currents.
    jumps: Jumps {
        /// Share of its weight from which on no ground resists a robot by itself: it pushes against something, or its wheels spin.
        blocked: f64 = 0.4, "1", "loose sand resists rolling by 0.2 to 0.3; tyres grip by 0.5 to 0.9";
        /// Share of its weight from which on no slope pulls back a robot that drives up it: its wheels slip before.
        climbed: f64 = 0.6, "1", "37 degrees; rubber on dry ground grips by 0.5 to 0.9";
        /// A change shorter than this is not reported: straight driving.
        least: f64 = 1.5, "s", "guess";
        /// No friction falls to this share of the usual load: the robot runs downhill.
        below_friction: f64 = 0.35, "1", "guess";
        /// For how long both sides read nothing where the robot runs downhill.
        below_seconds: f64 = 1.0, "s", "guess";
        /// Scatter of the straight load along one floor, as a share.
        scatter: f64 = 0.15, "1", "chosen after a look at the open Husky runs";
        /// A load jumped where its neighbour at the same speed is off by less than this share of its own excess.
        neighbour: f64 = 0.5, "1", "guess";
        /// Headings this far apart tell a slope from the ground.
        other_heading: f64 = std::f64::consts::FRAC_PI_3, "rad", "guess";
        /// Share of a slope by which the measured tilt has to differ from it to contradict it.
        off_slope: f64 = 0.5, "1", "definition: nearer to level ground than to the slope";
        /// So much straight driving in another heading rules out that one slope is under all of it.
        elsewhere: f64 = 5.0, "s", "guess";
        /// Headings this far apart are the way back.
        way_back: f64 = 2.6, "rad", "guess";
    }

    /// An encoder that shows another speed than there is.
    encoders: Encoders {
        /// Speed that is set for so long before it is followed.
        settled: f64 = 1.0, "s", "guess: several lags of usual drives";
        /// By how much a set speed may change meanwhile.
        steady: f64 = 0.02, "m/s", "guess";
        /// Share by which the speed that a side shows is off, from which on it is looked at.
        off: f64 = 0.06, "1", "guess; drives follow set speeds to some per cent";
        /// Share by which the other side is off at most.
        other: f64 = 0.03, "1", "guess: half of that";
        /// Share of the turning that an encoder that is off would make, up to which the body turns as is set.
        turned: f64 = 0.5, "1", "definition: nearer to what is set than to what is shown";
        /// For how long at least.
        least: f64 = 3.0, "s", "guess, as of a body that stands";
        /// Rows of one stretch are at most this far apart.
        apart: f64 = 4.0, "s", "guess: a change of speed that has to settle";
        /// Share by which a side rolls farther than it shows, while it shows what is set, from which on it is looked at.
        rolls: f64 = 0.15, "1", "guess; slopes and unlike tyres turn robots by some per cent";
        /// Scatter of that share from row to row up to which it is one, over it.
        scatter: f64 = 0.35, "1", "guess; a body that stands in turns or is pushed shows any";
    }

    /// Changes of what turning costs.
    scrub: Scrub {
        /// Ratios within this factor are one ground.
        same: f64 = 1.25, "1", "guess";
        /// Scatter of such torques on one ground, as a share.
        scatter: f64 = 0.08, "1", "guess";
        /// Turns of references that last so long say what turns take.
        turn: f64 = 1.0, "s", "guess: as long as a current is filtered";
        /// So many of them are needed.
        turns: usize = 5, "1", "guess";
        /// Least steady turning that shows a change.
        least: f64 = 3.0, "s", "guess";
        /// A way counts as turned to, or a side as known, after so much steady turning.
        one_way: f64 = 1.5, "s", "guess";
        /// Usual turning between two changes that are one, over what shows these.
        between: f64 = 0.2, "share", "guess; slow arcs";
        /// Time in which a load is put on a robot that stands, at least.
        loading: f64 = 4.0, "s", "guess; a hand and a box";
        /// What turning costs on the references' ground is known after so much of it.
        known: f64 = 5.0, "s", "guess";
    }

    /// Turning without a gyro and without a difference of the speeds.
    turning: FromLoads {
        /// Loads are averaged over this long.
        mean: f64 = 0.7, "s", "guess";
        /// Sides that differ by less than this share of the straight load carry the same.
        even: f64 = 0.36, "1", "guess";
        /// Speed below which nothing says which way the robot travels.
        least_speed: f64 = 0.02, "m/s", "guess";
    }

    /// An inertial unit that tips.
    tipping: Tipping {
        /// Angle that is told, at least.
        least: f64 = degrees(2.0), "rad", "guess; less may be what the ground does";
        /// Scatter of the tilt before and after, over the angle, up to which it is one step.
        scatter: f64 = 0.3, "1", "guess; slopes change with the heading";
        /// Driving before and after at least.
        beside: f64 = 10.0, "s", "guess";
        /// What a slope of the angle would do to the straight load, over the usual one, at least.
        least_pull: f64 = 0.5, "1", "guess: more than cold drive trains do";
        /// What the loads leave once the unit is taken to have tipped, over what they leave of slopes alone, squared, at most.
        left: f64 = 0.25, "1", "guess: half the deviation";
    }

    /// A side that does not turn as commanded and moves the body with it.
    following: Following {
        /// Share of the commanded speed by which it turns faster or slower.
        off: f64 = 0.25, "1", "guess; a controller that follows slowly is within a tenth";
        /// For how long at least, all stretches together.
        least: f64 = 3.0, "s", "guess, as of a body that stands";
        /// Share of the settled driving in which references show the same, over the recordings'.
        usual: f64 = 0.2, "1", "guess";
        /// Rows of one stretch are at most this far apart.
        apart: f64 = 1.0, "s", "guess";
        /// Scatter of a torque that a motor does not exceed, over it.
        level: f64 = 0.15, "1", "guess: noise of currents, and a limit that warms";
        /// Torque beside these stretches over that in them up to which it is the most that the motor gives.
        most: f64 = 1.3, "1", "guess: noise of single readings, and a limit that warms";
        /// Quantile of the shares of the commanded speed that is told as the largest; the smallest is as far from the other end.
        shares: f64 = 0.95, "1", "definition of a 90 % range";
    }

    /// Straight driving whose load rises and falls again and again.
    pulses: Pulses {
        /// How long the commanded speeds must have been constant.
        settled: f64 = 2.0, "s", "guess: slow controllers let go of what they needed in a turn over seconds";
        /// Length of the stretches that are looked at, at least.
        stretch: f64 = 4.0, "s", "guess: two periods of the slowest";
        /// The same at most: longer ones are cut.
        longest: f64 = 20.0, "s", "guess: what pulls does not keep its time for ever";
        /// All of them together, at least.
        least: f64 = 8.0, "s", "guess: two stretches";
        /// Lowest and highest frequency that is looked for.
        band: [f64; 2] = [0.4, 5.0], "Hz", "guess: hoses, hitches and wheels";
        /// The highest over the rate of the rows, at most.
        highest: f64 = 0.25, "1", "guess: half of what can be told from rows";
        /// Step of the frequencies that are tried, over one by the length of a stretch.
        step: f64 = 0.25, "1", "definition: a quarter of a period is lost at most";
        /// Share of the load's variance that the best frequency takes.
        share: f64 = 0.5, "1", "guess: rough ground has none that does";
        /// Root mean square of the load about its mean over the usual one.
        clear: f64 = 3.0, "1", "guess";
        /// The same over the usual straight load.
        least_share: f64 = 0.25, "1", "guess: as much as cold drive trains change it";
        /// Scatter of the frequency, or of it over the speed, over stretches up to which it is one.
        alike: f64 = 0.1, "1", "guess";
        /// Ratio of the fastest to the slowest stretch from which speeds tell the one from the other.
        speeds: f64 = 1.3, "1", "guess: three times the scatter";
    }

    /// A body that does not turn with its wheels.
    standstill: Stuck {
        /// The body stands if it turns by less than this share of what its wheels are commanded.
        share: f64 = 0.35, "1", "field study: 0.2 reported standing up to 11 s late";
        /// For so long at least.
        least_seconds: f64 = 3.0, "s", "guess";
        /// Commanded speed of a side from which its wheels have to turn.
        commanded: f64 = 0.1, "m/s", "guess: drives with a dead band follow slower ones badly";
        /// Wheels that turn at this share of what is commanded follow it.
        follows: f64 = 0.5, "1", "guess";
        /// Wheels are held that turn by less than this share of what is commanded.
        wheels: f64 = 0.2, "1", "guess: a drive that follows is at .9 and more";
        /// Torque over that of straight driving below which motors are switched off.
        off: f64 = 0.1, "1", "guess: currents have a dead band, and rolling by itself takes more";
        /// Quantile of the torques of straight driving that counts as a large one.
        large: f64 = 0.9, "1", "guess: motors are not switched off for nine tenths of a drive";
        /// Difference of the speeds in a turn that counts.
        turn: f64 = 0.08, "m/s", "guess";
        /// Turning rates are averaged over this long before: a body that is stuck rocks.
        mean: f64 = 1.0, "s", "guess";
        /// Stretches that are this close, without a turn that succeeds between them, are one.
        bridge: f64 = 5.0, "s", "guess";
    }
}
