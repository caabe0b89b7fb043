//! The true robot: explicit steps, brush tyres, casters.

/// A wheel.
#[derive(Debug, Clone)]
pub(super) struct Wheel {
    pub(super) name: String,
    pub(super) place: [f64; 2],
    pub(super) direction: f64,
    /// From its axle to the axles of its rollers, rad.
    pub(super) roller: Option<f64>,
    pub(super) radius: f64,
    pub(super) inertia: f64,
    pub(super) motor: Option<usize>,
    pub(super) is_steered: bool,
}

/// A motor, seen at its wheels.
#[derive(Debug, Clone)]
pub(super) struct Motor {
    pub(super) name: String,
    pub(super) is_differential: bool,
    pub(super) inertia: f64,
    pub(super) gain: f64,
    pub(super) lag: f64,
    pub(super) coulomb: f64,
    pub(super) viscous: f64,
}

/// A caster: pivot and trail.
#[derive(Debug, Clone, Copy)]
pub(super) struct Caster {
    pub(super) pivot: [f64; 2],
    pub(super) trail: f64,
    pub(super) rolling: f64,
}

/// The robot.
#[derive(Debug, Clone)]
pub(super) struct Robot {
    pub(super) mass: f64,
    pub(super) inertia: f64,
    pub(super) com: [f64; 3],
    pub(super) wheels: Vec<Wheel>,
    pub(super) motors: Vec<Motor>,
    pub(super) casters: Vec<Caster>,
    /// x of what is steered; the axle that is not lies at 0.
    pub(super) steered_at: f64,
    pub(super) steering_zero: f64,
    pub(super) steering_gain: f64,
    pub(super) adhesion: f64,
    /// Slip at which a brush slides whole.
    pub(super) slip: f64,
    pub(super) rolling: f64,
    pub(super) roller_drag: f64,
    /// Force at its centre of mass over the square of its speed, N s²/m².
    pub(super) drag: f64,
    /// Gravity along the world, m/s².
    pub(super) slope: [f64; 2],
}

/// What moves.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub(super) place: [f64; 2],
    pub(super) yaw: f64,
    /// Velocity of the centre of mass in the body.
    velocity: [f64; 2],
    pub(super) rate: f64,
    pub(super) spin: Vec<f64>,
    torque: Vec<f64>,
    caster: Vec<f64>,
    specific: [f64; 2],
    /// Last changes of velocity and yaw rate, per second.
    gained: [f64; 3],
}

const GRAVITY: f64 = 9.81;
/// Speed of a wheel over which dry friction changes its sign, rad/s.
const STICKS: f64 = 0.08;
/// Speed below which slip is that at this speed, m/s.
const SLOW: f64 = 0.25;

impl Robot {
    pub(super) fn at_rest(&self) -> State {
        State {
            place: [0.0; 2],
            yaw: 0.0,
            velocity: [0.0; 2],
            rate: 0.0,
            spin: vec![0.0; self.wheels.len()],
            torque: vec![0.0; self.motors.len()],
            caster: vec![0.0; self.casters.len()],
            specific: [0.0; 2],
            gained: [0.0; 3],
        }
    }

    /// Direction in which a wheel rolls at a steering angle.
    pub(super) fn direction(&self, wheel: &Wheel, steering: f64) -> f64 {
        if !wheel.is_steered || steering == 0.0 {
            return wheel.direction;
        }
        // Ackermann: about the point on the rear axle that a wheel in the middle turns about.
        let about = self.steered_at / steering.tan();
        let angle = (wheel.place[0] / (about - wheel.place[1])).atan();
        angle + wheel.direction
    }

    /// The axis along which a wheel's contact holds.
    pub(super) fn axis(&self, wheel: &Wheel, steering: f64) -> [f64; 2] {
        let e = self.direction(wheel, steering);
        let at = wheel.roller.map_or(e, |roller| e + 0.5 * std::f64::consts::PI + roller);
        [at.cos(), at.sin()]
    }

