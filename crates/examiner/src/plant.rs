//! The true robot: four wheels with carcasses, belts, bearings with presliding, lagged loads.

use crate::casters::Casters;
use crate::contact::Contact;
use crate::events::{Events, inside};
use crate::hidden::Hidden;
use crate::law::Friction;
use crate::robot::{Constants, GRAVITY};

/// Numbers in a state.
pub(crate) const N: usize = 33;
/// Places in a state: pose (3), velocity of the geometric centre in body axes and yaw rate (3),
/// then by wheel (FL, RL, FR, RR) speed, angle, dry friction share, carcass deflection along and
/// across, by side belt twist, the lagged specific force (2) and the shifted cargo, and by side the
/// memory of a law. On casters FL and FR are these, and of them nothing but the angle counts.
pub(crate) const VELOCITY: usize = 3;
pub(crate) const YAW_RATE: usize = 5;
pub(crate) const SPEED: usize = 6;
pub(crate) const ANGLE: usize = 10;
const DRY: usize = 14;
const TWIST: usize = 18;
const ALONG: usize = 20;
const ACROSS: usize = 24;
const LOAD: usize = 28;
const CARGO: usize = 30;
pub(crate) const MEMORY: usize = 31;

/// The state of the robot.
pub(crate) type State = [f64; N];

/// What holds still during one step.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Moment {
    /// Torque delivered to each side.
    pub torque: [f64; 2],
    pub coulomb: f64,
    pub rolling: f64,
    pub gust: [f64; 2],
    pub lifted: Option<usize>,
    /// Dry friction of a brake that touches, by side.
    pub touch: [f64; 2],
}

/// A robot with everything that does not change during a run worked out.
#[derive(Debug, Clone)]
pub(crate) struct Plant {
    pub hidden: Hidden,
    c: Constants,
    pub(crate) mass: f64,
    inertia: f64,
    pub(crate) height: f64,
    centre: [f64; 2],
    radius: [f64; 2],
    contact: Contact,
    /// Places of the wheels, ahead and to the left.
    pub(crate) at: [[f64; 4]; 2],
    /// Relative loss of friction per newton of load.
    load_loss: f64,
    per_presliding: f64,
    /// Of a front and a rear wheel.
    per_inertia: [f64; 2],
    rough_ground: bool,
}

impl Plant {
    /// The plant of a robot and what it hides.
    pub(crate) fn new(c: &Constants, hidden: &Hidden) -> Self {
        let mass = c.mass + hidden.payload;
        Self {
            c: *c,
            mass,
            inertia: c.yaw_inertia + hidden.payload_inertia,
            height: c.height + hidden.payload_height,
            centre: [0, 1].map(|i| c.centre[i] + hidden.centre[i]),
            radius: hidden.radius.map(|r| c.radius * (1.0 + r)),
            contact: Contact::new(c, hidden),
            at: match c.casters {
                None => {
                    [[1.0, -1.0, 1.0, -1.0].map(|k| k * c.half_base), [1.0, 1.0, -1.0, -1.0].map(|k| k * c.half_track)]
                }
                Some(Casters { places: [[x, y], [x2, y2]], .. }) => {
                    [[x, 0.0, x2, 0.0], [y, c.half_track, y2, -c.half_track]]
                }
            },
            load_loss: c.load_loss / (0.25 * mass * GRAVITY),
            per_presliding: 1.0 / c.presliding,
            per_inertia: [1.0 / c.wheel_inertia, 1.0 / (c.wheel_inertia + c.motor_inertia)],
            rough_ground: hidden.ice.is_some() || hidden.mud.is_some(),
            hidden: hidden.clone(),
        }
    }

