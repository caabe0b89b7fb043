//! The plant in steady driving, weights of effects, the answer and the next drive.

::settings::settings! {
    /// What effects are weighed with.
    pub(crate) struct Settings;

    /// The plant in steady driving.
    plant: SteadyPlant {
        /// Integration step.
        step: f64 = 2e-3, "s", "guess";
        /// Headings over which a turn is averaged.
        headings: usize = 6, "1", "guess";
        /// Speed below which a braking side reads its braking current, without sign.
        braking_reads: f64 = 0.12, "m/s", "chosen after a look at the open Husky runs";
    }

    /// Calibration of the robot on the loads of references.
    calibration: Calibration {
        /// Gauss–Newton steps at most.
        steps: usize = 12, "1", "guess";
        /// Finite step of a derivative, sigmas of the constant.
        shift: f64 = 0.2, "1", "guess";
        /// Longest step, sigmas of the constant.
        longest: f64 = 1.0, "1", "guess";
        /// Farthest value from the robot file's, sigmas of the constant.
        farthest: f64 = 4.0, "1", "guess";
    }

    /// What is thought of effects before anything is measured.
    priors: Priors {
        /// The straight load of a drive train varies by up to this factor (90 %) between days without a cause that
        /// these signals could name: cold grease, tyre pressure.
        unnamed_straight: f64 = 1.45, "1", "given, for cold drive trains (docs/evidence.md)";
        /// A strength is taken to be within so many medium sizes, one sigma; medium sizes grow with the robot.
        plausible: f64 = 3.0, "1", "guess";
        /// Price of naming an effect.
        per_effect: f64 = 3.0, "nats", "guess";
        /// What an effect costs more that needs a hand on the robot: its mass, motors, torque constant, wheels.
        by_hand: f64 = 3.0, "nats", "guess: ground and slope differ between places, bodies do not change by themselves";
        /// Price of each factor of "unknown".
        per_unknown: f64 = 4.0, "nats", "guess";
    }

    /// Soft ground.
    soft_ground: SoftGround {
        /// One sigma of the logarithm of the effective track that the plant's tyre laws may be wrong by.
        by_law: f64 = 0.08, "1", "guess: laws of rigid ground";
        /// One sigma of the logarithm of the effective track on soft ground over that on hard ground.
        plausible: f64 = 0.25, "1", "guess: a quarter";
        /// Most that the effective track says for or against a cause.
        most: f64 = 6.0, "nats", "guess: a track alone names no ground";
    }

    /// Fits of effects to the differences of loads.
    effects: EffectFits {
        /// Steps of a fit at most.
        steps: usize = 8, "1", "guess";
        /// Gain below which a fit has arrived.
        least_gain: f64 = 1e-2, "nats", "guess";
        /// Finite step of a derivative, medium sizes.
        shift: f64 = 0.1, "1", "guess";
        /// What holds a size that shows in no load.
        ridge: f64 = 1e-6, "1", "numerical guard";
        /// An effect whose response (squared, in sigmas) is weaker than this at a medium size does not show in steady
        /// loads.
        least_response: f64 = 1e-3, "1", "guess";
        /// Single effects that are tried with a second one.
        firsts: usize = 4, "1", "guess";
    }

    /// Loads drawn about those of a case.
    replicas: Replicas {
        /// Drives that differ as is usual, which count beside those that were measured.
        usual_drives: u32 = 1, "1", "guess; two references alone say little of what drives differ by";
    }

    /// Probabilities and classes.
    answer: Answer {
        /// Divisor of scores before they become probabilities: those of steady loads are nats as they are.
        temperature: f64 = 1.0, "1", "definition of the score";
        /// Effects within this much of the best (odds of 200) cannot be told from it: steady loads are few numbers, and
        /// the recordings were driven at different places.
        indistinguishable: f64 = 5.3, "nats", "widened from 3 after a look at the open sandy-loam runs, where 3 \
            left rolling resistance alone although every straight drive goes one way";
        /// What is this much less probable than "nothing is missing" stands in for nothing.
        least_plausible: f64 = 2.0, "nats", "guess";
        /// Probability that a drift is of the wheels of a side, and of its encoder.
        drift: [f64; 2] = [0.75, 0.24], "1", "guess; wheels wear and are changed, encoders are configured once";
        /// Probability of a body that was seen to stand: a gyro that is off looks alike.
        standing: f64 = 0.99, "1", "guess";
        /// Wheels that spin with less than so many times what a side takes straight ahead find no hold.
        light: f64 = 1.5, "1", "guess: turns on the spot take two times as much and more";
        /// Probability that a longer effective track alone, without a load that differs, is soft ground.
        soft: f64 = 0.5, "1", "guess: or another surface, or other tyres";
        /// Probability that another effective track is an error of the gyro's scale.
        gyro: f64 = 0.25, "1", "guess: gyros are exchanged less often than grounds";
        /// Half widths of their 90 % intervals by which loads of little steady driving have to differ to count.
        tentative: f64 = 2.0, "1", "guess: a few seconds show more than they scatter by";
        /// Probability that a change inside a recording is one: it is reported where its 90 % interval shows it.
        changed: f64 = 0.9, "1", "definition of the interval";
        /// Members of a class at most, the likeliest; the table of causes has all.
        members: usize = 3, "1", "field study: longer classes cannot be acted upon";
        /// They explain at least this share of what the best of them does.
        fits: f64 = 0.5, "1", "guess";
        /// Steady driving of the recordings from which on "nothing is missing" can be said.
        needed: f64 = 20.0, "s", "guess: twice what makes one load firm";
        /// Causes below this probability are not listed.
        listed: f64 = 1e-3, "1", "guess";
    }

    /// Sentences of the answer.
    sentences: Sentences {
        /// Drives that are named to split a class: the first ones are enough to begin with.
        drives: usize = 3, "1", "guess";
        /// Speeds of pooled recordings that differ by more than this are given as a range.
        one_speed: f64 = 0.05, "m/s", "guess";
        /// Times closer than this are one moment.
        moment: f64 = 1.0, "s", "guess";
        /// Stretches without straight driving that are named.
        hidden: usize = 3, "1", "guess";
    }

    /// The next drive.
    next: NextDrive {
        /// Time of each level.
        each: f64 = 14.0, "s", "a load needs ten seconds of steady driving to be firm";
        /// A load is measured to this share at least in that time.
        measured: f64 = 0.02, "1", "guess";
        /// Sizes are taken to be known within so many medium sizes at least.
        widest: f64 = 3.0, "1", "guess";
        /// Finite step of a derivative, medium sizes.
        shift: f64 = 0.1, "1", "guess";
        /// Slow, medium and fast, as shares of the fastest speed that was driven.
        speeds: [f64; 3] = [0.35, 0.6, 1.0], "1", "guess";
        /// Speed of the slowest spin, as a share of the slow one.
        slowest: f64 = 0.5, "1", "guess";
        /// Speed of the inner side on a circle over that of the outer one.
        inner: f64 = 0.4, "1", "guess";
    }
}
