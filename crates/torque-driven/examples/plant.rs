//! How long a step of the catalogue's plant takes: `cargo run --release -p diagnosis --example plant -- lanes`.
//!
//! `scalar` is one robot, `lanes` sixteen side by side, each with a mass of its own; no effects. Prints time per robot and step;
//! `--steps N --rounds 1` is for counting instructions.

use std::error::Error;
use std::hint::black_box;

use pulp::NullaryFnOnce;
use robot_model::{Lanes, Plant, Robot, Scalar, State};

#[path = "../../../benches/shared/clock.rs"]
mod clock;
#[path = "shared/robot.rs"]
mod robot;

const WIDTH: usize = 16;
const STEP: f64 = 1e-3;
/// Steps that a torque is held.
const HELD: usize = 10;

/// A drive of one robot or several, compiled for every vector unit that the machine may have.
struct Drive<'a, 'b, T: Scalar> {
    plant: &'a Plant<'b, T>,
    torque: &'a [[f64; 2]],
    steps: usize,
}

impl<T: Scalar> NullaryFnOnce for Drive<'_, '_, T> {
    type Output = T;

    #[inline(always)]
    fn call(self) -> T {
        let mut s = State::default();
        for k in 0..self.steps {
            let torque = self.torque[k / HELD % self.torque.len()].map(T::real);
            self.plant.step_drive(&mut s, torque);
            let delivered = self.plant.delivered(&s);
            self.plant.step_under(&mut s, delivered);
        }
        s.position[0]
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let steps = clock::option("--steps", 100_000)?;
    let rounds = clock::option("--rounds", 7)?;
    let torque: Vec<[f64; 2]> = (0..4000).map(|k| robot::torque(0.01 * f64::from(k))).collect();
    let robot = black_box(robot::robot());
    let (mode, width, seconds) = match std::env::args().nth(1).as_deref() {
        None | Some("scalar") => {
            let plant = Plant::new(&robot, &[], STEP);
            let run = || pulp::Arch::new().dispatch(Drive { plant: &plant, torque: &torque, steps });
            ("scalar", 1, clock::timed(rounds, run).0)
        }
        Some("lanes") => {
            let mut wide: Robot<Lanes<WIDTH>> = Robot::assemble(|constant| Lanes::real(constant(&robot)));
            for (i, mass) in wide.mass.0.iter_mut().enumerate() {
                *mass += 0.01 * i as f64;
            }
            let plant = Plant::new(&wide, &[], Lanes::real(STEP));
            let run = || pulp::Arch::new().dispatch(Drive { plant: &plant, torque: &torque, steps });
            ("lanes", WIDTH, clock::timed(rounds, run).0)
        }
        Some(other) => return Err(format!("there is no mode '{other}'; there are scalar and lanes").into()),
    };
    println!("catalogue.{mode} {:.2} ns/step   {width} side by side", 1e9 * seconds / (steps * width) as f64);
    Ok(())
}
