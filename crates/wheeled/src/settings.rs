//! The tuned numbers of this crate.

::settings::settings! {
    /// Tuned numbers of the comparison of robots of any wheels with what the torques of their motors imply.
    pub(crate) struct Settings;

    /// Rows of a recording and the grid of the model.
    grid: Grid {
        /// Distance of the instants at which drive and model are compared.
        step: f64 = 0.02, "s", "equal to that of cars";
        /// Steps of the plant in one of the grid.
        substeps: usize = 4, "1", "guess; 5 ms: implicit in all speeds";
        /// Gaps of a channel that are bridged.
        gap: f64 = 0.1, "s", "guess; motion hardly changes within it";
        /// Gaps of the pose that are bridged.
        pose_gap: f64 = 0.25, "s", "guess; a pose at 10 Hz of which one is missing, off by a centimetre at usual accelerations";
        /// Share of a pose by which a number of them may fall short of a whole one.
        whole: f64 = 1e-3, "1", "rounding of times";
        /// Times the usual distance up to which poses count as evenly apart.
        even: f64 = 1.2, "1", "guess";
        /// How well wheels and gyro show velocity and yaw rate of the body at an instant, one sigma.
        by_wheels: [f64; 2] = [0.01, 0.01], "m/s, rad/s", "guess; noise of encoders over a few rows, and what wheels slip beside the model";
        /// The same of sideways velocity, of robots whose wheels have no rollers.
        sideways: f64 = 0.05, "m/s", "guess; such wheels slide by some hundredths on slopes and in bends: with 0.01 a slope of 0.035 rad was told as 0.029";
        /// Share of the wheels below which they are not looked at.
        little: f64 = 0.05, "1", "guess; a good pose alone is faster";
        /// Half length over which velocities are taken from the pose.
        smoothing: f64 = 0.1, "s", "guess; averages a good pose's noise to millimetres per second";
        /// Half length over which speeds of wheels and gyro are taken at the start of a window: longer ones take a step of the torque
        /// for a lag.
        speeds: f64 = 0.04, "s", "guess; two steps of the grid";
        /// Steps of the grid in which wheels come to slip as they must, at the start of a drive without a pose.
        settling: usize = 5, "1", "guess; 0.1 s, longer than light wheels take";
        /// Rows below which a drive is refused.
        rows: usize = 50, "1", "guess; a second at 50 Hz";
        /// Time between two rows beyond which a drive is refused: times in milliseconds look like that.
        apart: f64 = 0.5, "s", "guess; half a window";
        /// Time over which motors and joints settle before a window.
        warm: f64 = 0.3, "s", "guess; several lags of usual current loops";
    }

    /// Drives that would tell the remaining answers apart.
    next_drive: NextDrive {
        /// Distance of the instants at which the drives that were made show how fast the robot goes.
        looked: f64 = 0.2, "s", "guess";
        /// Time in which a motor comes to the speed that it should have.
        follows: f64 = 0.15, "s", "guess; usual speed controllers";
        /// Speed below which a steered wheel keeps its direction.
        stands: f64 = 0.01, "m/s", "guess";
    }

    /// Telling columns in other units than the robot file says.
    units: Units {
        /// Stretches over which gyro and wheels are compared with the pose.
        stretch: f64 = 0.5, "s", "equal to that of cars";
        /// So many stretches with motion tell a unit, at least.
        stretches: usize = 10, "1", "equal to that of cars";
        /// Least yaw rate of the pose that counts.
        turning: f64 = 0.2, "rad/s", "equal to that of cars";
        /// Least speed of the pose that counts.
        moving: f64 = 0.1, "m/s", "equal to that of cars";
        /// Factor within which a ratio is that of two units.
        near: f64 = 1.25, "1", "guess; radii and scales of gyros are off by less, and the least factor of units is 6";
        /// Steepest ground of a robot file.
        steepest: f64 = 45.0, "°", "guess; nothing drives on more: such a number is no angle in degrees";
    }

    /// Windows over which motion and model are compared.
    windows: Windows {
        /// Length of a window.
        length: f64 = 1.0, "s", "guess; equal to that of cars";
        /// Distance of their beginnings.
        every: f64 = 0.5, "s", "guess; half a window";
        /// Parts of a window over each of which speeds of wheels and gyro are compared.
        parts: usize = 4, "1", "guess; longer than the time in which light wheels follow the body";
        /// Weight of a row beside the others of its window.
        shared: f64 = 0.5, "1", "guess; rows of a window share the errors of its start";
        /// Metres that a heading error of one radian costs.
        lever: f64 = 0.5, "m/rad", "guess; the half track of a large robot";
        /// Largest error of a row, in the unit of its kind.
        ceiling: f64 = 30.0, "m; rad/s; m/s", "guess; far above what wheeled robots do in a second";
        /// Least sigmas of position and heading, gyro, rims of wheels.
        floor: [f64; 3] = [1e-3, 3e-3, 3e-3], "m; rad/s; m/s", "guess; good motion capture, noise of small sensors";
        /// Speed of the fastest rim, or way in a window over its length, below which the robot stands.
        moving: f64 = 0.03, "m/s", "guess";
        /// Remaining error of windows over their way, beyond which fits begin from where every cause is free, too.
        near: f64 = 0.01, "1", "a look at seed 1 of drawn robots: a radius and a lag that were missed left 0.015 and 0.023";
        /// Windows in motion below which nothing is fitted.
        least: usize = 8, "1", "guess";
        /// Step of finite differences, shares of a cause's usual size.
        difference: f64 = 1e-3, "1", "guess; forward: a hundredth made a mass and the torque of all motors, which drives do not tell apart, seem known to 0.2 %";
    }

    /// Fits of all constants.
    fitting: Fitting {
        /// Farthest a constant may move, usual sizes and sigmas together.
        farthest: f64 = 3.0, "1", "guess; normal priors leave a thousandth beyond";
    }

    /// By how much a robot seems to be another because its tyres have another law than the model: one sigma, beside what the owner
    /// states.
    skidding: Skidding {
        /// Distances of wheels, where fixed ones stand behind each other, so that turning makes them skid.
        place: f64 = 0.3, "share", "Mandow et al. 2007, IROS: on one ground tracks 1.2 to 2 times as wide as measured; as wide as that no cause is asked for";
        /// Place of the centre of mass, and of the tracked point, forward, over the longest distance of two contacts.
        middle: f64 = 0.05, "1", "a look at seeds 3 and 4 of drawn robots: six wheels on brush tyres turn about a point up to 5 % off";
        /// Friction coefficient of the ground.
        grip: f64 = 0.4, "share", "guess; it counts with the distances along the robot only";
        /// Direction of a wheel of such a robot.
        direction: f64 = 0.03, "rad", "guess; the same drives";
    }

    /// How far laws of tyres differ from that of the model: one sigma.
    tyre: Tyre {
        /// Share of the brush model.
        brush_share: f64 = 0.5, "1", "guess; both laws within one sigma";
        /// Stiffness sideways over that ahead.
        lateral_stiffness: f64 = 0.25, "share", "Pacejka 2012, Tire and Vehicle Dynamics: car tyres at 0.5 to 1.2";
        /// Speed below which tyres slip as if at it.
        rest_speed: f64 = 0.5, "share", "guess; a matter of the model, not of the tyre";
        /// The same share from drive to drive.
        brush_scatter: f64 = 0.05, "1", "guess; dust";
        /// The same stiffness from drive to drive.
        lateral_scatter: f64 = 0.03, "share", "guess; dust";
    }

    /// By how much a number that is told may be off because a robot has another law than the model: one sigma.
    told: Told {
        /// Slip at the largest force.
        slip: f64 = 0.35, "share", "guess; laws of tyres with one peak differ by a third in their slope";
        /// Lag and dead time of motors.
        time: f64 = 0.005, "s", "guess; a step of the plant";
    }

    /// How well constants are known where the robot file does not say: one sigma.
    known: Known {
        /// Mass.
        mass: f64 = 0.03, "share", "guess; a scale, without what was added since";
        /// Place of the centre of mass over the longest distance of two contacts.
        com: f64 = 0.02, "1", "guess; from a drawing";
        /// Yaw inertia.
        yaw_inertia: f64 = 0.2, "share", "guess; a rectangle for a robot";
        /// Radius.
        radius: f64 = 0.01, "share", "guess; rubber under load";
        /// Distances.
        place: f64 = 0.01, "share", "a tape measure";
        /// Direction of a wheel.
        direction: f64 = 0.01, "rad", "guess; half a degree by eye";
        /// Friction of motors over the scale of their torques.
        friction: f64 = 0.1, "1", "guess; gears warm up";
        /// Torque over what is recorded.
        gain: f64 = 0.03, "share", "data sheets of motors: 5 to 10 %, of which part is shared";
        /// Lag and dead time of motors.
        lag: f64 = 0.01, "s", "guess; half a period of usual logs";
        /// Zero of the steering.
        steering: f64 = 0.01, "rad", "guess";
        /// Gain of the steering.
        steering_gain: f64 = 0.02, "share", "guess; linkages";
        /// Drag over the square of the speed, of the weight.
        drag: f64 = 0.002, "s²/m²", "guess; air of a robot that fills half a square metre and weighs 15 kg";
        /// Rolling resistance.
        rolling: f64 = 0.005, "1", "guess; a third of usual tyres' on hard ground";
        /// Rolling resistance of casters.
        caster_rolling: f64 = 0.01, "1", "guess; small hard wheels";
        /// Friction of a caster's pivot over its trail's share of the weight.
        pivot: f64 = 0.01, "1", "guess; a bearing";
        /// Slip at the largest force.
        slip: f64 = 0.3, "share", "guess; tyres and floors";
        /// Friction coefficient of the ground.
        grip: f64 = 0.2, "share", "guess; floors of buildings: 0.5 to 0.9";
        /// Slope.
        slope: f64 = 0.005, "rad", "guess; floors of buildings";
        /// Direction of the tracked axes.
        pose_direction: f64 = 0.02, "rad", "a degree: by eye";
        /// Place of the tracked point.
        pose_origin: f64 = 0.01, "m", "a tape measure";
        /// Delay between robot and pose.
        clock: f64 = 0.02, "s", "guess; a few periods of usual logs";
        /// Scale of the gyro.
        gyro_scale: f64 = 0.01, "share", "data sheets of small gyros";
        /// Bias of the gyro.
        gyro_bias: f64 = 0.005, "rad/s", "data sheets of small gyros, after a start at rest";
        /// Force that a robot is usually driven with over its weight, for the scale of friction.
        push: f64 = 0.1, "1", "guess; an acceleration of 1 m/s²";
        /// A walking pace, for the scale of viscous friction.
        pace: f64 = 1.0, "m/s", "guess; service robots";
    }

    /// Usual sizes of causes: one sigma about none.
    usual: Usual {
        /// Mass.
        mass: f64 = 0.3, "share", "guess; payloads";
        /// Place of the centre of mass over the longest distance of two contacts.
        com: f64 = 0.15, "1", "guess; a load at an edge";
        /// Yaw inertia.
        yaw_inertia: f64 = 0.5, "share", "guess";
        /// Radius.
        radius: f64 = 0.1, "share", "guess; worn or flat tyres";
        /// Distances.
        place: f64 = 0.1, "share", "guess; read at the wrong end";
        /// Direction of a wheel.
        direction: f64 = 0.06, "rad", "guess; three degrees";
        /// Friction of motors over the scale of their torques.
        friction: f64 = 0.5, "1", "guess; a brake that drags";
        /// Torque over what is recorded.
        gain: f64 = 0.3, "share", "guess; magnets, gears, units of current";
        /// Lag and dead time.
        lag: f64 = 0.1, "s", "guess";
        /// Zero of the steering.
        steering: f64 = 0.06, "rad", "guess";
        /// Gain of the steering.
        steering_gain: f64 = 0.15, "share", "guess";
        /// Drag over the square of the speed, of the weight.
        drag: f64 = 0.03, "s²/m²", "guess; at a walking pace as much as a carpet; tall grass, a sail, a brush that is pushed";
        /// Rolling resistance, of casters, and drag of rollers.
        rolling: f64 = 0.04, "1", "guess; carpet, hair in bearings";
        /// Friction of a caster's pivot over its trail's share of the weight.
        pivot: f64 = 0.1, "1", "guess; rust";
        /// Slip at the largest force.
        slip: f64 = 1.0, "share", "guess; a factor of e";
        /// Friction coefficient of the ground.
        grip: f64 = 0.6, "share", "guess; wet or dusty floors";
        /// Slope.
        slope: f64 = 0.03, "rad", "guess; two degrees";
        /// Direction of the tracked axes.
        pose_direction: f64 = 0.1, "rad", "guess";
        /// Place of the tracked point.
        pose_origin: f64 = 0.05, "m", "guess";
        /// Delay between robot and pose.
        clock: f64 = 0.15, "s", "guess";
        /// Scale of the gyro.
        gyro_scale: f64 = 0.1, "share", "guess";
        /// Bias of the gyro.
        gyro_bias: f64 = 0.03, "rad/s", "guess";
    }

    /// By how much constants differ from drive to drive although nothing is changed: one sigma, before the drives themselves
    /// are asked.
    scatter: Scatter {
        /// Friction, share of what is usual for a motor of this robot.
        friction: f64 = 0.02, "1", "guess; temperature of gears";
        /// Torque and gains.
        gain: f64 = 0.005, "share", "guess; temperature of magnets";
        /// Lag and dead time.
        lag: f64 = 0.002, "s", "guess; clocks are set up anew";
        /// Directions, and zero of the steering.
        direction: f64 = 2e-3, "rad", "guess; play";
        /// Rolling resistance.
        rolling: f64 = 0.001, "1", "guess; temperature of tyres";
        /// Drag over the square of the speed, of the weight.
        drag: f64 = 1e-4, "s²/m²", "guess; wind of doors";
        /// Slip at the largest force.
        slip: f64 = 0.1, "share", "guess; dust";
        /// Friction coefficient of the ground.
        grip: f64 = 0.02, "share", "guess; dust";
        /// Slope.
        slope: f64 = 2e-3, "rad", "guess; another part of the floor";
        /// Place of the tracked point.
        pose_origin: f64 = 1e-3, "m", "guess; motion capture is set up anew";
        /// Delay between robot and pose.
        clock: f64 = 0.004, "s", "guess; clocks are set up anew";
        /// Bias of the gyro.
        gyro_bias: f64 = 2e-3, "rad/s", "guess; temperature";
        /// Masses and lengths.
        geometry: f64 = 1e-4, "share; m", "nothing moves";
    }

    /// Forecasts from torques alone.
    forecast: Forecast {
        /// Lengths of forecasts.
        lengths: [f64; 3] = [0.5, 1.0, 2.0], "s", "horizons of predictive controllers";
        /// Distance of their beginnings.
        every: f64 = 1.0, "s", "guess";
        /// Past over which velocities at the start are taken.
        past: f64 = 0.2, "s", "guess; noise against delay";
        /// Way below which a forecast is of a robot that stands, and does not count.
        way: f64 = 0.05, "m", "guess";
        /// Turning below which the same holds.
        turn: f64 = 0.05, "rad", "guess; half a metre from the robot it is a way of 2.5 cm";
    }

    /// When something is left that no cause accounts for.
    unexplained: Unexplained {
        /// Remaining error of windows over their way, beyond which what is left asks for a cause.
        share: f64 = 0.06, "1", "a look at drawn robots, where answers that are right leave 0.006 to 0.024, and at 24 of MuJoCo: 0.013 to 0.049, a wind 0.077";
        /// Share of the re-tuned error that has to be left then.
        of_retuned: f64 = 0.8, "1", "guess";
        /// Error with causes over that of constants re-tuned within what is known, from which on the causes are not needed.
        hardly: f64 = 0.7, "1", "a look at 24 robots of MuJoCo, whose tyres follow another law: a cause that is there leaves 0.6 and less";
        /// Remaining error over the way, beyond which nothing is explained, however much more was left before.
        most: f64 = 0.4, "1", "guess; wrong signs and units leave half of the motion and more";
        /// The same from which on something unknown is likelier where nothing is called missing and no reference says what is usual.
        doubted: f64 = 0.035, "1", "a look at sound robots of other hands: up to 0.024";
    }
}

/// As this crate uses them.
pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
