//! What is written reads back, and every path of the layout leads to a field that is there.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Cursor;

use serde_json::Value;
use verdict::{Cause, Compared, Correction, Diagnosis, EffectAt, Estimate, Span, Trace, Verdict};

use super::*;

/// A run of five windows with a gap and a brake that drags from the third on.
fn diagnosis() -> Diagnosis {
    let series = |offset: f64| (0..5).map(|i| (i != 1).then(|| f64::from(i) + offset)).collect::<Vec<_>>();
    let channel = |signal: &'static str, side: Option<&'static str>, unit: &'static str| Compared {
        signal: signal.into(),
        unit: unit.into(),
        side: side.map(Into::into),
        recorded: series(0.0),
        nominal: series(0.5),
        retuned: Vec::new(),
        corrected: series(0.125),
        usual: Some(0.1),
    };
    let trace = |recording: &str| Trace {
        recording: recording.to_owned(),
        time: (0..5).map(|i| 0.05 + 0.1 * f64::from(i)).collect(),
        channels: vec![channel("left wheel speed", None, "rad/s"), channel("torque", Some("right"), "N m")],
        path: (0..5).map(|i| [f64::from(i), -1.0]).collect(),
        before: vec![Some(2.0); 5],
        after: vec![Some(1.0); 5],
        ..Trace::default()
    };
    let brake = Cause {
        effect: "coulomb_side".to_owned(),
        name: "dragging brake: left".to_owned(),
        probability: 0.9,
        magnitude: Some(1.0),
        sigma: None,
        unit: "N m".into(),
        parameters: BTreeMap::from([("Tb".to_owned(), Estimate { value: 1.0, sigma: None, at_bound: false })]),
        side: Some("left".into()),
        place: None,
        intervals: Some(BTreeMap::from([("run 1".to_owned(), vec![[0.2, 0.4]])])),
    };
    let mut out = Diagnosis::withheld();
    out.verdict = Verdict::Explained;
    out.sentences = vec!["Missing: a brake.".to_owned()];
    out.ranked = vec![brake];
    let effect = EffectAt { effect: "coulomb_side".to_owned(), ..EffectAt::default() };
    out.correction = Correction { effects: vec![effect], ..Correction::default() };
    out.located.spans = vec![Span {
        recording: "run 1".to_owned(),
        signal: "left wheel speed".to_owned(),
        side: None,
        interval: [0.2, 0.5],
        onset: None,
        end: None,
        gain: 3.0,
    }];
    out.traces = vec![trace("run 1"), trace("run_2")];
    out
}

/// All messages by topic, with their log times.
fn read_back(bytes: &[u8]) -> BTreeMap<String, Vec<(i64, Value)>> {
    let mut out: BTreeMap<String, Vec<(i64, Value)>> = BTreeMap::new();
    let mut last = 0;
    let passed = recordings::messages("out.mcap", &mut Cursor::new(bytes), &mut |message| {
        assert!(message.log_time_ns >= last, "messages in the order of their times");
        last = message.log_time_ns;
        let value = serde_json::from_slice(message.bytes).expect("JSON");
        out.entry(message.topic.name.clone()).or_default().push((message.log_time_ns, value));
        Ok::<(), recordings::FileError>(())
    });
    assert!(passed.expect("a readable file").losses.is_empty());
    out
}

#[test]
fn what_is_written_reads_back() {
    let diagnosis = diagnosis();
    let bytes = bytes(&diagnosis).expect("written");
    assert_eq!(bytes, super::bytes(&diagnosis).expect("written"), "the same input gives the same bytes");
    let topics = read_back(&bytes);
    let speed = &topics["/run-u20-1/left_wheel_speed"];
    assert_eq!(speed.len(), 5);
    let (t, third) = &speed[2];
    assert_eq!((*t, &third["timestamp"]["nsec"]), (250_000_000, &Value::from(250_000_000)));
    assert_eq!(
        (&third["recorded"], &third["residual_before"], &third["residual_after"]),
        (&2.0.into(), &(-0.5).into(), &(-0.125).into())
    );
    assert_eq!((third.get("retuned"), &third["unit"]), (None, &"rad/s".into()));
    assert_eq!(speed[1].1.get("recorded"), None, "a gap is no number");
    assert!(topics.contains_key("/run_2/right_torque"), "{:?}", topics.keys());
    let states = |topic: &str| -> Vec<(i64, String)> {
        topics[topic].iter().map(|(t, m)| (t / 1_000_000, m["state"].as_str().expect("text").to_owned())).collect()
    };
    let expected = [(0, "absent"), (200, "present"), (400, "absent")].map(|(t, s)| (t, s.to_owned()));
    assert_eq!(states("/run-u20-1/state/coulomb_side"), expected);
    assert_eq!(states("/run_2/state/coulomb_side"), [(0, "absent".to_owned())]);
    assert_eq!(states("/run-u20-1/state/left_wheel_speed")[1], (200, "mismatch".to_owned()));
    assert_eq!(topics["/run-u20-1/path"][0].1["poses"].as_array().map(Vec::len), Some(5));
    assert_eq!(topics["/verdict"][0].1["message"], "Missing: a brake.");
    assert_eq!(topics["/verdict"][0].1["level"], 3);
    assert_eq!(topics["/verdict"][1].0, 200_000_000);
}

/// Every text below a key.
fn all_of<'v>(value: &'v Value, key: &str, out: &mut Vec<&'v str>) {
    match value {
        Value::Array(all) => all.iter().for_each(|v| all_of(v, key, out)),
        Value::Object(all) => {
            out.extend(all.get(key).and_then(Value::as_str));
            all.values().for_each(|v| all_of(v, key, out));
        }
        _ => {}
    }
}

/// The panels that a layout's tree names.
fn leaves<'v>(tree: &'v Value, out: &mut BTreeSet<&'v str>) {
    match tree {
        Value::String(id) => assert!(out.insert(id), "{id} stands twice"),
        Value::Object(_) => {
            for key in ["first", "second"] {
                leaves(&tree[key], out);
            }
        }
        other => panic!("no panel and no split: {other}"),
    }
}

#[test]
fn every_path_of_the_layout_leads_to_a_field_and_every_panel_is_shown() {
    let diagnosis = diagnosis();
    let topics = read_back(&bytes(&diagnosis).expect("written"));
    let layout = layout::layout(&diagnosis);
    let mut paths = Vec::new();
    all_of(&layout["configById"], "value", &mut paths);
    assert_eq!(paths.len(), 2 * (2 * 5 + 2 + 3), "{paths:?}");
    for path in paths {
        let (topic, field) = path.rsplit_once('.').expect("a field");
        let is_there = topics[topic].iter().any(|(_, message)| message.get(field).is_some());
        assert!(is_there, "{path}");
    }
    let mut shown = BTreeSet::new();
    leaves(&layout["layout"], &mut shown);
    for tab in layout["configById"]["Tab!recordings"]["tabs"].as_array().expect("tabs") {
        leaves(&tab["layout"], &mut shown);
    }
    let panels: BTreeSet<&str> = layout["configById"].as_object().expect("panels").keys().map(String::as_str).collect();
    assert_eq!(shown, panels);
}
