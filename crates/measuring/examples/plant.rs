//! How long a step of the catalogue's plant takes: `cargo run --release -p measuring --example plant -- lanes`.
//!
//! `scalar` is one robot, `lanes` sixteen side by side, each with a mass of its own; no effects. Prints time per robot and step;
//! `--steps N --rounds 1` is for counting instructions.

use std::error::Error;
use std::hint::black_box;

use robot_model::{Lanes, Plant, Robot, Scalar, State};
use sim::rollout::{Commanded, Rollout};

#[path = "../../../benches/shared/clock.rs"]
mod clock;
#[path = "../../../benches/shared/robot.rs"]
mod robot;

const WIDTH: usize = 16;
const STEP: f64 = 1e-3;
/// Steps that a torque is held.
const HELD: usize = 10;

/// A drive of one robot or several; where it ends along x.
fn drive<T: Scalar>(plant: &Plant<'_, T>, torque: &[[f64; 2]], steps: usize) -> T {
    let mut s = State::default();
    let held = |step: usize, _: usize| torque[step / HELD % torque.len()].map(T::real);
    let Ok(()) = Rollout::new(plant, steps, 1).run_vectorised(&mut s, &mut Commanded(held), &mut ());
    s.position[0]
}

fn main() -> Result<(), Box<dyn Error>> {
    let steps = clock::option("--steps", 100_000)?;
    let rounds = clock::option("--rounds", 7)?;
    let torque: Vec<[f64; 2]> = (0..4000).map(|k| robot::torque(0.01 * f64::from(k))).collect();
    let robot = black_box(robot::robot());
    let (mode, width, seconds) = match std::env::args().nth(1).as_deref() {
        None | Some("scalar") => {
            let plant = Plant::new(&robot, &[], STEP);
            let run = || drive(&plant, &torque, steps);
            ("scalar", 1, clock::timed(rounds, run).0)
        }
        Some("lanes") => {
            let mut wide: Robot<Lanes<WIDTH>> =
                Robot::assemble(robot.chassis, |constant| Lanes::real(constant(&robot)));
            for (i, mass) in wide.mass.0.iter_mut().enumerate() {
                *mass += 0.01 * i as f64;
            }
            let plant = Plant::new(&wide, &[], Lanes::real(STEP));
            let run = || drive(&plant, &torque, steps);
            ("lanes", WIDTH, clock::timed(rounds, run).0)
        }
        Some(other) => return Err(format!("there is no mode '{other}'; there are scalar and lanes").into()),
    };
    println!("catalogue.{mode} {:.2} ns/step   {width} side by side", 1e9 * seconds / (steps * width) as f64);
    Ok(())
}
