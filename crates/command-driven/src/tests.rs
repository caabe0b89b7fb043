//! Made-up robots whose response is known.

use recordings::{Channel, Clock, Recording, Signal};
use robot_model::Robot;
use verdict::{Diagnosis, FreeRun, Parameter, Scaling, Verdict};

use super::controller::{DAMPING, DEAD_TIME, FREQUENCY, GAIN, LAG, Law, RAMP, TURN_LIMIT, WHEEL_LIMIT};
use super::ground::{self, RADIUS, TRACK};
use super::run::{Piece, STEP};
use super::*;

const NOMINAL: [f64; 2] = [0.15, 0.6];

fn robot() -> Robot<f64> {
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
struct Truth {
    law: Law,
    drive: Vec<f64>,
    ground: Vec<f64>,
}

impl Truth {
    fn perfect() -> Self {
        Self {
            law: Law::default(),
            drive: verdict::DRIVE_CONSTANTS.iter().map(|c| c.neutral).collect(),
            ground: ground::neutral(),
        }
    }

    /// A controller as in stock skid-steer robots.
    fn stock() -> Self {
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
    fn recording(&self, name: &str, steps: usize, seed: u64, wheel_noise: f64) -> Recording {
        const ROWS: usize = 120;
        let mut spread = Spread(seed);
        let mut command = Vec::new();
        for _ in 0..steps {
            let c = [8.0 * spread.next(), 8.0 * spread.next()];
            command.extend(std::iter::repeat_n(c, ROWS));
        }
        // The first row of every window would begin where it was measured: one window per drive, whole and unmeasured.
        let mut wheel = vec![[0.0; 2]];
        let mut piece =
            Piece { start: 0.0, command: command.clone(), wheel: command.clone(), heading: None, position: None };
        piece.wheel[0] = [0.0; 2];
        let free = super::controller::free_run(self.law, &self.drive, &piece);
        wheel.extend_from_slice(&free[1..]);
        let (mut heading, mut x, mut y) = (vec![0.3], vec![0.0], vec![0.0]);
        let twist = |w: [f64; 2]| {
            let g = &self.ground;
            let r = g[RADIUS] * NOMINAL[0];
            [0.5 * r * (w[0] + w[1]), r * (w[1] - w[0]) / (g[TRACK] * NOMINAL[1])]
        };
        for i in 1..wheel.len() {
            let [a, b] = [twist(wheel[i - 1]), twist(wheel[i])];
            let before = heading[i - 1];
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
            channel(Signal::CommandSpeedLeft, side(&command, 0), 0.0),
            channel(Signal::CommandSpeedRight, side(&command, 1), 0.0),
            channel(Signal::WheelSpeedLeft, side(&wheel, 0), wheel_noise),
            channel(Signal::WheelSpeedRight, side(&wheel, 1), wheel_noise),
            channel(Signal::PoseX, x, 0.005),
            channel(Signal::PoseY, y, 0.005),
            channel(Signal::PoseYaw, heading, 0.005),
        ];
        Recording::new(name, vec![Clock { name: "one".to_owned(), nominal_rate_hz: None }], channels).expect("built")
    }

    fn run(&self, name: &str, steps: usize, seed: u64) -> ResponseRun {
        ResponseRun::new(&self.recording(name, steps, seed, 0.1)).expect("a run")
    }
}

fn diagnosed(truth: &Truth, references: Option<&Truth>) -> Diagnosis {
    let case = ResponseCase {
        robot: robot(),
        references: references.iter().map(|r| r.run("reference", 40, 7)).collect(),
        recordings: vec![truth.run("a", 30, 1), truth.run("b", 20, 2)],
        held_out: vec![truth.run("c", 15, 3)],
    };
    diagnose_response(&case, &|_| {}).expect("a diagnosis")
}

fn parameter<'a>(d: &'a Diagnosis, id: &str) -> &'a Parameter {
    let all = &d.response.as_ref().expect("a response").parameters;
    all.iter().find(|p| p.id == id).unwrap_or_else(|| panic!("no {id} in {all:?}"))
}

/// Twice the 90 % interval holds the truth in all but one of a thousand.
fn holds(d: &Diagnosis, id: &str, truth: f64) {
    let p = parameter(d, id);
    let half = p.half_width.expect("an interval");
    assert!((p.value - truth).abs() < 2.0 * half, "{id}: {} ± {half}, not {truth}", p.value);
    assert!(half < 0.1 * truth.abs().max(0.1), "{id}: ± {half} is no answer");
}

fn run<'a>(d: &'a Diagnosis, quantity: &str) -> &'a FreeRun {
    d.free_runs.iter().find(|r| r.recording == "held out" && r.quantity.starts_with(quantity)).expect("a row")
}

