//! Standard output for results, standard error for everything else.

use std::io::{ErrorKind, Write};
use std::panic::AssertUnwindSafe;
use std::process::ExitCode;
use std::sync::{Mutex, MutexGuard, PoisonError};

use anyhow::{Context, Result};
use serde_json::Value;

mod counted;
mod excerpt;
mod progress;

pub(crate) use counted::Counted;
pub(crate) use progress::{Progress, Stages};
pub(crate) use report::sections::heading;

/// Writes a result to standard output. A reader that has seen enough (`| head`) is no failure.
pub(crate) fn emit(text: &str) -> Result<()> {
    let mut out = anstream::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(e).context("cannot write to standard output"),
        _ => Ok(()),
    }
}

/// Writes JSON to a file, or to standard output for `-`.
pub(crate) fn emit_json(target: &str, value: &Value) -> Result<()> {
    let text = serde_json::to_string_pretty(value)? + "\n";
    if target == "-" {
        return emit(&text);
    }
    std::fs::write(target, text).with_context(|| format!("cannot write '{target}'"))
}

/// Says on standard error why nothing, or not everything, was done; with the lines that it is about, if any.
pub(crate) fn failure(error: &anyhow::Error) {
    let sentence = format!("{error:#}");
    match excerpt::render(error, &sentence) {
        // Nobody listens when this fails.
        Some(report) => drop(writeln!(anstream::stderr(), "{report}")),
        None => line("error", anstyle::AnsiColor::Red, &sentence),
    }
}

/// Says on standard error that the program itself is wrong.
pub(crate) fn defect(message: &str) {
    line("error", anstyle::AnsiColor::Red, message);
}

/// Says on standard error what may have gone wrong.
pub(crate) fn warning(message: &str) {
    line("warning", anstyle::AnsiColor::Yellow, message);
}

fn line(kind: &str, colour: anstyle::AnsiColor, message: &str) {
    let style = colour.on_default().bold();
    // Nobody listens when this fails.
    let _ = writeln!(anstream::stderr(), "{style}{kind}{style:#}: {message}");
}

/// The last panic, which counts only if nobody catches it: readers catch those of libraries on damaged files.
static LAST_PANIC: Mutex<Option<String>> = Mutex::new(None);

/// Runs the program; of a defect in it the one line that tells it, like every other failure.
pub(crate) fn catch_panics(program: impl FnOnce() -> ExitCode) -> Result<ExitCode, String> {
    std::panic::set_hook(Box::new(|info| {
        let what = info.payload_as_str().unwrap_or("no message");
        let place = info.location().map_or(String::new(), |l| format!(" at {}:{}", l.file(), l.line()));
        *last_panic() = Some(format!("{place}: {what}"));
    }));
    // Nothing of what the program held is used afterwards.
    std::panic::catch_unwind(AssertUnwindSafe(program)).map_err(|_| {
        let what = last_panic().take().unwrap_or_default();
        format!("defect in lacuna{what}; please report it together with the input")
    })
}

/// A panic while the message is stored leaves it as good as it was.
fn last_panic() -> MutexGuard<'static, Option<String>> {
    LAST_PANIC.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The hook is the process's: one test for all that it does.
    #[test]
    fn only_panics_that_nobody_catches_end_the_program() {
        let ended = catch_panics(|| {
            let caught = std::panic::catch_unwind(|| panic!("a damaged page"));
            if caught.is_err() { ExitCode::from(3) } else { ExitCode::SUCCESS }
        });
        assert_eq!(ended, Ok(ExitCode::from(3)));
        let ended = catch_panics(|| panic!("no such row"));
        drop(std::panic::take_hook());
        let message = ended.expect_err("nobody caught it");
        assert!(message.starts_with("defect in lacuna at ") && message.contains("console.rs:"), "{message}");
        assert!(message.ends_with(": no such row; please report it together with the input"), "{message}");
    }
}
