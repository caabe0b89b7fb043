//! Made-up robots whose response is known, and drives of them.

use recordings::{Channel, Clock, Recording, Signal};
use robot_model::Robot;
use verdict::Diagnosis;

use crate::controller::{DEAD_TIME, GAIN, LAG, Law, RAMP, TURN_LIMIT, WHEEL_LIMIT, free_run};
use crate::ground::{self, RADIUS, TRACK};
use crate::run::{Piece, STEP};
use crate::{ResponseCase, ResponseRun, diagnose_response};
use inference::Options;

pub(crate) const NOMINAL: [f64; 2] = [0.15, 0.6];

pub(crate) fn robot() -> Robot<f64> {
    let mut robot = testing::robot();
    (robot.wheel_radius, robot.half_track) = (NOMINAL[0], 0.5 * NOMINAL[1]);
    robot
}

/// A small generator of numbers in [−1, 1): the tests need spread, not quality.
struct Spread(u64);

impl Spread {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Of standard deviation one, nearly normal.
    fn noise(&mut self) -> f64 {
        (0..12).map(|_| 0.5 * self.next()).sum()
    }
}

/// What is driven: the response, and what the sensors add.
pub(crate) struct Truth {
    pub(crate) law: Law,
    pub(crate) drive: Vec<f64>,
    pub(crate) ground: Vec<f64>,
    /// Speed that a wheel has beside that of its drive, by time s and side, rad/s.
    pub(crate) wheel_push: fn(f64, usize) -> f64,
    /// Yaw rate that the body has beside that of its wheels, by time s and heading rad, rad/s.
    pub(crate) body_push: fn(f64, f64) -> f64,
    /// From this time on, s, the robot is another one.
    pub(crate) later: Option<(f64, Box<Self>)>,
}

impl Truth {
    pub(crate) fn perfect() -> Self {
        Self {
            law: Law::default(),
            drive: verdict::DRIVE_CONSTANTS.iter().map(|c| c.neutral).collect(),
            ground: ground::neutral(),
            wheel_push: |_, _| 0.0,
            body_push: |_, _| 0.0,
            later: None,
        }
    }

    /// A controller as in stock skid-steer robots.
    pub(crate) fn stock() -> Self {
        let mut out = Self::perfect();
        let x = &mut out.drive;
        x[DEAD_TIME] = 0.22;
        (x[GAIN[0]], x[GAIN[1]]) = (1.3, 0.8);
        (x[TURN_LIMIT], x[WHEEL_LIMIT]) = (3.0, 6.0);
        (x[RAMP[0]], x[RAMP[1]]) = (10.0, 4.0);
        x[LAG] = 0.12;
        out
    }

    /// A drive of `steps` commands of 6 s.
    pub(crate) fn recording(&self, name: &str, steps: usize, seed: u64, wheel_noise: f64) -> Recording {
        const ROWS: usize = 120;
        let mut spread = Spread(seed);
        let mut command = Vec::new();
        for _ in 0..steps {
            let c = [8.0 * spread.next(), 8.0 * spread.next()];
            command.extend(std::iter::repeat_n(c, ROWS));
        }
        self.recorded(name, &command, spread, wheel_noise)
    }

    /// A drive on these commands, every 50 ms.
    pub(crate) fn driven(&self, name: &str, command: &[[f64; 2]], seed: u64, wheel_noise: f64) -> Recording {
        self.recorded(name, command, Spread(seed), wheel_noise)
    }