    /// What holds during the step at `t` of a run.
    pub(crate) fn moment(&self, t: f64, torque: [f64; 2], s: &State, events: &Events) -> Moment {
        let h = &self.hidden;
        let f = &h.foreign;
        let mut m = Moment {
            torque,
            coulomb: if h.drift == 0.0 { 0.0 } else { h.drift * h.laws.drift(t, h.drift_time) },
            rolling: h.onset.map_or(0.0, |(at, fr)| if t >= at { fr } else { 0.0 }),
            ..Moment::default()
        };
        if f.gust > 0.0 {
            m.gust = events.gust(t).map(|g| g * f.gust);
        }
        m.lifted = f.lifted.filter(|_| inside(&events.lifted, t));
        if let Some((side, torque)) = f.touch.filter(|_| inside(&events.touch, t)) {
            m.touch[side] = torque;
        }
        if f.sag > 0.0 {
            let power: f64 = (0..2).map(|i| (torque[i] * s[SPEED + 1 + 2 * i]).max(0.0)).sum();
            let left = (1.0 - f.sag * power / f.sag_power).max(0.3);
            m.torque = m.torque.map(|t| t * left);
        }
        if f.ripple > 0.0 || f.cogging > 0.0 {
            for side in 0..2 {
                let angle = s[ANGLE + 1 + 2 * side];
                m.torque[side] *= 1.0 + f.ripple * (f.ripple_order * angle).sin();
                m.torque[side] += f.cogging * (f.cogging_order * angle).sin().powi(3);
            }
        }
        m
    }

    /// Rates of the state, and the specific force at the geometric centre in body axes.
    pub(crate) fn rates(&self, s: &State, m: &Moment) -> (State, [f64; 2]) {
        let (c, h, f) = (&self.c, &self.hidden, &self.hidden.foreign);
        let mut d = [0.0; N];
        let (sin, cos) = s[2].sin_cos();
        let (vx, vy, w) = (s[VELOCITY], s[VELOCITY + 1], s[YAW_RATE]);
        let centre = [self.centre[0], self.centre[1] + f.cargo * s[CARGO]];
        d[CARGO] = (w - w.abs() * s[CARGO]) * 2.0;
        let radius = self.radii(s);
        let loads = self.loads(s, centre, m, &radius);
        let omega: [f64; 4] = four(s, SPEED);
        let mut rolling = [c.rolling + m.rolling; 4];
        let mut grip: [f64; 4] =
            std::array::from_fn(|i| c.adhesion * (1.0 + c.load_loss - self.load_loss * loads[i]) * loads[i]);
        if self.rough_ground {
            self.ground(s, [sin, cos], &mut grip, &mut rolling);
        }
        if let Some(law) = &f.law {
            grip = grip.map(|g| g * law.on_grip(w));
        }
        if c.casters.is_some() {
            (grip[0], grip[2]) = (0.0, 0.0);
        }
        let slip = [
            std::array::from_fn(|i| omega[i] * radius[i] - vx + w * self.at[1][i]),
            std::array::from_fn(|i| -vy - w * self.at[0][i]),
        ];
        let rolled = std::array::from_fn(|i| (omega[i] * radius[i]).abs());
        let deflection = [four(s, ALONG), four(s, ACROSS)];
        let tyres = self.contact.forces(deflection, slip, rolled, grip, [sin, cos]);
        d[ALONG..ALONG + 4].copy_from_slice(&tyres.rates[0]);
        d[ACROSS..ACROSS + 4].copy_from_slice(&tyres.rates[1]);
        let [along, across] = tyres.force;
        let mut force = [along.iter().sum::<f64>(), across.iter().sum::<f64>()];
        let mut moment: f64 =
            (0..4).map(|i| (self.at[0][i] - centre[0]) * across[i] - (self.at[1][i] - centre[1]) * along[i]).sum();
        if let Some(casters) = &c.casters {
            for k in 0..2 {
                let push = self.push(casters, k, s, loads[2 * k], rolling[2 * k] - c.rolling);
                d[ANGLE + 2 * k] = push.swing;
                force = [force[0] + push.force[0], force[1] + push.force[1]];
                moment += (push.at[0] - centre[0]) * push.force[1] - (push.at[1] - centre[1]) * push.force[0];
            }
        }
        let drive = self.belts(s, m, &mut d);
        let driven = if c.casters.is_some() { [1, 3].as_slice() } else { &[0, 1, 2, 3] };
        // Every wheel of a side bears its share of that side's friction.
        let part = 2.0 / driven.len() as f64;
        for i in driven.iter().copied() {
            let side = i / 2;
            let mut dry = part * (c.coulomb[side] + h.coulomb[side] + m.coulomb).max(0.0);
            if h.stiction > 0.0 {
                dry += part * h.stiction * (-power((omega[i] / h.stribeck_speed).abs(), h.laws.stribeck)).exp();
            }
            if omega[i] < 0.0 {
                dry += part * f.ratchet;
            }
            dry += part * m.touch[side];
            dry += rolling[i] * loads[i] * radius[i];
            let taken = f.law.map_or_else(Friction::default, |law| law.friction(side, omega[i], s[MEMORY + side]));
            dry += part * taken.dry;
            let share = s[DRY + i];
            d[DRY + i] = (omega[i] - omega[i].abs() * share) * self.per_presliding;
            let viscous = part * (c.viscous[side] + h.viscous);
            let loss = dry * share + viscous * omega[i] + part * taken.smooth + radius[i] * along[i];
            d[SPEED + i] = (drive[i] - loss) * self.per_inertia[i % 2];
            d[ANGLE + i] = omega[i];
        }
        for axis in 0..2 {
            d[LOAD + axis] = (force[axis] / self.mass - s[LOAD + axis]) / c.load_lag;
        }
        if let Some(law) = &f.law {
            for side in 0..2 {
                d[MEMORY + side] = law.memory_rate(omega[2 * side + 1], s[MEMORY + side]);
            }
        }
        self.add_body_forces(s, m, centre, [sin, cos], &mut force, &mut moment);
        let turn = moment / self.inertia;
        let felt = [
            force[0] / self.mass + turn * centre[1] + w * w * centre[0],
            force[1] / self.mass - turn * centre[0] + w * w * centre[1],
        ];
        let fall = [GRAVITY * (h.slope[0] * cos + h.slope[1] * sin), GRAVITY * (h.slope[1] * cos - h.slope[0] * sin)];
        d[0] = vx * cos - vy * sin;
        d[1] = vx * sin + vy * cos;
        d[2] = w;
        d[VELOCITY] = felt[0] + fall[0] + w * vy;
        d[VELOCITY + 1] = felt[1] + fall[1] - w * vx;
        d[YAW_RATE] = turn;
        (d, felt)
    }

