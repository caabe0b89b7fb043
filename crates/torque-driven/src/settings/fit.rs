//! Free runs, fits and the calibration on the references.

use crate::channel::ByQuantity;

::settings::settings! {
    /// What fits and calibration were tuned with.
    pub(crate) struct Settings;

    /// Free runs of the plant.
    simulation: Simulation {
        /// Integration step of a speed-driven robot.
        step_at_speed: f64 = 2e-3, "s", "guess";
        /// Torques that are remembered at most: a handful of drives for each of a few recordings.
        remembered: usize = 24, "1", "guess";
    }

    /// What differs a little from run to run.
    deviations: Deviations {
        /// Relative standard deviation of the adhesion between runs, before the common factor.
        adhesion: f64 = 0.004, "1", "guess";
        /// The same of the rolling resistance.
        rolling_resistance: f64 = 0.01, "1", "guess";
        /// The same of the dry friction of each side.
        dry_friction: f64 = 0.01, "1", "guess";
        /// The same of the viscous friction.
        viscous_friction: f64 = 0.005, "1", "guess";
        /// Standard deviation of the gyro's offset between runs.
        gyro: f64 = 0.0015, "rad/s", "guess";
        /// The same of both offsets of the accelerometer.
        acceleration: f64 = 0.03, "m/s²", "guess";
    }

    /// How far constants move from one visit to another; the table of constants says how far each moves usually.
    between_visits: BetweenVisits {
        /// Common factors of the moves between visits that are tried where the references are of several visits.
        factors: [f64; 9] = [0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0], "1", "guess; steps of √2";
        /// Width of the log-normal prior of that factor, whose median is 1, in its logarithm.
        factor_width: f64 = 0.7, "1", "guess: a factor of two either way is usual";
    }

    /// Gauss–Newton in free run.
    fit: Fit {
        /// Gain below which a fit has arrived.
        least_gain: f64 = 0.05, "nats", "guess, far below what decides between hypotheses";
        /// Finite step of a constant of the robot, in its sigma.
        constant_step: f64 = 0.05, "1", "measured without references: with 0.3 fits stopped where moves of 0.03 still changed the misfit by 13 nats";
        /// Move of every constant, in its sigma, up to which loose constants keep their columns.
        same_columns: f64 = 0.2, "1", "guess: less than what constants are told to";
        /// Without references: factor of the steps that a fit may take.
        patience_by_file: usize = 3, "1", "measured on four robots without references: with 1 fits ended 9 to 30 nats above where they arrive";
        /// Damping of a fit's first step where constants are loose, share of each diagonal.
        first_damping: f64 = 0.1, "1", "measured without references: of 0.1, 0.01 and 0.001 the one that arrived most often";
        /// Finite step of an effect's value, in its unit.
        effect_step: f64 = 0.1, "1", "guess";
        /// Least finite step of an effect's value, as a share of the value.
        least_effect_step: f64 = 0.02, "1", "guess";
        /// Tuning beyond so many sigmas is no tuning.
        farthest: f64 = 6.0, "1", "guess";
        /// At most so many units of an effect's value at once: a linear column says nothing beyond.
        longest: f64 = 2.0, "1", "guess";
        /// A whiff of a prior on strengths keeps what the data do not determine where it is: its information per unit.
        whiff: f64 = 1e-3, "1", "numerical guard";
        /// The same where a sigma is stated: so little that it narrows none.
        whiff_of_sigmas: f64 = 1e-6, "1", "numerical guard";
    }

    /// Constants and noise from the references.
    calibration: Calibrating {
        /// Typical residual of each channel, the standard deviation to start with.
        first_sigma: ByQuantity = ByQuantity {
            wheel_speed: 0.3,
            yaw_rate: 0.04,
            forward_velocity: 0.03,
            lateral_velocity: 0.012,
            forward_acceleration: 0.12,
            lateral_acceleration: 0.08,
        }, "rad/s, rad/s, m/s, m/s, m/s², m/s²", "typical residuals";
        /// No channel is trusted beyond this share of its typical residual.
        least_share: f64 = 0.1, "1", "guess";
        /// Gauss–Newton steps, with the channels' variances renewed after each.
        steps: usize = 4, "1", "guess";
        /// Move of every constant below which more steps are needless, share of its sigma.
        settled: f64 = 0.002, "1", "guess";
        /// Gauss–Newton steps after the spread between runs has been chosen.
        last_steps: usize = 2, "1", "guess";
        /// Common factors of the run-to-run deviations that are tried.
        spreads: [f64; 6] = [0.6, 0.9, 1.3, 1.9, 2.7, 3.8], "1", "guess";
        /// Common factor to start with, and the median of its log-normal prior.
        usual_spread: f64 = 1.3, "1", "guess";
        /// Width of that prior in the logarithm.
        spread_width: f64 = 0.6, "1", "guess";
        /// Correlation of the errors of left and right dry friction in a robot file.
        coulomb_correlation: f64 = 0.8, "1", "guess: one owner, one gearbox type, one measurement";
        /// References below which no channel is trusted beyond what a tuned simulation of a robot usually leaves.
        enough_references: usize = 2, "1", "formula: one drive cannot be left out to see what a fit to the others leaves of it";
        /// Without references, and with too few: what a tuned simulation of a robot leaves in each channel.
        usual_residual: ByQuantity = ByQuantity {
            wheel_speed: 0.12,
            yaw_rate: 0.03,
            forward_velocity: 0.02,
            lateral_velocity: 0.012,
            forward_acceleration: 0.12,
            lateral_acceleration: 0.10,
        }, "rad/s, rad/s, m/s, m/s, m/s², m/s²", "references of the 72 development cases (fault-free drives)";
        /// Without references: sigmas of yaw inertia, height of the centre of mass and slip at the peak of adhesion, in
        /// those of the robot file: fault-free robots push these constants, since their true laws are not the plant's.
        wider: f64 = 2.0, "1", "a prototype without references and a look at the 72 development cases";
        /// Without references: sigmas of the motor inertia, for the same reason.
        wider_motor_inertia: f64 = 4.0, "1", "a look at the 72 development cases without their references";
        /// Without references: change of a channel's residual beyond which the search is repeated.
        repeat_change: f64 = 0.12, "1", "the same prototype";
        /// Without references: searches at most.
        most_searches: usize = 3, "1", "guess";
        /// Power with which the misfit grows where recordings are driven harder than any reference.
        beyond: f64 = 2.0, "1", "formula: what a law that is not the robot's leaves grows with what it scales, and squares with its square";
        /// Driving up to which nothing is called hard, in what is usual for speed, turning and their changes.
        least_driving: f64 = 0.5, "1", "guess";
        /// Segments at the middle that a kernel mean over kinds of driving begins with.
        pseudo_counts: f64 = 2.0, "1", "guess";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
