//! What was found, for programs.

use recordings::{Contents, HeaderStamps};
use serde_json::{Value, json};

use super::{Checked, Measured, Used, tables};
use crate::envelope::Program;

/// Version of this form.
const FORMAT: u32 = 1;

pub(super) fn render(c: &Checked) -> Value {
    json!({
        "format": FORMAT,
        "program": Program::default(),
        "bags": c.bags.iter().map(|(name, contents)| bag(name, contents)).collect::<Vec<_>>(),
        "tables": c.tables.iter().map(tables::as_json).collect::<Vec<_>>(),
        "mapping": mapping(&c.mapping),
        "recordings": c.recordings.iter().map(|r| json!({
            "name": r.name,
            "channels": r.channels.iter().map(channel).collect::<Vec<_>>(),
            "diagnoses": r.permits,
        })).collect::<Vec<_>>(),
        "robot": c.of_robot.as_ref().map(super::OfRobot::to_json),
        "same_content": c.same,
        "proposed_mapping": c.proposed.as_ref().map(|p| json!({
            "file": p.file, "inferred": p.inferred, "skeleton": p.is_skeleton,
        })),
        "lost": c.lost,
    })
}

fn mapping(used: &Used) -> Value {
    let (name, named, inferred) = match used {
        Used::Named(name) => (name.as_str(), true, None),
        Used::BuiltIn(name) => (name.as_str(), false, None),
        Used::Proposed { inferred, .. } => ("proposed", false, Some(inferred)),
        Used::RobotFile | Used::Nothing(_) => return Value::Null,
    };
    json!({ "name": name, "named_by_user": named, "inferred": inferred })
}

fn bag(name: &str, contents: &Contents) -> Value {
    let topics: Vec<Value> = contents
        .topics
        .iter()
        .map(|t| {
            let fields = t.fields.as_ref().map(|f| f.iter().map(|f| f.path.clone()).collect::<Vec<_>>());
            json!({
                "name": t.name, "type": t.message_type, "encoding": t.encoding, "messages": t.count,
                "undecodable": t.undecodable, "first_log_time_ns": t.log_time_ns.0, "last_log_time_ns": t.log_time_ns.1,
                "header_stamps": t.stamps.as_ref().map(stamps), "fields": fields.as_ref().ok(), "not_decoded": fields.as_ref().err(),
            })
        })
        .collect();
    json!({
        "file": name, "bytes": contents.bytes, "sha256": contents.sha256, "unchecked_messages": contents.unchecked,
        "topics": topics,
    })
}

fn stamps(s: &HeaderStamps) -> Value {
    let delay = s.delay.as_ref().map(|d| {
        json!({
            "median_ms": d.median_ms, "smallest_ms": d.smallest_ms, "largest_ms": d.largest_ms,
            "drift_ppm": d.drift.map(|drift| drift.ppm), "drift_between_ppm": d.drift.map(|drift| drift.between_ppm),
        })
    });
    json!({ "set": s.set, "zero": s.unset, "log_time_minus_stamp": delay })
}

fn channel(m: &Measured) -> Value {
    let (q, t) = (&m.quality, &m.quality.timing);
    let findings: Vec<Value> = q
        .findings(m.unit)
        .iter()
        .map(|f| {
            json!({
                "kind": format!("{:?}", f.kind), "severity": format!("{:?}", f.severity), "number": f.number,
                "sample": f.at.map(|at| at.sample), "t_ns": f.at.map(|at| at.t_ns), "text": f.to_string(),
            })
        })
        .collect();
    json!({
        "signal": m.name, "column": m.column, "unit": m.unit, "samples": t.samples, "rate_hz": t.rate_hz(),
        "jitter_s": t.jitter_mad_s, "gaps": t.gaps.tally.count, "longest_gap_s": t.gaps.longest_s,
        "duplicates": t.duplicates.count, "out_of_order": t.out_of_order.count, "missing": q.values.missing.count,
        "step": q.grid.map(|g| g.step), "noise": q.noise, "findings": findings,
    })
}