    /// Effective radii of the wheels.
    fn radii(&self, s: &State) -> [f64; 4] {
        let h = &self.hidden;
        let mut radius = [0, 0, 1, 1].map(|side| self.radius[side]);
        for side in 0..2 {
            if h.runout[side] > 0.0 {
                for axle in 0..2 {
                    let angle = s[ANGLE + 2 * side + axle] + h.runout_phase[axle];
                    radius[2 * side + axle] += h.runout[side] * angle.cos();
                }
            }
        }
        radius
    }

    /// What the ground under each wheel does to grip and rolling resistance.
    fn ground(&self, s: &State, [sin, cos]: [f64; 2], grip: &mut [f64; 4], rolling: &mut [f64; 4]) {
        for i in 0..4 {
            let (ahead, left) = (self.at[0][i], self.at[1][i]);
            let x = s[0] + ahead * cos - left * sin;
            let y = s[1] + ahead * sin + left * cos;
            if let Some((_, lost)) = self.hidden.ice.filter(|p| p.0.holds(x, y)) {
                grip[i] *= 1.0 - lost;
            }
            if let Some((_, added)) = self.hidden.mud.filter(|p| p.0.holds(x, y)) {
                rolling[i] += added;
            }
        }
    }

    /// Torques that reach the wheels through motors and belts; sets the rates of the belts.
    fn belts(&self, s: &State, m: &Moment, d: &mut State) -> [f64; 4] {
        let mut drive = [0.0; 4];
        if self.c.casters.is_some() {
            return [0.0, m.torque[0], 0.0, m.torque[1]];
        }
        for side in 0..2 {
            let (front, rear) = (2 * side, 2 * side + 1);
            let play = s[SPEED + rear] - s[SPEED + front];
            let most = self.hidden.belt[side];
            let elastic = self.c.belt_stiffness * s[TWIST + side];
            let passed = (elastic + self.c.belt_damping * play).clamp(-most, most);
            let slips = elastic.abs() > most && elastic * play > 0.0;
            d[TWIST + side] = if slips { 0.0 } else { play };
            drive[front] = passed;
            drive[rear] = m.torque[side] - passed;
        }
        drive
    }

