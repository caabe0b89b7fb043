//! The car: commands in, motion out, by small steps.

use std::collections::VecDeque;

/// Step of the plant, s.
pub(super) const STEP: f64 = 0.000_5;
/// Speed below which tyres roll without slip, m/s: the brush law is stiff there.
const SLOW: f64 = 0.4;
/// Gravity, m/s².
pub(super) const GRAVITY: f64 = 9.81;
/// Share of the voltage below which the bridge is open.
const FREE: f64 = 0.01;
/// A servo reads its pulse so often, s.
const PULSE: f64 = 0.02;

/// Tyres of both axles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tyres {
    /// Side acceleration of the axle per slip angle at small angles, front and rear, m/s² per rad.
    pub(super) stiffness: [f64; 2],
    /// Coefficient of friction.
    pub(super) friction: f64,
}

/// A car as it is.
#[derive(Debug, Clone)]
pub(super) struct Car {
    pub(super) wheelbase: f64,
    /// Centre of mass ahead of the rear axle, m.
    pub(super) rear: f64,
    /// Height of the centre of mass, m.
    pub(super) height: f64,
    /// Yaw inertia over mass, m².
    pub(super) gyration: f64,
    /// Steering angle at full command, rad.
    pub(super) full: f64,
    pub(super) centre: f64,
    /// Share of the gain near the centre that is lost, and found beyond.
    pub(super) bend: f64,
    /// Natural frequency of the servo, rad/s; it is critically damped.
    pub(super) servo: f64,
    /// Dead time of the steering beyond its pulse, s.
    pub(super) delay: f64,
    /// Lag before the servo, s.
    pub(super) lag: f64,
    /// Time for a radian at the largest rate, s.
    pub(super) slowness: f64,
    /// Half of the play of the linkage, rad.
    pub(super) play: f64,
    pub(super) tyres: Option<Tyres>,
    /// Acceleration at full throttle at rest, m/s².
    pub(super) drive: f64,
    pub(super) dead_zone: f64,
    /// Speed at which full throttle pushes no more, m/s.
    pub(super) top_speed: f64,
    /// Dry friction, m/s².
    pub(super) dry: f64,
    /// Drag, 1/m.
    pub(super) drag: f64,
    /// Time constant of the current, s.
    pub(super) motor_lag: f64,
    /// Slope of the ground along x and y, positive where it rises, rad.
    pub(super) slope: [f64; 2],
}

impl Car {
    /// Acceleration by its weight on the slope, ahead and to the left, m/s².
    fn weight_along(&self, yaw: f64) -> [f64; 2] {
        let [x, y] = self.slope.map(|slope| -GRAVITY * slope.sin());
        let (sin, cos) = yaw.sin_cos();
        [x * cos + y * sin, y * cos - x * sin]
    }
}

/// State of a car: x, y of the rear axle, heading, velocity of the centre of mass, yaw rate.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Motion {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) yaw: f64,
    pub(super) speed: f64,
    pub(super) side: f64,
    pub(super) rate: f64,
}

/// A car in motion.
pub(super) struct Driven<'a> {
    car: &'a Car,
    pub(super) motion: Motion,
    /// Commands on their way.
    late: VecDeque<f64>,
    pulse: f64,
    next_pulse: f64,
    lagged: f64,
    servo: [f64; 2],
    wheels: f64,
    effort: f64,
    /// Acceleration ahead of the step before, m/s².
    ahead: f64,
    time: f64,
}

impl<'a> Driven<'a> {
    pub(super) fn new(car: &'a Car, motion: Motion) -> Self {
        let waiting = (car.delay / STEP).round() as usize;
        let straight = car.centre;
        Self {
            car,
            motion,
            late: VecDeque::from(vec![0.0; waiting + 1]),
            pulse: straight,
            next_pulse: 0.0,
            lagged: straight,
            servo: [straight, 0.0],
            wheels: straight,
            effort: 0.0,
            ahead: 0.0,
            time: 0.0,
        }
    }

    /// A step with throttle and steering commands from −1 to 1.
    pub(super) fn step(&mut self, throttle: f64, steering: f64) {
        self.steer(steering);
        self.push(throttle);
        self.time += STEP;
    }

    fn steer(&mut self, command: f64) {
        let car = self.car;
        self.late.push_back(command);
        let command = self.late.pop_front().unwrap_or(command);
        if self.time >= self.next_pulse {
            self.pulse = car.centre + car.full * (command + car.bend * (command.powi(3) - command));
            self.next_pulse += PULSE;
        }
        self.lagged =
            if car.lag > STEP { self.lagged + (self.pulse - self.lagged) * STEP / car.lag } else { self.pulse };
        let [angle, rate] = self.servo;
        let pull = car.servo.powi(2) * (self.lagged - angle) - 2.0 * car.servo * rate;
        let most = 1.0 / car.slowness.max(0.01);
        let rate = (rate + STEP * pull).clamp(-most, most);
        self.servo = [angle + STEP * rate, rate];
        self.wheels = self.wheels.clamp(self.servo[0] - car.play, self.servo[0] + car.play);
    }

