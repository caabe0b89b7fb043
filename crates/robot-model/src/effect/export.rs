//! How an effect is written to the simulators that models are exported to, as plain data.
//!
//! What an engine has a law for becomes a value of the model ([`Way::Held`]). What it has no law for is added beside it
//! ([`Way::Added`], [`Residual`]). The writers of the engines read this; none of them knows an effect by its name.

/// An engine with the format of its models.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Engine {
    /// MuJoCo, MJCF.
    Mjcf,
    /// URDF with Gazebo's extensions.
    Urdf,
    /// Gazebo, SDF.
    Sdf,
}

impl Engine {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Mjcf, Self::Urdf, Self::Sdf];

    /// Name of its format.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mjcf => "MJCF",
            Self::Urdf => "URDF",
            Self::Sdf => "SDF",
        }
    }
}

/// How an engine gets an effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// It has the law: which value of the model carries it.
    Held(&'static str),
    /// It has no such law: why. A residual says what to add.
    Added(&'static str),
}

impl Way {
    /// Of a fault that no single reading shows, but the samples of a whole drive: frozen rows, clocks that disagree.
    pub const ON_SAMPLES: Self = Self::Held("applied to the samples of a simulated drive");
}

/// A part of a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Section {
    /// Masses.
    Body,
    /// Joints of the wheels, belts, shape of the wheels.
    Wheels,
    /// Contacts, gravity.
    Ground,
    /// From command to torque.
    Drive,
    /// Encoders, IMU, pose, and their clocks.
    Sensors,
}

/// What carries the values of an effect where an engine holds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Carrier {
    /// The robot's constants and coefficients: the law is applied once to the robot at rest.
    Law,
    /// A body of its own, with the mass, height and yaw inertia that the law adds to the robot.
    OwnBody,
    /// The grip of the robot's wheels, of which the first value is lost; of a disc on the ground where it has a place.
    Grip,
    /// Place of the wheels off their axles: cosine and sine part, m.
    WheelCentre,
    /// Quadratic drag of the body, N s²/m².
    Drag,
    /// Mean of the gyro's noise, rad/s.
    GyroMean,
    /// Means of the accelerometer's noise along x and y, m/s².
    AccelerometerMean,
    /// How far the accelerometer is turned to the left, rad.
    AccelerometerYaw,
    /// How far the accelerometer's x and y axis point up, rad.
    AccelerometerTilt,
    /// Relative error of the encoders' gain.
    EncoderGain,
    /// Delays of the IMU and of the pose, s.
    SensorDelay,
}

/// What is added where an engine does not hold an effect.
///
/// Lines are Python over `w`, `v`, `r`, `T`, `t`, `angle`, `at`, `heading`, `ch`, `sh`, `sign`, `share` (the legend in every exported model).
/// In lines and sentences stand for numbers at the exported values:
///
/// | written | stands for |
/// |---|---|
/// | `{0}` to `{4}` | value of a parameter, in the order of the specification |
/// | `{sides}` | indices of the sides that have the effect, as a Python tuple |
/// | `{side}` | "left", "right", or "left and right" |
/// | `{place}` | x, y and radius of its disc on the ground, m |
/// | `{force x}`, `{force y}`, `{moment}` | what the law adds to the force (gravity's part included) and the moment at rest at heading 0, N, N m |
/// | `{rolling}` | torque that the law adds to the rolling resistance of each wheel at rest, four numbers, N m |
/// | `{rim}`, `{half track}`, `{weight}` | the wheels' radius, half the track, m, and the weight, N |
/// | `{law}` | the law as a formula |
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Residual {
    /// Nothing of its own: it goes into the robot's constants by its law, and those have lines where an engine lacks them.
    OfConstants,
    /// Lines that add to `torque[j]`, `force[k]` or `moment`.
    Force(&'static [&'static str]),
    /// Lines that change `grip[i]` of the wheels.
    Ground(&'static [&'static str]),
    /// Lines that change readings `y[..]`.
    Reading(&'static [&'static str]),
    /// A sentence that says what to do.
    Words(&'static str),
}

/// When an engine that holds an effect elsewise does not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Exception {
    /// The engine; `None` is every one.
    pub engine: Option<Engine>,
    /// At which values or presence.
    pub when: When,
    /// Why.
    pub why: &'static str,
}

/// Condition of an [`Exception`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum When {
    /// It is limited to a disc on the ground.
    AtPlace,
    /// One of its values is negative.
    Negative,
}

/// Why an engine without drives does not hold what acts on the command.
const NO_DRIVE: &str = "a joint takes the torque that it is given; what comes before belongs to the controller";

/// How an effect is written to each engine.
#[derive(Debug, Clone, Copy)]
pub struct Export {
    /// The part of a model that it changes.
    pub section: Section,
    /// How MuJoCo gets it.
    pub mjcf: Way,
    /// How URDF gets it.
    pub urdf: Way,
    /// How Gazebo gets it.
    pub sdf: Way,
    /// How `lacuna simulate` and `lacuna predict` get it from a robot file.
    pub robot_file: Way,
    /// What carries its values where it is held.
    pub carrier: Carrier,
    /// What is added where it is not.
    pub residual: Residual,
    /// When an engine that holds it elsewise does not.
    pub exceptions: &'static [Exception],
}

impl Export {
    /// No engine has the law: a sentence in the model says what to add. The plant of Lacuna has it.
    pub const ADDED_BY_HAND: Self = Self {
        section: Section::Body,
        mjcf: Way::Added("it has no such law"),
        urdf: Way::Added("it has no such law"),
        sdf: Way::Added("it has no such law"),
        robot_file: Way::Held("its law in the plant"),
        carrier: Carrier::Law,
        residual: Residual::Words("Add it by its law: {law}."),
        exceptions: &[],
    };
    /// Its law changes constants of the robot: where an engine lacks one of them, that constant has its lines.
    pub const BY_CONSTANTS: Self = Self { residual: Residual::OfConstants, ..Self::ADDED_BY_HAND };
    /// Of the drive: where joints take the torque that they are given, its constants have their lines.
    pub const DRIVE: Self =
        Self { section: Section::Drive, urdf: Way::Added(NO_DRIVE), sdf: Way::Added(NO_DRIVE), ..Self::BY_CONSTANTS };
    /// Of a sensor: URDF has none.
    pub const SENSOR: Self = Self {
        section: Section::Sensors,
        urdf: Way::Added("it describes a robot without its sensors"),
        ..Self::ADDED_BY_HAND
    };

    /// The same way for MuJoCo, URDF and Gazebo.
    #[must_use]
    pub const fn everywhere(self, way: Way) -> Self {
        Self { mjcf: way, urdf: way, sdf: way, ..self }
    }

    /// How an engine gets it at usual values.
    pub const fn way(&self, engine: Engine) -> Way {
        match engine {
            Engine::Mjcf => self.mjcf,
            Engine::Urdf => self.urdf,
            Engine::Sdf => self.sdf,
        }
    }
}
