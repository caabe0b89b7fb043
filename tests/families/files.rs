//! Files that were cut off: family 20.

use std::path::{Path, PathBuf};

use examiner::{DrawnCase, EffectId};
use inference::DiagnosisError;
use recordings::{LossKind, Policy};
use torque_driven::Run;

use crate::common::{case_of, draw, read};
use crate::rules::{answer, is_named, strong};

const EFFECT: EffectId = EffectId::Payload;

/// The first recording, cut off in the middle of a row.
fn cut_off(drawn: &DrawnCase, share: f64) -> (PathBuf, Vec<u8>) {
    let (path, bytes) = drawn.files.iter().find(|(p, _)| p == Path::new("recordings/run_1.csv")).expect("a recording");
    let text = std::str::from_utf8(bytes).expect("text");
    let near = (share * text.len() as f64) as usize;
    let row = near + text[near..].find('\n').expect("a row ends") + 1;
    // Behind the second number of the row.
    let comma = row + text[row..].match_indices(',').nth(1).expect("numbers").0;
    (path.clone(), bytes[..comma].to_vec())
}

#[test]
fn a_file_that_was_cut_off_is_reported_and_the_rest_diagnosed() {
    let drawn = draw(&strong(&[EFFECT]), 120);
    let (path, bytes) = cut_off(&drawn, 0.6);
    let refused = read(&path, &bytes, Policy::Strict).expect_err("a torn row").to_string();
    assert!(refused.contains("run_1.csv") && refused.contains("fields where the header has"), "{refused}");
    let rest = read(&path, &bytes, Policy::Normal).expect("the rows before");
    let [loss] = rest.losses.as_slice() else { panic!("{:?}", rest.losses) };
    assert_eq!((loss.kind, loss.count), (LossKind::FieldCount, 1), "{loss}");
    let mut case = case_of(&drawn);
    let whole = case.recordings[0].rows();
    case.recordings[0] = Run::new(&rest.recording).expect("a run");
    assert!(case.recordings[0].rows() < whole * 2 / 3);
    is_named(&answer("seed 120, cut off", &case), EFFECT);
}

#[test]
fn a_file_of_which_too_little_is_left_is_refused() {
    let drawn = draw(&strong(&[EFFECT]), 120);
    let (path, bytes) = cut_off(&drawn, 0.02);
    let rest = read(&path, &bytes, Policy::Normal).expect("the rows before");
    let refused = Run::new(&rest.recording).expect_err("too short");
    assert!(matches!(refused, DiagnosisError::TooShort { .. }), "{refused}");
    assert!(refused.to_string().contains("run_1"), "{refused}");
}
