//! The tuned numbers of this crate.

::settings::settings! {
    /// Tuned numbers of fits with a deviation of every drive, and of the causes that they name.
    pub(crate) struct Settings;

    /// Errors of rows.
    errors: Errors {
        /// Errors farther off than this many sigmas count less.
        outlier: f64 = 4.0, "1", "guess";
        /// Quantile of the errors from which their scale is taken.
        quantile: f64 = 0.9, "1", "guess; the rest may be outliers";
        /// Sigmas within which that share of a normal distribution lies.
        quantile_sigmas: f64 = 1.645, "1", "mathematics: the quantile of the normal distribution";
        /// Stretches over which errors that a model's laws leave may follow one another.
        stretch: f64 = 4.0, "s", "guess; longer than a manoeuvre";
        /// Correlation of errors that follow one another, at most.
        correlated: f64 = 0.9, "1", "guess; a twentieth of the rows then counts";
    }

    /// Fits of all constants.
    fitting: Fitting {
        /// Rounds in which scales of errors and scatter of drives are estimated anew.
        rounds: usize = 2, "1", "guess";
        /// Linearisations of a round at most.
        iterations: usize = 15, "1", "guess";
        /// The same of a fit with another cause, which starts where the equations end.
        again: usize = 6, "1", "guess";
        /// Linearisations of which one takes the columns anew; the others keep those of the one before.
        renewed: usize = 2, "1", "guess; columns take most of the time, and a step changes them little";
        /// Damping after an undamped step that failed, and factor of the damping after one that did not.
        damping: [f64; 2] = [0.01, 0.3], "1", "guess; what curves still does at the next step";
        /// Relative fall of the cost below which a round is at rest.
        fall: f64 = 1e-4, "1", "guess";
        /// Errors of a fit in which every cause is free over those of the best answer, from which on no other answer is looked for.
        freed: f64 = 0.9, "1", "guess; a cause that was missed left twice as much and more";
        /// Factors on the usual scatter of drives that are tried.
        factors: [f64; 6] = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0], "1", "guess";
        /// Sigma of the logarithm of that factor.
        width: f64 = 1.0, "1", "guess; a factor of e";
        /// Longest step of a constant, usual sizes.
        longest: f64 = 1.0, "1", "guess";
    }

    /// Which causes the drives ask for.
    naming: Naming {
        /// Log odds of a cause before the data are seen.
        odds: f64 = -3.0, "nat", "guess; one in twenty robots has a given cause";
        /// Log odds from which a cause is named.
        named: f64 = 1.5, "nat", "guess; a probability of 0.82";
        /// Causes at most.
        most: usize = 7, "1", "guess";
        /// Causes that fit as well within these odds cannot be told apart.
        alike: f64 = 3.0, "nat", "a factor of 20";
        /// Error of forecasts of left-out drives over that with such a cause in its place, from which on it forecasts as well.
        near_forecast: f64 = 0.95, "1", "guess; some drives do not tell five per cent";
        /// Odds within which a cause that forecasts left-out drives as well cannot be told apart either.
        near: f64 = 12.0, "nat", "guess; linear equations get a change by a fifth wrong by some nats";
        /// Constants that were re-tuned beside a named cause, told at most.
        beside: usize = 3, "1", "guess; the page lists all";
        /// Causes below this probability are not listed.
        listed: f64 = 0.05, "1", "guess";
        /// A factor on the radius this near to a familiar one is told as that.
        familiar: f64 = 0.03, "1", "guess; tyres do not differ by more";
        /// Familiar factors: counts on both edges, half turns, gears.
        factors: [f64; 8] = [2.0, 0.5, 4.0, 0.25, 10.0, 0.1, std::f64::consts::TAU, 1.0 / std::f64::consts::TAU], "1",
            "edges of encoders, diameters for radii, turns for radians";
        /// Sigmas by which a constant has to move to be told as re-tuned.
        moved: f64 = 0.5, "1", "guess";
        /// Sigmas from which on constants that are re-tuned are not told to be within what is known.
        told_far: f64 = 2.5, "1", "of thirty normal constants the farthest lies beyond in one robot of three";
        /// Sigmas of what is known within which all constants may be re-tuned for an answer without a cause: known by the robot file, and
        /// by references.
        within: [f64; 2] = [3.5, 2.5], "1", "of thirty normal constants the farthest lies beyond 3.5 in one robot of seventy; since the references 2.5 are 1.5 of the owner's";
        /// Scale of the errors of one kind of reading over that of re-tuned constants, below which a cause shows in it.
        seen: f64 = 0.7, "1", "equal to that of the motion of robots under torque";
        /// Share of the probability that a cause keeps which is not needed.
        doubted: f64 = 0.3, "1", "guess";
        /// Error of forecasts of left-out drives with the causes over that of the robot as stated, from which on they are refuted.
        refuted: f64 = 1.25, "1", "guess; a robot of MuJoCo whose motor weakens midway: 1.31; of 22 that have what was named none above 0.98";
        /// Error of such forecasts with the causes over that of the robot as stated, from which on they confirm nothing.
        confirmed: f64 = 0.95, "1",
            "equal to that of commanded robots; of 26 named answers about robots of another hand true ones left 0.11 to 0.72, a false one 1.04";
        /// The same over that of re-tuned constants.
        worse: f64 = 1.1, "1", "guess; the same robots: 0.29 to 1.03, a false one 1.15";
        /// The same, and what is left of the motion over what re-tuned constants leave, from which on nothing but what owners know speaks
        /// for the causes.
        no_better: f64 = 0.98, "1", "guess; medians of forecasts differ by as much from fit to fit";
        /// Fits with what was named before, at most.
        rounds: usize = 4, "1", "guess; two are usual";
        /// Named causes for which fits with others in their place are tried: those that the data would miss most.
        exchanged: usize = 2, "1", "guess; each takes a fit or two";
        /// Others that are tried, of the equations about the re-tuned robot and about the answer each.
        stand_ins: usize = 2, "1", "guess; each takes a fit";
        /// Evidence by the equations that another may lack before it is tried.
        near_enough: f64 = 60.0, "nat", "guess; a straight line errs by tens of them";
        /// Evidence within which a cause cannot be told from another, each with a fit of its own that leaves about the same errors.
        alike_by_errors: f64 = 15.0, "nat", "five times the usual: two cars of another simulator whose steering gain was told as their wheelbase lay 10 apart";
        /// Share by which the errors may then differ.
        leaves_more: f64 = 0.06, "share", "the same cars: 0.03; a simulated one of our own: 0.05";
        /// Sigmas of what is known by which one that may stand for another must move a constant.
        moved_as_stand_in: f64 = 1.0, "1", "guess";
        /// Sets of causes, of those named in recordings, that are tried in references together with the recordings.
        also_in_references: usize = 2, "1", "guess; each takes a fit of the recordings";
        /// Evidence by which references have to speak for such causes, beside what these cost anywhere.
        references_lack: f64 = 2.3, "nat", "guess; of ten drives that their owner calls right one lacks what others are said to lack";
        /// Of two that cannot be told apart, that leads which moves constants by so many times fewer sigmas; causes that move one by so many
        /// times more sigmas than re-tuning are dropped where they are not needed.
        nearer: f64 = 3.0, "1", "guess; owners measure badly, but not that badly";
        /// Sigmas with which its owner knows a length that a cause may move it by before an answer without that cause is looked for.
        believed: f64 = 10.0, "1", "guess; one that was read off wrongly or is of another robot lies beyond, and is seen in the errors";
        /// Lengths for which that is done, at most.
        disbelieved: usize = 2, "1", "guess; each takes as long as the answer";
    }

    /// Causes that begin or end while the drives go on.
    onset: Onsets {
        /// Length of the stretches at whose borders they may.
        coarse: f64 = 1.0, "s", "guess; a window of usual length";
        /// Time on either side that has to be compared.
        least: f64 = 4.0, "s", "guess; a manoeuvre";
        /// Stretches on either side at least, where rows become known farther apart.
        least_stretches: usize = 2, "1", "guess; one may be an outlier";
        /// Log odds that a cause begins or ends in these drives.
        odds: f64 = -2.0, "nat", "guess; one in eight";
        /// Log odds over causes that are always there from which on it is told.
        named: f64 = 5.0, "nat", "guess; laws that are not quite those of the robot change from manoeuvre to manoeuvre";
        /// Share of the errors of causes that are always there which may be left then.
        leaves: f64 = 0.85, "1", "guess; a cause that is there half of the time leaves far less";
        /// The same of one that no other drive shows.
        leaves_alone: f64 = 0.6, "1", "guess; a drive whose turning swings by 5 % as time goes by leaves 0.67, six cars whose tyres, grip or drag change 0.19 to 0.42";
        /// The same of one that begins in each drive anew.
        leaves_anew: f64 = 0.7, "1", "guess; an instant for each drive is free to take what counts that are lost leave";
        /// Errors of causes that are always there, as a share of the motion, below which nothing is looked for in the course of time.
        errs: f64 = 0.005, "share", "guess; a millimetre of a stretch of 20 cm";
        /// Share of a row's window that has passed after an onset when its error is about half there.
        passed: f64 = 0.6, "share", "mathematics: 0.5 of an error that grows with time, 0.7 of one with its square";
        /// By how much that is unsure.
        unsure: f64 = 0.3, "share", "guess";
        /// Hypotheses that are tried by equations of their own.
        tried: usize = 3, "1", "guess; each takes all columns twice a round";
        /// Evidence by the equations of causes that are always there that a hypothesis may lack before it is tried.
        near: f64 = 5.0, "nat", "guess; where nothing begins they lack ten and more";
        /// Evidence that an instant may lack of the best one before it is no longer looked at.
        likely: f64 = 40.0, "nat", "guess; a straight line errs by tens of them";
        /// Rounds in which the instant of each drive is chosen given those of the others, beside a first one.
        rounds: usize = 2, "1", "guess";
    }

    /// What is left of recordings beside what is left of references.
    beside_references: BesideReferences {
        /// So many times as much, as a share of the motion, is something that the answer does not hold.
        times: f64 = 4.0, "1", "guess; other speeds and turns double it";
        /// So many times as much is told, and makes something unknown likelier.
        doubted: f64 = 2.0, "1", "guess; of sound drawn robots few leave twice what their references do";
        /// Probability of something unknown where it is just called missing.
        doubt: f64 = 0.45, "1", "guess; nothing is told, so that it is a little likelier";
        /// Share below which it is not.
        doubted_least: f64 = 0.005, "share", "guess; a millimetre of a stretch of 20 cm";
        /// Below this share nothing is asked for.
        least: f64 = 0.02, "share", "guess";
    }

    /// References and recordings of different days.
    visits: Visits {
        /// Distance of a constant in the recordings from that in the references, in sigmas with which the owner knows it.
        moved: f64 = 0.6, "1", "equal to that of torque-driven robots";
        /// The same, of the usual size of a cause, at most.
        most: f64 = 0.15, "1", "guess; what moves farther is asked a cause for";
    }

    /// Drives to choose from.
    menu: Menu {
        /// Quantile of speeds, turning and bends that were driven which is asked for at most.
        quantile: f64 = 0.95, "1", "guess; what is beyond may be noise";
        /// Quantile of speeds that counts as the fastest.
        top: f64 = 0.99, "1", "guess; a glitch lasts for a row or two";
        /// Share of the fastest speed from which on a robot drives.
        moving: f64 = 0.15, "1", "guess";
        /// Share of the fastest turning from which on a robot that does not drive turns on the spot.
        turns: f64 = 0.4, "1", "guess; noise of a pose at rest is less";
        /// A robot that was never faster hardly moved.
        least_speed: f64 = 0.01, "m/s", "guess";
        /// Share of the time from which on a robot turns on the spot, or drives backward.
        spun: f64 = 0.02, "1", "guess";
        /// Slow, medium and fast, as shares of the fastest.
        speeds: [f64; 3] = [0.35, 0.6, 1.0], "1", "equal to those of speed-driven robots";
        /// Bends, as a share of the tightest.
        tight: f64 = 0.7, "1", "guess";
        /// Rounds of drives that repeat two levels.
        repeats: usize = 3, "1", "guess";
    }

    /// Drives beside their simulations, on pages and in pictures.
    traces: Traces {
        /// Distance of the rows that are shown.
        step: f64 = 0.1, "s", "equal to the windows of torque-driven robots";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
