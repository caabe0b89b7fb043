//! Every tuned number of a rehearsal.

::settings::settings! {
    /// Tuned numbers of a rehearsal.
    pub(crate) struct Settings;

    /// What is rehearsed unless the caller says otherwise: minutes of computing, not hours.
    plan: Planned {
        /// Sizes that are simulated, in sizes of interest.
        sizes: [f64; 4] = [0.5, 1.0, 2.0, 4.0], "1", "guess; octaves about the size below which nobody would act";
        /// Replicas of each size.
        replicas: usize = 3, "1", "three minutes of two cores";
        /// Replicas at most, of each size and with nothing hidden.
        most: usize = 1000, "1", "guess; hours for one effect";
        /// Replicas in which nothing is hidden, at least.
        fault_free: usize = 12, "1", "guess; with none alarmed, Wilson's interval ends at a quarter";
        /// Beginning of each recording and reference that is driven again.
        seconds: f64 = 12.0, "s", "three minutes of two cores";
        /// Recordings that are driven again, at most.
        recordings: usize = 2, "1", "three minutes of two cores; a correction is compared on those left out of the fit";
        /// References of a replica, at most.
        references: usize = 3, "1", "three minutes of two cores";
        /// Share of replicas from which on an effect counts as found.
        wanted: f64 = 0.5, "1", "guess; found more often than not";
    }

    /// What is rehearsed by the equations of a fit unless the caller says otherwise.
    plan_of_fit: PlannedOfFit {
        /// Sizes that are hidden, in usual sizes of the cause.
        sizes: [f64; 4] = [0.125, 0.25, 0.5, 1.0], "1", "guess; octaves up to what such a cause usually has";
        /// Replicas of each size.
        replicas: usize = 40, "1", "seconds of two cores";
        /// Replicas in which nothing is hidden, at least.
        fault_free: usize = 200, "1", "guess; with none alarmed, Wilson's interval ends at two per cent";
    }

    /// What is rehearsed of responses to commands unless the caller says otherwise.
    plan_of_response: PlannedOfResponse {
        /// Sizes that are hidden, in sizes of interest.
        sizes: [f64; 3] = [0.25, 0.5, 1.0], "1", "guess; octaves up to the size below which nobody would act";
        /// Replicas of each size.
        replicas: usize = 3, "1", "four minutes of two cores for five minutes of driving";
        /// Replicas in which nothing is hidden, at least.
        fault_free: usize = 12, "1", "guess; with none alarmed, Wilson's interval ends at a quarter";
    }

    /// What is rehearsed of steady loads unless the caller says otherwise.
    plan_of_loads: PlannedOfLoads {
        /// Sizes that are hidden, in sizes of interest.
        sizes: [f64; 3] = [1.0, 2.0, 4.0], "1", "guess; octaves from the size below which nobody would act: loads of one floor scatter by as much";
        /// Replicas of each size.
        replicas: usize = 3, "1", "four minutes of two cores";
        /// Replicas in which nothing is hidden, at least.
        fault_free: usize = 24, "1", "guess; with none alarmed, Wilson's interval ends at a seventh";
    }

    /// Robots that are drawn about the robot file.
    constants: Constants {
        /// Farthest move of a constant, in the robot file's sigmas.
        farthest: f64 = 2.0, "1", "guess; what a robot file states is hardly ever worse";
        /// How far constants differ from drive to drive, one sigma in the robot file's sigmas.
        between_drives: f64 = 0.05, "1", "guess; friction, known to 13 %, varies by 0.5 to 1 % from drive to drive";
        /// Draws of a robot that can exist.
        tries: usize = 20, "1", "numerical guard";
    }

    /// Noise of sensors.
    noise: Noises {
        /// Samples of a channel that tell its noise, at least.
        least_samples: usize = 50, "1", "guess";
        /// Noise of a wheel angle where the recordings show none, one sigma.
        angle: f64 = 1e-4, "rad", "data sheets: encoders of 16384 counts";
        /// Noise of a gyro where the recordings show none, one sigma.
        gyro: f64 = 0.005, "rad/s", "data sheets of MEMS gyros at 100 Hz";
        /// Noise of an accelerometer where the recordings show none, one sigma.
        acceleration: f64 = 0.05, "m/s²", "data sheets of MEMS accelerometers at 100 Hz";
        /// Noise of a heading where the recordings show none, one sigma.
        heading: f64 = 0.004, "rad", "guess; as a pose of 4 mm on a robot of a metre";
        /// Time between wheel angles whose differences add up to how far a wheel turns.
        apart: f64 = 0.1, "s", "guess; long beside the noise of angles, short beside manoeuvres";
        /// Sigma below which a channel shows no noise, as a share of the usual one.
        none: f64 = 0.01, "1", "guess; a simulator's log";
    }

    /// Telling which effects can be seen at all.
    seen: Seen {
        /// Largest change of any recorded channel, in its noise, that counts as none.
        nothing: f64 = 0.01, "1", "guess; far below what averaging over a drive shows";
        /// Share of the recorded way below which a replica is told to have hardly moved.
        slowed: f64 = 0.5, "1", "guess";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
