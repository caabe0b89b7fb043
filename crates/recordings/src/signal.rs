//! The closed vocabulary of signals that a diagnosis can use.

use bags::suggest;

use crate::units::Unit;

/// Declares the enum, its names and units in one place, so that a new signal is one line.
macro_rules! signals {
    ($($(#[$doc:meta])* $variant:ident = $name:literal, $unit:ident;)*) => {
        /// What a channel measures. Body frame x forward, y left, z up; everything in SI.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[non_exhaustive]
        pub enum Signal {
            $($(#[$doc])* $variant,)*
        }

        impl Signal {
            /// Every signal, in the order in which a recording lists its channels.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// The id in mappings and messages: `wheel_speed_left`.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),* }
            }

            /// The SI unit of the values.
            pub const fn unit(self) -> Unit {
                match self { $(Self::$variant => Unit::$unit),* }
            }
        }
    };
}

signals! {
    /// Measured speed of the left wheels about their axle.
    WheelSpeedLeft = "wheel_speed_left", RadianPerSecond;
    /// Measured speed of the right wheels about their axle.
    WheelSpeedRight = "wheel_speed_right", RadianPerSecond;
    /// Measured angle of the left wheels, absolute within a run.
    WheelAngleLeft = "wheel_angle_left", Radian;
    /// Measured angle of the right wheels, absolute within a run.
    WheelAngleRight = "wheel_angle_right", Radian;
    /// Torque of the whole left side, at the wheels.
    TorqueLeft = "torque_left", NewtonMetre;
    /// Torque of the whole right side, at the wheels.
    TorqueRight = "torque_right", NewtonMetre;
    /// Motor current of the left side.
    CurrentLeft = "current_left", Ampere;
    /// Motor current of the right side.
    CurrentRight = "current_right", Ampere;
    /// Wheel speed that the left drive is told to hold (a set-point).
    CommandSpeedLeft = "command_speed_left", RadianPerSecond;
    /// Wheel speed that the right drive is told to hold (a set-point).
    CommandSpeedRight = "command_speed_right", RadianPerSecond;
    /// Turning rate about the forward axis.
    GyroX = "gyro_x", RadianPerSecond;
    /// Turning rate about the left axis.
    GyroY = "gyro_y", RadianPerSecond;
    /// Turning rate about the upward axis (yaw rate).
    GyroZ = "gyro_z", RadianPerSecond;
    /// Specific force forward.
    AccelX = "accel_x", MetrePerSecondSquared;
    /// Specific force to the left.
    AccelY = "accel_y", MetrePerSecondSquared;
    /// Specific force upward (about +9.81 at rest).
    AccelZ = "accel_z", MetrePerSecondSquared;
    /// Position of the body's reference point, world x.
    PoseX = "pose_x", Metre;
    /// Position of the body's reference point, world y.
    PoseY = "pose_y", Metre;
    /// Heading, counter-clockwise from world x.
    PoseYaw = "pose_yaw", Radian;
    /// Speed of the reference point, forward in the body frame.
    BodyVx = "body_vx", MetrePerSecond;
    /// Speed of the reference point, to the left in the body frame.
    BodyVy = "body_vy", MetrePerSecond;
}

impl Signal {
    /// The signal with this id.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|signal| signal.name() == name)
    }

    /// The signal whose id is most like `name`, when one is like enough.
    pub fn nearest(name: &str) -> Option<Self> {
        suggest::nearest(name, Self::ALL.iter().map(|signal| signal.name())).and_then(Self::from_name)
    }

    /// True for what is a set-point by its nature, whatever a mapping says.
    pub const fn is_set_point(self) -> bool {
        matches!(self, Self::CommandSpeedLeft | Self::CommandSpeedRight)
    }

    /// The self-describing column name that [`crate::write_csv`] writes: `gyro_z_rad_s`.
    pub fn column_name(self) -> String {
        format!("{}_{}", self.name(), self.unit().column_suffix())
    }

    /// What to write instead of an unknown id.
    pub(crate) fn hint(name: &str) -> String {
        let known: Vec<&str> = Self::ALL.iter().map(|signal| signal.name()).collect();
        suggest::hint(name, &known)
    }
}

impl std::fmt::Display for Signal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_read_back() {
        for &signal in Signal::ALL {
            assert_eq!(Signal::from_name(signal.name()), Some(signal));
        }
        assert_eq!(Signal::from_name("gyro"), None);
        assert_eq!(Signal::nearest("wheel_sped_left"), Some(Signal::WheelSpeedLeft));
        assert_eq!(Signal::nearest("banana"), None);
    }

    #[test]
    fn column_names_are_those_of_the_blind_cases() {
        assert_eq!(Signal::TorqueLeft.column_name(), "torque_left_Nm");
        assert_eq!(Signal::AccelX.column_name(), "accel_x_m_s2");
        assert_eq!(Signal::BodyVx.column_name(), "body_vx_m_s");
        assert_eq!(Signal::PoseYaw.column_name(), "pose_yaw_rad");
    }
}
