//! A law for what has no name.

::settings::settings! {
    /// What the search for a law was tuned with.
    pub(crate) struct Settings;

    /// When a law is looked for.
    asked: Asked {
        /// Share of the excess cost that the best name leaves, above which a law is looked for beside it.
        left: f64 = 0.35, "1", "the design's prototype; in 55 named development cases a name left 0.26 at most";
    }

    /// What a law is usually as large as, of which its evidence takes account.
    priors: Priors {
        /// Force on the body, as a share of the robot's weight; a slope is as large in rad.
        force: f64 = 0.06, "1", "the prototype's 8 N of a robot of 14 kg";
        /// Torque of a side, as a share of that force at the wheel's rim.
        torque: f64 = 0.7, "1", "the prototype's 0.6 N m";
        /// Yaw moment, as a share of that force at half the track.
        moment: f64 = 0.6, "1", "the prototype's 1 N m";
        /// Share of the grip.
        grip: f64 = 0.4, "1", "the prototype";
        /// Share of a wheel's radius.
        radius: f64 = 0.04, "1", "the prototype's 4 mm";
    }

    /// The response to an input in any window.
    operator: Operator {
        /// Size of the input in a window, as a share of what is usual at its place.
        pulse: f64 = 0.3, "1", "guess: larger than rounding, smaller than what changes the way of sliding";
        /// Parts of a window in which what a law depends on is evaluated.
        parts: usize = 5, "1", "guess: a wheel at 10 rad/s turns by 0.2 rad in a part";
        /// Candidates that are weighed together.
        together: usize = 160, "1", "guess: as many as keep the matrix small";
        /// Places at which products of factors are tried: those with the best single factors.
        places: usize = 5, "1", "guess";
        /// Places on the ground that are tried.
        spots: usize = 6, "1", "guess";
    }

    /// Refits in free run.
    refit: Refit {
        /// Finalists.
        finalists: usize = 7, "1", "the prototype";
        /// Finalists of one place, at most.
        per_place: usize = 3, "1", "the prototype";
        /// Gauss–Newton steps of a finalist.
        steps: usize = 4, "1", "as of named effects";
        /// Gauss–Newton steps of those that may win.
        more_steps: usize = 6, "1", "as of named effects";
        /// Distance from the best within which a finalist may win.
        close: f64 = 60.0, "nats", "as of named effects";
        /// Gain below which a finalist starts a second time, from the re-tuned point.
        small_gain: f64 = 60.0, "nats", "the prototype";
        /// Laws from which moves start.
        movers: usize = 3, "1", "the prototype";
        /// Refits of moves, at most.
        moves: usize = 12, "1", "the prototype";
        /// Largest constant, in usual sizes.
        most: f64 = 50.0, "1", "guess";
        /// Saturation of outliers in the last fit of the winner.
        outlier_scale: f64 = 30.0, "1", "the prototype: with 3 strong laws come out 15 % too small";
    }

    /// Effects of one's own.
    own: Own {
        /// Wheel speed of a free run, in the fastest that was recorded, from which on an effect makes the plant run away.
        runaway: f64 = 20.0, "1", "guess: far beyond what a law of a wrong size does";
    }

    /// What a law pays for what it is made of.
    prices: Prices {
        /// Price of a law.
        law: f64 = 10.0, "nats", "the prototype";
        /// Price of a factor.
        factor: f64 = 6.0, "nats", "the prototype: with 3 decorations win";
        /// Price of a shape number.
        shape: f64 = 1.0, "nats", "the prototype";
    }

    /// What must hold before a law is told.
    gates: Gates {
        /// Score that a law must exceed.
        score: f64 = 25.0, "nats", "the prototype";
        /// By how much it must exceed the score of the best name.
        above_name: f64 = 20.0, "nats", "the prototype";
        /// Gain that a recording counts with, and loss that one may have at most.
        recording: f64 = 5.0, "nats", "the prototype";
        /// Recordings that must gain.
        recordings: usize = 2, "1", "the prototype: what happened once may be an event";
        /// Share of the excess cost that may be left.
        left: f64 = 0.4, "1", "the prototype";
        /// Share of the excess cost that may be left where a place alone is told.
        left_of_place: f64 = 0.7, "1", "guess, after five development outsiders whose laws left 83 to 95 %";
        /// Share of the excess cost that may be left where an arbitrary input tells a place.
        left_of_place_alone: f64 = 0.4, "1", "guess: as of a law";
        /// Coefficient of the same law in the references, as a share of that in the recordings, that is refused.
        in_references: f64 = 0.25, "1", "the prototype: without it six of 18 fault-free robots were told a law";
        /// Laws within this cannot be told apart.
        class: f64 = 10.0, "nats", "the prototype";
        /// Coefficient in the references from which on every drive has the law.
        in_every: f64 = 0.6, "1", "guess";
        /// Evidence in the references that such a law must have.
        evidence_in_references: f64 = 10.0, "nats", "guess";
    }

    /// Events: instants at which something acts, where no law fits.
    events: Events {
        /// Sizes of an arbitrary input that are tried, in what is usual at its place.
        sizes: [f64; 3] = [0.3, 1.0, 3.0], "1", "guess: a third of a law of usual size to three times that";
        /// Sigmas from which the input of a window stands out.
        sigmas: f64 = 3.0, "1", "the prototype";
        /// Solutions one after another, each about the free run with what the one before found.
        rounds: usize = 3, "1", "guess";
        /// Events below which there is no list.
        least: usize = 3, "1", "guess: what happened twice may be chance";
        /// Share of the windows from which on it is no event.
        filled: f64 = 0.3, "1", "the prototype";
        /// Share of the excess cost that may be left.
        left: f64 = 0.6, "1", "guess: between a law's and a place's";
        /// Things in common that are told.
        shared: usize = 2, "1", "guess";
        /// Probability that an amount at an event is larger, or smaller, than one elsewhere, from which on it is told.
        clear: f64 = 0.8, "1", "guess";
        /// Share of the windows in which torques act against the same, from which on it is said what does so.
        against: f64 = 0.85, "1", "guess";
        /// Share of the events whose amounts are told.
        most_of_them: f64 = 0.8, "1", "guess";
    }

    /// Proof on what was not used.
    proof: Proof {
        /// Gauss–Newton steps of a fit to the other recordings.
        steps: usize = 3, "1", "as of named effects";
        /// Significant digits of numbers in formulas.
        digits: usize = 6, "1", "guess: more than any drive determines";
        /// Half width of a 90 % interval, in sigmas.
        interval: f64 = 1.645, "1", "mathematics: a quantile of the normal distribution";
        /// Share of a constant that the model gets wrong, one sigma.
        model_error: f64 = 0.02, "1", "as of named effects";
        /// One sigma of a constant, in sigmas of the curvature.
        curvature: f64 = 2.0, "1", "as of named effects";
        /// Quantiles of a variable between which a law was seen.
        seen: [f64; 2] = [0.01, 0.99], "1", "guess";
        /// Parts of a recording by which the placebo is shifted.
        shifts: [f64; 4] = [0.17, 0.37, 0.59, 0.83], "1", "guess: no simple shares of a repeated drive";
        /// By how much its error must be below that of re-tuning, over all quantities, as a share of it.
        below_retuned: f64 = 0.02, "1", "guess: less is not worth a law";
        /// By how much a shifted copy, or the best name, may do better: a law that hardly changes in time is its own copy.
        above_shifted: f64 = 0.01, "1", "guess";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
