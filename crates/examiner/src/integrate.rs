//! Classical Runge-Kutta of fourth order with a fixed step; explicit steps as an artefact.

use crate::hidden::Hidden;
use crate::plant::{Moment, N, Plant, State};

/// Seconds of a step.
pub(crate) const STEP: f64 = 0.000_25;

/// Moves a state on: by Runge-Kutta, or as a simulator with coarse explicit steps would.
#[derive(Debug, Clone)]
pub(crate) struct Stepper {
    step: f64,
    /// Calls that one explicit step stands for; zero for none.
    stride: usize,
    calls: usize,
    felt: [f64; 2],
}

impl Stepper {
    /// A stepper that is called every `step` seconds.
    pub(crate) fn new(hidden: &Hidden, step: f64) -> Self {
        let stride = (hidden.foreign.explicit_step / step).round() as usize;
        Self { step, stride, calls: 0, felt: [0.0; 2] }
    }

    /// Moves the state on; gives the specific force.
    pub(crate) fn step(&mut self, plant: &Plant, s: &mut State, m: &Moment) -> [f64; 2] {
        if self.stride == 0 {
            return advance(plant, s, m, self.step);
        }
        if self.calls.is_multiple_of(self.stride) {
            let (rates, felt) = plant.rates(s, m);
            for (x, rate) in s.iter_mut().zip(rates) {
                *x += self.stride as f64 * self.step * rate;
            }
            self.felt = felt;
        }
        self.calls += 1;
        self.felt
    }
}

/// Moves the state by `step`; gives the specific force at its start.
pub(crate) fn advance(plant: &Plant, s: &mut State, m: &Moment, step: f64) -> [f64; 2] {
    let (k1, felt) = plant.rates(s, m);
    let at = |k: &State, h: f64| -> State { std::array::from_fn(|i| s[i] + h * k[i]) };
    let (k2, _) = plant.rates(&at(&k1, 0.5 * step), m);
    let (k3, _) = plant.rates(&at(&k2, 0.5 * step), m);
    let (k4, _) = plant.rates(&at(&k3, step), m);
    for i in 0..N {
        s[i] += step / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
    }
    felt
}

#[cfg(test)]
mod tests {
    use super::{STEP, advance};
    use crate::hidden::Hidden;
    use crate::plant::{Moment, N, Plant, SPEED, State};
    use crate::robot::Constants;
    use crate::{RobotClass, TyreLaw};

    fn robot(class: RobotClass, law: TyreLaw) -> Constants {
        Constants::nominal(3, class, law)
    }

    fn run(plant: &Plant, s: &mut State, torque: [f64; 2], seconds: f64, step: f64) -> [f64; 2] {
        let m = Moment { torque, ..Moment::default() };
        let mut felt = [0.0; 2];
        for _ in 0..(seconds / step).round() as usize {
            felt = advance(plant, s, &m, step);
        }
        felt
    }

    #[test]
    fn a_straight_run_settles_where_torque_balances_friction() {
        for law in [TyreLaw::Brush, TyreLaw::Pacejka] {
            for class in [RobotClass::Small, RobotClass::Medium, RobotClass::Large] {
                let c = robot(class, law);
                let plant = Plant::new(&c, &Hidden::default());
                let mut s = [0.0; N];
                let omega = 8.0;
                let rolling = 0.5 * c.mass * 9.81 * c.rolling * c.radius;
                let torque = c.coulomb[0] + c.viscous[0] * omega + rolling;
                let time = 8.0 * c.mass * c.radius * c.radius / c.viscous[0];
                run(&plant, &mut s, [torque; 2], time, STEP);
                assert!((s[SPEED + 1] - omega).abs() < 0.08, "{class:?} {}", s[SPEED + 1]);
                assert!(s[5].abs() < 1e-9 && s[4].abs() < 1e-9);
                assert!((s[3] / (omega * c.radius) - 1.0).abs() < 0.02);
            }
        }
    }

    #[test]
    fn left_and_right_mirror_each_other() {
        let plant = Plant::new(&robot(RobotClass::Medium, TyreLaw::Brush), &Hidden::default());
        let (mut a, mut b) = ([0.0; N], [0.0; N]);
        run(&plant, &mut a, [6.0, -2.0], 2.0, STEP);
        run(&plant, &mut b, [-2.0, 6.0], 2.0, STEP);
        assert!(a[5] < -0.3, "{}", a[5]);
        assert!((a[5] + b[5]).abs() < 1e-9 && (a[1] + b[1]).abs() < 1e-9);
        assert!((a[0] - b[0]).abs() < 1e-9 && (a[SPEED] - b[SPEED + 2]).abs() < 1e-9);
    }

    // Carcasses that unwind may rock it back a little.
    #[test]
    fn a_robot_left_alone_stops_and_stays() {
        let plant = Plant::new(&robot(RobotClass::Medium, TyreLaw::Pacejka), &Hidden::default());
        let mut s = [0.0; N];
        run(&plant, &mut s, [0.0; 2], 1.0, STEP);
        assert!(s.iter().all(|x| *x == 0.0));
        s = plant.settled([0.0, 0.0, 0.0, 0.8, 0.0, 1.0], [7.0, 9.0], [0.0; 2]);
        let c = robot(RobotClass::Medium, TyreLaw::Pacejka);
        let energy = |s: &State| {
            let wheels: f64 = (0..4)
                .map(|i| {
                    let motor = if i % 2 == 1 { c.motor_inertia } else { 0.0 };
                    (c.wheel_inertia + motor) * s[SPEED + i].powi(2)
                })
                .sum();
            0.5 * (c.mass * (s[3] * s[3] + s[4] * s[4]) + c.yaw_inertia * s[5] * s[5] + wheels)
        };
        let start = energy(&s);
        let mut before = energy(&s);
        for _ in 0..20 {
            run(&plant, &mut s, [0.0; 2], 0.1, STEP);
            assert!(energy(&s) < before + 1e-3 * start, "{} {before}", energy(&s));
            before = energy(&s);
        }
        run(&plant, &mut s, [0.0; 2], 4.0, STEP);
        assert!(energy(&s) < 1e-5 * start, "{}", energy(&s));
    }

    #[test]
    fn a_gentle_slope_is_held_by_dry_friction_and_felt_by_the_accelerometer() {
        let h = Hidden { slope: [0.02, 0.0], ..Hidden::default() };
        let plant = Plant::new(&robot(RobotClass::Medium, TyreLaw::Brush), &h);
        let mut s = [0.0; N];
        let felt = run(&plant, &mut s, [0.0; 2], 5.0, STEP);
        assert!(s[3].abs() < 1e-3 && s[0] < 0.02, "{} {}", s[3], s[0]);
        assert!((felt[0] + 9.81 * 0.02).abs() < 0.02, "{}", felt[0]);
    }

    #[test]
    fn half_the_step_changes_next_to_nothing() {
        let plant = Plant::new(&robot(RobotClass::Small, TyreLaw::Brush), &Hidden::default());
        let (mut a, mut b) = ([0.0; N], [0.0; N]);
        run(&plant, &mut a, [0.5, -0.3], 1.0, STEP);
        run(&plant, &mut b, [0.5, -0.3], 1.0, 0.5 * STEP);
        assert!((a[5] - b[5]).abs() < 1e-4 && (a[SPEED] - b[SPEED]).abs() < 1e-3);
    }
}
