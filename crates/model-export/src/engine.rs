//! The engines that models are written for.

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

    /// Where the lines of a residual belong.
    pub(crate) const fn residual_place(self) -> &'static str {
        match self {
            Self::Mjcf => "The class Residual of the Python file beside this one does this before every mj_step.",
            Self::Urdf => {
                "Add torque to the rear wheel joints where the controller writes its efforts (ros2_control: the hardware \
                 interface's write), and force and moment as a wrench on the link chassis."
            }
            Self::Sdf => {
                "A system plugin's PreUpdate adds torque with Joint::SetForce to the rear wheel joints, and force and \
                 moment with Link::AddWorldWrench to the link chassis."
            }
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
