//! What the best answer leaves: how much beyond noise, in which signal, on which side, when; and whether that is so much
//! that the cause is unknown.
//!
//! Wheels are judged at the commands, the body at the measured wheel speeds: neither inherits the other's errors. The
//! floor of a signal is what its noise leaves of a perfect forecast, or what the references' own fit leaves where there
//! are some. A mismatch is unknown when it stands above that floor, matters beside the motion, and most of it remains.

use inference::evidence::logistic;
use inference::robust::mean;
use verdict::{Remainder, Span};

use crate::compare::Simulated;
use crate::identified::Identified;
use crate::identify::Base;
use crate::run::{ResponseRun, STEP, WINDOW};
use crate::settings::{Remaining, SETTINGS};
use crate::squares::Squares;
use crate::windows::Windows;

const LEFT: Remaining = SETTINGS.left;

/// Signals, each with its unit; the first two are the sides.
pub(crate) const SIGNALS: [(&str, &str); 4] =
    [("left wheel speed", "rad/s"), ("right wheel speed", "rad/s"), ("heading", "rad"), ("position", "m")];
pub(crate) const HEADING: usize = 2;
pub(crate) const POSITION: usize = 3;

/// One number for each signal.
pub(crate) type BySignal = [f64; SIGNALS.len()];

/// What references leave when they are fitted, mean squares.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Floor {
    /// In the mean.
    mean: BySignal,
    /// The most that lasts.
    lasting: BySignal,
    /// Their motion.
    motion: BySignal,
}

impl Floor {
    /// The same of recordings that move otherwise: errors grow with the motion, and do not fall with it, for a drive may be slow in
    /// the mean and fast where it errs.
    fn at(&self, motion: BySignal) -> Self {
        let by = |s: usize| if self.motion[s] > 0.0 { (motion[s] / self.motion[s]).max(1.0) } else { 1.0 };
        let scaled = |of: BySignal| std::array::from_fn(|s| by(s) * of[s]);
        Self { mean: scaled(self.mean), lasting: scaled(self.lasting), motion }
    }
}

/// What is left of a mismatch.
#[derive(Debug, Clone)]
pub(crate) struct Remains {
    /// Share of the whole mismatch that the best answer leaves.
    pub(crate) share: f64,
    /// Probability that something of which no cause is known shows in each signal.
    pub(crate) unknown: BySignal,
    /// Probability that most of the mismatch has no known cause.
    pub(crate) mostly: f64,
    /// Root mean square of what is left in each signal, and of its floor.
    pub(crate) error: BySignal,
    pub(crate) floor: BySignal,
    /// Stretches that stand out, the clearest first; only of signals with an unknown cause.
    pub(crate) spans: Vec<Span>,
    by_signal: Vec<(String, f64)>,
}

impl Remains {
    /// The signal with the most that is not known.
    pub(crate) fn worst(&self) -> usize {
        let relative = |s: usize| self.unknown[s] * self.error[s] / self.floor[s].max(f64::MIN_POSITIVE);
        (0..SIGNALS.len()).max_by(|a, b| relative(*a).total_cmp(&relative(*b))).unwrap_or(0)
    }

    /// Holds an unknown cause of the wheel speeds for this likely, at least.
    pub(crate) fn doubt_wheels(&mut self, probability: f64) {
        self.mostly = self.mostly.max(probability);
        self.unknown[..HEADING].iter_mut().for_each(|unknown| *unknown = unknown.max(probability));
    }

    /// Probability that something has no known cause.
    pub(crate) fn something(&self) -> f64 {
        self.unknown.into_iter().fold(0.0, f64::max)
    }

    /// Where it is, in words; both sides are one place when one leaves half as much as the other.
    pub(crate) fn place(&self) -> &'static str {
        let [l, r] = [self.error[0], self.error[1]];
        match self.worst() {
            HEADING => "in the heading",
            POSITION => "in the position",
            _ if l.min(r) > LEFT.alike * l.max(r) => "in the wheel speeds of both sides",
            0 => "on the left side",
            _ => "on the right side",
        }
    }

    /// For the verdict.
    pub(crate) fn remainder(&self) -> Remainder {
        let stands = self.something() > LEFT.likely;
        Remainder {
            share: self.share,
            by_signal: self.by_signal.clone(),
            place: stands.then(|| self.place().to_owned()),
            regime: None,
        }
    }
}

