//! Drawn robots with something hidden, by formulas of their own: nothing here comes from the crate but the types that it
//! takes. Wheels turn, the body moves on fine steps with what is hidden, and counts and poses are read off.

use odometry::{Case, Drive, Sigmas, Wheel, WheelData, WheeledRobot};

/// Reproducible numbers: xorshift64*, Box and Muller.
pub(crate) struct Draw(u64);

impl Draw {
    pub(crate) fn new(seed: u64) -> Self {
        let mut out = Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
        for _ in 0..8 {
            out.uniform();
        }
        out
    }

    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.uniform()
    }

    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * self.uniform().max(1e-300).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }

    pub(crate) fn sign(&mut self) -> f64 {
        if self.uniform() < 0.5 { -1.0 } else { 1.0 }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Differential,
    Tricycle,
    Omni3,
    Mecanum4,
}

/// What is hidden; sizes are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Hidden {
    Nothing,
    OneRadius,
    AllRadii,
    DoubledCounts,
    Distance,
    SteeringZero,
    Mounting,
    Origin,
    SlipInTurns,
    /// The same, whole in slow turns already.
    SlipInSlowTurns,
    /// Wheels turn more than the body moves, way and turning alike, by a share in proportion to the body's speed.
    SlipWithSpeed,
    /// The same, each wheel by its own speed.
    SlipByWheels,
    /// Wheels are much nearer to each other than stated.
    FarDistance,
    /// No slip does that: the body gets ahead of its wheels in turns.
    GainInTurns,
    ClockOffset,
    ClockRate,
    LostCounts,
    /// The third of three omni wheels points another way.
    Direction,
}

/// The robot as it is: all lengths in m, angles in rad.
#[derive(Debug, Clone)]
pub(crate) struct Truth {
    pub radius: Vec<f64>,
    /// Track; wheelbase of a tricycle; centre to wheel of an omni robot; (wheelbase + track)/2 of a mecanum one.
    pub base: f64,
    pub steering: f64,
    /// Angle of the third omni wheel to its stated direction, to the left.
    pub turned: f64,
    pub mounting: f64,
    pub origin: [f64; 2],
    pub slip: f64,
    /// Turning rate at which that slip is half of what it becomes, rad/s.
    pub slip_rate: f64,
    /// Share by which wheels turn more, per speed of the body and of their own, s/m.
    pub speed_slip: [f64; 2],
    pub offset: f64,
    pub rate: f64,
    pub lost: Option<usize>,
}

pub(crate) struct Drawn {
    pub case: Case,
    pub truth: Truth,
}

const COUNTS: f64 = 4096.0;
const RADIUS_SIGMA: f64 = 0.006;
const BASE_SIGMA: f64 = 0.01;

fn robot(kind: Kind) -> (WheeledRobot, f64, f64) {
    let (robot, radius, base) = match kind {
        Kind::Differential => (WheeledRobot::differential(0.06, 0.32), 0.06, 0.32),
        Kind::Tricycle => (WheeledRobot::tricycle(0.05, 0.4), 0.05, 0.4),
        Kind::Omni3 => (WheeledRobot::omni_3(0.05, 0.2), 0.05, 0.2),
        Kind::Mecanum4 => (WheeledRobot::mecanum_4(0.05, 0.3, 0.26), 0.05, 0.28),
    };
    let mut robot = robot.with_wheels(|_, w| Wheel { counts_per_turn: Some(COUNTS), ..w });
    robot.sigmas = Sigmas {
        radius: Some(RADIUS_SIGMA),
        across: Some(BASE_SIGMA),
        along: Some(BASE_SIGMA),
        steering: Some(0.01),
        ..Sigmas::default()
    };
    (robot, radius, base)
}

/// Turns of the wheels, rad, that roll the body by a motion; inverse formulas written out by kind.
fn wheels(kind: Kind, t: &Truth, [x, y, a]: [f64; 3]) -> (Vec<f64>, f64) {
    let ways = match kind {
        Kind::Differential => vec![x - 0.5 * t.base * a, x + 0.5 * t.base * a],
        Kind::Tricycle => {
            let lever = t.base * a;
            return (vec![x.hypot(lever) / t.radius[0]], lever.atan2(x));
        }
        Kind::Omni3 => {
            let turned = t.base * a;
            let root = 3.0_f64.sqrt() / 2.0;
            // The third stands behind and rolls to the left; turned to the left it rolls backward as well.
            let (sin, cos) = t.turned.sin_cos();
            vec![-root * x - 0.5 * y - turned, root * x - 0.5 * y - turned, cos * (y - turned) - sin * x]
        }
        Kind::Mecanum4 => {
            let turned = t.base * a;
            vec![x - y - turned, x + y + turned, x + y - turned, x - y + turned]
        }
    };
    (ways.iter().zip(&t.radius).map(|(w, r)| w / r).collect(), 0.0)
}

