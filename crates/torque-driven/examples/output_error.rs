//! How long an output-error fit takes: `cargo run --release -p diagnosis --example output_error -- fit`.
//!
//! Six constants of a robot of 20 kg from four recordings of 30 s at 100 Hz, start 5 to 10 % off, noise as sensors have it.
//! `jacobian` prints the time of one Jacobian, seven robots in lanes, over that of one robot alone.

use std::error::Error;

use robot_model::{Plant, Robot, State};
use torque_driven::output_error::{CHANNELS, Constant, OutputError, Recorded};

#[path = "../../../benches/shared/clock.rs"]
mod clock;
#[path = "../../../benches/shared/robot.rs"]
mod robot;

const SIGMA: [f64; CHANNELS] = [0.005, 0.005, 0.005, 0.01, 0.05, 0.05];
const START: [f64; 6] = [1.06, 0.93, 0.95, 1.08, 1.1, 0.92];
const STEP: f64 = 1e-3;
const PERIOD: f64 = 0.01;
const ROWS: usize = 3000;

/// Normally distributed numbers, nearly: sums of twelve.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        let mut sum = -6.0;
        for _ in 0..12 {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            sum += (self.0 >> 11) as f64 / (1_u64 << 53) as f64;
        }
        sum
    }
}

fn recorded(truth: &Robot<f64>, number: usize, noise: &mut Noise) -> Recorded {
    let plant = Plant::new(truth, &[], STEP);
    let mut s = State::default();
    let (mut torque, mut observed) = (Vec::new(), Vec::new());
    for row in 0..ROWS {
        let command = robot::torque(row as f64 * PERIOD + 13.7 * number as f64);
        for _ in 0..(PERIOD / STEP).round() as usize {
            plant.step(&mut s, command);
        }
        let yaw = s.heading[1].atan2(s.heading[0]);
        let y = [s.position[0], s.position[1], yaw, s.yaw_rate, s.wheel_speed[0], s.wheel_speed[1]];
        torque.push(command);
        observed.push(std::array::from_fn(|c| y[c] + SIGMA[c] * noise.next()));
    }
    Recorded { name: format!("run_{number}"), start: State::default(), period: PERIOD, torque, observed }
}

fn constants() -> Result<Vec<Constant>, Box<dyn Error>> {
    Ok(vec![
        Constant::tunable("mass")?,
        Constant::tunable("yaw_inertia")?,
        Constant::tunable("adhesion")?,
        Constant::tunable("slip_at_peak")?,
        Constant::factor("coulomb", |robot, factor| robot.coulomb = robot.coulomb.map(|c| c * factor)),
        Constant::tunable("viscous")?,
    ])
}

fn main() -> Result<(), Box<dyn Error>> {
    let truth = robot::robot();
    let mut noise = Noise(88_172_645_463_325_252);
    let recordings: Vec<Recorded> = (0..4).map(|number| recorded(&truth, number, &mut noise)).collect();
    let problem = OutputError::new(&truth, constants()?, &recordings, SIGMA, STEP)?;
    let start = START.map(f64::ln);
    match std::env::args().nth(1).as_deref() {
        None | Some("fit") => {
            let (seconds, fitted) = clock::timed(clock::option("--rounds", 3)?, || problem.fit(&start));
            let fitted = fitted?;
            let worst = fitted.delta.iter().map(|d| d.exp_m1().abs()).fold(0.0, f64::max);
            println!(
                "fit.lacuna {:.1} ms   {} Jacobians, cost/n {:.4}, worst parameter error {worst:.2e}",
                1e3 * seconds,
                fitted.jacobians,
                fitted.cost / fitted.numbers as f64
            );
        }
        Some("jacobian") => {
            let rounds = clock::option("--rounds", 5)?;
            let (jacobian, linear) = clock::timed(rounds, || problem.curvature(&start));
            let (alone, cost) = clock::timed(rounds, || problem.cost(&start));
            println!(
                "jacobian.lacuna {:.3} runs   {:.1} ms for {} robots, {:.1} ms for one alone, cost {:.6e}",
                jacobian / alone,
                1e3 * jacobian,
                linear?.len() + 1,
                1e3 * alone,
                cost?
            );
        }
        Some(other) => return Err(format!("there is no mode '{other}'; there are fit and jacobian").into()),
    }
    Ok(())
}
