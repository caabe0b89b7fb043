//! What is being done and how long it will take: a bar on a terminal, lines with `--verbose`, otherwise nothing.

use std::cell::Cell;
use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// How often the spinner turns.
pub(super) const TICK: Duration = Duration::from_millis(100);

/// Where a stage of long work begins, as a share of the whole work of its kind.
pub(crate) type Stages = &'static [(&'static str, f64)];

/// Tells how far the work is. Nothing of it goes to standard output.
pub(crate) struct Progress {
    bar: Option<ProgressBar>,
    lines: bool,
    stages: Stages,
    /// When the stages began.
    since: Cell<Option<Instant>>,
}

impl Progress {
    /// Of work whose length nobody knows before.
    pub(crate) fn new(verbose: bool) -> Self {
        Self::of(&[], verbose)
    }

    /// Of work in stages.
    pub(crate) fn of(stages: Stages, verbose: bool) -> Self {
        let bar = (!verbose && io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::new_spinner();
            bar.enable_steady_tick(TICK);
            bar
        });
        Self { bar, lines: verbose, stages, since: Cell::new(None) }
    }

    /// A stage begins.
    pub(crate) fn stage(&self, what: &str) {
        let share = self.stages.iter().find(|(name, _)| *name == what).map(|&(_, share)| share);
        let since = self.since.get().unwrap_or_else(Instant::now);
        self.since.set(Some(since));
        if let Some(bar) = &self.bar {
            let left = share.and_then(|share| left(since.elapsed(), share));
            bar.set_message(left.map_or_else(|| what.to_owned(), |left| format!("{what}, about {left} left")));
            if let Some(share) = share {
                bar.set_style(style("{spinner} {bar:30} {msg}"));
                bar.set_length(100);
                bar.set_position(percent(share));
            }
        }
        if self.lines {
            let share = share.map_or(String::new(), |share| format!("[{:>3} %] ", percent(share)));
            let _ = writeln!(io::stderr(), "{share}{what}");
        }
    }

    /// So many bytes are read, of so many.
    pub(crate) fn bytes(&self, done: u64, of: u64) {
        let Some(bar) = &self.bar else { return };
        if bar.length() != Some(of) || done < bar.position() {
            bar.set_style(style("{spinner} {bar:30} {msg}, {bytes} of {total_bytes}, {eta} left"));
            bar.set_length(of);
            bar.reset_eta();
        }
        bar.set_position(done);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// A style that the program itself wrote; the usual one, if it were wrong.
pub(super) fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

fn percent(share: f64) -> u64 {
    (100.0 * share).round() as u64
}

/// The time that is left after `elapsed` for a share of the work, in words; unknown at the very start.
fn left(elapsed: Duration, share: f64) -> Option<String> {
    /// Below this share the guess would be wild.
    const LEAST: f64 = 0.05;
    (share >= LEAST).then(|| {
        let seconds = (elapsed.as_secs_f64() * (1.0 - share) / share).ceil();
        if seconds < 90.0 { format!("{seconds} s") } else { format!("{} min", (seconds / 60.0).round()) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_follows_from_what_was_done() {
        assert_eq!(left(Duration::from_secs(5), 0.0), None);
        assert_eq!(left(Duration::from_secs(5), 0.25).as_deref(), Some("15 s"));
        assert_eq!(left(Duration::from_secs(100), 0.1).as_deref(), Some("15 min"));
    }
}