/// A robot of a kind with something hidden, and its drives in `sessions`.
pub(crate) fn drawn(kind: Kind, hidden: Hidden, sessions: usize, seconds: f64, seed: u64) -> Drawn {
    let mut draw = Draw::new(seed);
    let (robot, radius, base) = robot(kind);
    let measured = robot.measured().len();
    let mut truth = Truth {
        radius: (0..measured).map(|_| radius * (RADIUS_SIGMA * draw.normal()).exp()).collect(),
        base: base * (BASE_SIGMA * draw.normal()).exp(),
        steering: 0.01 * draw.normal(),
        turned: 0.0,
        mounting: 0.001 * draw.normal(),
        origin: [0.001 * draw.normal(), 0.001 * draw.normal()],
        slip: 1e-3 * draw.normal(),
        slip_rate: 0.05,
        speed_slip: [0.0; 2],
        offset: 0.0,
        rate: 0.0,
        lost: None,
    };
    let sign = draw.sign();
    match hidden {
        Hidden::Nothing => {}
        Hidden::OneRadius => truth.radius[0] *= 1.0 + sign * draw.between(0.04, 0.08),
        Hidden::AllRadii => {
            let factor = 1.0 + sign * draw.between(0.05, 0.12);
            truth.radius.iter_mut().for_each(|r| *r *= factor);
        }
        // As many counts are recorded as the file says edges are twice: the body moves half as far per count.
        Hidden::DoubledCounts => truth.radius.iter_mut().for_each(|r| *r *= 0.5),
        Hidden::Distance => truth.base *= 1.0 + sign * draw.between(0.08, 0.2),
        Hidden::FarDistance => truth.base *= 0.7,
        Hidden::SteeringZero => truth.steering = sign * draw.between(0.06, 0.12),
        Hidden::Mounting => truth.mounting = sign * draw.between(0.025, 0.08),
        Hidden::Origin => truth.origin = [sign * draw.between(0.02, 0.06), 0.0],
        Hidden::SlipInTurns => truth.slip = draw.between(0.03, 0.08),
        Hidden::SlipInSlowTurns => {
            truth.slip = draw.between(0.06, 0.12);
            truth.slip_rate = 0.015;
        }
        Hidden::SlipWithSpeed => truth.speed_slip[0] = draw.between(0.06, 0.12),
        Hidden::SlipByWheels => truth.speed_slip[1] = draw.between(0.06, 0.12),
        Hidden::GainInTurns => truth.slip = -draw.between(0.03, 0.08),
        Hidden::ClockOffset => truth.offset = sign * draw.between(0.15, 0.4),
        Hidden::ClockRate => truth.rate = sign * draw.between(0.01, 0.025),
        Hidden::Direction => truth.turned = sign * draw.between(0.04, 0.08),
        Hidden::LostCounts => truth.lost = Some((draw.uniform() * measured as f64) as usize % measured),
    }
    let recordings = (0..sessions)
        .map(|s| {
            let mut here = truth.clone();
            // Tyres, floors and markers differ from session to session.
            here.radius.iter_mut().for_each(|r| *r *= (4e-4 * draw.normal()).exp());
            here.base *= (1e-3 * draw.normal()).exp();
            here.steering += 1e-3 * draw.normal();
            here.mounting += 1e-3 * draw.normal();
            here.origin = here.origin.map(|o| o + 1e-3 * draw.normal());
            here.offset += 0.02 * draw.normal();
            here.slip += 1e-3 * draw.normal();
            drive(kind, &robot, &here, &format!("drive {s}"), seconds, &mut draw)
        })
        .collect();
    Drawn { case: Case { robot, references: Vec::new(), recordings }, truth }
}

