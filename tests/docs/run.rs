//! The commands of a page, run in a folder of its own.

use std::env::consts::EXE_SUFFIX;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{self, Output};

use crate::blocks::{self, Block};
use crate::command::Command;
use crate::{compare, root, shown};
use harness::commands::ELSEWHERE;
use harness::stale::newer_source;

/// The programs that the documentation speaks of.
pub(crate) struct Programs {
    lacuna: PathBuf,
    xtask: PathBuf,
    measuring: PathBuf,
    proof: PathBuf,
}

impl Programs {
    /// Those beside this test; built where they are not there, or older than their sources.
    pub(crate) fn find() -> Self {
        let this = std::env::current_exe().expect("this program");
        let profile = this.parent().and_then(Path::parent).expect("it lies in target/PROFILE/deps");
        let target = profile.parent().expect("it lies in target/PROFILE/deps");
        let packages = ["lacuna", "xtask", "measuring", "proof"];
        let programs = packages.map(|name| profile.join(format!("{name}{EXE_SUFFIX}")));
        let are_new = programs.iter().all(|program| program.is_file() && newer_source(program).is_none());
        let [lacuna, xtask, measuring, proof] = programs;
        let found = Self { lacuna, xtask, measuring, proof };
        // Tests of the whole workspace build all; cargo would build them anew, with the features of fewer packages.
        if are_new {
            return found;
        }
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut build = process::Command::new(cargo);
        build
            .args(["build", "--locked", "--bins", "--target-dir"])
            .arg(target)
            .args(packages.into_iter().flat_map(|package| ["-p", package]));
        if profile.ends_with("release") {
            build.arg("--release");
        }
        let status = build.current_dir(root()).status().expect("cargo");
        assert!(status.success(), "the programs cannot be built");
        found
    }

    /// The program that knows a command of `cargo xtask`; `None` where tests of the workspace do not build it.
    fn of(&self, args: &[String]) -> Option<&Path> {
        let elsewhere = ELSEWHERE.iter().find(|command| args.first().is_some_and(|name| name == command.name));
        match elsewhere.map(|command| command.package) {
            None => Some(&self.xtask),
            Some("measuring") => Some(&self.measuring),
            Some("proof") => Some(&self.proof),
            Some(_) => None,
        }
    }
}

/// Lines of what came out that a failure shows.
const MOST_SHOWN: usize = 60;

/// What became of the commands.
#[derive(Debug, Default)]
pub(crate) struct Tally {
    pub(crate) run: usize,
    pub(crate) checked: Vec<String>,
    pub(crate) skipped: Vec<String>,
    pub(crate) failures: Vec<String>,
}

impl Tally {
    pub(crate) fn add(&mut self, mut other: Self) {
        self.run += other.run;
        self.checked.append(&mut other.checked);
        self.skipped.append(&mut other.skipped);
        self.failures.append(&mut other.failures);
    }
}

/// A folder beside the data, as the repository is.
struct Scratch {
    folder: tempfile::TempDir,
    has_data: bool,
}

impl Scratch {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir(folder.path().join("repository")).expect("a folder");
        let data = root().join("../shared");
        let has_data = data.is_dir() && beside(&data, &folder.path().join("shared"));
        Self { folder, has_data }
    }

    fn path(&self) -> PathBuf {
        self.folder.path().join("repository")
    }
}

#[cfg(unix)]
fn beside(data: &Path, link: &Path) -> bool {
    let data = data.canonicalize().expect("it is there");
    std::os::unix::fs::symlink(data, link).is_ok()
}

#[cfg(not(unix))]
fn beside(_data: &Path, _link: &Path) -> bool {
    false
}

/// Runs the commands of a page.
pub(crate) fn page(programs: &Programs, page: &Path) -> Tally {
    let text = fs::read_to_string(page).expect("a page");
    let scratch = Scratch::new();
    let mut tally = Tally::default();
    for block in blocks::of(&text) {
        run_block(programs, &scratch, &block, &shown(page), &mut tally);
    }
    tally
}