/// What was fitted, and what each fit that left windows out says about them.
pub(crate) struct Fitted<'a> {
    pub(crate) windows: &'a Windows,
    pub(crate) folds: &'a [Simulated],
    pub(crate) base: &'a Base,
    pub(crate) found: &'a Identified,
    /// Nominal wheel radius and track, m.
    pub(crate) nominal: [f64; 2],
}

/// What a fit leaves of its own windows: the floor for others of the same robot.
pub(crate) fn floor(fitted: &Fitted<'_>) -> Floor {
    let windows = fitted.windows;
    let squares = Squares::new(fitted);
    let of = |s: usize| mean(windows.by_block(|w| squares.corrected[w][s])).unwrap_or(0.0);
    let lasting = |s: usize| lasting(windows, |w| squares.corrected[w][s]).unwrap_or(0.0);
    Floor { mean: std::array::from_fn(of), lasting: std::array::from_fn(lasting), motion: squares.motion }
}

/// What is left of the recordings.
///
/// `objected`: a wrong cause, or re-tuned constants, forecast left-out windows as well; less that is left is then enough.
pub(crate) fn remains(runs: &[ResponseRun], fitted: &Fitted<'_>, references: Option<Floor>, objected: bool) -> Remains {
    let windows = fitted.windows;
    let squares = Squares::new(fitted);
    let motion = squares.motion;
    let known = |s: usize| motion[s] > 0.0;
    let references = references.map(|floor| floor.at(motion));
    let floor: BySignal = std::array::from_fn(|s| squares.noise[s].max(references.map_or(0.0, |f| f.mean[s])));
    // What lasts is no jump, though it may last for one command only: a wheel that is held, a body that stands.
    let lasts: [bool; SIGNALS.len()] = std::array::from_fn(|s| {
        let usual = references.map_or(LEFT.large.powi(2) * motion[s], |f| {
            (LEFT.stands_out * f.lasting[s]).max(LEFT.interest.powi(2) * motion[s])
        });
        let least = usual.max(LEFT.stands_out * floor[s]);
        known(s) && lasting(windows, |w| squares.corrected[w][s]).is_some_and(|most| most > least)
    });
    let level = |of: &[BySignal], s: usize| {
        let blocks = windows.by_block(|w| of[w][s]);
        if lasts[s] { mean(blocks).unwrap_or(0.0) } else { without_the_worst(&blocks) }
    };
    let corrected: BySignal = std::array::from_fn(|s| level(&squares.corrected, s));
    let beyond = |square: f64, s: usize| if known(s) { (square - floor[s]).max(0.0) / motion[s] } else { 0.0 };
    let left: BySignal = std::array::from_fn(|s| beyond(corrected[s], s));
    let gap: BySignal = std::array::from_fn(|s| beyond(level(&squares.nominal, s), s).max(left[s]));

    let centre = if objected { LEFT.objected_centre } else { LEFT.left_centre };
    let most = |share: f64| logistic(LEFT.left_slope * (share - centre));
    let share_of = |left: f64, gap: f64| if gap > 0.0 { left / gap } else { 0.0 };
    let unknown = std::array::from_fn(|s| {
        if left[s] <= 0.0 {
            return 0.0;
        }
        // Where it lasts it is as large as it must be to stand out and to matter.
        if lasts[s] {
            return most(share_of(left[s], gap[s]));
        }
        let stands = logistic(LEFT.slope * ((corrected[s] / floor[s].max(f64::MIN_POSITIVE)).ln() - LEFT.centre));
        let matters = logistic(LEFT.slope * (left[s].sqrt() / LEFT.interest).ln());
        stands * matters * most(share_of(left[s], gap[s]))
    });
    let share = share_of(left.iter().sum(), gap.iter().sum());
    let total: f64 = left.iter().sum();
    let mut order: Vec<usize> = (0..SIGNALS.len()).filter(|s| left[*s] > 0.0).collect();
    order.sort_by(|a, b| left[*b].total_cmp(&left[*a]));
    let mut out = Remains {
        share,
        unknown,
        mostly: 0.0,
        error: corrected.map(f64::sqrt),
        floor: floor.map(f64::sqrt),
        spans: Vec::new(),
        by_signal: order.into_iter().map(|s| (SIGNALS[s].0.to_owned(), left[s] / total)).collect(),
    };
    out.mostly = out.something() * most(share);
    for s in (0..SIGNALS.len()).filter(|s| unknown[*s] > LEFT.likely) {
        let least = (LEFT.stands_out * floor[s]).max(LEFT.interest.powi(2) * motion[s]);
        let high: Vec<f64> = squares.corrected.iter().map(|w| w[s] / least).collect();
        out.spans.extend(spans(runs, windows, s, &high));
    }
    out.spans.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    out.spans.truncate(LEFT.spans);
    out
}