    /// Vertical loads of the wheels.
    fn loads(&self, s: &State, centre: [f64; 2], m: &Moment, radius: &[f64; 4]) -> [f64; 4] {
        let quarter = 0.25 * self.mass;
        let pitch = (GRAVITY * centre[0] - s[LOAD] * self.height) / self.c.half_base;
        let roll = (GRAVITY * centre[1] - s[LOAD + 1] * self.height) / self.c.half_track;
        let mut n = match &self.c.casters {
            None => [pitch + roll, roll - pitch, pitch - roll, -pitch - roll].map(|x| quarter * (GRAVITY + x).max(0.0)),
            Some(casters) => self.loads_on_casters(casters, s, centre, [s[LOAD], s[LOAD + 1]]),
        };
        if let Some(wheel) = m.lifted {
            // The wheel's share goes to the other wheel of its axle.
            let lost = 0.85 * n[wheel];
            n[wheel] -= lost;
            n[(wheel + 2) % 4] += lost;
        }
        if self.hidden.laws.load_per_rise > 0.0 {
            for (i, load) in n.iter_mut().enumerate() {
                let rise = radius[i] - self.radius[i / 2];
                *load *= (1.0 + self.hidden.laws.load_per_rise * rise).max(0.0);
            }
        }
        n
    }

    /// Adds what acts on the body besides the tyres and gravity.
    fn add_body_forces(
        &self,
        s: &State,
        m: &Moment,
        centre: [f64; 2],
        [sin, cos]: [f64; 2],
        force: &mut [f64; 2],
        moment: &mut f64,
    ) {
        let h = &self.hidden;
        let (vx, vy) = (s[VELOCITY], s[VELOCITY + 1]);
        if h.drag > 0.0 {
            // The size is the force at 1 m/s, whatever the exponent.
            let speed = power((vx * vx + vy * vy).sqrt(), h.laws.drag - 1.0);
            force[0] -= h.drag * speed * vx;
            force[1] -= h.drag * speed * vy;
        }
        force[0] -= h.pull;
        *moment -= centre[1] * h.pull;
        if let Some(law) = &h.foreign.law {
            let (push, turn) = law.on_body(s[2], [vx, vy], s[YAW_RATE]);
            (force[0], force[1]) = (force[0] + push[0], force[1] + push[1]);
            *moment += turn + centre[0] * push[1] - centre[1] * push[0];
        }
        let mut world = m.gust;
        if let Some((stiffness, anchor, slack)) = h.foreign.cable {
            let (x, y) = (s[0] - anchor[0], s[1] - anchor[1]);
            let far = (x * x + y * y).sqrt();
            let pull = stiffness * (far - slack).max(0.0) / far.max(1e-6);
            world[0] -= pull * x;
            world[1] -= pull * y;
        }
        force[0] += world[0] * cos + world[1] * sin;
        force[1] += world[1] * cos - world[0] * sin;
    }

    /// A state with the given pose, body velocity, yaw rate and wheel speeds and angles of the
    /// sides, and everything unseen where steady motion would have it.
    pub(crate) fn settled(&self, seen: [f64; 6], speed: [f64; 2], angle: [f64; 2]) -> State {
        let mut s = [0.0; N];
        s[..6].copy_from_slice(&seen);
        for wheel in 0..4 {
            let side = wheel / 2;
            s[SPEED + wheel] = speed[side];
            s[ANGLE + wheel] = angle[side];
            s[DRY + wheel] = (speed[side] / 0.03).tanh();
            let rolled = speed[side] * self.radius[side];
            let slip = [rolled - seen[3] + seen[5] * self.at[1][wheel], -seen[4] - seen[5] * self.at[0][wheel]];
            let [along, across] = self.contact.steady(slip, rolled.abs());
            s[ALONG + wheel] = along;
            s[ACROSS + wheel] = across;
        }
        if let Some(casters) = &self.c.casters {
            for (k, [x, y]) in casters.places.into_iter().enumerate() {
                // Long dragged along, and ahead where the robot stands.
                let pivot = [seen[3] - seen[5] * y, seen[4] + seen[5] * x];
                s[ANGLE + 2 * k] = if pivot == [0.0; 2] { 0.0 } else { pivot[1].atan2(pivot[0]) };
                (s[SPEED + 2 * k], s[DRY + 2 * k], s[ALONG + 2 * k], s[ACROSS + 2 * k]) = (0.0, 0.0, 0.0, 0.0);
            }
        }
        s[LOAD + 1] = seen[3] * seen[5];
        s[CARGO] = (seen[5] / 0.1).tanh();
        s
    }
}

/// Four numbers of a state.
fn four(s: &State, at: usize) -> [f64; 4] {
    std::array::from_fn(|i| s[at + i])
}

/// A power of a number that is not negative; squares and first powers as products.
fn power(x: f64, exponent: f64) -> f64 {
    if exponent == 2.0 {
        x * x
    } else if exponent == 1.0 {
        x
    } else {
        x.powf(exponent)
    }
}
