//! Sensor faults that two sensors show without any force law.

::settings::settings! {
    /// What the checks of sensors against each other were tuned with.
    pub(crate) struct Settings;

    /// Probability of a fault of a sensor.
    faults: Faults {
        /// Usual size of a fault, in the size that matters.
        usual: f64 = 3.0, "1", "guess";
        /// Price of any fault of a sensor, to which its rarity is added.
        price: f64 = 3.0, "nats", "guess: one robot in twenty";
        /// The surest that a fault can be: what the checks do not know of may look like it.
        surest: f64 = 0.99, "1", "guess";
    }

    /// Recordings judged against references.
    pool: Pool {
        /// A difference is reported when it exceeds so many sigma, and what matters.
        sure: f64 = 4.0, "1", "guess";
        /// Run-to-run spread that is expected beforehand, as a share of the size that matters.
        usual_spread: f64 = 0.25, "1", "guess";
        /// Runs that this expectation is worth: three or four runs alone tell a spread badly.
        worth: f64 = 4.0, "1", "guess";
        /// A run has a say when its sigma is below this share of the size that matters.
        determined: f64 = 0.5, "1", "guess";
        /// Share of a column's square that keeps collinear columns apart: what it decides gets a huge sigma.
        ridge: f64 = 1e-9, "1", "numerical guard";
    }

    /// Encoders against the speed of the pose.
    wheels: Wheels {
        /// Time over which speeds are compared.
        span: f64 = 0.4, "s", "guess";
        /// Slowest wheel that counts.
        slowest: f64 = 1.5, "rad/s", "guess";
        /// Most turning per driving of a bend in which wheels still roll.
        bend: f64 = 1.5, "rad/m", "guess; a circle of two thirds of a metre";
        /// Error of the wheel radius in a robot file, one sigma, where no references show it.
        usual: f64 = 0.05, "share", "guess; tyres under load, and what they slip";
        /// Share of the size that matters up to which the other side may be off then.
        other: f64 = 0.5, "1", "guess";
        /// Fewest stretches of driving and of braking.
        fewest: usize = 4, "1", "guess";
        /// Slip of driving wheels where a drive hardly ever brakes, one sigma.
        slip: f64 = 0.03, "share", "guess; hard ground, far from what tyres hold";
        /// The size of which scales of drives have the usual spread of runs as a share, beside references.
        differ: f64 = 0.15, "share", "guess; slip differs from drive to drive by some per cent";
        /// Sigmas from which on a stretch is far off.
        far: f64 = 3.0, "1", "guess; a wheel that spins for a moment";
    }

    /// The accelerometer against the pose.
    acceleration: Acceleration {
        /// Usual bias along x and y and angle of an accelerometer, one sigma, where no references show it.
        usual: [f64; 3] = [0.1, 0.1, 0.03], "m/s², m/s², rad", "guess; a sensor of a few hundredths of g that is mounted by eye";
        /// Half of the time over which a second difference of the pose is taken.
        half: f64 = 1.0, "s", "guess";
        /// Noise of the pose that smoothing allows; only the heading is used of it.
        pose_sigma: f64 = 0.004, "m", "guess";
        /// Fewest poses of a run that has a say.
        least_poses: usize = 20, "1", "guess";
    }

    /// Clocks against each other.
    clocks: Clocks {
        /// Rows on each side over which a rate is averaged.
        around: usize = 5, "1", "guess";
        /// Poses that tell as much as one: their noise is white, but the errors of what they are compared with are not.
        alike: f64 = 3.0, "1", "guess";
        /// Usual delay between gyro and pose, s, and its growth, s/s, which nobody calls a fault: one sigma, where no references show it.
        usual: [f64; 2] = [0.01, 3e-4], "s, s/s", "guess; a period of usual motion capture and its network; timers that are read apart";
        /// Sigmas by which the wheels' turning must show in a sensor before its delay against them is reported.
        least_gain: f64 = 3.0, "1", "guess";
    }

    /// Jumps of the wheel angle.
    jumps: Jumps {
        /// Steps on each side of a jump that tell the usual step.
        around: usize = 5, "1", "guess";
        /// Steps on each side of a jump that must agree with the usual one.
        beside: usize = 2, "1", "guess";
        /// Most by which the steps beside a jump differ from the usual one, as a share of the smallest jump.
        steady: f64 = 0.3, "1", "guess";
        /// Sigmas of the references' count, a rare event's, by which the recordings must have more jumps.
        sure: f64 = 4.0, "1", "guess";
    }

    /// The gyro against the heading of the pose.
    gyro: Gyro {
        /// Yaw travel below which a gyro's scale cannot be measured.
        least_travel: f64 = 3.0, "rad", "guess";
        /// Poses that tell as much as one: errors of a pose and of an integrated gyro last about a second.
        alike: f64 = 10.0, "1", "guess";
        /// Fewest poses of a run that has a say.
        least_poses: usize = 20, "1", "guess";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