/// The largest value that windows which follow each other keep for long.
fn lasting(windows: &Windows, value: impl Fn(usize) -> f64) -> Option<f64> {
    let length = (LEFT.lasting / (WINDOW as f64 * STEP)).ceil() as usize;
    let last = windows.list.len().checked_sub(length)?;
    let is_whole = |first: &usize| windows.list[*first].piece == windows.list[first + length - 1].piece;
    let kept = |first: usize| (first..first + length).map(&value).fold(f64::INFINITY, f64::min);
    (0..=last).filter(is_whole).map(kept).max_by(f64::total_cmp)
}

/// Mean without the largest value: one jump of a sensor, or one command step, decides nothing.
fn without_the_worst(blocks: &[f64]) -> f64 {
    let largest = blocks.iter().copied().fold(0.0, f64::max);
    (blocks.iter().sum::<f64>() - largest).max(0.0) / (blocks.len() as f64 - 1.0).max(1.0)
}

/// Windows that follow each other with a mean square above 1, as stretches of their recordings.
fn spans(runs: &[ResponseRun], windows: &Windows, signal: usize, high: &[f64]) -> Vec<Span> {
    let length = WINDOW as f64 * STEP;
    let mut out: Vec<Span> = Vec::new();
    let mut last = None;
    for (w, window) in windows.list.iter().enumerate().filter(|(w, _)| high[*w] > 1.0) {
        let (run, first, end) = (&runs[window.run], windows.time(w), windows.end(w));
        let gain = 0.5 * (high[w] - high[w].ln());
        match out.last_mut().filter(|_| last == Some(w.wrapping_sub(1)) && windows.list[w - 1].piece == window.piece) {
            Some(span) => {
                span.interval[1] = first + length;
                span.gain += gain;
            }
            None => out.push(Span {
                recording: run.name.clone(),
                signal: SIGNALS[signal].0.to_owned(),
                side: (signal < HEADING).then(|| inference::words::side(signal).into()),
                interval: [first, first + length],
                onset: (first > 0.0).then_some([first - length, first + length]),
                end: None,
                gain,
            }),
        }
        if let Some(span) = out.last_mut() {
            let until = span.interval[1];
            span.end = (until + length < end).then_some([until - length, until + length]);
        }
        last = Some(w);
    }
    out
}

#[cfg(test)]
mod tests {
    use verdict::{Diagnosis, Verdict};

    use super::*;
    use crate::controller::{DEAD_TIME, GAIN};
    use crate::diagnose_response;
    use crate::testing::{Truth, alone, diagnosed};
    use catalogue::answer::UNKNOWN;
    use inference::Options;

    fn probability(d: &Diagnosis, id: &str) -> f64 {
        d.ranked.iter().find(|c| c.effect == id).map_or(0.0, |c| c.probability)
    }

    fn remainder(d: &Diagnosis) -> &Remainder {
        d.located.remainder.as_ref().expect("what is left")
    }

    #[test]
    fn a_side_that_is_pulled_for_no_known_cause_is_unknown_with_side_and_time() {
        let pulled = |t: f64, side: usize| if side == 0 && t > 40.0 { 2.5 * (2.5 * t).sin() } else { 0.0 };
        let d = diagnosed(&Truth { wheel_push: pulled, ..Truth::perfect() }, None);
        assert_eq!((d.verdict, &*d.ranked[0].effect), (Verdict::Unknown, "unknown"), "{:?}", d.ranked);
        assert_eq!(remainder(&d).place.as_deref(), Some("on the left side"));
        assert!(remainder(&d).share > 0.8 && remainder(&d).by_signal[0].0 == "left wheel speed", "{:?}", remainder(&d));
        assert!(d.located.spans.iter().all(|s| s.side.as_deref() == Some("left") && s.interval[0] > 37.0));
        assert!(d.sentences[0].starts_with("Unknown: no cause"), "{:?}", d.sentences);
    }

