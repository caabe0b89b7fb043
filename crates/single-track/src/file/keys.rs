//! Where a robot file of this kind has a constant, for those who write corrected files.

use crate::constants::Quantity;

impl Quantity {
    /// Table and key that state it in a robot file; the table is `None` at the top of the file.
    pub fn key(self) -> (Option<&'static str>, &'static str) {
        use Quantity as Q;
        let (table, key) = match self {
            Q::Wheelbase => return (None, "wheelbase"),
            Q::CentreOfMass => return (None, "centre_of_mass"),
            Q::Gyration => return (None, "yaw_inertia"),
            Q::FullSteering => ("steering", "full_angle"),
            Q::Centre => ("steering", "centre"),
            Q::Curve => ("steering", "bend"),
            Q::Asymmetry => ("steering", "asymmetry"),
            Q::SteeringDelay => ("steering", "delay"),
            Q::SteeringLag => ("steering", "lag"),
            Q::Slowness => ("steering", "seconds_per_radian"),
            Q::Play => ("steering", "half_play"),
            Q::FrontCompliance => ("tyres", "front_compliance"),
            Q::RearCompliance => ("tyres", "rear_compliance"),
            Q::FrontInverseGrip => ("tyres", "front_inverse_grip"),
            Q::RearInverseGrip => ("tyres", "rear_inverse_grip"),
            Q::DriveGain => ("drive", "full_acceleration"),
            Q::DeadZone => ("drive", "dead_zone"),
            Q::BackEmf => ("drive", "back_emf"),
            Q::Friction => ("drive", "friction"),
            Q::Viscous => ("drive", "viscous_friction"),
            Q::MotorBraking => ("drive", "motor_braking"),
            Q::Drag => ("drive", "drag"),
            Q::DriveLag => ("drive", "lag"),
            Q::DriveDelay => ("drive", "delay"),
            Q::SlopeX => ("ground", "slope_x"),
            Q::SlopeY => ("ground", "slope_y"),
            Q::PointX => ("point", "x"),
            Q::PointY => ("point", "y"),
            Q::Direction => ("point", "yaw"),
            Q::Clock => ("clock", "delay"),
            Q::GyroScale => ("gyro", "scale"),
            Q::GyroBias => ("gyro", "bias"),
            Q::GyroDelay => ("gyro", "delay"),
            Q::EncoderScale => ("encoder", "scale"),
            Q::WheelSlip => ("encoder", "slip_in_bends"),
            Q::EncoderDelay => ("encoder", "delay"),
        };
        (Some(table), key)
    }
}
