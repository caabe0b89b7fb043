//! The robot as its user knows it, and the true one, which differs within the stated sigmas.

use std::collections::BTreeMap;

use crate::casters::Casters;
use crate::random::Stream;
use crate::{RobotClass, TyreLaw};

pub(crate) const GRAVITY: f64 = 9.81;

/// Relative standard deviations of the user's values.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sigmas {
    pub mass: f64,
    pub yaw_inertia: f64,
    pub height: f64,
    pub adhesion: f64,
    pub rolling: f64,
    pub coulomb: f64,
    pub side_difference: f64,
    pub viscous: f64,
    pub torque_constant: f64,
    pub motor_inertia: f64,
    /// Absolute, metres.
    pub centre: f64,
    pub run_to_run: f64,
}

pub(crate) const SIGMAS: Sigmas = Sigmas {
    mass: 0.01,
    yaw_inertia: 0.05,
    height: 0.05,
    adhesion: 0.08,
    rolling: 0.12,
    coulomb: 0.12,
    side_difference: 0.06,
    viscous: 0.12,
    torque_constant: 0.015,
    motor_inertia: 0.04,
    centre: 0.004,
    run_to_run: 0.02,
};

/// What decides the motion of a robot; front and rear wheels alike, sides left then right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Constants {
    pub mass: f64,
    pub yaw_inertia: f64,
    pub height: f64,
    /// Centre of mass from the geometric centre, forward and left.
    pub centre: [f64; 2],
    pub half_base: f64,
    pub half_track: f64,
    pub radius: f64,
    pub wheel_inertia: f64,
    pub motor_inertia: f64,
    pub adhesion: f64,
    pub rolling: f64,
    pub coulomb: [f64; 2],
    pub viscous: [f64; 2],
    /// Delivered over logged torque.
    pub torque_gain: f64,
    pub current_lag: f64,
    pub torque_limit: f64,
    pub hitch: f64,
    /// Slip at the peak, forward; sideways it is `side_slip` times larger.
    pub peak_slip: f64,
    pub side_slip: f64,
    /// Lateral over longitudinal friction.
    pub lateral: f64,
    /// Relative loss of friction per relative rise of load.
    pub load_loss: f64,
    /// Share of friction lost when sliding fast.
    pub sliding_loss: f64,
    pub relaxation: f64,
    pub load_lag: f64,
    /// Wheel angle over which dry friction builds up.
    pub presliding: f64,
    pub belt_stiffness: f64,
    pub belt_damping: f64,
    pub law: TyreLaw,
    /// Casters, of a robot that stands on two driven wheels and these.
    pub casters: Option<Casters>,
}

/// Rounded to five significant digits, as a data sheet has it.
fn digits(x: f64) -> f64 {
    if x == 0.0 {
        return 0.0;
    }
    let scale = 10_f64.powi(4 - x.abs().log10().floor() as i32);
    (x * scale).round() / scale
}

/// Middle values of the classes from small to large: mass, half base, half track, radius, height,
/// wheel inertia, motor inertia per side, dry and viscous friction per side.
const MIDDLE: [[f64; 9]; 3] = [
    [5.0, 0.1, 0.125, 0.06, 0.07, 0.0006, 0.002, 0.05, 0.011],
    [20.0, 0.176, 0.216, 0.097, 0.12, 0.006, 0.018, 0.33, 0.13],
    [62.0, 0.256, 0.2775, 0.165, 0.18, 0.05, 0.14, 1.7, 0.75],
];

fn middle(class: RobotClass) -> [f64; 9] {
    MIDDLE[match class {
        RobotClass::Small => 0,
        RobotClass::Medium => 1,
        RobotClass::Large => 2,
    }]
}

/// Middle values of a robot of some mass: powers of the mass between the classes, and beyond them the power of the
/// nearest two.
fn middle_of(mass: f64) -> [f64; 9] {
    let [low, high] = if mass < MIDDLE[1][0] { [MIDDLE[0], MIDDLE[1]] } else { [MIDDLE[1], MIDDLE[2]] };
    let share = (mass / low[0]).ln() / (high[0] / low[0]).ln();
    std::array::from_fn(|i| low[i] * (high[i] / low[i]).powf(share))
}

impl Constants {
    /// The user's robot.
    pub(crate) fn nominal(seed: u64, class: RobotClass, law: TyreLaw) -> Self {
        Self::around(middle(class), seed, law)
    }

    /// The user's robot, of about this mass, kg.
    pub(crate) fn of_mass(seed: u64, mass: f64, law: TyreLaw) -> Self {
        Self::around(middle_of(mass), seed, law)
    }

