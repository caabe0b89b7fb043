//! Laws of a car at deviations of its constants.

use crate::constants::{Constant, Quantity};
use crate::model::{Lateral, Laws};
use hierarchical_fit::Valued;

impl Laws {
    /// Laws at deviations of the constants.
    pub(crate) fn at(constants: &[Constant], theta: &[f64]) -> Self {
        let mut out = Self {
            lateral: Lateral::Dynamic,
            full: 0.0,
            centre: 0.0,
            curve: 0.0,
            asymmetry: 0.0,
            delay: 0.0,
            lag: 0.0,
            slowness: 0.0,
            play: 0.0,
            wheelbase: 1.0,
            rear: 0.0,
            gyration: 1.0,
            front_compliance: 0.0,
            rear_compliance: 0.0,
            front_inverse_grip: 0.0,
            rear_inverse_grip: 0.0,
            gain: 0.0,
            dead_zone: 0.0,
            back_emf: 0.0,
            friction: 0.0,
            viscous: 0.0,
            motor_braking: 0.0,
            drag: 0.0,
            drive_lag: 0.0,
            drive_delay: 0.0,
            slope: [0.0; 2],
            point: [0.0; 2],
            direction: 0.0,
            clock: 0.0,
            gyro_scale: 1.0,
            gyro_bias: 0.0,
            gyro_delay: 0.0,
            encoder_scale: 1.0,
            wheel_slip: 0.0,
            encoder_delay: 0.0,
        };
        for (constant, deviation) in constants.iter().zip(theta) {
            *out.of(constant.quantity) = constant.value(*deviation);
        }
        out
    }

    fn of(&mut self, quantity: Quantity) -> &mut f64 {
        use Quantity as Q;
        match quantity {
            Q::FullSteering => &mut self.full,
            Q::Centre => &mut self.centre,
            Q::Curve => &mut self.curve,
            Q::Asymmetry => &mut self.asymmetry,
            Q::SteeringDelay => &mut self.delay,
            Q::SteeringLag => &mut self.lag,
            Q::Slowness => &mut self.slowness,
            Q::Play => &mut self.play,
            Q::Wheelbase => &mut self.wheelbase,
            Q::CentreOfMass => &mut self.rear,
            Q::Gyration => &mut self.gyration,
            Q::FrontCompliance => &mut self.front_compliance,
            Q::RearCompliance => &mut self.rear_compliance,
            Q::FrontInverseGrip => &mut self.front_inverse_grip,
            Q::RearInverseGrip => &mut self.rear_inverse_grip,
            Q::DriveGain => &mut self.gain,
            Q::DeadZone => &mut self.dead_zone,
            Q::BackEmf => &mut self.back_emf,
            Q::Friction => &mut self.friction,
            Q::Viscous => &mut self.viscous,
            Q::MotorBraking => &mut self.motor_braking,
            Q::Drag => &mut self.drag,
            Q::DriveLag => &mut self.drive_lag,
            Q::DriveDelay => &mut self.drive_delay,
            Q::SlopeX => &mut self.slope[0],
            Q::SlopeY => &mut self.slope[1],
            Q::PointX => &mut self.point[0],
            Q::PointY => &mut self.point[1],
            Q::Direction => &mut self.direction,
            Q::Clock => &mut self.clock,
            Q::GyroScale => &mut self.gyro_scale,
            Q::GyroBias => &mut self.gyro_bias,
            Q::GyroDelay => &mut self.gyro_delay,
            Q::EncoderScale => &mut self.encoder_scale,
            Q::WheelSlip => &mut self.wheel_slip,
            Q::EncoderDelay => &mut self.encoder_delay,
        }
    }
}