    fn recorded(&self, name: &str, command: &[[f64; 2]], mut spread: Spread, wheel_noise: f64) -> Recording {
        // The first row of every window would begin where it was measured: one window per drive, whole and unmeasured.
        let mut wheel = vec![[0.0; 2]];
        let mut piece = Piece {
            start: 0.0,
            command: command.to_vec(),
            within: None,
            wheel: command.to_vec(),
            heading: None,
            integrated: false,
            position: None,
        };
        piece.wheel[0] = [0.0; 2];
        let at = |i: usize| match &self.later {
            Some((from, later)) if i as f64 * STEP >= *from => later.as_ref(),
            _ => self,
        };
        let runs = |truth: &Self| free_run(truth.law, &truth.drive, &piece);
        let [first, second] = [runs(self), runs(self.later.as_ref().map_or(self, |(_, later)| later))];
        let push = |i: usize, s: usize| (at(i).wheel_push)(i as f64 * STEP, s);
        wheel.extend((1..command.len()).map(|i| {
            let free = if std::ptr::eq(at(i), self) { &first } else { &second };
            [0, 1].map(|s| free[i][s] + push(i, s))
        }));
        let (mut heading, mut x, mut y) = (vec![0.3], vec![0.0], vec![0.0]);
        let twist = |i: usize, heading: f64| {
            let (g, w) = (&at(i).ground, wheel[i]);
            let r = g[RADIUS] * NOMINAL[0];
            let push = (at(i).body_push)(i as f64 * STEP, heading);
            [0.5 * r * (w[0] + w[1]), r * (w[1] - w[0]) / (g[TRACK] * NOMINAL[1]) + push]
        };
        for i in 1..wheel.len() {
            let before = heading[i - 1];
            let [a, b] = [twist(i - 1, before), twist(i, before)];
            let after = before + 0.5 * STEP * (a[1] + b[1]);
            x.push(x[i - 1] + 0.5 * STEP * (a[0] * f64::cos(before) + b[0] * f64::cos(after)));
            y.push(y[i - 1] + 0.5 * STEP * (a[0] * f64::sin(before) + b[0] * f64::sin(after)));
            heading.push(after);
        }
        let time: Vec<i64> = (0..).step_by(50_000_000).take(wheel.len()).collect();
        let mut channel = |signal: Signal, v: Vec<f64>, sigma: f64| {
            let v = v.into_iter().map(|v| v + sigma * spread.noise()).collect();
            Channel::new(signal, 0, time.clone(), v).expect("a channel")
        };
        let side = |rows: &[[f64; 2]], s: usize| rows.iter().map(|r| r[s]).collect::<Vec<f64>>();
        let channels = vec![
            channel(Signal::CommandSpeedLeft, side(command, 0), 0.0),
            channel(Signal::CommandSpeedRight, side(command, 1), 0.0),
            channel(Signal::WheelSpeedLeft, side(&wheel, 0), wheel_noise),
            channel(Signal::WheelSpeedRight, side(&wheel, 1), wheel_noise),
            channel(Signal::PoseX, x, 0.005),
            channel(Signal::PoseY, y, 0.005),
            channel(Signal::PoseYaw, heading, 0.005),
        ];
        Recording::new(name, vec![Clock { name: "one".to_owned(), nominal_rate_hz: None }], channels).expect("built")
    }

    pub(crate) fn run(&self, name: &str, steps: usize, seed: u64) -> ResponseRun {
        ResponseRun::new(&self.recording(name, steps, seed, 0.1)).expect("a run")
    }
}

/// A case of these recordings alone.
pub(crate) fn alone(recordings: Vec<ResponseRun>) -> ResponseCase {
    ResponseCase { robot: robot(), geometry_sigma: [0.01; 2], references: vec![], recordings, held_out: vec![] }
}

pub(crate) fn diagnosed(truth: &Truth, references: Option<&Truth>) -> Diagnosis {
    let case = ResponseCase {
        robot: robot(),
        geometry_sigma: [0.01; 2],
        references: references.iter().map(|r| r.run("reference", 40, 7)).collect(),
        recordings: vec![truth.run("a", 30, 1), truth.run("b", 20, 2)],
        held_out: vec![truth.run("c", 15, 3)],
    };
    diagnose_response(&case, &Options::default(), &|_| {}).expect("a diagnosis")
}