#[test]
fn a_stock_controller_is_found_with_its_constants() {
    let truth = Truth::stock();
    let d = diagnosed(&truth, None);
    assert_eq!(d.verdict, Verdict::Explained);
    assert_eq!(d.ranked[0].effect, "drive_command");
    for id in ["transport_delay", "motor_lag"] {
        let p = d.ranked.iter().find(|c| c.effect == id).map_or(0.0, |c| c.probability);
        assert!(p > 0.9, "{id}: {p}");
    }
    let response = d.response.as_ref().expect("a response");
    assert_eq!(response.scaling, Some(Scaling::Proportional.words().into()));
    let truth = [
        ("dead_time", 0.22),
        ("forward_gain", 1.3),
        ("turn_gain", 0.8),
        ("turn_limit", 3.0),
        ("wheel_limit", 6.0),
        ("forward_ramp", 10.0),
        ("turn_ramp", 4.0),
        ("lag", 0.12),
    ];
    for (id, value) in truth {
        holds(&d, id, value);
    }
    // Nothing is wrong on the ground, and nothing is said to be.
    assert!(response.parameters.iter().all(|p| p.element.is_drive()), "{:?}", response.parameters);
    assert!(d.sentences[0].contains("do not do what is commanded"), "{:?}", d.sentences);
    let r = run(&d, "wheel speed");
    assert!(r.corrected < 0.2 && 5.0 * r.corrected < r.nominal, "{r:?}");
    assert!(r.placebo.is_some_and(|p| p > 1.5 * r.corrected), "{r:?}");
}

#[test]
fn how_sides_are_held_at_the_limit_is_told_apart() {
    for scaling in [Scaling::EachSide, Scaling::TurnFirst] {
        let mut truth = Truth::stock();
        truth.law.scaling = scaling;
        truth.drive[TURN_LIMIT] = f64::INFINITY;
        let d = diagnosed(&truth, None);
        assert_eq!(d.response.as_ref().expect("a response").scaling, Some(scaling.words().into()));
        holds(&d, "wheel_limit", 6.0);
    }
}

#[test]
fn a_second_order_lag_is_preferred_where_it_is() {
    let mut truth = Truth::stock();
    truth.law.second_order = true;
    (truth.drive[FREQUENCY], truth.drive[DAMPING]) = (8.0, 0.5);
    let d = diagnosed(&truth, None);
    holds(&d, "natural_frequency", 8.0);
    holds(&d, "damping", 0.5);
}

#[test]
fn a_perfect_robot_has_no_mismatch() {
    let d = diagnosed(&Truth::perfect(), None);
    assert_eq!(d.verdict, Verdict::NoMismatch, "{:?}", d.ranked);
    assert_eq!(d.ranked[0].effect, "none");
    assert!(d.sentences[0].starts_with("No mismatch"));
}

#[test]
fn a_wrong_track_is_the_track_and_not_the_command() {
    let mut truth = Truth::perfect();
    truth.ground[TRACK] = 1.6;
    let d = diagnosed(&truth, None);
    assert_eq!(d.ranked[0].effect, "effective_track", "{:?}", d.ranked);
    holds(&d, "track_factor", 1.6);
    assert_eq!(d.response.as_ref().expect("a response").parameters.len(), 1);
    assert!(d.sentences[0].contains("The wheels do what is commanded"), "{:?}", d.sentences);
    let r = run(&d, "yaw");
    assert!(2.0 * r.corrected < r.nominal && r.placebo.is_some_and(|p| p > 1.5 * r.corrected), "{r:?}");
}

#[test]
fn what_the_references_do_as_well_is_not_missing() {
    let reference = Truth::stock();
    let same = diagnosed(&Truth::stock(), Some(&reference));
    assert_eq!(same.verdict, Verdict::NoMismatch, "{:?}", same.ranked);
    let mut later = Truth::stock();
    later.drive[DEAD_TIME] = 0.4;
    let d = diagnosed(&later, Some(&reference));
    assert_eq!(d.ranked[0].effect, "transport_delay", "{:?}", d.ranked);
    holds(&d, "dead_time", 0.4);
    approx::assert_abs_diff_eq!(parameter(&d, "dead_time").simulated.expect("known"), 0.22, epsilon = 0.02);
}

#[test]
fn too_few_steps_are_refused() {
    let runs = vec![Truth::stock().run("a", LEAST_STEPS - 1, 1)];
    let case = |recordings| ResponseCase { robot: robot(), references: vec![], recordings, held_out: vec![] };
    let error = diagnose_response(&case(runs), &|_| {}).expect_err("refused").to_string();
    assert!(error.contains("9 command steps") && error.contains("10 are needed"), "{error}");
    assert!(matches!(diagnose_response(&case(vec![]), &|_| {}), Err(DiagnosisError::Empty { what: "recording" })));
}
