//! What is worth telling of a channel: one sentence each, with its number and its place.

use std::fmt;

use super::tally::At;
use super::thresholds::{BUNCHED_SHARE, HELD_SHARE, LARGE_JITTER, MIN_SAMPLES, STEPWISE_SHARE};
use super::words::{counted, number, of_unit, percent, times};
use super::{Extreme, Quality, Tally};

/// How much a finding matters to whoever uses the channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Severity {
    /// Good to know.
    Note,
    /// Part of the samples cannot be trusted.
    Warning,
    /// Times or the whole channel cannot be trusted.
    Serious,
}

/// What kind of thing was found; the number of a [`Finding`] is that in brackets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum FindingKind {
    /// No sample at all (0).
    Empty,
    /// The clock was set ahead (how often).
    JumpsAhead,
    /// The clock was set back or wrapped (how often).
    JumpsBack,
    /// Samples that waited and came at once (how often).
    Late,
    /// Pauses (how many).
    Gaps,
    /// Reordered samples (how many).
    OutOfOrder,
    /// Repeated stamps (how many).
    Duplicates,
    /// Uneven periods (what 99 % of the deviations stay below, s).
    Jitter,
    /// Samples that arrive together (share).
    Bunched,
    /// Stamps that were computed or rounded (period, s).
    ComputedStamps,
    /// Missing values (how many).
    Missing,
    /// One value throughout (the value).
    Constant,
    /// One value for much longer than usual (duration of the longest, s).
    Stuck,
    /// Values that are held over several samples (share of repeats).
    Held,
    /// A signal in long steps, as a set-point (share of repeats).
    Stepwise,
    /// Samples that pile up at the smallest value (how many).
    SaturatedLow,
    /// Samples that pile up at the largest value (how many).
    SaturatedHigh,
    /// A coarse quantisation (step).
    Coarse,
    /// Nothing is shown around zero (its width).
    DeadBand,
    /// A counter or angle that wraps (how often).
    Wraps,
}

/// One thing worth telling; shown as its sentence.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// What kind.
    pub kind: FindingKind,
    /// How much it matters.
    pub severity: Severity,
    /// The number that [`FindingKind`] names.
    pub number: f64,
    /// Where: the first or the worst place, where there is one.
    pub at: Option<At>,
    sentence: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.sentence)
    }
}

/// A step is coarse when fewer than this many make up the range of the values.
const COARSE_STEPS: f64 = 256.0;

/// Collects findings.
struct Findings(Vec<Finding>);

impl Findings {
    fn add(&mut self, kind: FindingKind, severity: Severity, number: f64, at: Option<At>, sentence: String) {
        self.0.push(Finding { kind, severity, number, at, sentence });
    }

    /// Adds what was counted, if it was.
    fn tally(&mut self, kind: FindingKind, severity: Severity, tally: &Tally, sentence: String) {
        if tally.count > 0 {
            self.add(kind, severity, tally.count as f64, tally.first.first().copied(), sentence);
        }
    }
}

impl Quality {
    /// What is worth telling, the worst first; `unit` is the channel's, for the sentences.
    pub fn findings(&self, unit: &str) -> Vec<Finding> {
        let mut found = Findings(Vec::new());
        if self.timing.samples == 0 {
            found.add(FindingKind::Empty, Severity::Serious, 0.0, None, "no sample".to_owned());
            return found.0;
        }
        of_stamps(self, &mut found);
        of_values(self, unit, &mut found);
        of_shape(self, unit, &mut found);
        found.0.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
        found.0
    }
}

fn of_stamps(quality: &Quality, found: &mut Findings) {
    use FindingKind::{Bunched, ComputedStamps, Duplicates, Gaps, Jitter, JumpsAhead, JumpsBack, Late, OutOfOrder};
    let timing = &quality.timing;
    let (duration, jump) = (timing.duration_s(), number(timing.largest_jump_s.abs()));
    let ahead = &timing.jumps_ahead;
    let text = format!(
        "stamps jump ahead {}, by up to {jump} s, while the signal goes on: the clock was set",
        times(ahead.count)
    );
    found.tally(JumpsAhead, Severity::Serious, ahead, text);
    let back = &timing.jumps_back;
    let text = format!("stamps jump back {}, by up to {jump} s: the clock was set or wrapped", times(back.count));
    found.tally(JumpsBack, Severity::Serious, back, text);

    let late = &timing.late;
    let text = format!("samples wait {} and then come at once: use the stamps of their source", times(late.count));
    found.tally(Late, Severity::Warning, late, text);

    let gaps = &timing.gaps;
    let share = gaps.total_s / duration;
    if let Some(at) = gaps.longest_at {
        let severity = if share > 0.1 { Severity::Serious } else { Severity::Warning };
        let (many, longest) = (counted(gaps.tally.count, "gap"), number(gaps.longest_s));
        let text = format!("{many}, the longest {longest} s, {} of the time", percent(share));
        found.add(Gaps, severity, gaps.tally.count as f64, Some(at), text);
    }
    let late = &timing.out_of_order;
    found.tally(OutOfOrder, Severity::Warning, late, format!("{} out of order", counted(late.count, "sample")));
    let twice = &timing.duplicates;
    let text = format!("{} with the stamp of the one before", counted(twice.count, "sample"));
    found.tally(Duplicates, Severity::Warning, twice, text);

    let Some(period) = timing.period_s.filter(|_| timing.samples >= MIN_SAMPLES) else { return };
    if timing.bunched_share > BUNCHED_SHARE {
        let text =
            format!("samples arrive in bursts: {} of the periods are next to nothing", percent(timing.bunched_share));
        found.add(Bunched, Severity::Warning, timing.bunched_share, None, text);
    }
    if timing.jitter_99_s > LARGE_JITTER * period {
        let (off, usual) = (number(timing.jitter_99_s), number(period));
        let text = format!("uneven stamps: 1 % of the periods are off by more than {off} s from the usual {usual} s");
        found.add(Jitter, Severity::Warning, timing.jitter_99_s, None, text);
    }
    if timing.computed {
        let text =
            format!("stamps are even to the last digit ({} s): computed or rounded, not measured", number(period));
        found.add(ComputedStamps, Severity::Note, period, None, text);
    }
}

