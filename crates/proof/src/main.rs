//! `cargo xtask blind`, `evidence`, `mujoco`, `next` and `bag`.

use std::process::ExitCode;

fn main() -> ExitCode {
    proof::run()
}
