//! A layout for Foxglove: one tab for each recording, one row for each signal.
//!
//! The form is that of a layout which Foxglove exports: `configById` holds panels by `Type!id`, `layout` is a tree of
//! rows and columns with panels as leaves. Paths are message paths: `/topic.field`.

use serde_json::{Map, Value, json};
use verdict::{Compared, Diagnosis, Trace};

use super::messages::FRAME;
use super::names::{VERDICT, named, of_recording, of_run, of_signal, of_state, plain, with_side};

/// Colours that the colour-blind tell apart (Okabe and Ito): recorded, as it is, re-tuned, corrected.
const COLOURS: [&str; 4] = ["#000000", "#d55e00", "#cc79a7", "#0072b2"];

/// The layout that shows what [`super::bytes`] holds.
pub(super) fn layout(diagnosis: &Diagnosis) -> Value {
    let mut panels = Map::new();
    let tabs: Vec<Value> = diagnosis
        .traces
        .iter()
        .map(|trace| json!({ "title": trace.recording, "layout": tab(diagnosis, trace, &mut panels) }))
        .collect();
    panels.insert("Tab!recordings".to_owned(), json!({ "activeTabIdx": 0, "tabs": tabs }));
    panels.insert(
        "RosOut!verdict".to_owned(),
        json!({ "searchTerms": [], "minLogLevel": 1, "topicToRender": VERDICT, "foxglovePanelTitle": "Verdict" }),
    );
    json!({
        "configById": panels,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": { "speed": 1 },
        "layout": {
            "direction": "column", "first": "Tab!recordings", "second": "RosOut!verdict", "splitPercentage": 82,
        },
    })
}

/// What is shown of one recording.
fn tab(diagnosis: &Diagnosis, trace: &Trace, panels: &mut Map<String, Value>) -> Value {
    let run = of_recording(&trace.recording);
    let mut add = |kind: &str, name: &str, config: Value| {
        let id = format!("{kind}!{run}-{name}");
        panels.insert(id.clone(), config);
        Value::from(id)
    };
    let mut rows = Vec::new();
    for channel in &trace.channels {
        let name = with_side(&channel.signal, channel.side.as_deref());
        let signals = add("Plot", &plain(&name), signals(trace, channel, &name));
        let residuals = add("Plot", &format!("{}-residual", plain(&name)), residuals(trace, channel, &name));
        rows.push(json!({ "direction": "row", "first": signals, "second": residuals, "splitPercentage": 60 }));
    }
    let topic = of_run(&trace.recording, "mismatch");
    let lines =
        [(format!("{topic}.before"), "as it is", COLOURS[1]), (format!("{topic}.after"), "corrected", COLOURS[3])];
    rows.push(add("Plot", "mismatch", plot("Mismatch relative to fault-free drives", &lines)));
    rows.push(add("StateTransitions", "states", transitions(diagnosis, trace)));
    let stacked = stack(rows, "column");
    if trace.path.is_empty() {
        return stacked;
    }
    let ground = add("3D", "ground", ground(trace));
    json!({ "direction": "row", "first": stacked, "second": ground, "splitPercentage": 68 })
}

/// Panels below or beside each other, each with the same share.
fn stack(mut panels: Vec<Value>, direction: &str) -> Value {
    let Some(mut below) = panels.pop() else { return Value::Null };
    for (count, panel) in panels.into_iter().rev().enumerate() {
        let share = 100.0 / (count as f64 + 2.0);
        below = json!({ "direction": direction, "first": panel, "second": below, "splitPercentage": share });
    }
    below
}

fn signals(trace: &Trace, channel: &Compared, name: &str) -> Value {
    let topic = of_signal(trace, channel);
    let all = [
        ("recorded", "recorded", &channel.recorded),
        ("nominal", "as it is", &channel.nominal),
        ("retuned", "re-tuned", &channel.retuned),
        ("corrected", "corrected", &channel.corrected),
    ];
    let there = all.iter().zip(COLOURS).filter(|((_, _, series), _)| !series.is_empty());
    let lines: Vec<_> = there.map(|((field, label, _), colour)| (format!("{topic}.{field}"), *label, colour)).collect();
    plot(&format!("{name}, {}", channel.unit), &lines)
}

fn residuals(trace: &Trace, channel: &Compared, name: &str) -> Value {
    let topic = of_signal(trace, channel);
    let mut lines = vec![(format!("{topic}.residual_before"), "as it is", COLOURS[1])];
    if !channel.corrected.is_empty() {
        lines.push((format!("{topic}.residual_after"), "corrected", COLOURS[3]));
    }
    plot(&format!("{name}: recorded less simulated, {}", channel.unit), &lines)
}

/// A plot over the log time.
fn plot(title: &str, lines: &[(String, &str, &str)]) -> Value {
    let paths: Vec<Value> = lines
        .iter()
        .map(|(path, label, colour)| {
            json!({
                "value": path, "label": label, "color": colour, "enabled": true, "timestampMethod": "receiveTime",
                "showLine": true, "lineSize": 1,
            })
        })
        .collect();
    json!({
        "paths": paths, "foxglovePanelTitle": title, "isSynced": true, "xAxisVal": "timestamp", "showLegend": true,
        "legendDisplay": "floating", "showPlotValuesInLegend": false, "showXAxisLabels": true, "showYAxisLabels": true,
        "sidebarDimension": 240,
    })
}

fn transitions(diagnosis: &Diagnosis, trace: &Trace) -> Value {
    let run = &trace.recording;
    let causes = named(diagnosis).map(|cause| (cause.name.clone(), of_state(run, &cause.effect)));
    let signals = trace.channels.iter().map(|channel| {
        let name = with_side(&channel.signal, channel.side.as_deref());
        let topic = of_state(run, &name);
        (name, topic)
    });
    let paths: Vec<Value> = causes
        .chain(signals)
        .map(|(label, topic)| {
            json!({ "value": format!("{topic}.state"), "label": label, "timestampMethod": "receiveTime" })
        })
        .collect();
    json!({ "paths": paths, "isSynced": true, "foxglovePanelTitle": "Causes, and when signals mismatch" })
}

/// The path from above: a line, and the pose at the cursor.
fn ground(trace: &Trace) -> Value {
    let [path, pose] = ["path", "pose"].map(|what| of_run(&trace.recording, what));
    let middle = |axis: usize| {
        let all = trace.path.iter().map(|p| p[axis]);
        let (low, high) = all.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
        (0.5 * (low + high), high - low)
    };
    let ((x, width), (y, height)) = (middle(0), middle(1));
    json!({
        "cameraState": {
            "perspective": false, "distance": 1.5 * width.max(height).max(1.0), "phi": 0, "thetaOffset": 0,
            "target": [x, y, 0], "targetOffset": [0, 0, 0], "targetOrientation": [0, 0, 0, 1], "fovy": 45,
            "near": 0.5, "far": 5000,
        },
        "followTf": FRAME, "followMode": "follow-none",
        "layers": { "grid": {
            "layerId": "foxglove.Grid", "instanceId": "grid", "visible": true, "frameLocked": true, "size": 100,
            "divisions": 100, "lineWidth": 1, "color": "#8888884d", "position": [0, 0, 0], "rotation": [0, 0, 0],
        } },
        "topics": {
            path: { "visible": true, "type": "line", "lineWidth": 0.05 },
            pose: { "visible": true, "type": "axis", "axisScale": 0.5 },
        },
        "foxglovePanelTitle": "Ground",
    })
}
