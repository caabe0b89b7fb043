//! The single-track car: steering servo, drive, tyres, and its motion over a grid of steps.
//!
//! Steering: command `u` to angle `δ = A u + A₂ |u| u³/|u|… ` by [`Laws::map`], then dead time, lag, a largest rate and play.
//! Drive: `v̇ = g e − (c₁ + c₂ |e| + c₃ [e ≠ 0] + c₄ |v|) v − f sgn v + v_y r − λ_f f_f δ − G s·(cos ψ, sin ψ)` with the throttle `e` beyond the
//! dead zone, after its lag, gravity `G` and the slope `s` of the ground along the map's axes; sideways a slope pulls alike.
//! Tyres: side acceleration of an axle `f = α/√(k² + (α q)²)` at a slip angle `α`: compliance `k` (rad s²/m), largest `1/q`.
//! Encoder: speed `c v (1 + κ (v r)²)`: driven wheels slip by their push over their stiffness; the push makes up for the drag
//! of tyres that grip sideways, `f_f δ ≈ k f²` (Kiencke & Nielsen).
//! Lateral velocity and yaw rate take implicit steps, stable at every speed; for `k → 0` they are those of the kinematic car
//! (Kiencke & Nielsen, Automotive Control Systems; CommonRoad vehicle models).

use crate::drive::Drive;
use crate::settings::{Model, SETTINGS};

const RULES: Model = SETTINGS.model;
/// Step of the grid, s.
pub(crate) const STEP: f64 = SETTINGS.grid.step;

/// How the tyres act.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Lateral {
    /// Compliance and grip of both axles, lateral velocity and yaw rate as states.
    Dynamic,
    /// The same with the Pacejka formula `D sin(C atan(B α))`.
    Pacejka,
    /// Yaw rate at once: `r = v tan δ / (L + K v²)`, the compliance of the front standing for K.
    Kinematic,
}

/// Laws of a car.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Laws {
    pub(crate) lateral: Lateral,
    pub(crate) full: f64,
    pub(crate) centre: f64,
    pub(crate) curve: f64,
    pub(crate) asymmetry: f64,
    pub(crate) delay: f64,
    pub(crate) lag: f64,
    pub(crate) slowness: f64,
    pub(crate) play: f64,
    pub(crate) wheelbase: f64,
    /// Centre of mass ahead of the rear axle.
    pub(crate) rear: f64,
    pub(crate) gyration: f64,
    pub(crate) front_compliance: f64,
    pub(crate) rear_compliance: f64,
    pub(crate) front_inverse_grip: f64,
    pub(crate) rear_inverse_grip: f64,
    pub(crate) gain: f64,
    pub(crate) dead_zone: f64,
    pub(crate) back_emf: f64,
    pub(crate) friction: f64,
    pub(crate) viscous: f64,
    pub(crate) motor_braking: f64,
    pub(crate) drag: f64,
    pub(crate) drive_lag: f64,
    pub(crate) drive_delay: f64,
    /// Slope of the ground along x and y, positive where it rises.
    pub(crate) slope: [f64; 2],
    pub(crate) point: [f64; 2],
    pub(crate) direction: f64,
    pub(crate) clock: f64,
    pub(crate) gyro_scale: f64,
    pub(crate) gyro_bias: f64,
    pub(crate) gyro_delay: f64,
    pub(crate) encoder_scale: f64,
    /// Share by which the encoder is ahead, over the square of the sideways acceleration.
    pub(crate) wheel_slip: f64,
    pub(crate) encoder_delay: f64,
}

/// Place of the rear axle, heading, speed forward, lateral velocity of the centre of mass, yaw rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct State {
    pub(crate) place: [f64; 2],
    pub(crate) yaw: f64,
    pub(crate) speed: f64,
    pub(crate) side: f64,
    pub(crate) rate: f64,
}

/// Steering angle and throttle beyond the dead zone of every step of a drive.
#[derive(Debug, Clone)]
pub(crate) struct Inputs {
    pub(crate) steering: Vec<f64>,
    pub(crate) throttle: Vec<f64>,
}

impl Laws {
    /// Steering angle that a command asks for.
    pub(crate) fn map(&self, u: f64) -> f64 {
        self.centre + self.full * u + self.curve * (u * u * u - u) + self.asymmetry * u * u
    }

    /// What steering and drive do with the commands of a drive: they depend on nothing else.
    pub(crate) fn inputs(&self, drive: &Drive) -> Inputs {
        self.inputs_between(drive, 0, drive.steps())
    }

