//! The tuned numbers of this crate.

::settings::settings! {
    /// Tuned numbers of the comparison of cars with the single-track model.
    pub(crate) struct Settings;

    /// Drives that would tell the remaining answers apart.
    next_drive: NextDrive {
        /// Time in which the car comes to the speed that it should have.
        follows: f64 = 0.3, "s", "guess; a driver";
        /// Speed below which bends are asked for as at this one.
        stands: f64 = 0.1, "m/s", "guess";
        /// Throttle with which a car drives.
        usual_throttle: f64 = 0.2, "1", "guess";
    }

    /// Clocks of car and pose that are farther apart than a fit finds. Grids and limits are those of wheel counts.
    clock: Clock {
        /// Delay up to which a fit finds it by itself.
        apart: f64 = 0.4, "s", "guess; the fit is linear over the time in which a car turns in";
        /// Clocks are looked at where speed and turning differ by more than this share of their mean.
        wrong: f64 = 0.06, "1", "guess; gyro and encoder are known to some per cent, and wheels slip by as much";
        /// Longest time between messages that a line bridges.
        held: f64 = 0.3, "s", "guess; three messages at 10 Hz";
        /// What offsets and rates of single drives are resolved to, one sigma.
        resolution: [f64; 2] = [0.03, 3e-4], "s, 1", "guess; a third of the time between messages, over a minute and a half";
        /// Sigmas from which a rate is one.
        sure: f64 = 3.0, "1", "guess";
        /// Probability of what is measured so.
        probability: f64 = 0.99, "1", "guess; gyro and encoder agree with the pose by it, and with nothing else";
    }

    /// Rows of a recording and the grid of the model.
    grid: Grid {
        /// Step of the model.
        step: f64 = 0.02, "s", "a tenth of the fastest lateral time constant of small cars' tyres that still shows";
        /// Gaps of the pose that are bridged.
        gap: f64 = 0.15, "s", "guess; a pose at 10 Hz, whose stamps scatter; a line through it errs by 8 mm at 3 m/s²";
        /// Half length over which velocities are taken from the pose for fits.
        smoothing: f64 = 0.1, "s", "guess; averages a good pose's noise to millimetres per second";
        /// Rows below which a drive is refused.
        rows: usize = 20, "1", "guess; two seconds of a car that reports at 10 Hz";
        /// Time between two rows beyond which a drive is refused: times in milliseconds look like that.
        apart: f64 = 0.5, "s", "guess; half a window; a thousand rows per second in milliseconds are 1 apart";
        /// Largest share of the commands' range that a throttle or steering command may exceed.
        command: f64 = 0.05, "1", "guess; rounding and trims";
    }

    /// Telling columns in other units than the robot file says.
    units: Units {
        /// Stretches over which gyro and encoder are compared with the pose.
        stretch: f64 = 0.5, "s", "guess; long beside delays of channels and noise of a pose";
        /// So many stretches with motion tell a unit, at least.
        stretches: usize = 10, "1", "guess: five seconds";
        /// Least yaw rate of the pose that counts.
        turning: f64 = 0.2, "rad/s", "guess";
        /// Least speed of the pose that counts.
        moving: f64 = 0.1, "m/s", "guess";
        /// Factor within which a ratio is that of two units.
        near: f64 = 1.25, "1", "guess; scales of sensors are known to a few per cent, and the least factor of units is 3.6";
        /// Factor within which most stretches have the same ratio, else it is of no unit.
        steady: f64 = 1.15, "1", "guess; a unit is the same everywhere, wheels that spin are not";
        /// Least steering angle of stretches in which the car is compared with its steering.
        steered: f64 = 0.1, "rad", "guess; beyond offsets and play";
        /// Least throttle of these: backward a car turns the other way.
        forward: f64 = 0.03, "1", "guess; noise of a command";
        /// Stretches in which a car turns to one side, as a share of all, from which on it does.
        one_sided: f64 = 0.8, "1", "guess; a car that slides or rolls back for a moment";
        /// Turning over that of the steering, below which x and y are in another unit, and beyond which yaw is.
        steered_factors: [f64; 2] = [0.03, 15.0], "1", "guess; the least factors of units are 100 and 57, and cars understeer threefold at most";
        /// A step of yaw by this share of a turn of 2 pi is where it wraps around.
        wrap: f64 = 0.5, "1", "definition";
    }

    /// Steps of the model.
    model: Model {
        /// Speed below which slip angles are taken as if at this speed.
        slow: f64 = 0.1, "m/s", "guess; slip angles are not defined at rest";
        /// Least compliance of a tyre: below it the step gives the kinematic car.
        least_compliance: f64 = 1e-4, "rad s²/m", "a hundredth of usual tyres'";
        /// Least distance of the centre of mass from the front axle, share of the wheelbase.
        least_share: f64 = 0.1, "1", "guess; no car stands on its front wheels alone";
        /// Gravity.
        gravity: f64 = 9.81, "m/s²", "definition";
        /// Shape factor C of the Pacejka tyre of the rival.
        pacejka_shape: f64 = 1.4, "1", "Pacejka, Tyre and Vehicle Dynamics: 1.3 to 1.65 for side force";
        /// Throttle beyond the dead zone at which a motor is switched on in full.
        throttle_on: f64 = 0.02, "1", "guess; a step of the throttle of usual remote controls";
        /// Least distances and rates that count as above none.
        tiny: f64 = 1e-9, "1", "far above rounding, far below anything measured";
    }

    /// Windows over which motion and model are compared.
    windows: Windows {
        /// Length of a window.
        length: f64 = 1.0, "s", "guess; half of the forecasts, several lags of usual servos";
        /// Distance of their beginnings.
        every: f64 = 0.5, "s", "guess; half a window";
        /// Messages of the car within the smoothing of the pose, fewer than which are compared as they are.
        smoothed: usize = 3, "1", "definition: one on either side";
        /// Weight of a row of the pose beside the others of its window.
        shared: f64 = 0.5, "1", "guess; middle and end of a window share the errors of its start";
        /// Metres that a heading error of one radian costs.
        lever: f64 = 1.0, "m/rad", "guess; the way in a second at 1 m/s";
        /// Largest error of a row, in the unit of its kind.
        ceiling: f64 = 30.0, "m; rad/s; m/s", "guess; far above what small cars do in a second";
        /// Least sigmas of position and heading, gyro, encoder.
        floor: [f64; 3] = [1e-3, 5e-3, 5e-3], "m; rad/s; m/s", "guess; good motion capture, noise of small sensors";
        /// Way in a window, or speed, below which the car stands.
        moving: f64 = 0.05, "m; m/s", "guess";
        /// Remaining error of windows over their way, beyond which fits begin from another place, too.
        near: f64 = 0.04, "1", "guess; twice what a good answer leaves";
        /// Windows in motion below which nothing is fitted.
        least: usize = 8, "1", "guess";
        /// Step of finite differences, shares of a cause's usual size.
        difference: f64 = 0.01, "1", "guess; the dead zone's corner is crossed by few rows";
        /// The same of the time that the steering takes for a radian: small ones change nothing, for no step is that fast.
        difference_of_rate: f64 = 0.3, "1", "guess; 0.15 s/rad, which a step of 0.3 rad shows";
    }

    /// Fits of all constants.
    fitting: Fitting {
        /// Farthest a constant may move, usual sizes and sigmas together.
        farthest: f64 = 3.0, "1", "guess; normal priors leave a thousandth beyond";
    }

    /// Values that cars have where the robot file does not say, and how well they are known: one sigma.
    known: Known {
        /// Steering angle at full command.
        full: [f64; 2] = [0.45, 0.15], "rad; share", "usual linkages of small and large cars";
        /// Centre of the steering.
        centre: f64 = 0.03, "rad", "guess; trim of a hobby servo";
        /// Steering angle that is not in proportion to the command.
        curve: f64 = 0.02, "rad", "guess; linkages";
        /// Delays, lags.
        delay: f64 = 0.02, "s", "guess; a few periods of usual logs";
        /// Time that the steering takes for a radian.
        slowness: f64 = 0.1, "s/rad", "usual servos take 0.05 to 0.2 s for 60 degrees";
        /// Play of the steering.
        play: f64 = 0.005, "rad", "guess";
        /// Distances.
        distance: f64 = 0.01, "share", "a tape measure";
        /// Tyre compliance: slip angle for a sideways acceleration.
        compliance: f64 = 1.5e-3, "rad s²/m", "guess; less than a tenth of usual tyres'";
        /// Inverse of the largest sideways acceleration.
        inverse_grip: f64 = 0.02, "s²/m", "guess; less than a fifth of usual tyres'";
        /// Yaw inertia over mass times the square of the wheelbase.
        gyration: f64 = 0.104, "1", "a uniform rectangle half as wide as long: 1.25 / 12";
        /// Yaw inertia.
        inertia: f64 = 0.3, "share", "guess; a rectangle for a car";
        /// Acceleration at full throttle.
        gain: [f64; 2] = [10.0, 1.5], "m/s²; share", "small electric cars; nothing is known of a motor not stated";
        /// Throttle at which the motor begins to turn.
        dead_zone: [f64; 2] = [0.05, 0.15], "1", "usual drivers; nothing is known of a motor not stated";
        /// Loss of acceleration with speed and throttle: back-EMF.
        back_emf: [f64; 2] = [1.0, 3.0], "1/s", "a top speed of 10 m/s; nothing is known of a motor not stated";
        /// Dry friction of the drive.
        friction: [f64; 2] = [0.5, 1.5], "m/s²", "small gears; nothing is known of a drive not stated";
        /// Viscous friction of the drive.
        viscous: [f64; 2] = [0.3, 1.0], "1/s", "nothing is known of a drive not stated";
        /// Loss of acceleration with speed while there is throttle at all: back-EMF of a motor that rolls free without.
        motor_braking: [f64; 2] = [0.5, 1.5], "1/s", "nothing is known of a motor not stated";
        /// Deceleration with the square of the speed.
        drag: [f64; 2] = [0.05, 0.1], "1/m", "air and tyres; nothing is known of a car not stated";
        /// Lag of the motor.
        drive_lag: [f64; 2] = [0.05, 0.1], "s", "nothing is known of a motor not stated";
        /// Dead time of the motor.
        drive_delay: [f64; 2] = [0.01, 0.04], "s", "buses and drivers; nothing is known of a motor not stated";
        /// Slope of the ground.
        slope: f64 = 0.005, "rad", "guess; floors of buildings";
        /// Place of the tracked point.
        point: f64 = 0.005, "m", "a tape measure";
        /// Direction of the tracked axes.
        direction: f64 = 0.035, "rad", "two degrees: by eye";
        /// Scale of the gyro.
        gyro_scale: f64 = 0.02, "share", "data sheets of small gyros";
        /// Bias of the gyro.
        gyro_bias: f64 = 0.01, "rad/s", "data sheets of small gyros, after a start at rest";
        /// Slip of the driven wheels over the square of the sideways acceleration.
        wheel_slip: f64 = 3e-4, "s⁴/m²", "guess; a hundredth at 6 m/s²";
        /// Radius of the wheels that the encoder's speed is computed with.
        radius: f64 = 0.02, "share", "guess; rubber under load";
        /// Share of the usual sigma below which an owner knows more of a number than is usual.
        as_usual: f64 = 0.999, "share", "rounding in files";
    }

    /// By how much a number of the owner's differs from that of the model because a car has another law than the model: one
    /// sigma, beside that of the owner.
    form: Form {
        /// Times of steering, drive and sensors.
        time: f64 = 0.012, "s", "guess; a servo of second order and one with a lag agree to a part of their times";
        /// Acceleration at full throttle.
        drive_gain: f64 = 0.08, "share", "guess; a motor's push is no straight line over throttle and speed";
        /// Dead zone of the throttle.
        dead_zone: f64 = 0.012, "1", "guess; dry friction is part of what an owner finds";
        /// Steering angle at full command.
        full: f64 = 0.02, "share", "guess; linkages, and axles that steer with load";
    }

    /// The same of a number that is told, whose interval is wider by it.
    told: Told {
        /// Times of steering, drive and sensors.
        time: f64 = 0.006, "s", "half of what an owner's number may differ by";
        /// The same, of the time itself; and of the play and the drive.
        share: f64 = 0.05, "share", "guess; a lag before a servo is no lag";
        /// Largest rate of the steering.
        rate: f64 = 0.1, "share", "a look at a simulated car of our own: 0.69 s for a radian where a servo that holds its rate takes 0.6";
        /// Compliance of tyres and the inverse of their grip.
        tyre: f64 = 0.22, "share", "brush tyres give way by 1.1 to 1.3 times their compliance at half of their grip: root mean square";
        /// Scales of gyro and encoder.
        scale: f64 = 0.005, "share", "guess; a parabola cuts the tops of fast turns";
        /// Place of the tracked point.
        point: f64 = 1e-3, "m", "guess; slip of tyres looks like another place";
    }

    /// Usual sizes of causes: one sigma about none.
    usual: Usual {
        /// Steering gain.
        gain: f64 = 0.4, "share", "guess";
        /// Steering centre.
        centre: f64 = 0.1, "rad", "guess";
        /// Steering angle out of proportion.
        curve: f64 = 0.1, "rad", "guess";
        /// Delays and lags.
        delay: f64 = 0.15, "s", "guess";
        /// Time that the steering takes for a radian.
        slowness: f64 = 0.5, "s/rad", "guess; slow servos";
        /// Play of the steering.
        play: f64 = 0.05, "rad", "guess";
        /// Distances.
        distance: f64 = 0.1, "share", "guess; a tape measure read at the wrong end, another body of the same car; with half of it a real car is forecast 92 instead of 64 mm off after 2 s";
        /// Place of the centre of mass.
        centre_of_mass: f64 = 0.01, "share", "guess; axle loads tell it, drives hardly do";
        /// Tyre compliance.
        compliance: f64 = 0.02, "rad s²/m", "tyres of small cars: 0.2 rad at 1 g";
        /// Inverse of the largest sideways acceleration.
        inverse_grip: f64 = 0.15, "s²/m", "a friction coefficient of 0.7";
        /// Yaw inertia.
        inertia: f64 = 0.3, "share", "guess; a rectangle for a car";
        /// Acceleration at full throttle.
        drive_gain: f64 = 0.5, "share", "guess; a battery that is empty, another gear";
        /// Dead zone of the throttle.
        dead_zone: f64 = 0.1, "1", "guess";
        /// Back-EMF.
        back_emf: f64 = 2.0, "1/s", "guess";
        /// Dry friction.
        friction: f64 = 1.0, "m/s²", "guess";
        /// Viscous friction.
        viscous: f64 = 0.5, "1/s", "guess";
        /// Dead time of the motor.
        drive_delay: f64 = 0.04, "s", "as it is known";
        /// Loss of acceleration with speed while there is throttle.
        motor_braking: f64 = 1.0, "1/s", "guess";
        /// Deceleration with the square of the speed.
        drag: f64 = 0.1, "1/m", "guess";
        /// Slope of the ground.
        slope: f64 = 0.03, "rad", "guess; two degrees";
        /// Place of the tracked point.
        point: f64 = 0.05, "m", "guess";
        /// Direction of the tracked axes.
        direction: f64 = 0.1, "rad", "guess";
        /// Scale of the gyro.
        gyro_scale: f64 = 0.1, "share", "guess";
        /// Bias of the gyro.
        gyro_bias: f64 = 0.05, "rad/s", "guess";
        /// Scale of the encoder.
        encoder: f64 = 0.3, "share", "guess; gears and counted edges";
        /// Slip of the driven wheels over the square of the sideways acceleration.
        wheel_slip: f64 = 2e-3, "s⁴/m²", "a look at eight drives of an open 1:10 car: 1 to 5 % at 5 to 6 m/s², 3 to 16 % at 6 to 8";
    }

    /// By how much constants differ from drive to drive although nothing is changed: one sigma, before the drives themselves
    /// are asked.
    scatter: Scatter {
        /// Steering gain.
        gain: f64 = 0.01, "share", "guess; a servo's voltage";
        /// Steering centre.
        centre: f64 = 0.004, "rad", "guess; play and trims";
        /// Steering angle out of proportion, play.
        curve: f64 = 1e-3, "rad", "guess";
        /// Delays and lags.
        delay: f64 = 0.005, "s", "guess; clocks are set up anew";
        /// Tyre compliance.
        compliance: f64 = 1e-3, "rad s²/m", "guess; floor and temperature";
        /// Inverse of the largest sideways acceleration.
        inverse_grip: f64 = 0.005, "s²/m", "guess; floor and temperature";
        /// Acceleration at full throttle.
        drive_gain: f64 = 0.05, "share", "guess; state of the battery";
        /// Dead zone of the throttle.
        dead_zone: f64 = 0.005, "1", "guess";
        /// Friction, dry.
        friction: f64 = 0.05, "m/s²", "guess; temperature of gears";
        /// Friction, viscous, and back-EMF.
        viscous: f64 = 0.03, "1/s", "guess; temperature of gears";
        /// Deceleration with the square of the speed.
        drag: f64 = 0.005, "1/m", "guess; floor and temperature of tyres";
        /// Slope of the ground.
        slope: f64 = 2e-3, "rad", "guess; another part of the floor";
        /// Place of the tracked point.
        point: f64 = 1e-3, "m", "guess; motion capture is set up anew";
        /// Direction of the tracked axes.
        direction: f64 = 2e-3, "rad", "guess; motion capture is set up anew";
        /// Scales of gyro and encoder.
        scale: f64 = 2e-3, "share", "guess; temperature";
        /// Slip of the driven wheels over the square of the sideways acceleration.
        wheel_slip: f64 = 1e-4, "s⁴/m²", "guess; floor and temperature";
        /// Bias of the gyro.
        bias: f64 = 3e-3, "rad/s", "guess; temperature";
        /// Geometry.
        geometry: f64 = 1e-4, "share", "nothing moves";
    }

    /// Forecasts from throttle and steering alone.
    forecast: Forecast {
        /// Lengths of forecasts.
        lengths: [f64; 3] = [0.5, 1.0, 2.0], "s", "horizons of predictive controllers of small cars";
        /// Distance of their beginnings.
        every: f64 = 0.5, "s", "guess";
        /// Way below which a forecast is of a car that stands, and does not count.
        way: f64 = 0.1, "m", "guess; a hundred times the noise of a good pose";
        /// Past over which velocities at the start are taken, of which one is chosen on the other drives.
        past: [f64; 3] = [0.14, 0.2, 0.3], "s", "guess; noise against delay";
        /// Times after which what a drive said of itself has faded to 1/e, of which one is chosen on the other drives.
        fading: [f64; 4] = [1.0, 2.0, 5.0, 20.0], "s", "guess; manoeuvres, batteries";
        /// Commands before the start from which the state of steering and drive comes.
        warm: f64 = 2.0, "s", "guess; ten lags of a slow servo";
        /// Factors on the scatter of drives within a drive, of which one is chosen on the other drives.
        freedom: [f64; 3] = [1.0, 3.0, 10.0], "1", "guess; constants of a manoeuvre differ more than those of a drive";
    }

    /// Sensors beside the pose.
    sensors: Sensors {
        /// By how much the share that a sensor shows of large sizes differs from that of small ones, from which on no scale does it.
        uneven: f64 = 0.15, "share", "guess; driven wheels slip by some per cent more where a car is fast";
        /// Rows of a sensor below which nothing is said.
        least: usize = 200, "1", "guess: ten seconds of twenty rows each";
        /// Share of what readings just before and after show that a reading has to share with them, below which nothing is said.
        reliable: f64 = 0.5, "share", "guess; half of it is noise of the pose then";
    }

    /// When something is left that no cause accounts for.
    unexplained: Unexplained {
        /// Remaining error of windows over their way, beyond which what is left asks for a cause.
        share: f64 = 0.15, "1", "guess; a car that is off by a metre in seven";
        /// Error with causes over that of constants re-tuned within what is known, from which on the causes are not needed.
        hardly: f64 = 1.0, "1", "causes that leave no less; 0.7 took back what was hidden in 4 of 36 drawn cars";
        /// Remaining error over the way, beyond which nothing is explained, however much more was left before.
        most: f64 = 0.2, "1", "guess; of 40 cars of two hands answers that are right leave 0.02 and less, two that are not 0.17 and 0.35";
        /// The same beyond which the columns are to be checked first.
        columns: f64 = 0.45, "1", "guess; wrong signs and units leave half of the motion and more";
        /// The same from which on something unknown is likelier where nothing is called missing and no reference says what is usual.
        doubted: f64 = 0.03, "1", "guess; sound cars of two other hands leave 0.007";
        /// Share of the re-tuned error that has to be left then.
        of_retuned: f64 = 0.8, "1", "guess";
    }

    /// Drives beside their simulations, on pages and in pictures.
    traces: Traces {
        /// Time over which a simulation runs free.
        free: f64 = 2.0, "s", "equal to the longest forecasts";
        /// Past over which velocities at its start are taken.
        past: f64 = 0.2, "s", "guess; the middle of those of forecasts";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
