//! How many of many are done, from any thread: a bar on a terminal, a line each with `--verbose`, otherwise nothing.

use std::io::{self, IsTerminal, Write};
use std::time::Duration;

use indicatif::ProgressBar;

use super::progress::{TICK, style};

/// Tells how many are done and how long the rest will take. Nothing of it goes to standard output.
pub(crate) struct Counted {
    bar: Option<ProgressBar>,
    lines: bool,
}

impl Counted {
    /// Of so many of these.
    pub(crate) fn new(of: usize, what: &str, verbose: bool) -> Self {
        let bar = (!verbose && io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::new(of as u64);
            bar.set_style(style(&format!("{{spinner}} {{bar:30}} {{pos}} of {{len}} {what}, about {{eta}} left")));
            bar.enable_steady_tick(TICK);
            bar
        });
        Self { bar, lines: verbose }
    }

    /// One more is done.
    pub(crate) fn one(&self, line: &str, took: Duration) {
        if let Some(bar) = &self.bar {
            bar.inc(1);
        }
        self.note(line, took);
    }

    /// Something else is done.
    pub(crate) fn note(&self, line: &str, took: Duration) {
        if self.lines {
            // Nobody listens when this fails.
            let _ = writeln!(io::stderr(), "[{:7.2} s] {line}", took.as_secs_f64());
        }
    }
}

impl Drop for Counted {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
