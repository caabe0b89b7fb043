//! What a diagnosis says, message by message.

use serde_json::{Map, Value, json};
use verdict::{Compared, Diagnosis, Trace, Verdict};

use super::Message;
use super::names::{VERDICT, named, of_run, of_signal, of_state, with_side};
use super::schema::Schema;

/// The frame of positions.
pub(super) const FRAME: &str = "ground";

/// Levels of `foxglove.Log`.
const INFO: u32 = 2;
const WARNING: u32 = 3;

/// All messages, topic by topic.
pub(super) fn of(diagnosis: &Diagnosis) -> Vec<Message> {
    let mut out = sentences(diagnosis);
    for trace in &diagnosis.traces {
        for channel in &trace.channels {
            out.extend(compared(trace, channel));
        }
        out.extend(mismatch(trace));
        out.extend(path(trace));
        out.extend(states(diagnosis, trace));
    }
    out
}

/// A message with its time stamp; what is `None` in it is left out, which is a gap.
fn message(topic: String, schema: Schema, t: f64, content: impl IntoIterator<Item = (&'static str, Value)>) -> Message {
    let log_time_ns = (t.max(0.0) * 1e9).round() as u64;
    let (sec, nsec) = (log_time_ns / 1_000_000_000, log_time_ns % 1_000_000_000);
    let mut all = Map::new();
    all.insert("timestamp".to_owned(), json!({ "sec": sec, "nsec": nsec }));
    all.extend(content.into_iter().filter(|(_, value)| !value.is_null()).map(|(key, value)| (key.to_owned(), value)));
    Message { topic, schema, log_time_ns, content: Value::Object(all) }
}

/// A number that may be missing, in a series that may be empty.
fn at(series: &[Option<f64>], index: usize) -> Option<f64> {
    series.get(index).copied().flatten().filter(|x| x.is_finite())
}

fn compared<'a>(trace: &'a Trace, channel: &'a Compared) -> impl Iterator<Item = Message> + 'a {
    let topic = of_signal(trace, channel);
    trace.time.iter().enumerate().map(move |(i, &t)| {
        let recorded = at(&channel.recorded, i);
        let simulated = [&channel.nominal, &channel.retuned, &channel.corrected].map(|series| at(series, i));
        let residual = |simulated: Option<f64>| Some(recorded? - simulated?);
        let content = [
            ("recorded", recorded.into()),
            ("nominal", simulated[0].into()),
            ("retuned", simulated[1].into()),
            ("corrected", simulated[2].into()),
            ("residual_before", residual(simulated[0]).into()),
            ("residual_after", residual(simulated[2]).into()),
            ("usual", channel.usual.into()),
            ("unit", channel.unit.as_ref().into()),
        ];
        message(topic.clone(), Schema::Compared, t, content)
    })
}

fn mismatch(trace: &Trace) -> impl Iterator<Item = Message> + '_ {
    let topic = of_run(&trace.recording, "mismatch");
    trace.time.iter().enumerate().map(move |(i, &t)| {
        let content = [("before", at(&trace.before, i).into()), ("after", at(&trace.after, i).into())];
        message(topic.clone(), Schema::Mismatch, t, content)
    })
}

/// Positions one by one, and all of them at the start. The heading is not part of a trace: every pose looks along x.
fn path(trace: &Trace) -> Vec<Message> {
    let pose = |[x, y]: [f64; 2]| json!({ "position": { "x": x, "y": y, "z": 0.0 }, "orientation": { "x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0 } });
    let known = || trace.time.iter().zip(&trace.path).filter(|(_, p)| p.iter().all(|x| x.is_finite()));
    let frame = || ("frame_id", Value::from(FRAME));
    let topic = of_run(&trace.recording, "pose");
    let mut out: Vec<Message> =
        known().map(|(&t, &p)| message(topic.clone(), Schema::Pose, t, [frame(), ("pose", pose(p))])).collect();
    if !out.is_empty() {
        let poses: Vec<Value> = known().map(|(_, &p)| pose(p)).collect();
        let topic = of_run(&trace.recording, "path");
        out.push(message(topic, Schema::Path, 0.0, [frame(), ("poses", poses.into())]));
    }
    out
}

/// When each signal mismatches and when each named cause is present: a message at every change.
fn states(diagnosis: &Diagnosis, trace: &Trace) -> Vec<Message> {
    let end = trace.time.last().copied().unwrap_or(0.0);
    let run = trace.recording.as_str();
    let mut out = Vec::new();
    let mut tell = |what: &str, intervals: &[[f64; 2]], during: &str, otherwise: &str| {
        let state = |t: f64, state: &str| message(of_state(run, what), Schema::State, t, [("state", state.into())]);
        if intervals.iter().all(|[from, _]| *from > 0.0) {
            out.push(state(0.0, otherwise));
        }
        for &[from, until] in intervals {
            out.push(state(from, during));
            if until < end {
                out.push(state(until, otherwise));
            }
        }
    };
    for cause in named(diagnosis) {
        let throughout = [[0.0, end]];
        let intervals = match &cause.intervals {
            None => &throughout[..],
            Some(by_run) => by_run.get(run).map_or(&[][..], Vec::as_slice),
        };
        tell(&cause.effect, intervals, "present", "absent");
    }
    for channel in &trace.channels {
        let name = with_side(&channel.signal, channel.side.as_deref());
        let spans = diagnosis.located.spans.iter();
        let own = spans.filter(|s| s.recording == run && with_side(&s.signal, s.side.as_deref()) == name);
        let mut intervals: Vec<[f64; 2]> = own.map(|s| s.interval).collect();
        intervals.sort_by(|a, b| a[0].total_cmp(&b[0]));
        tell(&name, &intervals, "mismatch", "as simulated");
    }
    out
}

/// The verdict in sentences at the start, and what is located where it begins.
fn sentences(diagnosis: &Diagnosis) -> Vec<Message> {
    let log = |t: f64, level: u32, name: &str, text: String| {
        let content = [
            ("level", level.into()),
            ("message", text.into()),
            ("name", name.into()),
            ("file", "".into()),
            ("line", 0.into()),
        ];
        message(VERDICT.to_owned(), Schema::Log, t, content)
    };
    let level = if matches!(diagnosis.verdict, Verdict::Explained | Verdict::Unknown) { WARNING } else { INFO };
    let mut out: Vec<Message> = diagnosis.sentences.iter().map(|s| log(0.0, level, "verdict", s.clone())).collect();
    out.extend(diagnosis.limits.iter().map(|s| log(0.0, INFO, "limits", s.clone())));
    for span in &diagnosis.located.spans {
        let [from, until] = span.interval;
        let signal = with_side(&span.signal, span.side.as_deref());
        out.push(log(
            from,
            WARNING,
            &span.recording,
            format!("{signal} mismatches from {from:.1} s until {until:.1} s"),
        ));
    }
    out
}