    /// Loads of wheels, then of casters: a plane over their places.
    fn loads(&self, specific: [f64; 2]) -> Vec<f64> {
        let places: Vec<[f64; 2]> =
            self.wheels.iter().map(|w| w.place).chain(self.casters.iter().map(|c| c.pivot)).collect();
        let at = |p: &[f64; 2]| [1.0, p[0] - self.com[0], p[1] - self.com[1]];
        let mut m = [[0.0; 4]; 3];
        for p in &places {
            let row = at(p);
            for i in 0..3 {
                for j in 0..3 {
                    m[i][j] += row[i] * row[j];
                }
            }
        }
        let lever = self.mass * self.com[2];
        (m[0][3], m[1][3], m[2][3]) = (self.mass * GRAVITY, -lever * specific[0], -lever * specific[1]);
        // Gauss and Jordan.
        for k in 0..3 {
            let pivot = m[k][k];
            m[k].iter_mut().for_each(|x| *x /= pivot);
            let own = m[k];
            for (_, row) in m.iter_mut().enumerate().filter(|(i, _)| *i != k) {
                let factor = row[k];
                row.iter_mut().zip(own).for_each(|(x, y)| *x -= factor * y);
            }
        }
        places.iter().map(|p| at(p).iter().zip(&m).map(|(x, row)| x * row[3]).sum::<f64>().max(0.0)).collect()
    }

    /// Share of the largest force of a brush at a slip over that at which it slides whole, with a tenth lost beyond.
    fn brush(rho: f64) -> f64 {
        if rho < 1.0 { rho * (3.0 - rho * (3.0 - rho)) } else { 1.0 - 0.1 * (rho - 1.0) / (rho + 2.0) }
    }

