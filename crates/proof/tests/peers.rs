//! The script of `cargo xtask law --peers` on a series whose law is known; ignored where there is no Python that has the peers.

use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};
use skipping::{Outcome, Skipped};

/// Symbols of the variables, as the command hands them.
const VARIABLES: [&str; 12] = ["x", "y", "omega", "T", "P", "slip", "v", "v_lat", "yaw_rate", "phi", "heading", "t"];

/// A drag of 2 N s/m times the velocity, known to 0.01 N, in windows of a drive that begins at this phase.
fn windows(recording: &str, phase: f64) -> Vec<Value> {
    let window = |k: u32| {
        let t = 0.1 * f64::from(k);
        let v = (0.7 * t + phase).sin() + 0.5 * (1.9 * t).cos();
        let turn = (1.3 * t - phase).cos();
        let torque = (2.3 * t + 2.0 * phase).sin();
        let omega = 10.0 * (v + 0.3 * turn);
        let values =
            [t.sin(), t.cos(), omega, torque, torque * omega, 0.1 * turn, v, 0.02 * turn, turn, 3.0 * t, 0.4 * t, t];
        json!({ "recording": recording, "values": values, "size": -2.0 * v, "sigma": 0.01 })
    };
    (0..60).map(window).collect()
}

/// The nodes of a formula; none where it is no formula that the command reads.
fn nodes(tree: &Value) -> Option<usize> {
    match tree {
        Value::Number(_) => Some(1),
        Value::String(name) => {
            let index: usize = name.strip_prefix('x')?.parse().ok()?;
            (index < VARIABLES.len()).then_some(1)
        }
        Value::Array(parts) => {
            let (function, arguments) = parts.split_first()?;
            let arity = match function.as_str()? {
                "add" | "sub" | "mul" | "div" => 2,
                "abs" | "sqrt" | "log" | "sin" | "cos" | "tanh" => 1,
                _ => return None,
            };
            let below = arguments.iter().map(nodes).sum::<Option<usize>>()?;
            (arguments.len() == arity).then_some(1 + below)
        }
        _ => None,
    }
}

fn peers_find_a_linear_drag_and_write_formulas_that_are_read() -> Outcome {
    let named = std::env::var_os("LACUNA_PEERS_PYTHON");
    let python =
        named.ok_or_else(|| Skipped::because("no Python with the peers; name one with LACUNA_PEERS_PYTHON"))?;
    let folder = tempfile::tempdir().expect("a folder");
    let [input, output] = ["job.json", "result.json"].map(|name| folder.path().join(name));
    let fit = [windows("run_1", 0.0), windows("run_2", 1.0)].concat();
    let left_out = windows("run_3", 2.5);
    let shown: Vec<&Value> = left_out.iter().map(|w| &w["values"]).collect();
    let job = json!({ "variables": VARIABLES, "fit": fit, "left_out": shown });
    std::fs::write(&input, job.to_string()).expect("writes");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/law/peers/fit.py");
    let run = Command::new(python).arg(script).args([&input, &output]).output().expect("starts");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));

    let result: Value = serde_json::from_str(&std::fs::read_to_string(output).expect("a result")).expect("JSON");
    let peers = result["peers"].as_array().expect("peers");
    assert_eq!(peers.len(), 5, "{result}");
    for peer in peers {
        let predicted: Vec<f64> = serde_json::from_value(peer["predicted"].clone()).expect("numbers");
        let truth: Vec<f64> = left_out.iter().filter_map(|w| w["size"].as_f64()).collect();
        assert_eq!(predicted.len(), truth.len());
        let missed: f64 = truth.iter().zip(&predicted).map(|(t, p)| (t - p).powi(2)).sum();
        let explained = 1.0 - missed / truth.iter().map(|t| t * t).sum::<f64>();
        assert!(explained > 0.8, "{} explains {explained}", peer["name"]);
        for tree in peer["trees"].as_array().into_iter().flatten() {
            let found = nodes(tree).unwrap_or_else(|| panic!("no formula: {tree}"));
            let is_symbolic = peer["name"] == "gplearn";
            assert!(!is_symbolic || peer["parts"] == found, "{tree} has {found} nodes, not {}", peer["parts"]);
        }
    }
    assert!(result["versions"]["pysindy"].is_string(), "{result}");
    Ok(())
}

skipping::tests![peers_find_a_linear_drag_and_write_formulas_that_are_read];
