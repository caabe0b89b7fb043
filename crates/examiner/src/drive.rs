//! Manoeuvres: the speed and yaw rate wanted at each row.

use crate::random::Stream;
use crate::robot::Constants;

/// A kind of drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Manoeuvre {
    /// Speeds and turns at random.
    Random,
    /// On the spot, both ways.
    Spin,
    /// Starts and stops, with a little turning.
    Stopgo,
    /// Circles left and right in turn.
    Eight,
    /// Circles one way.
    Loop,
    /// Swings left and right while driving ahead.
    Slalom,
    /// Ahead and back without turning.
    Straight,
}

impl Manoeuvre {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Random, Self::Spin, Self::Stopgo, Self::Eight, Self::Loop, Self::Slalom, Self::Straight];

    /// Its name in the truth.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::Spin => "spin",
            Self::Stopgo => "stopgo",
            Self::Eight => "eight",
            Self::Loop => "loop",
            Self::Slalom => "slalom",
            Self::Straight => "straight",
        }
    }
}

/// Two kinds for each of several runs, all kinds used about equally.
pub(crate) fn kinds(s: &mut Stream, runs: usize) -> Vec<[Manoeuvre; 2]> {
    let mut pool = Vec::new();
    while pool.len() < 2 * runs + 1 {
        let mut round = Manoeuvre::ALL;
        s.shuffle(&mut round);
        pool.extend(round);
    }
    (0..runs)
        .map(|i| {
            let (a, mut b) = (pool[2 * i], pool[2 * i + 1]);
            if a == b {
                b = pool[2 * i + 2];
            }
            [a, b]
        })
        .collect()
}

/// Draws what a kind of drive wants next.
#[derive(Debug, Clone)]
pub(crate) struct Driver {
    stream: Stream,
    kind: Manoeuvre,
    speed: f64,
    turn: f64,
    sway: f64,
    period: f64,
    side: f64,
    until: f64,
    wanted: [f64; 2],
    /// Speed and yaw rate after limits of acceleration.
    smooth: [f64; 2],
    /// How far from the start a drive may go.
    room: f64,
}

impl Driver {
    /// A driver at rest.
    pub(crate) fn new(mut stream: Stream, c: &Constants, kind: Manoeuvre) -> Self {
        // Speeds follow the wheel, so that wheel speeds are alike in all sizes of robot.
        let scale = (c.radius / 0.097).clamp(0.55, 1.4);
        let speed = scale * stream.uniform(0.6, 1.05);
        let turn = stream.uniform(0.7, 1.3);
        Self {
            kind,
            speed: if kind == Manoeuvre::Loop { 0.8 * speed } else { speed },
            turn: if kind == Manoeuvre::Loop { 0.8 * turn } else { turn },
            sway: stream.uniform(0.7, 1.3),
            period: stream.uniform(2.2, 4.5),
            side: stream.sign(),
            until: 0.0,
            wanted: [0.0; 2],
            smooth: [0.0; 2],
            room: 3.0 * scale,
            stream,
        }
    }

    /// Carries the motion of the drive before over.
    pub(crate) fn after(mut self, before: &Self) -> Self {
        self.smooth = before.smooth;
        self
    }

