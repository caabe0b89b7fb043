//! `cargo xtask mutants`: changes the code that decides, one small thing at a time, and asks whether a test notices.
//!
//! `cargo-mutants` does it; here stands what is worth the hours: the arithmetic that all kinds of robots share, the verdict,
//! and the files of the engines in which something is decided.

use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};
use clap::Args as ClapArgs;

use crate::output;

const EXAMPLES: &str = "\
Examples:
  cargo xtask mutants --list                     packages and files, nothing run
  cargo xtask mutants --package inference        those of one package
  cargo xtask mutants --shard 0/8                an eighth, on this machine
  cargo xtask mutants --file '**/decide.rs'      those of one file

What no test noticed stands in target/mutants/mutants.out/missed.txt. All of
them take many hours; .ci/run starts none. It needs cargo-mutants.

Exit codes: 0 every mutant is noticed, 1 one is not, or an error, 2 wrong
usage.";

/// A package and those of its files that decide; none means all of them.
type Deciding = (&'static str, &'static [&'static str]);

const DECIDING: [Deciding; 5] = [
    ("inference", &[]),
    ("verdict", &[]),
    ("torque-driven", &["answer.rs", "candidate.rs", "decide.rs", "null_scores.rs", "leave_out.rs", "search.rs"]),
    ("speed-driven", &["compare.rs", "forecast.rs", "level.rs", "name.rs"]),
    ("command-driven", &["compare.rs", "name.rs", "search.rs"]),
];

/// Arguments of `cargo xtask mutants`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Print packages and files, and run nothing.
    #[arg(long)]
    list: bool,
    /// Only this package.
    #[arg(long, value_name = "NAME", value_parser = DECIDING.map(|(package, _)| package))]
    package: Option<String>,
    /// Only files whose paths match this pattern.
    #[arg(long, value_name = "PATTERN", conflicts_with = "list")]
    file: Option<String>,
    /// Part K, from 0, of N.
    #[arg(long, value_name = "K/N", conflicts_with = "list")]
    shard: Option<String>,
    /// Longest test of a mutant, s: one that runs longer counts as noticed.
    #[arg(long, value_name = "S", default_value_t = 300)]
    timeout: u32,
    /// Mutants that are tested at the same time.
    #[arg(long, value_name = "N", default_value_t = 1)]
    jobs: u32,
}

/// Runs the command; true if every mutant was noticed.
pub(crate) fn run(args: &Args) -> Result<bool> {
    if args.list {
        for (package, pattern) in patterns(args) {
            println!("{package:16}{pattern}");
        }
        return Ok(true);
    }
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let version = Command::new(&cargo).args(["mutants", "--version"]).stderr(Stdio::null()).output();
    if !version.is_ok_and(|version| version.status.success()) {
        bail!("cargo-mutants is not there; `cargo install --locked cargo-mutants` installs it");
    }

    let mut command = Command::new(cargo);
    command.arg("mutants").args(arguments(args)).arg("--output").arg(output::folder("mutants")?);
    let status = command.current_dir(output::beside("")).status().context("cannot start cargo")?;
    match status.code() {
        Some(0) => Ok(true),
        // What was not noticed, and what ran too long.
        Some(2 | 3) => Ok(false),
        _ => bail!("cargo-mutants could not finish ({status}); what it says stands above"),
    }
}

/// Each package that is asked for with the pattern of each of its files.
fn patterns(args: &Args) -> Vec<(&'static str, String)> {
    let wanted = |(package, _): &Deciding| args.package.as_deref().is_none_or(|only| only == *package);
    let of = |(package, files): Deciding| {
        let all: &[&str] = if files.is_empty() { &["**/*.rs"] } else { files };
        all.iter().map(move |file| (package, format!("crates/{package}/src/{file}"))).collect::<Vec<_>>()
    };
    DECIDING.into_iter().filter(wanted).flat_map(of).collect()
}

/// What cargo-mutants is told.
fn arguments(args: &Args) -> Vec<String> {
    let mut packages: Vec<&str> = patterns(args).iter().map(|(package, _)| *package).collect();
    packages.dedup();
    let files = match &args.file {
        Some(pattern) => vec![pattern.clone()],
        None => patterns(args).into_iter().map(|(_, pattern)| pattern).collect(),
    };
    let pairs = |name: &'static str, values: Vec<String>| values.into_iter().flat_map(move |v| [name.to_owned(), v]);
    pairs("--package", packages.into_iter().map(str::to_owned).collect())
        .chain(pairs("--file", files))
        .chain(pairs("--timeout", vec![args.timeout.to_string()]))
        .chain(pairs("--jobs", vec![args.jobs.to_string()]))
        .chain(pairs("--shard", args.shard.iter().cloned().collect()))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{Args, DECIDING, arguments, patterns};

    const ALL: Args = Args { list: false, package: None, file: None, shard: None, timeout: 300, jobs: 1 };

    #[test]
    fn every_file_that_decides_is_there() {
        let crates = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
        for (package, files) in DECIDING {
            let folder = crates.join(package).join("src");
            assert!(folder.is_dir(), "{package}");
            for file in files {
                assert!(folder.join(file).is_file(), "{package}: {file}");
            }
        }
    }

    #[test]
    fn a_package_and_a_shard_narrow_what_is_run() {
        let args = Args { package: Some("speed-driven".to_owned()), shard: Some("1/4".to_owned()), ..ALL };
        assert!(patterns(&args).iter().all(|(package, _)| *package == "speed-driven"));
        let told = arguments(&args).join(" ");
        assert!(told.starts_with("--package speed-driven --file crates/speed-driven/src/compare.rs --file"), "{told}");
        assert!(told.ends_with("--timeout 300 --jobs 1 --shard 1/4"), "{told}");
        assert!(!arguments(&ALL).contains(&"--shard".to_owned()));
    }
}
