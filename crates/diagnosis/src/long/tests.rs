//! Screening of made-up drives in which something changes.

use recordings::Signal;

use super::*;
use testing::{PERIOD, recording, robot, samples};

/// A drive of the plant in curves; its wheels have more dry friction in some minutes.
fn drive(name: &str, seconds: f64, extra: f64) -> Recording {
    let robot = robot_model::Robot { coulomb: [0.3 + extra; 2], ..robot() };
    let rows = (seconds / PERIOD).round() as usize;
    let torque = |side: f64| samples(rows, move |t| 1.3 + 0.8 * (0.9 * t).sin() + side * 3.5 * (0.7 * t).sin());
    let inputs = recording(&[(Signal::TorqueLeft, torque(-1.0)), (Signal::TorqueRight, torque(1.0))]);
    let driven = torque_driven::simulate(&robot, &[], &inputs, &inference::Options::default()).expect("a drive");
    driven.renamed(name)
}

/// Minutes joined, the friction of each given.
fn joined(extra: &[f64]) -> Vec<Recording> {
    let shift = |piece: &Recording, minute: i64| {
        let channels = piece.channels().iter().map(|c| {
            let t_ns = c.t_ns().iter().map(|t| t + minute * 60_000_000_000).collect();
            recordings::Channel::new(c.signal(), 0, t_ns, c.values().to_vec()).expect("a channel")
        });
        Recording::new("long", piece.clocks().to_vec(), channels.collect()).expect("a recording")
    };
    extra.iter().zip(0..).map(|(&extra, minute)| shift(&drive("long", 60.0, extra), minute)).collect()
}

#[test]
fn minutes_unlike_the_references_are_chosen_and_the_rest_is_reported() {
    let references = [drive("ref", 40.0, 0.0), drive("ref 2", 40.0, 0.02)];
    let mut extra = [0.0; 24];
    extra[13] = 0.5;
    extra[14] = 0.8;
    let mut screening = Screening::new(&references.iter().collect::<Vec<_>>(), 6.0 * PIECE);
    for pieces in joined(&extra).chunks(5) {
        screening.take(pieces).expect("takes");
    }
    let (stretches, coverage, seen) = screening.finish();
    assert_eq!(coverage.compared_with, ComparedWith::References);
    assert_eq!((stretches.len(), coverage.chosen.len(), coverage.left_out), (6, 6, 18));
    for minute in [13.0, 14.0] {
        let found = coverage.chosen.iter().find(|c| (c.interval[0] - 60.0 * minute).abs() < 1e-6);
        assert!(found.is_some_and(|c| c.unlike > Some(10.0)), "{coverage:?}");
    }
    let [median, largest] = coverage.unlike_left_out;
    assert!(median <= largest && largest < Some(10.0), "{coverage:?}");
    assert_eq!(stretches[0].recording.name(), coverage.chosen[0].name);
    assert_eq!((seen.len(), seen[13].interval[0].round()), (24, 13.0 * 60.0));
    assert!((coverage.screened - 24.0 * 60.0).abs() < 1.0 && (coverage.diagnosed - 6.0 * 60.0).abs() < 1.0);
}

#[test]
fn without_references_the_beginning_says_what_is_usual() {
    let mut extra = [0.0; 20];
    extra[17] = 0.8;
    let mut screening = Screening::new(&[], 3.0 * PIECE);
    screening.take(&joined(&extra)).expect("takes");
    let (_, coverage, _) = screening.finish();
    assert_eq!(coverage.compared_with, ComparedWith::Beginning);
    assert!(coverage.chosen.iter().any(|c| (c.interval[0] - 17.0 * 60.0).abs() < 1e-6), "{coverage:?}");
}

#[test]
fn recordings_without_a_drive_are_spread_only() {
    let bare = recording(&[(Signal::GyroZ, (0..6000).map(|k| (f64::from(k) * 0.1, 0.0)).collect())]);
    let mut screening = Screening::new(&[], 3.0 * PIECE);
    screening.take(&bare.pieces(60_000_000_000)).expect("takes");
    let (stretches, coverage, _) = screening.finish();
    assert_eq!((coverage.compared_with, stretches.len()), (ComparedWith::Nothing, 3));
}