    /// The same of some steps; those before are none.
    pub(crate) fn inputs_between(&self, drive: &Drive, first: usize, last: usize) -> Inputs {
        let steps = last.min(drive.steps());
        // Implicit steps: exact in the delay of slow commands, however short the lag.
        let share = |lag: f64| STEP / (STEP + lag.abs());
        let (of_lag, of_drive) = (share(self.lag), share(self.drive_lag));
        let most = STEP / self.slowness.abs().max(RULES.tiny);
        let mut out = Inputs { steering: Vec::with_capacity(steps), throttle: Vec::with_capacity(steps) };
        out.steering.resize(first, 0.0);
        out.throttle.resize(first, 0.0);
        let mut settled = self.map(drive.steering.mean(STEP * first as f64 + self.clock - self.delay));
        let (mut turned, mut held, mut effort) = (settled, settled, 0.0);
        // What is below none leads instead of lagging, so that differences about none have one slope.
        let signed = |size: f64, before: f64, after: f64| if size < 0.0 { 2.0 * before - after } else { after };
        for k in first..steps {
            let time = STEP * k as f64 + self.clock;
            let wanted = self.map(drive.steering.mean(time - self.delay));
            settled += (wanted - settled) * of_lag;
            let asked = signed(self.lag, wanted, settled);
            turned += (asked - turned).clamp(-most, most);
            let angle = signed(self.slowness, asked, turned);
            held = held.clamp(angle - self.play.abs(), angle + self.play.abs());
            out.steering.push(signed(self.play, angle, held));

            let u = drive.throttle.mean(time - self.drive_delay);
            let pushed = (u.abs() - self.dead_zone).max(0.0) * u.signum();
            effort += (pushed - effort) * of_drive;
            out.throttle.push(signed(self.drive_lag, pushed, effort));
        }
        out
    }

    /// Secant of a tyre: side acceleration over slip angle.
    fn secant(&self, slip: f64, compliance: f64, inverse_grip: f64) -> f64 {
        let k = compliance.max(RULES.least_compliance);
        let q = inverse_grip.max(0.0);
        if self.lateral == Lateral::Pacejka && q > RULES.tiny {
            let c = RULES.pacejka_shape;
            let x = (q / (k * c) * slip).abs().max(RULES.tiny);
            return (c * x.atan()).sin() / x / (k * c);
        }
        1.0 / (k * k + (slip * q).powi(2)).sqrt()
    }

    /// Speed after a step with a push, where cornering and a slope cost some deceleration.
    pub(crate) fn speed_after(&self, speed: f64, effort: f64, drag: f64) -> f64 {
        let driven = speed + STEP * (self.gain * effort - drag);
        let on = (effort.abs() / RULES.throttle_on).min(1.0);
        let of_motor = self.back_emf * effort.abs() + self.motor_braking * on;
        let damped = driven / (1.0 + STEP * (self.viscous + of_motor + self.drag * speed.abs()).max(0.0));
        damped.signum() * (damped.abs() - STEP * self.friction).max(0.0)
    }

    /// One step.
    pub(crate) fn step(&self, s: &mut State, steering: f64, effort: f64) {
        let tan = steering.tan();
        let length = self.wheelbase;
        // Between the axles, or the car would not stand.
        let front = (length - self.rear).max(RULES.least_share * length);
        let before = *s;
        let (sin, cos) = s.yaw.sin_cos();
        let [x, y] = self.slope.map(|slope| RULES.gravity * slope);
        let [uphill, to_the_left] = [x * cos + y * sin, y * cos - x * sin];
        let mut drag = uphill;
        if self.lateral == Lateral::Kinematic {
            s.rate = s.speed * tan / (length + self.front_compliance * s.speed * s.speed);
            s.side = self.rear * s.rate;
        } else {
            let slow = s.speed.abs().max(RULES.slow);
            let slip_front = (s.speed * tan - s.side - front * s.rate) / slow;
            let slip_rear = (self.rear * s.rate - s.side) / slow;
            let a = self.secant(slip_front, self.front_compliance, self.front_inverse_grip);
            let b = self.secant(slip_rear, self.rear_compliance, self.rear_inverse_grip);
            let (share, h) = (self.rear / length, STEP);
            let turn = front * self.rear / (self.gyration * length);
            // f_front = a (v tan − side − front rate)/slow, f_rear = b (rear rate − side)/slow.
            let [p, q] = [h * a / slow, h * b / slow];
            let m = [
                [1.0 + share * p + (1.0 - share) * q, share * p * front - (1.0 - share) * q * self.rear + h * s.speed],
                [turn * (p - q), 1.0 + turn * (p * front + q * self.rear)],
            ];
            let w = [s.side + share * p * s.speed * tan - h * to_the_left, s.rate + turn * p * s.speed * tan];
            let det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
            s.side = (w[0] * m[1][1] - w[1] * m[0][1]) / det;
            s.rate = (w[1] * m[0][0] - w[0] * m[1][0]) / det;
            let force = a * (before.speed * tan - s.side - front * s.rate) / slow;
            drag += share * force * steering.sin() - s.side * s.rate;
        }
        s.speed = self.speed_after(s.speed, effort, drag);

        // The middle of the step.
        let yaw = s.yaw + 0.5 * STEP * s.rate;
        let ahead = 0.5 * (before.speed + s.speed);
        let across = s.side - self.rear * s.rate;
        s.place[0] += STEP * (ahead * yaw.cos() - across * yaw.sin());
        s.place[1] += STEP * (ahead * yaw.sin() + across * yaw.cos());
        s.yaw += STEP * s.rate;
    }

