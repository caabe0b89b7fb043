//! Runs both programs of a row in turn, each in a process of its own.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

use super::anchors::Anchors;
use super::figure::Figure;
use super::outcome::{Outcome, Side};
use super::table::{Of, Program, Row};
use crate::{child, examples};

/// One thread each: BLAS, OpenMP, numba and rayon.
const ONE_THREAD: [&str; 6] = [
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "BLIS_NUM_THREADS",
    "NUMBA_NUM_THREADS",
    "RAYON_NUM_THREADS",
];

/// Programs as far as they are there, and where they write.
pub(super) struct Bench {
    anchors: Anchors,
    python: Result<PathBuf, String>,
    /// Examples that were built, or why they were not.
    examples: BTreeMap<&'static str, Result<PathBuf, String>>,
    /// What programs print.
    logs: PathBuf,
}

impl Bench {
    /// Builds the examples that the rows need.
    pub(super) fn new(rows: &[&Row], anchors: Anchors, python: Result<PathBuf, String>, logs: PathBuf) -> Self {
        let mut examples = BTreeMap::new();
        for program in rows.iter().filter_map(|row| row.ours) {
            if let Of::Example { package, name } = program.of {
                examples.entry(name).or_insert_with(|| {
                    eprintln!("building example {name} of {package}");
                    examples::built(package, name)
                });
            }
        }
        Self { anchors, python, examples, logs }
    }

    /// A command that starts a program; or why it cannot be started: `Ok` where that is to be expected.
    fn command(&self, program: &Program) -> Result<Command, Side> {
        let skipped = |why: &String| Side::Skipped(why.clone());
        let (mut command, folder) = match program.of {
            Of::Example { name, .. } => {
                let path = match self.examples.get(name) {
                    Some(Ok(path)) => path,
                    Some(Err(why)) => return Err(Side::Failed(why.clone())),
                    None => return Err(Side::Failed(format!("example '{name}' was not built"))),
                };
                (Command::new(path), None)
            }
            Of::Anchor(name) => {
                let folder = self.anchors.compiled.as_ref().map_err(skipped)?;
                (Command::new(folder.join(name)), None)
            }
            Of::Script(name) => {
                let sources = self.anchors.sources.as_ref().map_err(skipped)?;
                let python = self.python.as_ref().map_err(skipped)?;
                let mut command = Command::new(python);
                command.arg(sources.join(name)).env("PYTHONDONTWRITEBYTECODE", "1");
                if let Ok(compiled) = &self.anchors.compiled {
                    command.env("PERFBIN", compiled);
                }
                (command, Some(sources))
            }
        };
        command.args(program.args).stdin(Stdio::null());
        for name in ONE_THREAD {
            command.env(name, "1");
        }
        if let Some(folder) = folder {
            command.current_dir(folder);
        }
        Ok(command)
    }

    fn figure(program: &Program, mut command: Command, log: &Path) -> Result<Figure> {
        let file = |ending: &str| -> Result<File> {
            let path = log.with_extension(ending);
            File::create(&path).with_context(|| format!("cannot write '{}'", path.display()))
        };
        let ended = child::run(command.stdout(file("out")?).stderr(file("err")?))?;
        let read = |ending: &str| std::fs::read_to_string(log.with_extension(ending)).unwrap_or_default();
        let last = read("err").lines().rev().find(|l| !l.trim().is_empty()).unwrap_or("it said nothing").to_owned();
        ensure!(ended.status.success(), "{} ({last})", ended.status);
        Figure::read(&read("out"), program.place)
    }

    /// Runs ours, theirs, ours, theirs ...; a program that fails is reported and not run again.
    pub(super) fn measure(&self, row: &Row, rounds: u32) -> Outcome {
        let rounds = rounds.min(row.rounds);
        let mut sides = [("ours", row.ours), ("theirs", row.theirs)].map(|(whose, program)| Measuring {
            program,
            log: self.logs.join(format!("{}-{whose}", row.name)),
            side: if program.is_some() { Side::Ran(Vec::new()) } else { Side::Absent },
        });
        for _ in 0..rounds {
            for at in &mut sides {
                let (Some(program), Side::Ran(figures)) = (at.program, &mut at.side) else { continue };
                let figure = match self.command(&program) {
                    Err(side) => Err(side),
                    Ok(command) => {
                        let told = |e: anyhow::Error| Side::Failed(format!("{}: {e:#}", shown(&program)));
                        Self::figure(&program, command, &at.log).map_err(told)
                    }
                };
                match figure {
                    Ok(figure) => figures.push(figure),
                    Err(side) => at.side = side,
                }
            }
        }
        let [ours, theirs] = sides.map(|s| s.side);
        let [name, group, what] = [row.name, row.group, row.what].map(str::to_owned);
        let outcome = Outcome { name, group, what, ours, theirs, rounds, asked: None, met: None }.judged(row.goal);
        if let Some(how) = outcome.failure() {
            eprintln!("FAILED: row {}: {how}", row.name);
        }
        outcome
    }
}

