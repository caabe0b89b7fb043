//! Bad rows in otherwise good files are skipped, counted and named, or refused where reading is strict.

use recordings::{Input, Mapping, Policy, Read, ReadOptions, RecordingError, Signal, read};

const MAPPING: &str = r#"
[[files]]
pattern = "*.csv"
time = { column = "t", unit = "s" }
[files.signals]
gyro_z = { column = "wz", unit = "rad/s" }
current_left = { column = "curL", unit = "A", magnitude_only = true, dead_band = 0.59 }
"#;

fn read_with(policy: Policy, bytes: &[u8]) -> Result<Read, RecordingError> {
    let mapping = Mapping::parse("m.toml", MAPPING).unwrap();
    read(&mapping, "a", &[Input { name: "a.csv", bytes }], &ReadOptions { policy })
}

fn message(text: &str) -> String {
    read_with(Policy::Normal, text.as_bytes()).unwrap_err().to_string()
}

#[test]
fn a_wrong_field_count_is_a_loss_unless_strict() {
    let text = "t,wz,curL\n0,1,1\n0.1,2\n0.2,3,1,9\n0.3,4,1\n0.4,5";
    let read = read_with(Policy::Normal, text.as_bytes()).unwrap();
    assert_eq!(read.losses[0].to_string(), "a.csv: 3 rows skipped: wrong number of fields, lines 3, 4, 6");
    assert_eq!(read.recording.get(Signal::GyroZ).unwrap().values(), [1.0, 4.0]);
    assert_eq!(
        read_with(Policy::Strict, text.as_bytes()).unwrap_err().to_string(),
        "a.csv: line 3: 2 fields where the header has 3; repair or delete the line"
    );
    let none = message("t,wz,curL\n0,1\n");
    assert_eq!(
        none,
        "a.csv: not one sample could be read (a.csv: 1 row skipped: wrong number of fields, line 2); \
         check the file and the columns of the mapping"
    );
}

#[test]
fn an_open_quote_costs_one_row_only() {
    let read = read_with(Policy::Normal, b"t,wz,curL\n0,1,1\n\"0.1,2\n0.2,3,1\n0.3,4,1\n").unwrap();
    assert_eq!((read.losses[0].count, &read.losses[0].lines[..]), (1, &[3][..]));
    assert_eq!(read.recording.get(Signal::GyroZ).unwrap().values(), [1.0, 3.0, 4.0]);
}

#[test]
fn an_empty_time_is_a_loss_unless_strict() {
    let text = b"t,wz,curL\n0,1,1\n,2,1\n0.2,3,1\n";
    let read = read_with(Policy::Normal, text).unwrap();
    assert_eq!(read.losses[0].to_string(), "a.csv: 1 row skipped: empty time, line 3");
    assert!(matches!(read_with(Policy::Strict, text), Err(RecordingError::NoTime { line: 3, .. })));
}

#[test]
fn a_repeated_stamp_costs_only_samples_that_clash() {
    let clash = b"t,wz,curL\n0,1,1\n0.1,2,1\n0.1,3,\n0.2,4,1\n";
    let read = read_with(Policy::Normal, clash).unwrap();
    assert_eq!(read.losses[0].to_string(), "a.csv: 1 row repeats a stamp: first sample kept, line 4");
    assert_eq!(read.recording.get(Signal::GyroZ).unwrap().values(), [1.0, 2.0, 4.0]);
    assert!(matches!(read_with(Policy::Strict, clash), Err(RecordingError::DuplicateStamp { line: 4, .. })));
    let split = read_with(Policy::Strict, b"t,wz,curL\n0,1,\n0,,5\n").unwrap();
    assert!(split.losses.is_empty());
    assert_eq!(split.recording.get(Signal::CurrentLeft).unwrap().values(), [5.0]);
}

#[test]
fn an_empty_column_is_told() {
    assert!(message("t,wz,curL\n0,,\n").contains("(every mapped cell is empty)"));
    let read = read_with(Policy::Normal, b"t,wz,curL\n0,1,\n1,2,\n").unwrap();
    assert_eq!(read.losses[0].to_string(), "a.csv: 1 column without a sample, column curL");
    assert_eq!(read.recording.get(Signal::CurrentLeft), None);
    let error = read.recording.require(Signal::CurrentLeft).unwrap_err().to_string();
    assert_eq!(error, "recording a: no signal current_left (A); map a column to it; mapped are: gyro_z");
}
