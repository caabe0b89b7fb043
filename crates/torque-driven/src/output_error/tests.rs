use robot_model::robot::{Drive, Robot};
use robot_model::{Plant, State};

use super::*;

const SIGMA: [f64; CHANNELS] = [0.005, 0.005, 0.005, 0.01, 0.05, 0.05];
const STEP: f64 = 1e-3;

fn robot() -> Robot<f64> {
    Robot {
        mass: 20.0,
        yaw_inertia: 0.9,
        com: [0.0, 0.0, 0.12],
        half_wheelbase: 0.175,
        half_track: 0.215,
        wheel_radius: 0.0965,
        wheel_inertia: 0.02,
        motor_inertia: 0.02,
        adhesion: 0.6,
        slip_at_peak: 0.2,
        sliding_share: 0.0,
        rest_speed: 0.15,
        lateral_factor: 1.0,
        rolling_resistance: 0.02,
        coulomb: [0.3; 2],
        viscous: [0.12; 2],
        stribeck: 0.0,
        chassis: robot_model::Chassis::SkidSteer,
        casters: [[0.0; 2]; 2],
        caster_trail: 0.0,
        caster_rolling: 0.0,
        hitch_x: -0.3,
        drive: Drive { gain: 1.0, lag: 0.0, extra_lag: 0.0, delay: 0.0, limit: 50.0, dead_band: 0.0 },
        gravity: 9.81,
    }
}

/// Numbers between −1 and 1 of variance 1/3 that look random.
struct Noise(u32);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(self.0) / f64::from(u32::MAX) * 2.0 - 1.0
    }
}

/// A drive of the plant itself with noise of `noise` standard deviations.
fn driven(robot: &Robot<f64>, rows: usize, phase: f64, noise: f64) -> Recorded {
    let plant = Plant::new(robot, &[], STEP);
    let mut s = State::default();
    let mut random = Noise(7 + phase as u32);
    let (mut torque, mut observed) = (Vec::new(), Vec::new());
    let delay = (robot.drive.delay / STEP).round() as usize;
    for row in 0..rows {
        let t = row as f64 * 0.01 + phase;
        let (a, b) = (2.2 + 1.2 * (0.7 * t).sin(), 2.6 * (0.31 * t + 0.4).sin() * f64::from((1.1 * t).sin() > -0.3));
        torque.push([a - b, a + b]);
        for k in 0..10 {
            let k: usize = row * 10 + k;
            plant.step(&mut s, torque[k.saturating_sub(delay) / 10]);
        }
        // The yaw of a compass: never beyond π.
        let yaw = s.heading[1].atan2(s.heading[0]);
        let y = [s.position[0], s.position[1], yaw, s.yaw_rate, s.wheel_speed[0], s.wheel_speed[1]];
        observed.push(std::array::from_fn(|c| y[c] + noise * 3.0_f64.sqrt() * SIGMA[c] * random.next()));
    }
    Recorded { name: format!("run_{phase}"), start: State::default(), period: 0.01, torque, observed }
}

fn constants() -> Vec<Constant> {
    let tunable = |id: &str| Constant::tunable(id).expect("a tunable");
    let coulomb = Constant::factor("coulomb", |r, f| r.coulomb = r.coulomb.map(|c| c * f));
    vec![
        tunable("mass"),
        tunable("yaw_inertia"),
        tunable("adhesion"),
        tunable("slip_at_peak"),
        coulomb,
        tunable("viscous"),
    ]
}

fn off() -> Vec<f64> {
    [1.06_f64, 0.93, 0.95, 1.08, 1.1, 0.92].map(f64::ln).to_vec()
}

#[test]
fn constants_are_recovered_from_noisy_drives_within_their_intervals() {
    // Of different lengths, and one with a hole.
    let mut drives = vec![driven(&robot(), 1500, 0.0, 1.0), driven(&robot(), 1100, 13.7, 1.0)];
    for row in 400..500 {
        drives[0].observed[row] = [f64::NAN; CHANNELS];
    }
    let problem = OutputError::new(&robot(), constants(), &drives, SIGMA, STEP).expect("a problem");
    let fitted = problem.fit(&off()).expect("determined");
    assert!(fitted.converged && fitted.jacobians < 12, "{} Jacobians", fitted.jacobians);
    assert_eq!(fitted.numbers, 2500 * CHANNELS);
    let per_number = fitted.cost / fitted.numbers as f64;
    assert!((0.95..1.05).contains(&per_number), "cost per number {per_number}");
    for (i, (delta, sigma)) in fitted.delta.iter().zip(&fitted.sigma).enumerate() {
        assert!(delta.abs() < 4.0 * sigma, "constant {i}: {delta} ± {sigma}");
        assert!(*sigma < 0.02, "constant {i}: ± {sigma}");
    }
    approx::assert_relative_eq!(fitted.robot.mass, 20.0 * fitted.delta[0].exp(), max_relative = 1e-14);
}