fn of_values(quality: &Quality, unit: &str, found: &mut Findings) {
    use FindingKind::{Constant, Held, Missing, SaturatedHigh, SaturatedLow, Stepwise, Stuck};
    let values = &quality.values;
    let samples = quality.timing.samples;
    let missing = &values.missing;
    let longest = values.longest_missing.map_or(0, |stretch| stretch.samples);
    let text = format!("{} missing, at most {longest} in a row", counted(missing.count, "value"));
    let severity = if missing.count == samples { Severity::Serious } else { Severity::Warning };
    found.tally(Missing, severity, missing, text);
    let (Some(low), Some(high)) = (values.low, values.high) else { return };
    if values.constant() {
        let text = format!("constant at {}{}", number(low.value), of_unit(unit));
        found.add(Constant, Severity::Warning, low.value, Some(low.longest.at), text);
        return;
    }
    let stepwise = values.held_share > STEPWISE_SHARE;
    if let Some((stretch, value)) = values.longest_stuck {
        // Zero is also what standing still looks like.
        let calm = value == 0.0 || stepwise;
        let severity = if calm { Severity::Note } else { Severity::Warning };
        let more = if values.stuck.count > 1 { format!(", {} in all", values.stuck.count) } else { String::new() };
        let (value, seconds) = (number(value), number(stretch.seconds));
        let text =
            format!("stays exactly at {value}{} for {seconds} s{more}: it stood still or was stuck", of_unit(unit));
        found.add(Stuck, severity, stretch.seconds, Some(stretch.at), text);
    }
    if samples >= MIN_SAMPLES && stepwise {
        let text = format!("changes in steps ({} repeat): a set-point or a slow source", percent(values.held_share));
        found.add(Stepwise, Severity::Note, values.held_share, None, text);
    } else if samples >= MIN_SAMPLES && values.held_share > HELD_SHARE {
        let text = format!(
            "{} of the samples repeat the one before: coarse or slower than its stamps",
            percent(values.held_share)
        );
        found.add(Held, Severity::Note, values.held_share, None, text);
    }
    let mut saturated = |kind, extreme: Extreme, side| {
        let share = percent(extreme.samples as f64 / samples as f64);
        let (severity, meaning) = match extreme.value {
            0.0 => (Severity::Note, "at rest, in a dead band or cut off"),
            _ if stepwise => (Severity::Note, "at its limit"),
            _ => (Severity::Warning, "clipped"),
        };
        let text = format!(
            "{share} of the samples are exactly at the {side}, {}{}: {meaning}",
            number(extreme.value),
            of_unit(unit)
        );
        found.add(kind, severity, extreme.samples as f64, Some(extreme.longest.at), text);
    };
    if low.saturated {
        saturated(SaturatedLow, low, "minimum");
    }
    if high.saturated {
        saturated(SaturatedHigh, high, "maximum");
    }
}

fn of_shape(quality: &Quality, unit: &str, found: &mut Findings) {
    use FindingKind::{Coarse, DeadBand, Wraps};
    let (Some(low), Some(high)) = (quality.values.low, quality.values.high) else { return };
    if let Some(wrap) = quality.wrap {
        let text = format!("wraps at {}, {}: unwrap it before use", number(wrap.modulus), times(wrap.count));
        found.add(Wraps, Severity::Note, wrap.count as f64, None, text);
    }
    let Some(grid) = quality.grid else { return };
    if grid.step * COARSE_STEPS > high.value - low.value {
        let text = format!("quantised in steps of {}{}", number(grid.step), of_unit(unit));
        found.add(Coarse, Severity::Note, grid.step, None, text);
    }
    if let Some(width) = grid.dead_band {
        let text = format!("reads 0 or at least {}{}: a dead band", number(width), of_unit(unit));
        found.add(DeadBand, Severity::Note, width, None, text);
    }
}
