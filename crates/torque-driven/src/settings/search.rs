//! Screening, and refits of what the screen finds.

::settings::settings! {
    /// What the search for effects was tuned with.
    pub(crate) struct Settings;

    /// The linearised screen.
    screen: Screen {
        /// Sigmas below zero from which on the share of a posterior that is positive follows its asymptote.
        asymptote: f64 = -30.0, "1", "numerical guard";
    }

    /// Discs on the ground by superposed columns.
    discs: Discs {
        /// Radii that are tried.
        radii: [f64; 3] = [0.8, 1.2, 1.7], "m", "guess";
        /// Centres that are tried: farthest points of the driven paths.
        centres: usize = 24, "1", "guess";
        /// Distance below which a further centre is no other place.
        apart: f64 = 0.1, "m", "guess";
        /// Steps by which the best disc is moved and resized.
        steps: [f64; 3] = [0.4, 0.2, 0.1], "m", "guess";
        /// Moves at each step, at most.
        passes: usize = 3, "1", "guess";
        /// Width over which a disc's edge is softened.
        soft: f64 = 0.1, "m", "what a robot crosses in a window";
        /// Prior cost of choosing a disc.
        cost: f64 = 3.4, "nats", "guess";
    }

    /// Onsets in time by superposed columns.
    onsets: Onsets {
        /// Onsets that are tried per recording, at most.
        most: usize = 60, "1", "guess";
        /// Rounds in which each run's onset is chosen given the others.
        rounds: usize = 3, "1", "guess";
        /// Prior cost of choosing an onset in a run.
        cost: f64 = 1.24, "nats", "guess";
    }

    /// Discs moved by exact free runs.
    exact_discs: ExactDiscs {
        /// Smallest radius.
        least_radius: f64 = 0.3, "m", "guess";
        /// Steps of the exact search.
        steps: [f64; 3] = [0.15, 0.08, 0.04], "m", "guess: the screen's superposed columns have come this close";
        /// Rounds of moves at each step, at most.
        rounds: usize = 2, "1", "guess";
    }

    /// Onsets moved by exact free runs.
    exact_onsets: ExactOnsets {
        /// Steps of the search.
        steps: [f64; 2] = [0.5, 0.1], "s", "guess";
        /// Steps to each side.
        reach: i32 = 4, "1", "guess";
    }

    /// Refits of single effects.
    finalists: Finalists {
        /// Finalists that are refitted: common effects, and rare ones, which take no place from a common one.
        places: [usize; 2] = [6, 2], "1", "guess";
        /// The same without references, where local forms of effects show large evidence before constants are re-tuned.
        places_by_file: [usize; 2] = [9, 2], "1", "a look at the 72 development cases without their references";
        /// Sizes of an effect, in medium strengths, whose free runs are compared where the robot file is far from the recordings.
        sizes: [f64; 5] = [0.5, 1.0, 2.0, 4.0, 8.0], "1", "guess: from what is seen to what is not overlooked";
        /// Gauss–Newton steps of a first refit.
        steps: usize = 4, "1", "guess";
        /// Gauss–Newton steps of those that may win.
        more_steps: usize = 6, "1", "guess";
        /// Distance from the best within which a form or a finalist may win.
        close: f64 = 60.0, "nats", "guess";
        /// Finalists that get more steps, at most.
        most_close: usize = 4, "1", "guess";
        /// Gain below which a finalist starts a second time, from the re-tuned point.
        small_gain: f64 = 30.0, "nats", "guess";
    }

    /// Re-tuning without any effect.
    retuning: Retuning {
        /// Gauss–Newton steps whose columns are renewed once on the way.
        first_steps: usize = 3, "1", "guess";
        /// Gauss–Newton steps after these.
        second_steps: usize = 5, "1", "guess";
        /// Gain of the best effect below which re-tuning starts again from its tuning.
        small_gain: f64 = 25.0, "nats", "guess";
        /// Gauss–Newton steps from there.
        last_steps: usize = 6, "1", "guess";
        /// Without references: single effects whose tuning "nothing" is started from.
        starts: usize = 3, "1", "guess";
        /// Without references: tyres from which it starts too, as slip at the peak of adhesion and rest speed: stiff tyres, and
        /// contacts of simulators, whose slip speed goes with the force at any speed of the wheel.
        tyres: [[f64; 2]; 3] = [[0.03, 0.3], [0.03, 3.0], [0.01, 3.0]], "1, m/s",
            "11 four-wheelers drawn in MuJoCo without references: each was the best start of some";
        /// Cost of the robot file's constants over that of re-tuned ones from which fits start from both.
        far: f64 = 2.0, "1", "guess";
    }

    /// Whether the wheels of a side have a motor each, where the robot file does not say it.
    four_motors: FourMotors {
        /// Log-likelihood that a robot with a motor at each wheel gains over one with coupled wheels from which on it is believed.
        least_gain: f64 = 10.0, "nats", "guess: what a cause has to gain to be named";
    }

    /// Without references, or where constants may have moved since: effects that hide in a constant.
    handed_over: HandedOver {
        /// Move of a constant, in sigmas of the robot file, from which on the effect that it may stand for is fitted from
        /// that move.
        least_sigmas: f64 = 1.6, "1", "a prototype without references, chosen on the development cases";
    }

    /// Refits of two effects together.
    pairs: Pairs {
        /// First effects of pairs, common and rare.
        firsts: [usize; 2] = [2, 1], "1", "guess";
        /// Partners of a first effect that are tried, common and rare.
        partners: [usize; 2] = [4, 1], "1", "guess";
        /// The same without references, or where constants may have moved since: what is missing hides in constants.
        partners_by_file: [usize; 2] = [6, 1], "1", "a look at the 72 development cases without their references";
        /// Evidence that a partner must exceed.
        partner_evidence: f64 = 3.0, "nats", "guess";
        /// Pairs that get more steps.
        polished: usize = 3, "1", "guess";
        /// Gain of a second effect that could matter.
        least_second: f64 = 12.0, "nats", "guess";
    }

    /// Refits of three effects together.
    thirds: Thirds {
        /// Gain of the best pair over the best single effect from which a third effect is looked for.
        least_second: f64 = 20.0, "nats", "guess";
        /// Pairs beside which one is looked for.
        pairs: usize = 2, "1", "guess";
        /// Partners of a pair that are tried.
        partners: usize = 3, "1", "guess";
        /// Evidence that a partner must exceed.
        partner_evidence: f64 = 5.0, "nats", "guess";
        /// Threes that get more steps.
        polished: usize = 2, "1", "guess";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