    fn around(middle: [f64; 9], seed: u64, law: TyreLaw) -> Self {
        let mut s = Stream::new(seed, "robot", 0);
        let [mass, base, track, radius, height, wheel, motor, dry, viscous] = middle;
        let size = s.uniform(0.92, 1.08);
        let mass = digits(mass * s.uniform(0.8, 1.22));
        let half_base = digits(base * size);
        let half_track = digits(track * size);
        let radius = digits(radius * size);
        let area = (2.0 * half_base).powi(2) + (2.0 * half_track).powi(2);
        let coulomb = digits(dry * s.uniform(0.8, 1.2));
        let viscous = digits(viscous * s.uniform(0.78, 1.22));
        Self {
            mass,
            yaw_inertia: digits(mass * area / 12.0 * s.uniform(1.55, 1.8)),
            height: digits(height * s.uniform(0.92, 1.09)),
            centre: [0.0; 2],
            half_base,
            half_track,
            radius,
            wheel_inertia: wheel,
            motor_inertia: digits(motor * s.uniform(0.68, 1.35)),
            adhesion: digits(s.uniform(0.5, 0.75)),
            rolling: digits(s.uniform(0.015, 0.03)),
            coulomb: [coulomb; 2],
            viscous: [viscous; 2],
            torque_gain: 1.0,
            current_lag: 0.008,
            torque_limit: digits(0.69 * mass * GRAVITY * radius * s.uniform(0.95, 1.1)),
            hitch: digits(-half_base * s.uniform(1.66, 1.76)),
            peak_slip: 0.12,
            side_slip: 1.0,
            lateral: 1.0,
            load_loss: 0.0,
            sliding_loss: 0.04,
            relaxation: 0.25 * radius,
            load_lag: 0.03,
            presliding: 0.012,
            belt_stiffness: 3.2 * mass * GRAVITY * radius * 2.0,
            belt_damping: 0.006 * mass * GRAVITY * radius,
            law,
            casters: None,
        }
    }

    /// The same on two driven wheels and casters.
    pub(crate) fn on_casters(self, seed: u64) -> Self {
        let mut s = Stream::new(seed, "casters", 0);
        let casters = Casters::draw(&mut s, self.half_track, self.radius, self.mass);
        let casters = Casters {
            places: casters.places.map(|place| place.map(digits)),
            trail: digits(casters.trail),
            rolling: digits(casters.rolling),
            ..casters
        };
        let centre = [digits(casters.centre(&mut s)), 0.0];
        Self { centre, casters: Some(casters), ..self }
    }

    /// Where the wheels stand that are driven or coupled, ahead and to the left.
    pub(crate) fn wheels(&self) -> Vec<[f64; 2]> {
        let (a, b) = (self.half_base, self.half_track);
        if self.casters.is_some() { vec![[0.0, b], [0.0, -b]] } else { vec![[a, b], [a, -b], [-a, b], [-a, -b]] }
    }

    /// The true robot behind the user's values.
    pub(crate) fn truth(&self, seed: u64) -> Self {
        let mut s = Stream::new(seed, "truth", 0);
        let mut off = |sigma: f64| s.normal(sigma).exp();
        let coulomb = off(SIGMAS.coulomb);
        let side = off(SIGMAS.side_difference / 2.0);
        let viscous = off(SIGMAS.viscous);
        let mut c = Self {
            mass: self.mass * off(SIGMAS.mass),
            yaw_inertia: self.yaw_inertia * off(SIGMAS.yaw_inertia),
            height: self.height * off(SIGMAS.height),
            adhesion: self.adhesion * off(SIGMAS.adhesion),
            rolling: self.rolling * off(SIGMAS.rolling),
            coulomb: [self.coulomb[0] * coulomb * side, self.coulomb[1] * coulomb / side],
            viscous: self.viscous.map(|v| v * viscous),
            torque_gain: off(SIGMAS.torque_constant),
            motor_inertia: self.motor_inertia * off(SIGMAS.motor_inertia),
            ..*self
        };
        c.centre = self.centre.map(|at| at + s.normal(SIGMAS.centre));
        c.peak_slip = match c.law {
            TyreLaw::Brush => s.uniform(0.14, 0.24),
            TyreLaw::Pacejka => s.uniform(0.1, 0.18),
        };
        c.side_slip = s.uniform(0.92, 1.15);
        c.lateral = s.normal(0.04).exp();
        c.load_loss = s.uniform(0.01, 0.04);
        c.sliding_loss = s.uniform(0.02, 0.05);
        c.relaxation = self.radius * s.uniform(0.1, 0.3);
        c.load_lag = s.uniform(0.02, 0.05);
        c.presliding = s.uniform(0.008, 0.02);
        if let Some(casters) = &mut c.casters {
            casters.rolling *= s.normal(SIGMAS.rolling).exp();
            casters.trail *= s.uniform(0.9, 1.1);
        }
        c
    }

