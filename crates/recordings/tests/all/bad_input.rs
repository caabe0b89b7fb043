//! Every kind of bad file gets one sentence with file, line, column and what to do.

use recordings::{Input, LossKind, Mapping, Policy, Read, ReadOptions, RecordingError, Signal, read};

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

/// Refused when normal; the loss and what is left of wz when tolerant.
fn tolerated(text: &str) -> (LossKind, Vec<u64>, Vec<f64>) {
    let read = read_with(Policy::Tolerant, text.as_bytes()).unwrap();
    assert_eq!(read.losses.len(), 1, "{:?}", read.losses);
    let values = read.recording.get(Signal::GyroZ).unwrap().values().to_vec();
    (read.losses[0].kind, read.losses[0].lines.clone(), values)
}

#[test]
fn nothing_in_the_file() {
    for text in ["", "  \n\n", "\u{feff}"] {
        assert_eq!(message(text), "a.csv: the file is empty; give a CSV file with a header line and rows");
    }
    let header_only = "a.csv: line 1 is a header but no row follows it; was the recording cut off?";
    assert_eq!(message("t,wz,curL\n"), header_only);
    assert_eq!(message("t,wz,curL"), header_only);
}

#[test]
fn a_header_that_is_no_text() {
    for bytes in [&b"\xff\xfet\0,\0w\0"[..], b"t\0,\0w\0\n", b"\x89PNG\r\n"] {
        let error = read_with(Policy::Tolerant, bytes).unwrap_err();
        assert!(matches!(error, RecordingError::NotText { line: 1, .. }), "{error}");
    }
}

#[test]
fn a_missing_column_with_the_nearest_name() {
    assert_eq!(
        message("t,wy,curL\n0,1,1\n"),
        "a.csv: line 1: no column `wz` (needed for gyro_z of mapping m.toml); \
         the columns are: t, wy, curL; correct the mapping or the file"
    );
    assert_eq!(
        message("t,wz,CURL\n0,1,1\n"),
        "a.csv: line 1: no column `curL` (needed for current_left of mapping m.toml); \
         did you mean `CURL`?; correct the mapping or the file"
    );
    assert!(message("time,wz,curL\n0,1,1\n").contains("no column `t` (needed for the time of mapping m.toml)"));
    assert!(message("t;wz;curL\n0;1;1\n").ends_with("the header is one field; set delimiter = \";\" in the mapping"));
    assert!(message("t\twz\n0\t1\n").ends_with("set delimiter = \"\\t\" in the mapping"));
}

#[test]
fn a_column_twice() {
    assert!(message("t,wz,wz,curL\n0,1,1,1\n").starts_with("a.csv: line 1: column `wz` occurs more than once"));
}

#[test]
fn an_optional_mapping_of_which_nothing_is_there() {
    let mapping = Mapping::built_in("skid-steer-columns").unwrap();
    let input = Input { name: "a.csv", bytes: b"time_s,foo\n0,1\n" };
    let error = read(&mapping, "a", &[input], &ReadOptions::default()).unwrap_err();
    assert!(matches!(error, RecordingError::NoSignals { .. }), "{error}");
}

#[test]
fn text_in_a_number() {
    let text = "t,wz,curL\n0,1,1\n0.1,oops,1\n0.2,3,1\n";
    assert_eq!(
        message(text),
        "a.csv: line 3, column wz: `oops` is not a number; \
         correct it, leave the cell empty, or read in tolerant mode (`--reading tolerant`) to skip it"
    );
    assert_eq!(tolerated(text), (LossKind::BadCell, vec![3], vec![1.0, 3.0]));
    let in_time = "t,wz,curL\n0,1,1\nnoon,2,1\n0.2,3,1\n";
    assert!(message(in_time).starts_with("a.csv: line 3, column t: `noon` is not a number"));
    assert_eq!(tolerated(in_time), (LossKind::BadTime, vec![3], vec![1.0, 3.0]));
}

#[test]
fn text_is_shown_without_what_a_terminal_would_obey() {
    let long = "x".repeat(60);
    assert!(message(&format!("t,wz,curL\n0,{long},1\n")).contains(&format!("`{}…`", "x".repeat(40))));
    assert!(message("t,wz,curL\n0,\u{1b}[31m,1\n").contains("`\\u{1b}[31m`"));
}

