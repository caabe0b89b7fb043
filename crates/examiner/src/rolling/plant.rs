//! The robot: from the motion of its body to turns of its wheels.

/// Rate below which a turn is slow, rad/s: slip in turns saturates beyond.
const SLOW_TURN: f64 = 0.15;

/// A wheel that is measured.
#[derive(Debug, Clone)]
pub(super) struct Wheel {
    pub(super) name: String,
    /// Contact with the ground, x forward, y left, m.
    pub(super) place: [f64; 2],
    /// Where it rolls to when it counts up, rad.
    pub(super) direction: f64,
    /// m.
    pub(super) radius: f64,
    /// Angle from its axle to those of its rollers, rad; 0 without rollers.
    pub(super) roller: f64,
}

/// A robot as it is.
#[derive(Debug, Clone)]
pub(super) struct Robot {
    pub(super) wheels: Vec<Wheel>,
    /// The first wheel is steered.
    pub(super) is_steered: bool,
    pub(super) steering_zero: f64,
    pub(super) steering_gain: f64,
    /// Share of the way that is lost in turns.
    pub(super) turn_slip: f64,
    /// Share of the turning that is lost per rad/s.
    pub(super) rate_slip: f64,
    /// Share of the way that is lost per m/s.
    pub(super) speed_slip: f64,
    /// Share of the sideways motion that rollers lose.
    pub(super) roller_slip: f64,
    /// How far ahead of the origin the point is about which it turns, m.
    pub(super) turns_about: f64,
    /// The pose's frame on the robot, rad.
    pub(super) mounting: f64,
    /// The pose's point on the robot, m.
    pub(super) origin: [f64; 2],
    /// By how much pose stamps are late, s.
    pub(super) clock_offset: f64,
    /// By how much the clock of the pose runs fast.
    pub(super) clock_rate: f64,
}

impl Robot {
    /// What the wheels must do for the body to move with these velocities, m/s, m/s, rad/s: rates of the wheels, rad/s, and
    /// the angle that the steering reports.
    pub(super) fn wheels(&self, [vx, vy, turning]: [f64; 3]) -> (Vec<f64>, f64) {
        let speed = vx.hypot(vy);
        let kept = (1.0 - self.turn_slip * (turning.abs() / SLOW_TURN).tanh()) * (-self.speed_slip * speed).exp();
        let ux = vx / kept;
        let uy = vy / kept / (1.0 - self.roller_slip);
        let turned = turning * (self.rate_slip * turning.abs()).exp();
        let at = |[x, y]: [f64; 2]| [ux - turned * y, uy + turned * x];
        if self.is_steered {
            let wheel = &self.wheels[0];
            let [a, b] = at(wheel.place);
            let reported = (b.atan2(a) - self.steering_zero) / self.steering_gain;
            return (vec![a.hypot(b) / wheel.radius], reported);
        }
        let rate = |wheel: &Wheel| {
            let [a, b] = at(wheel.place);
            let (sin, cos) = wheel.direction.sin_cos();
            let (ahead, across) = (a * cos + b * sin, b * cos - a * sin);
            // Nothing slides along the axles of the rollers, which stand across an omni wheel.
            let of_rollers = if wheel.roller == 0.0 { 0.0 } else { across / wheel.roller.tan() };
            (ahead - of_rollers) / wheel.radius
        };
        (self.wheels.iter().map(rate).collect(), 0.0)
    }

    /// The pose that is measured of a body at x, y, yaw.
    pub(super) fn measured(&self, [x, y, yaw]: [f64; 3]) -> [f64; 3] {
        let (sin, cos) = yaw.sin_cos();
        let [a, b] = self.origin;
        [x + cos * a - sin * b, y + sin * a + cos * b, yaw + self.mounting]
    }
}