    #[test]
    fn a_wheel_that_is_held_during_one_command_is_unknown_with_side_and_time() {
        // Pushes back what a command asks, for eight of its ten seconds: one block of windows shows it, and no other.
        let held = |t: f64, side: usize| if side == 1 && (41.0..49.0).contains(&t) { -3.0 } else { 0.0 };
        let truth = Truth { wheel_push: held, ..Truth::perfect() };
        let commands =
            [[3.0, 5.0], [-4.0, -1.0], [6.0, 2.0], [1.0, -3.0], [5.0, 5.0], [-2.0, 4.0], [2.0, 1.0], [-6.0, -5.0]];
        let each = (10.0 / STEP).round() as usize;
        let commands: Vec<[f64; 2]> = commands.into_iter().flat_map(|c| std::iter::repeat_n(c, each)).collect();
        let run = |truth: &Truth, name: &str, seed: u64| {
            ResponseRun::new(&truth.driven(name, &commands, seed, 0.1)).expect("a run")
        };
        let recordings = vec![run(&truth, "a", 1), run(&Truth::perfect(), "b", 2)];
        let case = alone(recordings);
        let d = diagnose_response(&case, &Options::default(), &|_| {}).expect("a diagnosis");
        assert_eq!(d.verdict, Verdict::Unknown, "{:?} {:?}", d.ranked, remainder(&d));
        assert_eq!(remainder(&d).place.as_deref(), Some("on the right side"));
        let [from, until] = d.located.spans[0].interval;
        assert!((38.0..43.0).contains(&from) && (46.0..52.0).contains(&until), "{from} {until}");
    }

    #[test]
    fn a_body_that_is_turned_by_something_else_is_unknown_in_its_heading() {
        let d = diagnosed(&Truth { body_push: |_, heading| 0.6 * heading.sin(), ..Truth::perfect() }, None);
        assert_eq!(d.verdict, Verdict::Unknown, "{:?}", d.ranked);
        assert_eq!(remainder(&d).place.as_deref(), Some("in the heading"), "{:?}", remainder(&d));
    }

    #[test]
    fn what_a_named_cause_leaves_is_told_beside_it() {
        let mut truth = Truth { body_push: |_, heading| 0.6 * heading.sin(), ..Truth::perfect() };
        (truth.drive[GAIN[0]], truth.drive[DEAD_TIME]) = (0.5, 0.5);
        let d = diagnosed(&truth, None);
        assert_eq!(d.verdict, Verdict::Explained, "{:?} {:?}", d.ranked, remainder(&d));
        assert!(probability(&d, "transport_delay") > 0.9 && probability(&d, UNKNOWN.id) > 0.5, "{:?}", d.ranked);
        assert!(d.sentences.iter().any(|s| s.contains("Something else") && s.contains("heading")), "{:?}", d.sentences);
    }

    #[test]
    fn what_is_right_and_what_is_named_is_not_unknown() {
        for (truth, verdict) in [(Truth::perfect(), Verdict::NoMismatch), (Truth::stock(), Verdict::Explained)] {
            for recordings in [[11, 12], [21, 22]] {
                let recordings = recordings.map(|seed| truth.run("r", 25, seed)).to_vec();
                let case = alone(recordings);
                let d = diagnose_response(&case, &Options::default(), &|_| {}).expect("a diagnosis");
                assert_eq!(d.verdict, verdict, "{:?}", d.ranked);
                assert!(probability(&d, UNKNOWN.id) < 0.01, "{:?}", d.ranked);
            }
        }
    }

    #[test]
    fn what_the_references_leave_as_well_is_usual() {
        let rough = |t: f64, _: usize| 0.8 * (3.0 * t).sin();
        let truth = || Truth { wheel_push: rough, ..Truth::perfect() };
        let (alone, beside) = (diagnosed(&truth(), None), diagnosed(&truth(), Some(&truth())));
        assert_eq!((alone.verdict, beside.verdict), (Verdict::Unknown, Verdict::NoMismatch), "{:?}", beside.ranked);
    }

    #[test]
    fn what_lasts_for_seconds_is_unknown_beside_references_that_leave_little() {
        let held = |t: f64, side: usize| if side == 0 && (40.0..47.0).contains(&t) { -1.5 } else { 0.0 };
        let d = diagnosed(&Truth { wheel_push: held, ..Truth::perfect() }, Some(&Truth::perfect()));
        assert_eq!(d.verdict, Verdict::Unknown, "{:?}", d.ranked);
        assert_eq!(remainder(&d).place.as_deref(), Some("on the left side"));
    }

    #[test]
    fn one_command_step_decides_nothing() {
        assert_eq!(without_the_worst(&[1.0, 100.0, 3.0]), 2.0);
        assert_eq!(without_the_worst(&[5.0]), 0.0);
    }
}
