//! Programs in callgrind.

use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

use super::kernels::Kernel;
use crate::examples;

/// Whether valgrind can be started.
pub(super) fn is_there() -> bool {
    Command::new("valgrind")
        .arg("--version")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

/// Instructions of a whole run, and what the program printed.
fn count(program: &Path, args: &[&str], file: &Path) -> Result<(f64, String)> {
    let mut option = std::ffi::OsString::from("--callgrind-out-file=");
    option.push(file);
    let told = Command::new("valgrind")
        .args(["--tool=callgrind", "--quiet"])
        .arg(option)
        .arg(program)
        .args(args)
        .env("RAYON_NUM_THREADS", "1")
        .stdin(Stdio::null())
        .output()
        .context("cannot start valgrind")?;
    let said = String::from_utf8_lossy(&told.stderr);
    ensure!(
        told.status.success(),
        "'{} {}' ended with {} in valgrind ({})",
        program.display(),
        args.join(" "),
        told.status,
        said.lines().last().unwrap_or("it said nothing")
    );
    let text = std::fs::read_to_string(file).with_context(|| format!("cannot read '{}'", file.display()))?;
    let total = total(&text).with_context(|| format!("callgrind counted nothing in '{}'", file.display()))?;
    Ok((total, String::from_utf8_lossy(&told.stdout).into_owned()))
}

/// The sum in a file of callgrind.
fn total(text: &str) -> Option<f64> {
    let line = text.lines().rev().find_map(|line| line.strip_prefix("totals:"))?;
    line.split_whitespace().next()?.parse().ok()
}

/// Instructions of one step: the difference of two lengths, so that start-up does not count.
pub(super) fn per_step(kernel: &Kernel, program: &Path, folder: &Path) -> Result<f64> {
    let [short, long] = kernel.lengths;
    let file = folder.join(format!("{}.callgrind", kernel.name));
    let run = |length: u32| {
        let length = length.to_string();
        let args: Vec<&str> = kernel.args.iter().copied().chain([kernel.option, length.as_str()]).collect();
        count(program, &args, &file).map(|(total, _)| total)
    };
    let steps = f64::from(long - short) * f64::from(kernel.steps);
    let more = (run(long)? - run(short)?) / steps;
    ensure!(
        more > 0.0,
        "{} takes no more instructions for more steps: it does not heed {}",
        kernel.name,
        kernel.option
    );
    Ok(more)
}

/// The vector unit that `pulp` takes in valgrind, as the weak form's example prints it.
pub(super) fn vector_unit(weak_form: &Path, folder: &Path) -> Result<String> {
    let (_, printed) = count(weak_form, &["--rows", "100", "--rounds", "1"], &folder.join("vector-unit.callgrind"))?;
    examples::vector_unit(&printed)
        .with_context(|| format!("the example of weak-form named no vector unit: '{}'", printed.trim()))
}

#[cfg(test)]
mod tests {
    use super::total;

    #[test]
    fn the_sum_is_found() {
        assert_eq!(total("version: 1\nsummary: 7\n\nfn=(1)\n1 7\n\ntotals: 123456\n"), Some(123_456.0));
        assert_eq!(total("version: 1\n"), None);
        assert_eq!(total("totals: many\n"), None);
    }
}
