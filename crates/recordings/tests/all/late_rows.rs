//! Rows that were overtaken on their way are sorted by their stamps and counted, in every format.

use crate::common::{Bag, wheel};
use proptest::prelude::*;
use recordings::{Input, LossKind, Mapping, Policy, Read, ReadOptions, RecordingError, Signal, read};

const MAPPING: &str = r#"
[[files]]
pattern = "*.csv"
time = { column = "t", unit = "ns" }
signals.gyro_z = { column = "wz", unit = "rad/s" }

[[files]]
topic = "/wheel"
time = { column = "stamp" }
signals.wheel_speed_left = { column = "speed", unit = "rad/s" }
"#;

fn read_file(policy: Policy, name: &str, bytes: &[u8]) -> Result<Read, RecordingError> {
    let mapping = Mapping::parse("m.toml", MAPPING).unwrap();
    let mut read = read(&mapping, "a", &[Input { name, bytes }], &ReadOptions { policy })?;
    read.losses.retain(|loss| loss.kind != LossKind::MissingFile);
    Ok(read)
}

/// Rows of an instant (ns) and a value as CSV and as a bag.
fn files(rows: &[(i64, f64)]) -> [(&'static str, Vec<u8>); 2] {
    let lines: Vec<String> = rows.iter().map(|(t, value)| format!("{t},{value}\n")).collect();
    let message = |&(t, value): &(i64, f64)| ("/wheel".to_owned(), t as u64, wheel(t as u64, value));
    let messages: Vec<_> = rows.iter().map(message).collect();
    [("a.csv", format!("t,wz\n{}", lines.concat()).into_bytes()), ("a.mcap", Bag::default().write(&messages))]
}

fn samples(read: &Read) -> Vec<(i64, f64)> {
    read.recording.channels()[0].samples().collect()
}

fn count(read: &Read, kind: LossKind) -> usize {
    read.losses.iter().filter(|loss| loss.kind == kind).map(|loss| loss.count).sum()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(128) })]

    #[test]
    fn rows_shuffled_within_a_second_read_as_those_in_order(
        steps in proptest::collection::vec((prop_oneof![Just(0), 1..300_000_000_i64], 0..=1_000_000_000_i64), 1..60),
    ) {
        let mut now = 1_700_000_000_000_000_000;
        let mut rows: Vec<(i64, i64, f64)> = Vec::new();
        for (number, (step, delay)) in steps.into_iter().enumerate() {
            now += step;
            rows.push((now + delay, now, number as f64));
        }
        rows.sort_by_key(|&(arrival, ..)| arrival);
        let shuffled: Vec<(i64, f64)> = rows.into_iter().map(|(_, t, value)| (t, value)).collect();
        let mut latest = i64::MIN;
        let mut late = 0;
        for &(t, _) in &shuffled {
            late += usize::from(t < latest);
            latest = latest.max(t);
        }
        let mut sorted = shuffled.clone();
        sorted.sort_by_key(|&(t, _)| t);
        for ((name, bytes), (_, in_order)) in files(&shuffled).into_iter().zip(files(&sorted)) {
            let (read, expected) =
                (read_file(Policy::Normal, name, &bytes).unwrap(), read_file(Policy::Normal, name, &in_order).unwrap());
            prop_assert_eq!(samples(&read), samples(&expected));
            prop_assert_eq!(count(&read, LossKind::OutOfOrder), late);
            prop_assert_eq!(count(&expected, LossKind::OutOfOrder), 0);
            let repeated = count(&read, LossKind::DuplicateStamp);
            prop_assert_eq!(repeated, count(&expected, LossKind::DuplicateStamp));
            prop_assert_eq!(repeated + samples(&read).len(), shuffled.len());
            prop_assert_eq!(read_file(Policy::Strict, name, &bytes).is_ok(), late + repeated == 0);
        }
    }
}

#[test]
fn a_second_is_the_limit_and_the_first_places_are_named() {
    let second = 1_000_000_000;
    let rows = [(0, 1.0), (3 * second, 2.0), (2 * second, 3.0), (4 * second, 4.0), (3 * second, 5.0)];
    for ((name, bytes), told) in files(&rows).into_iter().zip([
        ["a.csv: 2 rows out of order: sorted by their stamps, lines 4, 6", "line 6"],
        ["a.mcap: 2 rows out of order: sorted by their stamps, messages 3, 5", "message 5"],
    ]) {
        let read = read_file(Policy::Normal, name, &bytes).unwrap();
        assert_eq!(read.losses[0].to_string(), told[0]);
        assert!(read.losses[1].kind == LossKind::DuplicateStamp && read.losses[1].to_string().ends_with(told[1]));
        assert_eq!(samples(&read), [(0, 1.0), (2 * second, 3.0), (3 * second, 2.0), (4 * second, 4.0)]);
    }
    let mut rows = rows;
    rows[2].0 -= 1;
    for (name, bytes) in files(&rows) {
        let error = read_file(Policy::Normal, name, &bytes).unwrap_err().to_string();
        assert!(error.contains("time runs backwards") && error.contains("a clock that was set anew"), "{error}");
        let read = read_file(Policy::Tolerant, name, &bytes).unwrap();
        assert_eq!([LossKind::TimeBackwards, LossKind::OutOfOrder].map(|kind| count(&read, kind)), [1, 1]);
        assert_eq!(samples(&read).len(), 3);
    }
}

#[test]
fn a_late_row_fills_only_the_gaps_of_its_instant() {
    let mapping = Mapping::parse(
        "m.toml",
        &MAPPING.replace("\n\n", "\nsignals.gyro_x = { column = \"wx\", unit = \"rad/s\" }\n\n"),
    )
    .unwrap();
    let bytes = b"t,wz,wx\n1,1,\n2,2,2\n1,3,3\n";
    let read = read(&mapping, "a", &[Input { name: "a.csv", bytes }], &ReadOptions::default()).unwrap();
    let of = |signal| read.recording.get(signal).unwrap().samples().collect::<Vec<_>>();
    assert_eq!(of(Signal::GyroZ), [(1, 1.0), (2, 2.0)]);
    assert_eq!(of(Signal::GyroX), [(1, 3.0), (2, 2.0)]);
    assert_eq!([LossKind::OutOfOrder, LossKind::DuplicateStamp].map(|kind| count(&read, kind)), [1, 1]);
}