/// One side of a row while it is measured.
struct Measuring {
    program: Option<Program>,
    log: PathBuf,
    side: Side,
}

/// A program as messages call it.
fn shown(program: &Program) -> String {
    let name = match program.of {
        Of::Example { name, .. } | Of::Anchor(name) | Of::Script(name) => name,
    };
    std::iter::once(name).chain(program.args.iter().copied()).collect::<Vec<_>>().join(" ")
}

/// Rows by the names that were given; all where none was.
pub(super) fn chosen<'a>(rows: &'a [Row], only: &[String]) -> Result<Vec<&'a Row>> {
    for name in only {
        let known: Vec<OsString> = rows.iter().map(|r| r.name.into()).collect();
        ensure!(
            known.iter().any(|k| k == name.as_str()),
            "there is no row '{name}'; there are {}",
            rows.iter().map(|r| r.name).collect::<Vec<_>>().join(", ")
        );
    }
    Ok(rows.iter().filter(|r| only.is_empty() || only.iter().any(|name| name == r.name)).collect())
}

#[cfg(test)]
mod tests {
    use super::super::figure::Place;
    use super::super::table::{Goal, ROWS};
    use super::*;

    fn bench(folder: &Path) -> Bench {
        let missing = || Err("not here".to_owned());
        Bench {
            anchors: Anchors { sources: missing(), compiled: Ok(folder.to_path_buf()) },
            python: missing(),
            examples: BTreeMap::from([("kernels", Err("no example target".to_owned()))]),
            logs: folder.to_path_buf(),
        }
    }

    fn program(of: Of) -> Program {
        Program { of, args: &[], place: Place::First }
    }

    const ROW: Row =
        Row { name: "plant", group: "Kernels", what: "", ours: None, theirs: None, goal: Goal::None, rounds: 2 };

    #[test]
    fn a_program_that_fails_does_not_stop_the_other_side() {
        let folder = tempfile::tempdir().expect("a folder");
        let script = folder.path().join("plant");
        std::fs::write(&script, "#!/bin/sh\necho plant.scalar $OMP_NUM_THREADS.5 ns/step\n").expect("writes");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            std::fs::set_permissions(&script, std::fs::Permissions::from_mode(0o755)).expect("may be run");
        }
        let ours = Some(program(Of::Example { package: "measuring", name: "kernels" }));
        let row = Row { ours, theirs: Some(program(Of::Anchor("plant"))), ..ROW };
        let outcome = bench(folder.path()).measure(&row, 5);
        assert_eq!(outcome.ours, Side::Failed("no example target".into()));
        // Two rounds although five were asked for, on one thread.
        let figure = Figure { value: 1.5, unit: "ns/step".into() };
        assert_eq!((outcome.rounds, outcome.theirs), (2, Side::Ran(vec![figure.clone(), figure])));
    }

    #[test]
    fn what_is_not_here_is_skipped_and_what_is_broken_failed() {
        let folder = tempfile::tempdir().expect("a folder");
        let bench = bench(folder.path());
        let row = Row { theirs: Some(program(Of::Script("fit_py.py"))), ..ROW };
        assert_eq!(bench.measure(&row, 1).theirs, Side::Skipped("not here".into()));
        let row = Row { theirs: Some(program(Of::Anchor("nowhere"))), ..ROW };
        assert!(matches!(bench.measure(&row, 1).theirs, Side::Failed(how) if how.contains("nowhere")));
    }

    #[test]
    fn rows_are_chosen_by_name() {
        assert_eq!(chosen(ROWS, &[]).expect("all").len(), ROWS.len());
        let names = ["weak".to_owned(), "csv".to_owned()];
        assert_eq!(chosen(ROWS, &names).expect("two").iter().map(|r| r.name).collect::<Vec<_>>(), ["weak", "csv"]);
        let error = chosen(ROWS, &["weka".to_owned()]).expect_err("no row");
        assert!(error.to_string().starts_with("there is no row 'weka'; there are peak-fma, "));
    }
}