    fn push(&mut self, throttle: f64) {
        let car = self.car;
        let beyond = (throttle.abs() - car.dead_zone).max(0.0) * throttle.signum();
        self.effort += (beyond - self.effort) * STEP / car.motor_lag.max(STEP);
        let Motion { speed, yaw, .. } = self.motion;
        // A voltage that is ramped, against a back-EMF; a motor without voltage rolls free of it.
        let back = if self.effort.abs() < FREE { 0.0 } else { speed / car.top_speed };
        let driven = car.drive * (self.effort - back);

        let drag_of_tyres = self.turn();
        let m = &mut self.motion;
        let before = m.speed;
        let [ahead, _] = car.weight_along(yaw);
        let free = m.speed + STEP * (driven + ahead - car.drag * m.speed * m.speed.abs() - drag_of_tyres);
        m.speed = free.signum() * (free.abs() - STEP * car.dry).max(0.0);
        self.ahead = (m.speed - before) / STEP;

        let middle = yaw + 0.5 * STEP * m.rate;
        let across = m.side - car.rear * m.rate;
        m.x += STEP * (m.speed * middle.cos() - across * middle.sin());
        m.y += STEP * (m.speed * middle.sin() + across * middle.cos());
        m.yaw += STEP * m.rate;
    }

    /// Moves side velocity and yaw rate; the deceleration that cornering costs, m/s².
    fn turn(&mut self) -> f64 {
        let car = self.car;
        let m = &mut self.motion;
        let front = car.wheelbase - car.rear;
        let rolling = |m: &mut Motion, angle: f64| {
            m.rate = m.speed * angle.tan() / car.wheelbase;
            m.side = car.rear * m.rate;
        };
        let Some(tyres) = car.tyres else {
            rolling(m, self.wheels);
            return 0.0;
        };
        if m.speed.abs() < SLOW {
            rolling(m, self.wheels);
            return 0.0;
        }
        // Load goes back under acceleration.
        let shift = (car.height / car.wheelbase * self.ahead / GRAVITY).clamp(-0.2, 0.2);
        let share = [car.rear / car.wheelbase - shift, front / car.wheelbase + shift];
        let slip = [
            self.wheels * m.speed.signum() - ((m.side + front * m.rate) / m.speed.abs()).atan(),
            -((m.side - car.rear * m.rate) / m.speed.abs()).atan(),
        ];
        // Half of the push goes over each axle and takes from what holds sideways.
        let used = (self.ahead / (tyres.friction * GRAVITY)).clamp(-0.9, 0.9);
        let left = (1.0 - used * used).sqrt();
        let force =
            [0, 1].map(|k| share[k] * brush(slip[k].tan(), tyres.stiffness[k], left * tyres.friction * GRAVITY));
        let [_, to_the_left] = car.weight_along(m.yaw);
        m.side += STEP * (force[0] * self.wheels.cos() + force[1] + to_the_left - m.speed * m.rate);
        m.rate += STEP * (front * force[0] * self.wheels.cos() - car.rear * force[1]) / car.gyration;
        force[0] * self.wheels.sin() - m.side * m.rate
    }
}

/// Side acceleration of an axle by the brush model (Fiala): a cubic up to full sliding.
fn brush(slip: f64, stiffness: f64, most: f64) -> f64 {
    let z = stiffness * slip.abs() / most;
    let grown = if z < 3.0 { z - z * z / 3.0 + z.powi(3) / 27.0 } else { 1.0 };
    slip.signum() * most * grown
}

#[cfg(test)]
mod tests {
    use super::*;

    fn car(tyres: Option<Tyres>) -> Car {
        Car {
            wheelbase: 0.26,
            rear: 0.13,
            height: 0.05,
            gyration: 0.104 * 0.26 * 0.26,
            full: 0.4,
            centre: 0.0,
            bend: 0.0,
            servo: 80.0,
            delay: 0.0,
            lag: 0.0,
            slowness: 0.05,
            play: 0.0,
            tyres,
            drive: 8.0,
            dead_zone: 0.05,
            top_speed: 8.0,
            dry: 0.4,
            drag: 0.02,
            motor_lag: 0.03,
            slope: [0.0; 2],
        }
    }

    /// Radius of the circle that a car ends in.
    fn radius(car: &Car, throttle: f64) -> f64 {
        let mut driven = Driven::new(car, Motion { speed: 0.5, ..Motion::default() });
        for _ in 0..20_000 {
            driven.step(throttle, 0.5);
        }
        driven.motion.speed / driven.motion.rate
    }

    #[test]
    fn a_car_without_slip_turns_by_its_geometry_and_equal_tyres_neither_under_nor_oversteer() {
        let geometric = 0.26 / 0.2_f64.tan();
        assert!((radius(&car(None), 0.3) - geometric).abs() < 0.01 * geometric);
        let equal = Tyres { stiffness: [100.0, 100.0], friction: 1.2 };
        assert!((radius(&car(Some(equal)), 0.3) - geometric).abs() < 0.05 * geometric);
        let soft_front = Tyres { stiffness: [50.0, 100.0], friction: 1.2 };
        assert!(radius(&car(Some(soft_front)), 0.3) > 1.05 * geometric, "it understeers");
    }

    #[test]
    fn sideways_acceleration_ends_at_the_friction() {
        let slippery = car(Some(Tyres { stiffness: [100.0, 120.0], friction: 0.3 }));
        let mut driven = Driven::new(&slippery, Motion { speed: 1.0, ..Motion::default() });
        let mut most: f64 = 0.0;
        for _ in 0..20_000 {
            driven.step(0.5, 0.8);
            most = most.max((driven.motion.speed * driven.motion.rate).abs());
        }
        assert!(most > 2.0 && most < 4.0, "{most}");
    }
}
