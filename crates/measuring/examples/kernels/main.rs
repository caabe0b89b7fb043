//! One figure per hot kernel: CPU time of the thread, median of several loops in one run.
//!
//! `cargo run --release -p measuring --example kernels -- plant scalar` prints `plant.scalar 158.2 ns/step`.
//!
//! | kernel | one step of it |
//! |---|---|
//! | `ident scalar`, `ident lanes` | forward Euler, two outputs of six logistic neurons with their regressors, two angle rows |
//! | `plant scalar`, `plant lanes` | RK4 of 1 ms: side-sum belt, uncoupled tyre |
//! | `implicit scalar`, `implicit lanes` | ROS2 of 1 ms of the same plant |
//! | `controller scalar`, `controller lanes` | path, kinematic loop, two networks of eight neurons |
//! | `seedloop 1`, `seedloop 20` | 32 000 steps of controller, plant (so many substeps) and identifier; in ms |
//! | `ensemble 1000` | so many draws of the reproduction over one trajectory, with certificates; in s |
//!
//! `--steps N` sets the steps of a loop (draws of the ensemble), and runs one loop only: for counting instructions as the
//! difference of two lengths. In lanes, times are per robot.

mod clock;
mod fixture;
mod loops;

use std::process::ExitCode;

const USAGE: &str = "usage: kernels KERNEL VARIANT [--steps N]
  ident|plant|implicit|controller scalar|lanes
  seedloop 1|20
  ensemble 1000

Examples:
  kernels plant scalar
  kernels ident lanes --steps 200000

Exit codes: 0 printed, 2 unknown kernel";

/// How long a kernel runs.
#[derive(Clone, Copy)]
pub(crate) struct Length {
    /// Steps of one loop, if the caller says.
    pub(crate) steps: Option<usize>,
}

impl Length {
    /// Steps of a loop, and how many loops.
    pub(crate) fn or(self, steps: usize, loops: usize) -> (usize, usize) {
        self.steps.map_or((steps, loops), |n| (n, 1))
    }
}

fn main() -> ExitCode {
    let mut words: Vec<String> = std::env::args().skip(1).collect();
    let mut length = Length { steps: None };
    if let Some(at) = words.iter().position(|w| w == "--steps") {
        length.steps = words.get(at + 1).and_then(|n| n.parse().ok()).filter(|n| *n > 0);
        if length.steps.is_none() {
            eprintln!("kernels: --steps takes a whole number above zero\n{USAGE}");
            return ExitCode::from(2);
        }
        words.drain(at..at + 2);
    }
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let found = match words[..] {
        ["ident", "scalar"] => Some(loops::ident_scalar(length)),
        ["ident", "lanes"] => Some(loops::ident_lanes(length)),
        ["plant", "scalar"] => Some(loops::plant_scalar(length, fixture::Scheme::Explicit)),
        ["plant", "lanes"] => Some(loops::plant_lanes(length, fixture::Scheme::Explicit)),
        ["implicit", "scalar"] => Some(loops::plant_scalar(length, fixture::Scheme::Implicit)),
        ["implicit", "lanes"] => Some(loops::plant_lanes(length, fixture::Scheme::Implicit)),
        ["controller", "scalar"] => Some(loops::controller_scalar(length)),
        ["controller", "lanes"] => Some(loops::controller_lanes(length)),
        ["seedloop", substeps] => substeps.parse().ok().and_then(|n| loops::seedloop(length, n)),
        ["ensemble", draws] => draws.parse().ok().and_then(|n| loops::ensemble(length, n)),
        _ => None,
    };
    let Some((value, unit)) = found else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    println!("{} {value:.2} {unit}", words.join("."));
    ExitCode::SUCCESS
}
