//! Header stamps: those that nobody set are no instants, and the others are measured against the log times.

use std::io::Cursor;

use crate::common::{Bag, Kept, gyro};
use recordings::{HeaderStamps, Input, LossKind, Mapping, Policy, Read, ReadOptions, RecordingError, contents, read};

const MAPPING: &str = r#"
[[files]]
topic = "/gyro"
time = { column = "header.stamp" }
signals.gyro_z = { column = "angular_velocity.z", unit = "rad/s" }
"#;

/// A message logged at one instant and stamped at another.
fn message(log_ns: u64, stamp_ns: u64) -> Kept {
    let (sec, ns) = (stamp_ns / 1_000_000_000, stamp_ns % 1_000_000_000);
    let text = format!(r#"{{"header":{{"stamp":{{"sec":{sec},"nanosec":{ns}}}}},"angular_velocity":{{"z":0.5}}}}"#);
    ("/gyro".to_owned(), log_ns, text.into_bytes())
}

fn run(policy: Policy, messages: &[Kept]) -> Result<Read, RecordingError> {
    let bytes = Bag::default().write(messages);
    let mapping = Mapping::parse("m.toml", MAPPING)?;
    read(&mapping, "a", &[Input { name: "a.mcap", bytes: &bytes }], &ReadOptions { policy })
}

fn stamps(messages: &[Kept]) -> Option<HeaderStamps> {
    let inside = contents("a.mcap", &mut Cursor::new(Bag::default().write(messages))).unwrap();
    inside.topics[0].stamps.clone()
}

#[test]
fn stamps_that_are_all_zero_are_an_error_that_says_what_to_do() {
    let messages: Vec<Kept> = (1..20).map(|k| message(k * 1_000_000, 0)).collect();
    for (policy, which) in
        [(Policy::Strict, "message 1"), (Policy::Normal, "every message"), (Policy::Tolerant, "every message")]
    {
        assert_eq!(
            run(policy, &messages).unwrap_err().to_string(),
            format!(
                "a.mcap: topic `/gyro`: header.stamp is 0 in {which}: the driver does not set it; \
                 use time = {{ column = \"log_time\" }} in the mapping"
            )
        );
    }
    let found = stamps(&messages).unwrap();
    assert_eq!((found.set, found.unset, found.delay), (0, 19, None));
}

#[test]
fn single_stamps_of_zero_are_lost_messages() {
    let mut messages: Vec<Kept> = (1..20).map(|k| message(k * 1_000_000, k * 1_000_000)).collect();
    messages[0] = message(1_000_000, 0);
    messages[7] = message(8_000_000, 0);
    let read = run(Policy::Normal, &messages).unwrap();
    assert_eq!(read.losses.len(), 1);
    assert_eq!((read.losses[0].kind, &read.losses[0].lines[..]), (LossKind::UnsetStamp, &[1, 8][..]));
    assert_eq!(
        read.losses[0].to_string(),
        "a.mcap: 2 messages skipped: their header.stamp is 0, the driver did not set it, messages 1, 8"
    );
    let channel = &read.recording.channels()[0];
    assert_eq!((channel.len(), channel.t_ns()[0]), (17, 2_000_000));
    assert!(matches!(run(Policy::Strict, &messages), Err(RecordingError::UnsetStamp { .. })));
    let found = stamps(&messages).unwrap();
    assert_eq!((found.set, found.unset), (17, 2));
}

#[test]
fn delay_and_drift_of_the_log_against_the_stamps() {
    // 2 ms, every tenth message 9 ms; the log's clock is 50 ppm faster.
    let at = |k: u64| {
        let stamp = 1_000_000_000 + k * 10_000_000;
        message(stamp + 2_000_000 + k * 500 + if k % 10 == 3 { 7_000_000 } else { 0 }, stamp)
    };
    let found = stamps(&(0..2000).map(at).collect::<Vec<_>>()).unwrap();
    let delay = found.delay.unwrap();
    assert_eq!((found.set, found.unset), (2000, 0));
    assert!((delay.median_ms - 2.5).abs() < 0.2, "{delay:?}");
    assert_eq!((delay.smallest_ms, delay.largest_ms), (2.0, 2.0 + 7.0 + 1993.0 * 5e-4));
    let drift = delay.drift.unwrap();
    assert!((drift.ppm - 50.0).abs() < 0.5, "{drift:?}");
}

#[test]
fn messages_without_a_header_have_nothing_to_measure() {
    assert_eq!(stamps(&[("/gyro".to_owned(), 5, b"{\"z\":1}".to_vec())]), None);
    assert!(stamps(&[("/gyro".to_owned(), 5, gyro(1.0))]).is_some());
}