    /// Runs from a state, and gives it after every step.
    pub(crate) fn run(&self, mut state: State, inputs: &Inputs, from: usize, steps: usize) -> Vec<State> {
        let step = |k: usize| {
            self.step(&mut state, inputs.steering[k], inputs.throttle[k]);
            state
        };
        (from..(from + steps).min(inputs.steering.len())).map(step).collect()
    }

    /// What the encoder shows of a speed and a yaw rate.
    pub(crate) fn encoder(&self, speed: f64, rate: f64) -> f64 {
        self.encoder_scale * speed * (1.0 + self.wheel_slip * (speed * rate).powi(2))
    }

    /// The speed of which the encoder shows so much: by one step from where no wheel slips, which small shares need.
    pub(crate) fn speed_of_encoder(&self, shown: f64, rate: f64) -> f64 {
        let speed = shown / self.encoder_scale;
        speed / (1.0 + self.wheel_slip * (speed * rate).powi(2))
    }

    /// The pose that is measured of a state.
    pub(crate) fn tracked(&self, s: &State) -> [f64; 3] {
        let (sin, cos) = s.yaw.sin_cos();
        let [px, py] = self.point;
        [s.place[0] + cos * px - sin * py, s.place[1] + sin * px + cos * py, s.yaw + self.direction]
    }

    /// The state of a measured pose and its rates, m/s, rad/s.
    pub(crate) fn state(&self, pose: [f64; 3], rates: [f64; 3]) -> State {
        let yaw = pose[2] - self.direction;
        let (sin, cos) = yaw.sin_cos();
        let [px, py] = self.point;
        let ahead = rates[0] * cos + rates[1] * sin;
        let across = rates[1] * cos - rates[0] * sin;
        State {
            place: [pose[0] - cos * px + sin * py, pose[1] - sin * px - cos * py],
            yaw,
            speed: ahead + rates[2] * py,
            side: across - rates[2] * (px - self.rear),
            rate: rates[2],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::car::{Car, Stated};
    use crate::constant_table::constants;

    #[test]
    fn wheels_that_slip_in_bends_are_ahead_there_and_only_there() {
        let all = constants(&Car::new("drawn", 0.25));
        let laws = Laws { encoder_scale: 1.1, wheel_slip: 2e-3, ..Laws::at(&all, &vec![0.0; all.len()]) };
        assert!((laws.encoder(2.0, 0.0) / 2.2 - 1.0).abs() < 1e-12);
        // 6 m/s²: 7 % ahead; the speed is found again to some thousandths.
        let shown = laws.encoder(2.0, 3.0);
        assert!((shown / 2.2 - 1.072).abs() < 1e-12, "{shown}");
        assert!((laws.speed_of_encoder(shown, 3.0) / 2.0 - 1.0).abs() < 0.012);
    }

    #[test]
    fn a_motor_brakes_only_while_there_is_throttle_and_only_where_its_drive_is_stated() {
        let mut car = Car::new("drawn", 0.25);
        let laws = |car: &Car| {
            let all = constants(car);
            Laws::at(&all, &vec![0.0; all.len()])
        };
        assert_eq!((laws(&car).motor_braking, laws(&car).drag, laws(&car).drive_delay), (0.0, 0.0, 0.0));
        car.drive_gain = Stated::of(10.0, 0.5);
        let laws = laws(&car);
        assert!(laws.motor_braking > 0.0 && laws.drag > 0.0);
        let lost = |effort: f64| 2.0 + STEP * laws.gain * effort - laws.speed_after(2.0, effort, 0.0);
        let more = lost(RULES.throttle_on) - lost(0.0);
        assert!((more - 2.0 * STEP * laws.motor_braking).abs() < 0.1 * more, "{more}");
    }
}