    /// One step under the recorded torques and steering angle.
    pub(super) fn step(&self, s: &mut State, torque: &[f64], steering: f64, h: f64) {
        for (k, motor) in self.motors.iter().enumerate() {
            let keep = if motor.lag > 0.0 { (-h / motor.lag).exp() } else { 0.0 };
            s.torque[k] = motor.gain * torque[k] + keep * (s.torque[k] - motor.gain * torque[k]);
        }
        let steering = self.steering_zero + self.steering_gain * steering;
        let loads = self.loads(s.specific);
        let (mut force, mut moment) = ([0.0; 2], 0.0);
        let mut push = |f: [f64; 2], p: [f64; 2]| {
            force = [force[0] + f[0], force[1] + f[1]];
            moment += p[0] * f[1] - p[1] * f[0];
        };
        let (mut turning, mut stiff) = (vec![0.0; self.wheels.len()], vec![0.0; self.wheels.len()]);
        for (i, wheel) in self.wheels.iter().enumerate() {
            let p = [wheel.place[0] - self.com[0], wheel.place[1] - self.com[1]];
            let v = [s.velocity[0] - s.rate * p[1], s.velocity[1] + s.rate * p[0]];
            let at = self.direction(wheel, steering);
            let e = [at.cos(), at.sin()];
            let rim = s.spin[i] * wheel.radius;
            let mut slip = [rim * e[0] - v[0], rim * e[1] - v[1]];
            let mut drag = [0.0; 2];
            if wheel.roller.is_some() {
                let a = self.axis(wheel, steering);
                let along = slip[0] * a[0] + slip[1] * a[1];
                let free = [slip[0] - along * a[0], slip[1] - along * a[1]];
                let speed = free[0].hypot(free[1]);
                let pulled = self.roller_drag * loads[i] * (speed / 0.02).tanh() / speed.max(1e-9);
                drag = free.map(|x| pulled * x);
                slip = a.map(|x| along * x);
            }
            let speed = slip[0].hypot(slip[1]);
            let whole = self.slip * rim.abs().max(SLOW);
            let per_slip = self.adhesion * loads[i] * Self::brush(speed / whole) / speed.max(1e-9);
            let f = [per_slip * slip[0] + drag[0], per_slip * slip[1] + drag[1]];
            push(f, p);
            let held = self.rolling * loads[i] * wheel.radius * (s.spin[i] / STICKS).tanh();
            // How stiff the contact is along the wheel, and how fast the ground runs away below it.
            let a = wheel.roller.map_or(e, |_| self.axis(wheel, steering));
            let along = (e[0] * a[0] + e[1] * a[1]).powi(2);
            let gained = [s.gained[0] - s.gained[2] * p[1], s.gained[1] + s.gained[2] * p[0]];
            let ahead = h * (gained[0] * a[0] + gained[1] * a[1]) * (e[0] * a[0] + e[1] * a[1]);
            turning[i] = wheel.radius * (per_slip * ahead - f[0] * e[0] - f[1] * e[1]) - held;
            stiff[i] = wheel.radius.powi(2) * per_slip * along
                + (self.rolling * loads[i] * wheel.radius) / STICKS * (1.0 - (s.spin[i] / STICKS).tanh().powi(2));
        }
        for (k, caster) in self.casters.iter().enumerate() {
            let p = [caster.pivot[0] - self.com[0], caster.pivot[1] - self.com[1]];
            let v = [s.velocity[0] - s.rate * p[1], s.velocity[1] + s.rate * p[0]];
            let (sin, cos) = s.caster[k].sin_cos();
            let ahead = v[0] * cos + v[1] * sin;
            let pull = -caster.rolling * loads[self.wheels.len() + k] * (ahead / 0.02).tanh();
            push([pull * cos, pull * sin], p);
            s.caster[k] += h * ((v[1] * cos - v[0] * sin) / caster.trail - s.rate);
        }

        for (k, motor) in self.motors.iter().enumerate() {
            let of: Vec<usize> = (0..self.wheels.len()).filter(|&i| self.wheels[i].motor == Some(k)).collect();
            let parts = if motor.is_differential { of.iter().map(|&i| vec![i]).collect() } else { vec![of.clone()] };
            let share = 1.0 / parts.len() as f64;
            for part in parts {
                let spin = s.spin[part[0]];
                let sign = (spin / STICKS).tanh();
                let held = motor.coulomb * sign + motor.viscous * spin;
                let sum: f64 = part.iter().map(|&i| turning[i]).sum();
                let inertia: f64 = motor.inertia * share + part.iter().map(|&i| self.wheels[i].inertia).sum::<f64>();
                let steep = share * motor.coulomb / STICKS * (1.0 - sign * sign);
                let implicit = inertia + h * (steep + part.iter().map(|&i| stiff[i]).sum::<f64>());
                let now = spin + h * (share * (s.torque[k] - held) + sum) / implicit;
                for i in part {
                    s.spin[i] = now;
                }
            }
        }
        for (i, wheel) in self.wheels.iter().enumerate().filter(|(_, w)| w.motor.is_none()) {
            s.spin[i] += h * turning[i] / (wheel.inertia + h * stiff[i]);
        }

        let speed = s.velocity[0].hypot(s.velocity[1]);
        force = [0, 1].map(|k| force[k] - self.drag * speed * s.velocity[k]);
        s.specific = force.map(|f| f / self.mass);
        let (sin, cos) = s.yaw.sin_cos();
        let g = self.slope;
        let pull = [g[0] * cos + g[1] * sin, g[1] * cos - g[0] * sin];
        let v = s.velocity;
        s.gained =
            [s.specific[0] + pull[0] + s.rate * v[1], s.specific[1] + pull[1] - s.rate * v[0], moment / self.inertia];
        s.velocity = [v[0] + h * s.gained[0], v[1] + h * s.gained[1]];
        s.rate += h * s.gained[2];
        let origin = [s.velocity[0] + s.rate * self.com[1], s.velocity[1] - s.rate * self.com[0]];
        s.place[0] += h * (origin[0] * cos - origin[1] * sin);
        s.place[1] += h * (origin[0] * sin + origin[1] * cos);
        s.yaw += h * s.rate;
    }
}
