//! Every command tells what it takes.

use std::process::Command;

/// What the program prints for these arguments.
fn printed(args: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_xtask")).args(args).output().expect("it starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

#[test]
fn every_command_tells_what_it_takes() {
    let all = printed(&["--help"]);
    let listed = all.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    // Explanations that do not fit a line go on below it, indented further.
    let named = listed.filter(|line| !line.starts_with("   "));
    let names: Vec<&str> = named.filter_map(|line| line.split_whitespace().next()).filter(|n| *n != "help").collect();
    assert!(names.contains(&"book") && names.contains(&"blind"), "{names:?}");
    // Those of other packages are tested there: asked for, they would be built.
    let elsewhere: Vec<&str> = harness::commands::ELSEWHERE.iter().map(|command| command.name).collect();
    assert!(elsewhere.iter().all(|name| names.contains(name)), "{names:?}");
    for name in names.into_iter().filter(|name| !elsewhere.contains(name)) {
        assert!(printed(&[name, "--help"]).contains(&format!("xtask {name}")), "{name}");
    }
}
