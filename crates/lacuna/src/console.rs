//! Standard output for results, standard error for everything else.

use std::io::{self, ErrorKind, IsTerminal, Write};
use std::time::Duration;

use anyhow::{Context, Result};
use indicatif::ProgressBar;
use serde_json::Value;

/// Bold, for headings; left out where colours are not wanted (`NO_COLOR`, no terminal).
pub(crate) const HEADING: anstyle::Style = anstyle::Style::new().bold();

/// How often the spinner turns, ms.
const TICK: u64 = 100;

/// A heading.
pub(crate) fn heading(text: &str) -> String {
    format!("{HEADING}{text}{HEADING:#}\n")
}

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

/// Says on standard error why nothing, or not everything, was done.
pub(crate) fn error(message: &str) {
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

/// A defect of the program is told in one line, like every other failure.
pub(crate) fn report_panics() {
    std::panic::set_hook(Box::new(|info| {
        let what = info.payload_as_str().unwrap_or("no message");
        let place = info.location().map_or(String::new(), |l| format!(" at {}:{}", l.file(), l.line()));
        error(&format!("defect in lacuna{place}: {what}; please report it together with the input"));
        std::process::exit(1);
    }));
}

/// What is being done: a spinner on a terminal, lines with `--verbose`, otherwise nothing.
pub(crate) struct Progress {
    spinner: Option<ProgressBar>,
    lines: bool,
}

impl Progress {
    pub(crate) fn new(verbose: bool) -> Self {
        let spinner = (!verbose && io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::new_spinner();
            bar.enable_steady_tick(Duration::from_millis(TICK));
            bar
        });
        Self { spinner, lines: verbose }
    }

    /// A stage begins.
    pub(crate) fn stage(&self, what: &str) {
        if let Some(bar) = &self.spinner {
            bar.set_message(what.to_owned());
        }
        if self.lines {
            let _ = writeln!(io::stderr(), "{what}");
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.spinner {
            bar.finish_and_clear();
        }
    }
}
