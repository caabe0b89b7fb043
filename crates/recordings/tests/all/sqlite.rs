//! rosbag2's sqlite3 files: whole, compressed, old, cut and flipped.

use std::io::Cursor;

use crate::common::{Kept, WHEEL, keep, wheel};
use recordings::{FileError, LossKind, Mapping, Opened, ReadOptions, RecordingError, Signal, messages, read_from};
use rusqlite::Connection;

/// A bag as rosbag2 writes it, `count` messages on `/wheel` and one topic without any.
fn bag(count: u64, with_definitions: bool, message_type: &str, payload: impl Fn(u64) -> Vec<u8>) -> Vec<u8> {
    let mut connection = Connection::open("file:bag?vfs=memdb").unwrap();
    connection
        .execute_batch(
            "PRAGMA page_size = 512;
             CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
                 serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
             CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
                 data BLOB NOT NULL);
             INSERT INTO topics VALUES(1, '/empty', 'std_msgs/msg/Float64', 'cdr', '');",
        )
        .unwrap();
    connection.execute("INSERT INTO topics VALUES(2, '/wheel', ?, 'cdr', '')", [message_type]).unwrap();
    if with_definitions {
        connection
            .execute_batch(
                "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL,
                     encoding TEXT NOT NULL, encoded_message_definition TEXT NOT NULL, type_description_hash TEXT);",
            )
            .unwrap();
        connection
            .execute("INSERT INTO message_definitions VALUES(1, ?, 'ros2msg', ?, '')", [message_type, WHEEL])
            .unwrap();
    }
    for i in 0..count {
        let row = (2, 1_000_000_000 + 10_000_000 * i.cast_signed(), payload(i));
        connection.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", row).unwrap();
    }
    connection.serialize("main").unwrap().to_vec()
}

fn wheels(count: u64) -> Vec<u8> {
    bag(count, true, "test_msgs/msg/Wheel", |i| wheel(1_000_000_000 + 10_000_000 * i, i as f64))
}

type Kinds = Vec<(LossKind, usize)>;

fn read(name: &str, bytes: &[u8]) -> Result<(Vec<Kept>, Kinds), RecordingError> {
    let mut kept = Vec::new();
    let passed = messages(name, &mut Cursor::new(bytes), &mut |message| {
        kept.push(keep(&message));
        Ok::<(), RecordingError>(())
    })?;
    Ok((kept, passed.losses.iter().map(|loss| (loss.kind, loss.count)).collect()))
}

fn expected(count: u64) -> Vec<Kept> {
    let message = |i: u64| {
        let t = 1_000_000_000 + 10_000_000 * i;
        ("/wheel".to_owned(), t, wheel(t, i as f64))
    };
    (0..count).map(message).collect()
}

#[test]
fn whole_compressed_and_with_a_write_ahead_log() {
    let mut bytes = wheels(50);
    assert_eq!(read("a.db3", &bytes).unwrap(), (expected(50), vec![]));
    let packed = zstd::encode_all(bytes.as_slice(), 3).unwrap();
    assert_eq!(read("a.db3.zstd", &packed).unwrap(), (expected(50), vec![]));
    let cut = read("a.db3.zstd", &packed[..packed.len() - 5]);
    assert!(cut.is_err() || !cut.unwrap().1.is_empty());
    // The mark of a write-ahead log that was folded in.
    bytes[18..20].fill(2);
    assert_eq!(read("a.db3", &bytes).unwrap(), (expected(50), vec![]));
}

const MAPPING: &str = "[[files]]\ntopic = \"/wheel\"\ntime = { column = \"log_time\" }\n\
    signals.wheel_speed_left = { column = \"COLUMN\", unit = \"rad/s\" }";

fn speeds(column: &str, name: &str, bytes: &[u8]) -> Result<Vec<f64>, RecordingError> {
    let mapping = Mapping::parse("m.toml", &MAPPING.replace("COLUMN", column)).unwrap();
    let mut source = Cursor::new(bytes);
    let mut inputs = [Opened { name, source: &mut source }];
    let read = read_from(&mapping, "a", &mut inputs, &ReadOptions::default())?;
    assert!(read.losses.is_empty(), "{:?}", read.losses);
    Ok(read.recording.require(Signal::WheelSpeedLeft)?.values().to_vec())
}

#[test]
fn old_bags_use_the_definitions_that_are_built_in() {
    let float = |i: u64| [vec![0, 1, 0, 0], (i as f64).to_le_bytes().to_vec()].concat();
    let old = bag(3, false, "std_msgs/msg/Float64", float);
    assert_eq!(speeds("data", "a.db3", &old).unwrap(), [0.0, 1.0, 2.0]);
    let unknown = bag(3, false, "my_msgs/msg/Float64", float);
    assert_eq!(
        speeds("data", "a.db3", &unknown).unwrap_err().to_string(),
        "a.db3: topic `/wheel` (my_msgs/msg/Float64): the bag does not define this message and it is not built in; \
         record with ROS 2 Iron or later, or convert the bag to MCAP"
    );
    let packed = bag(3, false, "std_msgs/msg/Float64", |i| zstd::encode_all(float(i).as_slice(), 1).unwrap());
    assert_eq!(speeds("data", "a.db3", &packed).unwrap(), [0.0, 1.0, 2.0], "each message compressed by itself");
}

#[test]
fn every_cut_is_reported() {
    let bytes = wheels(50);
    let original = expected(50);
    let mut partly = 0;
    for end in (0..bytes.len()).step_by(7) {
        match read("a.db3", &bytes[..end]) {
            Err(RecordingError::File(FileError::NotReadable { .. })) => {}
            Err(other) => panic!("{end}: {other}"),
            Ok((kept, losses)) => {
                assert!(kept.iter().all(|message| original.contains(message)), "{end}");
                assert!(!losses.is_empty(), "{end}: {}", kept.len());
                assert!(losses.iter().any(|loss| loss.0 == LossKind::CutOff), "{end}: {losses:?}");
                partly += usize::from(!kept.is_empty());
            }
        }
    }
    assert!(partly > 100, "what can be read is read: {partly}");
}

#[test]
fn a_broken_page_leaves_what_is_before_and_behind() {
    let mut bytes = wheels(200);
    // Leaf pages start with 13; break one in the middle.
    let page = (0..bytes.len() / 512).filter(|page| bytes[page * 512] == 13).nth(12).unwrap();
    bytes[page * 512..(page + 1) * 512].fill(0xEE);
    let (kept, losses) = read("a.db3", &bytes).unwrap();
    let original = expected(200);
    assert_eq!((kept.first(), kept.last()), (original.first(), original.last()));
    assert!(kept.len() > 150 && kept.len() < 200, "{}", kept.len());
    assert_eq!(losses[0].0, LossKind::Damage);
    assert_eq!(losses.iter().find(|loss| loss.0 == LossKind::MissingMessage).unwrap().1, 200 - kept.len());
}

#[test]
fn flips_never_panic() {
    let bytes = wheels(12);
    let mut flipped = bytes.clone();
    for index in 0..bytes.len() {
        flipped[index] = bytes[index] ^ (1 << (index % 8));
        let _ = read("a.db3", &flipped);
        flipped[index] = bytes[index];
    }
}
