//! The constants of a car on which its motion and its reports depend, and how well they are known.

use catalogue::CauseSpec;
use hierarchical_fit::Valued;

use crate::settings::SETTINGS;

/// What a constant is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "their names and units stand in the table of constants")]
pub enum Quantity {
    FullSteering,
    Centre,
    Curve,
    Asymmetry,
    SteeringDelay,
    SteeringLag,
    Slowness,
    Play,
    Wheelbase,
    CentreOfMass,
    Gyration,
    FrontCompliance,
    RearCompliance,
    FrontInverseGrip,
    RearInverseGrip,
    DriveGain,
    DeadZone,
    BackEmf,
    Friction,
    Viscous,
    MotorBraking,
    Drag,
    DriveLag,
    DriveDelay,
    SlopeX,
    SlopeY,
    PointX,
    PointY,
    Direction,
    Clock,
    GyroScale,
    GyroBias,
    GyroDelay,
    EncoderScale,
    WheelSlip,
    EncoderDelay,
}

impl Quantity {
    /// Whether there is none below 0.
    pub(crate) fn is_size(self) -> bool {
        use Quantity as Q;
        matches!(
            self,
            Q::SteeringLag
                | Q::Slowness
                | Q::Play
                | Q::FrontCompliance
                | Q::RearCompliance
                | Q::FrontInverseGrip
                | Q::RearInverseGrip
                | Q::DeadZone
                | Q::BackEmf
                | Q::Friction
                | Q::Viscous
                | Q::MotorBraking
                | Q::Drag
                | Q::DriveLag
                | Q::WheelSlip
        )
    }
}

/// A constant: a deviation `θ` from what is given, as a factor `e^θ` or as a sum.
#[derive(Debug, Clone, PartialEq)]
pub struct Constant {
    /// What it is.
    pub quantity: Quantity,
    /// Its name.
    pub name: &'static str,
    /// Unit of its value.
    pub unit: &'static str,
    /// Its value as stated, or as usual.
    pub given: f64,
    /// Whether the owner states it.
    pub is_stated: bool,
    /// Whether the deviation is the logarithm of a factor.
    pub is_factor: bool,
    /// One sigma of what is known of the deviation.
    pub sigma: f64,
    /// One sigma of the deviation that it has as a cause.
    pub usual: f64,
    /// One sigma by which drives differ.
    pub scatter: f64,
    /// The cause that it stands for.
    pub cause: &'static CauseSpec,
}

impl Constant {
    /// Least and largest deviation.
    pub(crate) fn bounds(&self) -> [f64; 2] {
        let far = SETTINGS.fitting.farthest * (self.usual + self.sigma);
        [if self.quantity.is_size() { -self.given } else { -far }, far]
    }

    /// Whether something is known of it from which it may differ: by its owner, or, of the friction of the drive, by references. Of yaw
    /// inertia and clocks these say little: they make up for tyres and delays that are not quite the model's, in each drive otherwise.
    pub(crate) fn can_be_wrong(&self, has_references: bool) -> bool {
        self.sigma < self.usual || (has_references && matches!(self.quantity, Quantity::Friction | Quantity::Viscous))
    }
}

impl Valued for Constant {
    fn name(&self) -> &str {
        self.name
    }

    fn unit(&self) -> &'static str {
        self.unit
    }

    fn is_factor(&self) -> bool {
        self.is_factor
    }

    fn of_another_law(&self, value: f64) -> f64 {
        use Quantity as Q;
        let told = SETTINGS.told;
        match self.quantity {
            Q::SteeringDelay
            | Q::SteeringLag
            | Q::DriveLag
            | Q::DriveDelay
            | Q::Clock
            | Q::GyroDelay
            | Q::EncoderDelay => told.time.hypot(told.share * value),
            Q::Slowness => told.rate * value.abs(),
            Q::Play | Q::DriveGain | Q::DeadZone => told.share * value.abs(),
            Q::FrontCompliance | Q::RearCompliance | Q::FrontInverseGrip | Q::RearInverseGrip | Q::WheelSlip => {
                told.tyre * value.abs()
            }
            Q::GyroScale | Q::EncoderScale => told.scale * value.abs(),
            Q::PointX | Q::PointY => told.point,
            _ => 0.0,
        }
    }

    fn value(&self, deviation: f64) -> f64 {
        if self.is_factor { self.given * deviation.exp() } else { self.given + deviation }
    }
}