#[test]
fn a_jacobian_in_lanes_is_that_of_central_differences() {
    // More recordings than stand side by side, of two lengths.
    let drives: Vec<Recorded> = (0..5).map(|i| driven(&robot(), 150 + 40 * (i % 2), 3.0 * i as f64, 1.0)).collect();
    let problem = OutputError::new(&robot(), constants(), &drives, SIGMA, STEP).expect("a problem");
    let at = off();
    let mut rows: Vec<(f64, Vec<f64>)> = Vec::new();
    let equations = problem.each_row(&at, |e, columns| rows.push((e, columns.to_vec()))).expect("finite");
    let residuals = problem.residuals(&at).expect("finite");
    assert_eq!(rows.len(), residuals.len());
    // A lane has the bits of a run of its own.
    assert!(rows.iter().zip(&residuals).all(|((e, _), alone)| e == alone));
    for j in 0..at.len() {
        let shifted = |h: f64| {
            let mut delta = at.clone();
            delta[j] += h;
            problem.residuals(&delta).expect("finite")
        };
        let (more, less) = (shifted(1e-5), shifted(-1e-5));
        // The residual is y − ŷ, the column that of ŷ.
        let central: Vec<f64> = less.iter().zip(&more).map(|(less, more)| (less - more) / 2e-5).collect();
        let largest = central.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(largest > 1.0, "constant {j} has a trace");
        for (row, central) in rows.iter().zip(&central) {
            assert!((row.1[j] - central).abs() < 1e-4 * largest, "constant {j}: {} {central}", row.1[j]);
        }
    }
    let square: f64 = rows.iter().map(|(_, c)| c[1] * c[2]).sum();
    approx::assert_relative_eq!(equations.matrix[(2, 1)], square, max_relative = 1e-12);
    let cost: f64 = residuals.iter().map(|e| e * e).sum();
    approx::assert_relative_eq!(equations.cost, cost, max_relative = 1e-12);
}

#[test]
fn the_drives_delay_is_heeded() {
    let late = Robot { drive: Drive { delay: 0.034, lag: 0.02, ..robot().drive }, ..robot() };
    let drives = [driven(&late, 300, 2.0, 0.0)];
    let residuals = |robot: &Robot<f64>| {
        let problem = OutputError::new(robot, constants(), &drives, SIGMA, STEP).expect("a problem");
        problem.residuals(&[0.0; 6]).expect("finite").iter().fold(0.0_f64, |m, e| m.max(e.abs()))
    };
    assert!(residuals(&late) < 1e-9, "{}", residuals(&late));
    assert!(residuals(&robot()) > 1.0);
}

#[test]
fn what_the_data_do_not_determine_is_refused_by_name() {
    let tunable = |id: &str| Constant::tunable(id).expect("a tunable");
    let drives = [driven(&robot(), 400, 0.0, 1.0)];
    let fit = |constants: Vec<Constant>, drives: &[Recorded]| {
        let start = vec![0.01; constants.len()];
        let problem = OutputError::new(&robot(), constants, drives, SIGMA, STEP).expect("a problem");
        problem.fit(&start).expect_err("not determined").to_string()
    };
    // Twins.
    let twin = Constant::factor("weight", |r, f| r.mass *= f);
    let error = fit(vec![tunable("mass"), tunable("viscous"), twin], &drives);
    assert!(error.starts_with("the recordings do not determine mass, weight apart; "), "{error}");
    // A hitch without a trailer changes nothing.
    let hitch = Constant::offset("hitch_x", 0.1, |r, d| r.hitch_x += d).expect("a scale");
    let error = fit(vec![tunable("mass"), hitch], &drives);
    assert!(error.starts_with("the recordings do not determine hitch_x; "), "{error}");
    // A robot that stands tells nothing of its inertia.
    let still = Recorded { torque: vec![[0.0; 2]; 400], observed: vec![[0.0; CHANNELS]; 400], ..drives[0].clone() };
    let error = fit(vec![tunable("yaw_inertia")], &[still]);
    assert!(error.contains("yaw_inertia"), "{error}");
}

#[test]
fn bad_problems_are_reported() {
    let drive = driven(&robot(), 20, 0.0, 1.0);
    let told = |constants: Vec<Constant>, drive: Recorded, sigma: [f64; CHANNELS], step: f64| {
        OutputError::new(&robot(), constants, &[drive], sigma, step).expect_err("refused").to_string()
    };
    assert!(told(vec![], drive.clone(), SIGMA, STEP).contains("at least one constant"));
    assert!(told(constants(), drive.clone(), SIGMA, 0.0).contains("the step is 0"));
    assert!(told(constants(), drive.clone(), [0.0; CHANNELS], STEP).contains("output 0"));
    let short = Recorded { torque: vec![[1.0; 2]; 3], ..drive.clone() };
    assert!(told(constants(), short, SIGMA, STEP).contains("'run_0' has 3 rows of torque and 20 of outputs"));
    let hole = Recorded { torque: vec![[f64::NAN; 2]; 20], ..drive.clone() };
    assert!(told(constants(), hole, SIGMA, STEP).contains("row 0"));
    let error = Constant::tunable("colour").expect_err("no constant").to_string();
    assert!(error.starts_with("no constant 'colour' can be re-tuned; there are adhesion, "), "{error}");
    let adrift = Recorded { start: State { yaw_rate: f64::NAN, ..State::default() }, ..drive.clone() };
    let drives = [drive, adrift];
    let problem = OutputError::new(&robot(), constants(), &drives, SIGMA, STEP).expect("a problem");
    assert!(matches!(problem.fit(&[0.0; 5]), Err(OutputErrorError::Start { given: 5, constants: 6 })));
    assert!(matches!(problem.fit(&off()), Err(OutputErrorError::NotFinite { recording }) if recording == "run_0"));
}
