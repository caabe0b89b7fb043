//! Which drive would tell the rivals apart.

::settings::settings! {
    /// What the advice on the next drive was tuned with.
    pub(crate) struct Settings;

    /// The hypotheses that are still in the running.
    rivals: Rivals {
        /// Probability of "unknown" from which advice among the catalogue's effects needs a word.
        doubt: f64 = 0.1, "1", "guess";
    }

    /// How fast the drives of the menu are.
    scope: Limits {
        /// Share of what was reached before that counts as the robot's limit: a quantile.
        reached: f64 = 0.97, "1", "guess";
        /// Least limits of speed and yaw rate.
        least: [f64; 2] = [0.15, 0.3], "m/s, rad/s", "guess";
        /// A robot that drives so fast can also spin: share of the yaw rate at which its wheels turn as fast.
        spin: f64 = 0.6, "1", "guess";
        /// Windows that a point of the recorded path is a mean of.
        thinned: usize = 5, "1", "guess";
    }

    /// The drives of the menu.
    menu: Menu {
        /// Slow, medium and fast spins and straight drives, in shares of the limits.
        levels: [f64; 3] = [0.3, 0.6, 1.0], "1", "guess";
        /// Slow and fast circles, in shares of the limits.
        circles: [f64; 2] = [0.4, 0.8], "1", "guess";
        /// Yaw rate of a circle over its speed, both in shares of the limits.
        circle_turning: f64 = 0.5, "1", "guess";
        /// Speed of slow reversals, as a share of the limit.
        slow: f64 = 0.4, "1", "guess";
        /// Slow reversals, there and back, in a drive.
        slow_times: usize = 2, "1", "guess";
        /// Fast reversals, there and back, in a drive.
        fast_times: usize = 4, "1", "guess";
        /// Speed and yaw rate of reversals while turning, in shares of the limits.
        turning: [f64; 2] = [0.7, 0.6], "1", "guess";
        /// Beginnings of the coast-downs, in shares of the drive.
        coasts: [f64; 2] = [0.25, 0.75], "1", "formula: the second half of each way";
        /// Length of a coast-down, as a share of the drive.
        coast: f64 = 0.25, "1", "formula: the second half of each way";
        /// Speed of straight reversals with a load, as a share of the limit.
        loaded_speed: f64 = 0.8, "1", "guess";
        /// Yaw rate of spins with a load, as a share of the limit.
        loaded_spin: f64 = 0.6, "1", "guess";
        /// Reversals with a load, there and back, in a drive.
        loaded_times: usize = 2, "1", "guess";
        /// Reversals with the wheels off the ground, there and back, in a drive.
        lifted_times: usize = 3, "1", "guess";
        /// Speed across a place, as a share of the limit.
        across: f64 = 0.6, "1", "guess";
        /// Time from the start to the place, as a share of the drive.
        across_reach: f64 = 0.2, "1", "formula: half of the first half of the drive, ramps aside";
    }

    /// The robot as it is prepared for a drive.
    setups: Setups {
        /// Mass, kg, and inertia, kg m², of a robot whose wheels turn in the air: the body stays where it is.
        lifted_inertia: f64 = 1e6, "kg, kg m²", "numerical guard";
        /// Gravity that is left to it: no contact carries a force.
        lifted_gravity: f64 = 1e-9, "m/s²", "numerical guard";
        /// Share of its mass that a known load adds.
        load_mass: f64 = 0.2, "1", "guess";
        /// Share of its yaw inertia that a known load adds.
        load_inertia: f64 = 0.1, "1", "guess";
    }

    /// A robot that follows a course.
    follower: Follow {
        /// Time in which the wheels reach what is wanted.
        reach: f64 = 0.15, "s", "guess";
        /// How much faster the integral acts.
        integral: f64 = 3.0, "1/s", "guess";
        /// Yaw rate per error of the heading.
        heading: f64 = 2.0, "1/s", "guess";
        /// Largest error of the heading that counts.
        largest_error: f64 = 0.6, "rad", "guess";
        /// Wheel speed at which known friction is compensated in full.
        friction_rest: f64 = 0.5, "rad/s", "guess";
        /// A robot file's limit beyond this is none.
        no_limit: f64 = 1e6, "N m", "numerical guard";
    }

    /// What is expected of a drive.
    expected: Expected {
        /// Share of what the model says that counts: the rest is its own error.
        believed: f64 = 0.25, "1",
            "thirty robots of the examiner, seed 1: with all of it nearly every drive seemed to tell everything, and 0.95 \
             bits were expected where 0.73 were gained";
    }

    /// The search for a speed profile.
    profile: Profile {
        /// Time of a level.
        each: f64 = 1.5, "s", "guess";
        /// Fewest levels of a profile.
        fewest: usize = 3, "1", "guess";
        /// Most levels of a profile.
        most: usize = 8, "1", "guess";
        /// Rounds of the search.
        rounds: u64 = 4, "1", "guess";
        /// Candidates of a round.
        candidates: u64 = 12, "1", "guess";
        /// Candidates from which the next round is drawn.
        elite: usize = 4, "1", "guess";
        /// Spread of the levels at the beginning, in shares of the limits.
        first_spread: f64 = 0.8, "1", "guess";
        /// Least spread of the levels later, in shares of the limits.
        least_spread: f64 = 0.25, "1", "guess";
        /// Fixes the search: the same rivals get the same profile.
        seed: u64 = 2026, "1", "arbitrary";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