    /// The same robot later: every constant that its user is unsure of has moved, by at most so many sigmas.
    pub(crate) fn moved(&self, seed: u64, sigmas: f64) -> Self {
        let mut s = Stream::new(seed, "moved", 0);
        let mut off = |sigma: f64| (sigmas * sigma * s.uniform(-1.0, 1.0)).exp();
        let viscous = off(SIGMAS.viscous);
        let coulomb = off(SIGMAS.coulomb);
        let side = off(SIGMAS.side_difference / 2.0);
        Self {
            mass: self.mass * off(SIGMAS.mass),
            yaw_inertia: self.yaw_inertia * off(SIGMAS.yaw_inertia),
            height: self.height * off(SIGMAS.height),
            adhesion: self.adhesion * off(SIGMAS.adhesion),
            rolling: self.rolling * off(SIGMAS.rolling),
            coulomb: [self.coulomb[0] * coulomb * side, self.coulomb[1] * coulomb / side],
            viscous: self.viscous.map(|v| v * viscous),
            torque_gain: self.torque_gain * off(SIGMAS.torque_constant),
            motor_inertia: self.motor_inertia * off(SIGMAS.motor_inertia),
            centre: self.centre.map(|c| c + off(SIGMAS.centre).ln()),
            ..*self
        }
    }

    /// The same robot on another run: friction a little different each time.
    pub(crate) fn on_run(&self, s: &mut Stream, spread: f64) -> Self {
        let mut c = *self;
        let mut off = |sigma: f64| s.normal(sigma * spread).exp();
        c.adhesion *= off(0.003);
        c.rolling *= off(0.008);
        c.coulomb = [c.coulomb[0] * off(0.007), c.coulomb[1] * off(0.007)];
        let viscous = off(0.004);
        c.viscous = c.viscous.map(|v| v * viscous);
        c
    }

    /// What sets this robot apart from the one its user knows, by name.
    pub(crate) fn against(&self, n: &Self) -> BTreeMap<&'static str, f64> {
        BTreeMap::from([
            ("mass", self.mass / n.mass),
            ("yaw_inertia", self.yaw_inertia / n.yaw_inertia),
            ("com_height", self.height / n.height),
            ("com_x_m", self.centre[0] - n.centre[0]),
            ("com_y_m", self.centre[1] - n.centre[1]),
            ("adhesion", self.adhesion / n.adhesion),
            ("rolling_resistance", self.rolling / n.rolling),
            ("coulomb_left", self.coulomb[0] / n.coulomb[0]),
            ("coulomb_right", self.coulomb[1] / n.coulomb[1]),
            ("viscous", self.viscous[0] / n.viscous[0]),
            ("torque_constant", self.torque_gain),
            ("motor_inertia", self.motor_inertia / n.motor_inertia),
            ("slip_at_peak", self.peak_slip),
            ("slip_at_peak_sideways", self.peak_slip * self.side_slip),
            ("lateral_friction", self.lateral),
            ("friction_loss_with_load", self.load_loss),
            ("friction_loss_sliding", self.sliding_loss),
            ("relaxation_m", self.relaxation),
            ("load_lag_s", self.load_lag),
            ("presliding_rad", self.presliding),
        ])
    }

    /// Half the weight times the radius: the scale of a side's torque.
    pub(crate) fn torque_scale(&self) -> f64 {
        0.5 * self.mass * GRAVITY * self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::{Constants, digits};
    use crate::{RobotClass, TyreLaw};

    #[test]
    fn data_sheet_values_have_five_digits() {
        assert_eq!(digits(12.345_678), 12.346);
        assert_eq!(digits(0.001_234_567), 0.001_234_6);
        assert_eq!(digits(-0.3), -0.3);
    }

    #[test]
    fn robots_of_any_mass_pass_through_the_classes() {
        for of_class in super::MIDDLE {
            for (a, b) in super::middle_of(of_class[0]).into_iter().zip(of_class) {
                assert!((a / b - 1.0).abs() < 1e-12);
            }
        }
        let [mass, base, _, radius, ..] = super::middle_of(300.0);
        assert!((mass - 300.0).abs() < 1e-9 && base > 0.4 && radius > 0.25 && radius < base);
    }

    #[test]
    fn the_true_robot_is_near_the_stated_one() {
        for class in [RobotClass::Small, RobotClass::Medium, RobotClass::Large] {
            for seed in 0..20 {
                let n = Constants::nominal(seed, class, TyreLaw::Brush);
                let t = n.truth(seed);
                assert!((t.mass / n.mass).ln().abs() < 0.031);
                assert!((t.adhesion / n.adhesion).ln().abs() < 0.241);
                assert!(t.mass != n.mass && t.centre[0].abs() < 0.0121);
            }
        }
    }
}