#[test]
fn numbers_that_are_not_finite() {
    for bad in ["nan", "inf", "-Infinity", "1e999"] {
        let text = format!("t,wz,curL\n0,1,1\n0.1,{bad},1\n");
        let expected = format!("a.csv: line 3, column wz: `{bad}` is not a finite number in range");
        assert!(message(&text).starts_with(&expected));
        assert_eq!(tolerated(&text), (LossKind::BadCell, vec![3], vec![1.0]));
    }
    assert!(message("t,wz,curL\n1e300,1,1\n").contains("column t: `1e300` is not a finite number in range"));
}

#[test]
fn a_negative_magnitude() {
    let text = "t,wz,curL\n0,1,1\n0.1,2,-1\n";
    assert!(message(text).starts_with("a.csv: line 3, column curL: -1 is negative, but the mapping says"));
    assert_eq!(tolerated(text), (LossKind::NegativeMagnitude, vec![3], vec![1.0, 2.0]));
}

#[test]
fn time_running_backwards() {
    let text = "t,wz,curL\n0,1,1\n2.2,2,1\n0.1,3,1\n2.3,4,1\n";
    assert_eq!(
        message(text),
        "a.csv: line 4, column t: time runs backwards, from 2.2 s to 0.1 s; \
         sort the rows, split the file there, or read in tolerant mode (`--reading tolerant`) to skip them \
         (rows that are up to 1 s late are sorted, unless reading is strict; a longer step is a clock that was set anew)"
    );
    assert_eq!(tolerated(text), (LossKind::TimeBackwards, vec![4], vec![1.0, 2.0, 4.0]));
}

#[test]
fn lines_are_right_with_blank_lines_and_any_line_end() {
    for text in ["t,wz,curL\r\n0,1,1\r\n\r\n0.1,x,1\r\n", "t,wz,curL\r0,1,1\r\r0.1,x,1\r", "\n\nt,wz,curL\n0.1,x,1\n"] {
        assert!(message(text).starts_with("a.csv: line 4, column wz"), "{text:?} {}", message(text));
    }
}

#[test]
fn files_that_do_not_fit_the_mapping() {
    let mapping = Mapping::built_in("husky-open").unwrap();
    let options = ReadOptions::default();
    let input = |name| Input { name, bytes: b"time,curL,curR,velL,velR\n0,1,1,0.1,0.1\n" };
    let error = |inputs: &[Input<'_>]| read(&mapping, "01", inputs, &options).unwrap_err().to_string();
    assert_eq!(
        error(&[input("bag.csv")]),
        "bag.csv: fits no pattern of mapping husky-open (pro_*.csv, imu_*.csv); rename the file or add a pattern"
    );
    assert!(error(&[input("pro_1.csv"), input("pro_2.csv")]).starts_with("pro_2.csv: a second file"));
    assert_eq!(error(&[]), "run 01: no file was given; give at least one");
}

#[test]
fn cutting_a_file_anywhere_never_panics() {
    let whole = b"\xef\xbb\xbft,wz,curL\r\n0,\"1\",1\r\n0.1,-2.5e-3,1\r\n";
    for end in 0..whole.len() {
        for policy in [Policy::Strict, Policy::Normal, Policy::Tolerant] {
            let _ = read_with(policy, &whole[..end]);
            let mut flipped = whole.to_vec();
            for bit in 0..8 {
                flipped[end] = whole[end] ^ (1 << bit);
                let _ = read_with(policy, &flipped);
            }
        }
    }
}

// Bad rows in otherwise good files are skipped, counted and named, or refused where reading is strict.

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
fn an_empty_column_is_reported() {
    assert!(message("t,wz,curL\n0,,\n").contains("(every mapped cell is empty)"));
    let read = read_with(Policy::Normal, b"t,wz,curL\n0,1,\n1,2,\n").unwrap();
    assert_eq!(read.losses[0].to_string(), "a.csv: 1 column without a sample, column curL");
    assert_eq!(read.recording.get(Signal::CurrentLeft), None);
    let error = read.recording.require(Signal::CurrentLeft).unwrap_err().to_string();
    assert_eq!(error, "recording a: no signal current_left (A); map a column to it; mapped are: gyro_z");
}
