//! The Husky recordings that lie beside the workspace; ignored where they do not.

use std::fs;
use std::path::{Path, PathBuf};

use recordings::{Input, LossKind, Mapping, Policy, Read, ReadOptions, Signal, read};
use skipping::{Outcome, Skipped, beside};

fn husky() -> Result<PathBuf, Skipped> {
    beside("data/husky-open")
}

/// Every run of one ground.
fn runs(folder: &Path) -> Vec<Read> {
    let mapping = Mapping::built_in("husky-open").unwrap();
    let entries = fs::read_dir(folder).unwrap();
    let names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    let sorted = mapping.group(&names);
    assert!(sorted.unmatched.is_empty(), "{:?}", sorted.unmatched);
    let read_group = |group: &recordings::Group| {
        let files: Vec<_> =
            group.files.iter().map(|file| (&file.name, fs::read(folder.join(&file.name)).unwrap())).collect();
        let inputs: Vec<_> = files.iter().map(|(name, bytes)| Input { name, bytes }).collect();
        read(&mapping, &group.run, &inputs, &ReadOptions { policy: Policy::Strict }).unwrap()
    };
    sorted.groups.iter().map(read_group).collect()
}

pub(crate) fn every_husky_run_reads_whole_but_for_the_missing_imu() -> Outcome {
    let folder = husky()?;
    for (ground, expected) in [("FLOORING", 5), ("ASPHALT", 4), ("SANDY_LOAM", 6)] {
        let runs = runs(&folder.join(ground));
        assert_eq!(runs.len(), expected, "{ground}");
        for run in runs {
            let name = run.recording.name();
            if ground == "FLOORING" && name == "04" {
                assert_eq!(run.losses.len(), 1);
                assert_eq!(run.losses[0].kind, LossKind::MissingFile);
                assert_eq!(run.losses[0].file, "imu_04.csv");
                continue;
            }
            assert!(run.losses.is_empty(), "{ground} {name}: {:?}", run.losses);
            assert_eq!((run.recording.channels().len(), run.sources.len()), (10, 2));
            let current = run.recording.require(Signal::CurrentLeft).unwrap();
            assert!(current.values().iter().all(|&amps| amps == 0.0 || amps >= 0.59), "{ground} {name}");
            let gravity = run.recording.require(Signal::AccelZ).unwrap().values();
            let mean = gravity.iter().sum::<f64>() / gravity.len() as f64;
            assert!((mean - 9.81).abs() < 0.5, "{ground} {name}: {mean}");
            let seconds = run.recording.span_ns(0).unwrap().1 as f64 / 1e9;
            let other = run.recording.span_ns(1).unwrap().1 as f64 / 1e9;
            assert!((seconds - other).abs() < 1.5, "{ground} {name}: {seconds} s, {other} s");
        }
    }
    Ok(())
}
