//! Cases drawn by the examiner as the diagnosis gets them: files read, runs laid on their grid.

use std::path::Path;

use examiner::{Content, DrawnCase, Setting, Settings, Severity, TyreLaw};
use inference::Options;
use recordings::{Input, Mapping, Policy, Read, ReadOptions, Recording, RecordingError};
use robot_file::RobotSpec;
use torque_driven::diagnose;
use torque_driven::{Case, HeldOut, Run};
use verdict::Diagnosis;

/// A clear case of three references and three recordings.
pub(crate) fn settings(content: Content, duration_s: f64, heldout: usize) -> Settings {
    Settings {
        content,
        severity: Some(Severity::Strong),
        setting: Some(Setting::Normal),
        law: Some(TyreLaw::Brush),
        recordings: Some(3),
        heldout,
        duration_s,
        ..Settings::default()
    }
}

pub(crate) fn draw(settings: &Settings, seed: u64) -> DrawnCase {
    examiner::Case::draw("x", seed, settings).expect("sensible settings")
}

/// Reads a recording of a drawn case.
pub(crate) fn read(path: &Path, bytes: &[u8], policy: Policy) -> Result<Read, RecordingError> {
    let mapping = Mapping::built_in("skid-steer-columns").expect("built in");
    let stem = path.file_stem().and_then(|s| s.to_str()).expect("a name");
    let name = path.to_str().expect("text");
    recordings::read(&mapping, stem, &[Input { name, bytes }], &ReadOptions { policy })
}

/// The recordings below a folder of a drawn case, read strictly.
fn recordings_of(drawn: &DrawnCase, folder: &str) -> Vec<Recording> {
    let files = drawn.files.iter().filter(|(path, _)| path.starts_with(folder));
    files
        .map(|(path, bytes)| {
            let read = read(path, bytes, Policy::Strict).expect("readable");
            assert!(read.losses.is_empty(), "{:?}", read.losses);
            read.recording
        })
        .collect()
}

pub(crate) fn case_of(drawn: &DrawnCase) -> Case {
    let (_, robot) = drawn.files.iter().find(|(p, _)| p == Path::new("robot.json")).expect("a robot file");
    let robot = RobotSpec::parse("robot.json", std::str::from_utf8(robot).expect("text")).expect("a robot");
    let runs = |folder| recordings_of(drawn, folder).iter().map(|r| Run::new(r).expect("a run")).collect::<Vec<_>>();
    Case {
        sigma: robot.sigma,
        pose_sigma: robot.pose_sigma,
        references: runs("reference"),
        recordings: runs("recordings"),
        held_out: recordings_of(drawn, "heldout").iter().map(|r| HeldOut::new(r).expect("inputs")).collect(),
        ..Case::new(robot.robot)
    }
}

/// The diagnosis of a case, with what holds of every one.
pub(crate) fn answer(case: &Case, options: &Options) -> Diagnosis {
    let out = diagnose(case, options, &|_| {}).expect("a diagnosis");
    for c in &out.ranked {
        assert!((0.0..=1.0).contains(&c.probability), "{c:?}");
    }
    assert!(!out.sentences.is_empty());
    out
}

/// A diagnosis in one line, for what an assertion prints.
pub(crate) fn told(d: &Diagnosis) -> String {
    let causes: Vec<String> = d.ranked.iter().take(5).map(|c| format!("{} {:.3}", c.effect, c.probability)).collect();
    let trials: Vec<String> = d.trials.iter().take(4).map(|t| format!("{:?} {:.0}", t.hypothesis, t.score)).collect();
    format!("{:?}: {}; {}; costs {:.0?}", d.verdict, causes.join(", "), trials.join(", "), d.costs)
}
