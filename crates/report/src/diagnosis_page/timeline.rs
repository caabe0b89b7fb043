//! When the mismatch shows, signal by signal.

use verdict::Diagnosis;
use verdict::Loads;

use crate::figure::{Drawing, Figure, Lane, Marked, Role, Timeline};
use crate::page::Cell;
use crate::words::borders;

/// Recordings that are shown.
const RECORDINGS: usize = 12;

/// The length of a recording, s.
fn length(d: &Diagnosis, recording: &str) -> f64 {
    let traced = d.traces.iter().find(|t| t.recording == recording).and_then(|t| t.time.last().copied());
    let spans = d.located.spans.iter().filter(|s| s.recording == recording).map(|s| s.interval[1]);
    spans.chain(traced).fold(0.0, f64::max)
}

/// Recording, signal, and a stretch of it.
type Stretch<'a> = (&'a str, &'a str, Marked);

fn marked([from, until]: [f64; 2], role: Role, text: String) -> Marked {
    Marked { from, until, role, text }
}

/// When signals mismatch the calibrated simulation.
fn mismatches(d: &Diagnosis) -> impl Iterator<Item = Stretch<'_>> {
    d.located.spans.iter().map(|s| {
        let [from, until] = borders(s);
        let text = format!("{}, {}: {from} to {until}", s.recording, s.signal);
        (s.recording.as_str(), s.signal.as_str(), marked(s.interval, Role::Before, text))
    })
}

/// When the loads of steady driving change, and when that could not have been seen.
fn load_changes<'a>(d: &'a Diagnosis, loads: &'a Loads) -> Vec<Stretch<'a>> {
    let text = |recording: &str, [a, b]: [f64; 2], what: &str| format!("{recording}: {a:.1} to {b:.1} s, {what}");
    let straight = loads.changes.found.iter().map(|c| {
        let angle =
            if c.relative { "tilt".to_owned() } else { format!("slope {:.1} ± {:.1}°", c.slope, c.slope_half) };
        let what = format!("{angle}. {}", c.reason);
        (c.recording.as_str(), "straight load", c.interval, Role::Before, what)
    });
    let turning = loads.turning_changes.iter().map(|c| {
        let what = format!("{:.2} ± {:.2} times that of the rest", c.ratio, c.half);
        (c.recording.as_str(), "turning load", c.interval, Role::Before, what)
    });
    let sides = loads.side_changes.iter().map(|c| {
        let [before, after] = c.torque;
        let what = format!("the {} side takes {after:.1} N m after {before:.1} N m, ± {:.1}", c.side, c.half);
        (c.recording.as_str(), "load of one side", [c.onset[0], c.until], Role::Before, what)
    });
    let standing = loads.standstills.iter().map(|c| {
        let (signal, what) = match &c.side {
            Some(side) => ("wheels stand", format!("the wheels of the {side} side do not turn as commanded")),
            None if c.is_off => ("body stands", "the motors give no torque".to_owned()),
            None => ("body stands", "the wheels turn and the body does not".to_owned()),
        };
        (c.recording.as_str(), signal, c.interval, Role::Before, what)
    });
    let hidden = loads.changes.hidden.iter().map(|c| {
        let what = "turns or stops, in which no change could have been seen".to_owned();
        (c.recording.as_str(), "straight load", c.interval, Role::Placebo, what)
    });
    let grounds = loads.grounds.iter().map(|g| {
        let name = |id: &'a String| d.ranked.iter().find(|c| c.effect == *id).map_or(id.as_str(), |c| c.name.as_str());
        let names: Vec<&str> = g.causes.iter().map(name).collect();
        let what = if names.is_empty() { "no effect of the catalogue fits".to_owned() } else { names.join(" or ") };
        (g.recording.as_str(), "other ground", g.interval, Role::Before, what)
    });
    let unfollowed = loads.unfollowed.iter().flat_map(|u| {
        let stretches = u.intervals.iter().flat_map(|(name, all)| all.iter().map(move |interval| (name, *interval)));
        stretches.map(move |(name, interval)| {
            let what = format!("the {} side does not turn as commanded, at {:.2} N m", u.side, u.torque);
            (name.as_str(), "commands not followed", interval, Role::Before, what)
        })
    });
    let pulsing = loads.pulsing.iter().map(|p| {
        let what = format!("rises and falls {:.2} times a second by {:.2} N m (rms)", p.frequency, p.swing[0]);
        (p.recording.as_str(), "pulsing load", p.interval, Role::Before, what)
    });
    let tipped = loads.tipped.iter().map(|t| {
        let what = format!("the unit has tipped by {:.1}°", t.tilt.to_degrees());
        (t.recording.as_str(), "inertial unit", t.interval, Role::Before, what)
    });
    let drives = unfollowed.chain(pulsing).chain(tipped);
    let all = grounds.chain(straight).chain(turning).chain(sides).chain(standing).chain(drives).chain(hidden);
    all.map(|(recording, signal, interval, role, what)| {
        (recording, signal, marked(interval, role, text(recording, interval, &what)))
    })
    .collect()
}

/// Lanes of the first recordings, and how many recordings there are.
fn lanes(d: &Diagnosis) -> (Vec<Lane>, usize) {
    let mut out: Vec<Lane> = Vec::new();
    for (recording, signal, marked) in mismatches(d).chain(d.steady.iter().flat_map(|loads| load_changes(d, loads))) {
        let length = length(d, recording).max(marked.until);
        if let Some(lane) = out.iter_mut().find(|l| l.recording == recording && l.signal == signal) {
            lane.length = lane.length.max(length);
            lane.spans.push(marked);
        } else {
            out.push(Lane { recording: recording.to_owned(), signal: signal.to_owned(), length, spans: vec![marked] });
        }
    }
    out.sort_by(|a, b| a.recording.cmp(&b.recording));
    let mut recordings: Vec<String> = out.iter().map(|l| l.recording.clone()).collect();
    recordings.dedup();
    let all = recordings.len();
    recordings.truncate(RECORDINGS);
    out.retain(|l| recordings.contains(&l.recording));
    (out, all)
}

/// The timeline; nothing where nothing stands out.
pub(super) fn timeline(d: &Diagnosis) -> Option<Figure> {
    let (lanes, recordings) = lanes(d);
    if lanes.is_empty() {
        return None;
    }
    let rows = lanes.iter().flat_map(|l| &l.spans).map(|s| vec![Cell::from(s.text.as_str())]).collect();
    let caption = if d.steady.is_some() {
        "Stretches in which the load of a recording changes, or a drive or the inertial unit does. Grey: turns or stops, in which no change could have been seen."
    } else {
        "Stretches in which a signal differs from the calibrated simulation by more than in \
         fault-free drives; of twenty fault-free cases at most one shows any."
    };
    Some(Figure {
        title: "When it shows".to_owned(),
        caption: if recordings > RECORDINGS {
            format!("{caption} The first {RECORDINGS} of {recordings} recordings.")
        } else {
            caption.to_owned()
        },
        table: (vec!["stretch, with 90 % intervals of its ends"], rows),
        drawing: Drawing::Timeline(Timeline { lanes }),
    })
}
