//! Every command tells what it takes, as one of `cargo xtask`.

use std::process::Command;

#[test]
fn every_command_tells_what_it_takes() {
    for (name, _) in harness::commands::of("measuring") {
        let output =
            Command::new(env!("CARGO_BIN_EXE_measuring")).args([name, "--help"]).output().expect("the program starts");
        let help = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success() && help.contains(&format!("cargo xtask {name} [OPTIONS]")), "{name}: {help}");
    }
}
