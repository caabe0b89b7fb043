//! The tuned numbers of this crate.

::settings::settings! {
    /// What models are read with.
    pub(crate) struct Settings;

    /// What in a model is a wheel.
    wheels: Wheels {
        /// Largest vertical part of a wheel's axle (a direction of length one).
        level: f64 = 0.3, "1", "guess: camber and rounding";
        /// Least vertical part of the axis of a steering joint or a caster's swivel.
        upright: f64 = 0.9, "1", "guess: caster angles of up to 25 degrees";
        /// Height of a wheel's lowest point above the ground up to which it stands there, share of its radius.
        on_ground: f64 = 0.25, "1", "guess";
        /// Distance of a shape's middle from the axle up to which it is the wheel's, share of its radius.
        centred: f64 = 0.3, "1", "guess";
        /// Distance by which a wheel trails behind a swivel from which on it is a caster, share of its radius.
        trail: f64 = 0.1, "1", "guess";
    }

    /// What robot wheels make.
    layout: Layouts {
        /// Length of the cross product of directions below which they are parallel.
        parallel: f64 = 0.05, "1", "guess: rounding and toe";
        /// Distance along the robot below which wheels are of one axle, share of their radius.
        one_axle: f64 = 0.5, "1", "guess";
    }

    /// Numbers of models that mean nothing.
    fillers: Fillers {
        /// Friction coefficients outside are no measurements.
        friction: [f64; 2] = [0.02, 3.0], "1", "guess: simulators are given large ones so that nothing slides";
        /// Torque of a joint from which on it means "no limit".
        no_effort: f64 = 1e4, "N m", "guess: a common filler";
        /// Share by which the wheels of a side may differ in inertia before the surplus is that of the motors.
        motor_surplus: f64 = 0.05, "1", "guess";
        /// Mass of a wheel that states none, share of the robot's.
        wheel_mass: f64 = 0.03, "1", "guess";
        /// Trail of a caster that is drawn as a sphere.
        sphere_trail: f64 = 0.02, "m", "guess: small, so that it turns at once";
    }

    /// How well numbers of models are known: one sigma, as a share where no unit is told.
    spreads: Spreads {
        /// A length or a mass that a model states.
        stated: f64 = 0.02, "1", "guess: models are drawn by people";
        /// An inertia or a height that a model states.
        stated_inertia: f64 = 0.15, "1", "guess: often those of a box";
        /// Friction or damping that a model states.
        stated_friction: f64 = 0.5, "1", "guess: often tuned until the simulation drives";
        /// A number that no model states.
        lacking: f64 = 0.7, "1", "guess: known to a factor of two";
        /// The track that sides which skid turn by.
        skidding: f64 = 0.3, "1", "1.1 to 2 times the measured one: Mandow et al. 2007, Martinez et al. 2005";
        /// The steering's zero.
        centre: f64 = 0.02, "rad", "guess";
        /// The place of the tracked point.
        point: f64 = 0.01, "m", "guess";
        /// The direction of the tracked point's axes.
        direction: f64 = 0.02, "rad", "guess";
    }

    /// Robots that turn by skidding.
    skid: Skidding {
        /// Effective track over the measured one.
        wider: f64 = 1.4, "1", "1.1 to 2 are usual: Mandow et al. 2007, Martinez et al. 2005";
    }
}

pub(crate) const SETTINGS: Settings = Settings::DEFAULT;