    /// Speed and yaw rate wanted at `t` of this drive, given the measured pose.
    pub(crate) fn want(&mut self, t: f64, dt: f64, pose: [f64; 3]) -> [f64; 2] {
        let s = &mut self.stream;
        let next = t >= self.until;
        let ahead = -(pose[0] * pose[2].cos() + pose[1] * pose[2].sin());
        let far = pose[0].hypot(pose[1]) > self.room;
        match self.kind {
            Manoeuvre::Random if next => {
                self.until = t + s.uniform(0.8, 2.4);
                let backwards = if s.unit() < 0.3 { -0.5 } else { 1.0 };
                self.wanted = [backwards * self.speed * s.uniform(0.15, 1.2), s.uniform(-1.4, 1.4)];
            }
            Manoeuvre::Spin if next => {
                self.until = t + s.uniform(1.5, 3.2);
                self.side = -self.side;
                self.wanted = [0.0, self.side * s.uniform(0.6, 1.7)];
            }
            Manoeuvre::Stopgo if next => {
                self.until = t + s.uniform(0.9, 2.0);
                let go = self.wanted[0] == 0.0;
                let turn = if s.unit() < 0.5 { 0.0 } else { s.uniform(-0.6, 0.6) };
                self.wanted = if go { [self.speed * s.uniform(0.6, 1.2), turn] } else { [0.0; 2] };
            }
            Manoeuvre::Eight => {
                let lap = std::f64::consts::TAU / self.turn;
                let side = if ((t / lap) as usize).is_multiple_of(2) { self.side } else { -self.side };
                self.wanted = [self.speed, side * self.turn];
            }
            Manoeuvre::Loop => self.wanted = [self.speed, self.side * self.turn],
            Manoeuvre::Slalom => {
                let phase = std::f64::consts::TAU * t / self.period;
                self.wanted = [self.speed, self.side * self.sway * phase.sin()];
            }
            Manoeuvre::Straight if next => {
                self.until = t + s.uniform(1.5, 3.2);
                self.side = if far { ahead.signum() } else { -self.side };
                self.wanted = [self.side * self.speed * s.uniform(0.5, 1.0), 0.0];
            }
            _ => {}
        }
        let mut wanted = self.wanted;
        let homing = !matches!(self.kind, Manoeuvre::Spin | Manoeuvre::Straight | Manoeuvre::Eight);
        if far && homing {
            let bearing = (-pose[1]).atan2(-pose[0]) - pose[2];
            let off = bearing.sin().atan2(bearing.cos());
            let backwards = if wanted[0] < 0.0 { std::f64::consts::PI } else { 0.0 };
            let off = (off + backwards).sin().atan2((off + backwards).cos());
            wanted[1] = 0.4 * wanted[1] + (0.7 * off).clamp(-0.8, 0.8);
        }
        for (i, rate) in [1.5, 3.5].into_iter().enumerate() {
            let step = (wanted[i] - self.smooth[i]).clamp(-rate * dt, rate * dt);
            self.smooth[i] += step;
        }
        self.smooth
    }
}

/// Speed and heading controller of the robot.
#[derive(Debug, Clone)]
pub(crate) struct Controller {
    heading: f64,
    sums: [f64; 2],
    radius: f64,
    arm: f64,
    gain: f64,
    limit: f64,
    friction: [f64; 2],
}

impl Controller {
    /// A controller for the robot as its user knows it, its gain times a factor.
    pub(crate) fn new(c: &Constants, heading: f64, gain: f64) -> Self {
        Self {
            heading,
            sums: [0.0; 2],
            radius: c.radius,
            // Four wheels slide sideways when they turn, two do not.
            arm: if c.casters.is_some() { c.half_track } else { 1.5 * c.half_track },
            gain: gain * (0.055 * c.torque_scale()),
            limit: c.torque_limit,
            friction: [c.coulomb[0], c.viscous[0]],
        }
    }

    /// Torque set-points of the sides.
    pub(crate) fn command(&mut self, [speed, turn]: [f64; 2], yaw: f64, wheels: [f64; 2], dt: f64) -> [f64; 2] {
        self.heading += turn * dt;
        // A heading that runs away is not wound up.
        let error = (self.heading - yaw).clamp(-0.6, 0.6);
        self.heading = yaw + error;
        let turn = turn + 2.0 * error;
        [0, 1].map(|side| {
            let lever = if side == 0 { -self.arm } else { self.arm };
            let wanted = (speed + lever * turn) / self.radius;
            let error = wanted - wheels[side];
            let smooth = (wanted / 0.5).tanh();
            let known = self.friction[0] * smooth + self.friction[1] * wanted;
            let torque = known + self.gain * error + self.sums[side];
            if torque.abs() < self.limit || torque * error < 0.0 {
                self.sums[side] += 3.0 * self.gain * error * dt;
            }
            torque.clamp(-self.limit, self.limit)
        })
    }
}