fn run_block(programs: &Programs, scratch: &Scratch, block: &Block, page: &str, tally: &mut Tally) {
    let place = format!("{page}:{}", block.line);
    if let Some((name, text)) = &block.file {
        fs::write(scratch.path().join(name), text).expect("writes");
    }
    let only_checked = block.has("example") || (block.has("long") && std::env::var_os("LACUNA_LONG_DOCS").is_none());
    let (mut out, mut all_run) = (String::new(), true);
    let last = block.commands.len().saturating_sub(1);
    for (index, line) in block.commands.iter().enumerate() {
        let command = match Command::parse(line) {
            Ok(command) => command,
            Err(problem) => {
                tally.failures.push(format!("{place}: {problem}"));
                return;
            }
        };
        if line.contains("../shared/") && !scratch.has_data && !only_checked {
            tally.skipped.push(format!("{place}: {line}"));
            return;
        }
        let expected = if index == last { block.exit() } else { 0 };
        let outcome = match command {
            Command::Lacuna(args, into) if !only_checked => {
                let mut output = start(&programs.lacuna, scratch, &args);
                if let Some(file) = into {
                    fs::write(scratch.path().join(file), std::mem::take(&mut output.stdout)).expect("writes");
                }
                Some(output)
            }
            // Drawing cases is quick; all else that xtask does takes minutes, or writes into the repository.
            Command::Xtask(args) if !only_checked && args.iter().any(|arg| arg == "--draw-only") => {
                Some(start(&programs.proof, scratch, &args))
            }
            Command::Lacuna(args, _) => {
                check(&programs.lacuna, scratch, args, &place, line, tally);
                None
            }
            Command::Xtask(args) => {
                match programs.of(&args) {
                    Some(program) => check(program, scratch, args, &place, line, tally),
                    None => tally.checked.push(format!("{place}: {line}")),
                }
                None
            }
            Command::Cargo { packages, tests } => {
                tally.checked.push(format!("{place}: {line}"));
                tally
                    .failures
                    .extend(unknown_targets(&packages, &tests).map(|target| format!("{place}: no {target}: {line}")));
                None
            }
            Command::Beside(script) => {
                tally.checked.push(format!("{place}: {line}"));
                if scratch.has_data && !scratch.path().join(&script).is_file() {
                    tally.failures.push(format!("{place}: there is no {script}"));
                }
                None
            }
        };
        let Some(output) = outcome else {
            all_run = false;
            continue;
        };
        tally.run += 1;
        let [stdout, stderr] =
            [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
        if output.status.code() != Some(expected) {
            let code = output.status.code();
            tally
                .failures
                .push(format!("{place}: {line}\nended with {code:?} instead of {expected}\n{stdout}{stderr}"));
        }
        out += &stdout;
        out += &stderr;
    }
    if let Some(missing) = compare::first_missing(&block.shown, &out).filter(|_| all_run) {
        let start: Vec<&str> = out.lines().take(MOST_SHOWN).collect();
        let start = start.join("\n");
        tally
            .failures
            .push(format!("{place}: this line does not come out (any more):\n{missing}\nbut this does:\n{start}"));
    }
}

/// Runs a program in the page's folder.
fn start(program: &Path, scratch: &Scratch, args: &[String]) -> Output {
    let mut command = process::Command::new(program);
    // Started by hand, xtask writes below the current folder.
    command.args(args).current_dir(scratch.path()).env_remove("CARGO_MANIFEST_DIR").env("NO_COLOR", "1");
    command.output().expect("it starts")
}

/// Has a program read its arguments without doing anything.
fn check(program: &Path, scratch: &Scratch, mut args: Vec<String>, place: &str, line: &str, tally: &mut Tally) {
    tally.checked.push(format!("{place}: {line}"));
    args.push("--help".to_owned());
    let output = start(program, scratch, &args);
    if !output.status.success() {
        let why = String::from_utf8_lossy(&output.stderr);
        tally.failures.push(format!("{place}: {line}\nhas arguments that are refused:\n{why}"));
    }
}

/// Packages and tests that are not in the workspace.
fn unknown_targets<'a>(packages: &'a [String], tests: &'a [String]) -> impl Iterator<Item = &'a String> {
    let folder =
        |package: &str| if package == "xtask" { root().join(package) } else { root().join("crates").join(package) };
    let has_test = move |test: &str| {
        let all = packages.iter().map(|p| folder(p)).chain([root().to_path_buf()]);
        let at = |folder: PathBuf, end: &str| folder.join("tests").join(format!("{test}{end}")).is_file();
        all.into_iter().any(|folder| at(folder.clone(), ".rs") || at(folder, "/main.rs"))
    };
    let no_package = packages.iter().filter(move |package| !folder(package).is_dir());
    no_package.chain(tests.iter().filter(move |test| !has_test(test)))
}