/// Levels of body speed that change every two to four seconds, eased over half a second.
fn levels(kind: Kind, seconds: f64, draw: &mut Draw) -> Vec<(f64, [f64; 3])> {
    let mut out = vec![(0.0, [0.0; 3])];
    let mut t = 1.0;
    let sideways = matches!(kind, Kind::Omni3 | Kind::Mecanum4);
    while t < seconds {
        let x = draw.between(0.1, 0.4) * if kind == Kind::Tricycle { 1.0 } else { draw.sign() };
        let y = if sideways { draw.between(-0.3, 0.3) } else { 0.0 };
        let turning = if draw.uniform() < 0.3 { 0.0 } else { draw.sign() * draw.between(0.2, 0.9) };
        out.push((t, [x, y, turning]));
        t += draw.between(2.0, 4.0);
    }
    out
}

fn drive(kind: Kind, robot: &WheeledRobot, t: &Truth, name: &str, seconds: f64, draw: &mut Draw) -> Drive {
    let (fine, row) = (0.02, 0.1);
    let levels = levels(kind, seconds, draw);
    let speed_at = |time: f64| -> [f64; 3] {
        let k = levels.iter().rposition(|(begin, _)| *begin <= time).unwrap_or(0);
        let before = levels[k.saturating_sub(1)].1;
        let share = ((time - levels[k].0) / 0.5).clamp(0.0, 1.0);
        [0, 1, 2].map(|a| before[a] + share * (levels[k].1[a] - before[a]))
    };

    // Fine steps: wheels roll what they roll, the body moves less in turns.
    let steps = (seconds / fine) as usize;
    let (mut turned, mut steering, mut bodies) = (vec![vec![0.0; t.radius.len()]], vec![0.0], vec![[0.0; 3]]);
    for k in 0..steps {
        let rolled = speed_at(k as f64 * fine).map(|v| v * fine);
        let (mut wheel, steer) = wheels(kind, t, rolled);
        let [of_body, of_wheel] = t.speed_slip;
        let speed = rolled[0].hypot(rolled[1]) / fine;
        for (turn, radius) in wheel.iter_mut().zip(&t.radius) {
            *turn *= 1.0 + of_body * speed + of_wheel * (*turn * radius / fine).abs();
        }
        let last = turned.last().expect("a step").clone();
        turned.push(last.iter().zip(&wheel).map(|(a, b)| a + b).collect());
        steering.push(steer - t.steering);
        let rate = rolled[2].abs() / fine;
        let kept = 1.0 - t.slip * rate / (rate + t.slip_rate);
        let [px, py, yaw] = *bodies.last().expect("a step");
        let (sin, cos) = (yaw + 0.5 * rolled[2]).sin_cos();
        let [x, y] = [kept * rolled[0], kept * rolled[1]];
        bodies.push([px + cos * x - sin * y, py + sin * x + cos * y, yaw + rolled[2]]);
    }

    let rows = (seconds / row) as usize;
    let middle = 0.5 * seconds;
    let lost_from = rows / 3;
    let mut time = Vec::new();
    let mut counters: Vec<Vec<f64>> = vec![Vec::new(); t.radius.len()];
    let (mut steers, mut poses) = (Vec::new(), Vec::new());
    let mut missing = vec![0.0; t.radius.len()];
    for k in 0..rows {
        let now = k as f64 * row;
        // A pose at `now` shows what the counts have at `now − offset − rate (now − middle)`.
        let at = |time: f64| (time / fine).round().clamp(0.0, steps as f64) as usize;
        let shown = at(now + t.offset + t.rate * (now - middle));
        let before = at(now - row + t.offset + t.rate * (now - row - middle));
        time.push(now);
        for (wheel, counter) in counters.iter_mut().enumerate() {
            if t.lost == Some(wheel) && k >= lost_from && k < lost_from + rows / 6 {
                missing[wheel] += 0.4 * (turned[shown][wheel] - turned[before][wheel]);
            }
            counter.push(((turned[shown][wheel] - missing[wheel]) / std::f64::consts::TAU * COUNTS).round());
        }
        steers.push(steering[usize::midpoint(shown, before) + 1 - usize::from(shown == steps)]);
        let [px, py, yaw] = bodies[at(now)];
        let (sin, cos) = yaw.sin_cos();
        let noise = [5e-4 * draw.normal(), 5e-4 * draw.normal(), 1e-3 * draw.normal()];
        poses.push([
            px + cos * t.origin[0] - sin * t.origin[1] + noise[0],
            py + sin * t.origin[0] + cos * t.origin[1] + noise[1],
            yaw + t.mounting + noise[2],
        ]);
    }
    let steers = (kind == Kind::Tricycle).then_some(steers);
    Drive::new(name, robot, time, (WheelData::Counter, &counters), steers, poses).expect("a drive")
}
