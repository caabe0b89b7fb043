//! The recipes of `docs/fleet.md` for many machines: their shell lines run, their files parse.

use std::path::Path;
use std::process::{Command, Output};

use crate::common::Bench;
use serde_json::Value;

/// The text of a block that the page says to write to a file.
fn block(name: &str) -> String {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/fleet.md");
    let page = std::fs::read_to_string(page).unwrap();
    let (_, rest) = page.split_once(&format!("file={name}\n")).expect(name);
    rest.split_once("```").expect("the block ends").0.to_owned()
}

/// Runs a shell script in a folder with a recording that cannot be read, `lacuna` being on the path.
fn shell(bench: &Bench, script: &str, variable: (&str, &str)) -> Output {
    let program = Path::new(env!("CARGO_BIN_EXE_lacuna")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap_or_default());
    let mut command = Command::new("sh");
    command.args(["-c", script]).env("PATH", path).env(variable.0, variable.1).current_dir(bench.path(""));
    command.output().unwrap()
}

fn bench() -> Bench {
    let bench = Bench::new();
    bench.write("fleet.csv", "recording,robot,reference\ncase/recordings/none.csv,case/robot.toml,case/reference\n");
    bench
}

#[cfg(unix)]
#[test]
fn the_slurm_array_works_on_the_shard_of_its_task() {
    let script = block("fleet.sbatch");
    assert!(script.starts_with("#!/bin/sh\n") && script.contains("#SBATCH --array=1-64"), "{script}");
    let (bench, mut held) = (bench(), 0);
    for task in ["1", "2", "64"] {
        let output = shell(&bench, &script, ("SLURM_ARRAY_TASK_ID", task));
        let out = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(out.contains(&format!("of this shard ({task}/64 of 1)")) || out.starts_with("1 recordings:"), "{out}");
        held += usize::from(output.status.code() == Some(3));
        assert!(bench.path(&format!("out/{task}/rows.parquet")).is_file(), "{out}");
    }
    assert!(held <= 1, "one shard has the recording");
}

#[cfg(unix)]
#[test]
fn the_kubernetes_job_counts_from_zero_and_covers_all_shards() {
    let job: Value = serde_yaml_ng::from_str(&block("fleet.yaml")).unwrap();
    assert_eq!((&job["apiVersion"], &job["kind"]), (&"batch/v1".into(), &"Job".into()));
    assert_eq!(job["spec"]["completionMode"], "Indexed");
    assert_eq!(job["spec"]["completions"], 64);
    let container = &job["spec"]["template"]["spec"]["containers"][0];
    let command: Vec<&str> = container["command"].as_array().unwrap().iter().map(|w| w.as_str().unwrap()).collect();
    assert_eq!(command[..2], ["sh", "-c"]);
    let script = command[2].replace("/data/", "");
    let bench = bench();
    for (index, shard) in [("0", 1), ("63", 64)] {
        let output = shell(&bench, &script, ("JOB_COMPLETION_INDEX", index));
        let out = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(out.contains(&format!("of this shard ({shard}/64 of 1)")) || out.starts_with("1 recordings:"), "{out}");
        assert!(bench.path(&format!("out/{index}/rows.parquet")).is_file(), "{out}");
    }
    // What is done is done again by nobody; what has no answer is no reason to start the machine anew.
    assert_eq!(job["spec"]["template"]["spec"]["restartPolicy"], "OnFailure");
    assert!(script.contains("|| [ $? -eq 3 ]"), "{script}");
}
