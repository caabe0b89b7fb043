//! Bags made in memory.

#![allow(dead_code)] // each test file takes what it needs

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::Cursor;
use std::sync::Arc;

use bags::{FileError, Loss, Message};
use mcap::{Channel, Compression, Schema, WriteOptions};

/// One message as a test keeps it: topic, log time and bytes.
pub(crate) type Kept = (String, u64, Vec<u8>);

/// ROS 2 definition of the messages on `/wheel`.
pub(crate) const WHEEL: &str = "builtin_interfaces/Time stamp\nfloat64 speed\n\
    ================================================================================\n\
    MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";

/// A message on `/wheel`: stamp and speed, little endian.
pub(crate) fn wheel(ns: u64, speed: f64) -> Vec<u8> {
    let mut bytes = vec![0, 1, 0, 0];
    bytes.extend(((ns / 1_000_000_000) as i32).to_le_bytes());
    bytes.extend(((ns % 1_000_000_000) as u32).to_le_bytes());
    bytes.extend(speed.to_le_bytes());
    bytes
}

/// A message on `/gyro`, in JSON.
pub(crate) fn gyro(z: f64) -> Vec<u8> {
    format!("{{\"header\":{{\"stamp\":{{\"sec\":1,\"nanosec\":5}}}},\"angular_velocity\":{{\"z\":{z}}}}}").into_bytes()
}

/// `count` messages, on two topics in turn, 10 ms apart.
pub(crate) fn messages(count: u64) -> Vec<Kept> {
    let message = |i: u64| {
        let (t, value) = (1_000_000_000 + i * 10_000_000, 0.25 * i as f64 - 1.0);
        if i.is_multiple_of(2) {
            ("/wheel".to_owned(), t, wheel(t, value))
        } else {
            ("/gyro".to_owned(), t, gyro(value))
        }
    };
    (0..count).map(message).collect()
}

/// How a test writes a bag.
#[derive(Clone)]
pub(crate) struct Bag {
    pub(crate) compression: Option<Compression>,
    pub(crate) chunked: bool,
    pub(crate) chunk_size: u64,
    pub(crate) summary: bool,
    pub(crate) checksums: bool,
}

impl Default for Bag {
    fn default() -> Self {
        Self { compression: None, chunked: true, chunk_size: 300, summary: true, checksums: true }
    }
}

impl Bag {
    /// The bytes of a bag with these messages.
    pub(crate) fn write(&self, messages: &[Kept]) -> Vec<u8> {
        let mut options = WriteOptions::new()
            .compression(self.compression)
            .use_chunks(self.chunked)
            .chunk_size(Some(self.chunk_size))
            .calculate_chunk_crcs(self.checksums)
            .calculate_data_section_crc(self.checksums)
            .calculate_summary_section_crc(self.checksums)
            .profile("ros2");
        if !self.summary {
            options = options.emit_summary_records(false).emit_summary_offsets(false).emit_message_indexes(false);
        }
        let mut out = Cursor::new(Vec::new());
        let mut writer = options.create(&mut out).unwrap();
        let schema = |id, name: &str, encoding: &str, data: &'static [u8]| {
            Some(Arc::new(Schema { id, name: name.into(), encoding: encoding.into(), data: Cow::Borrowed(data) }))
        };
        let channel = |id, topic: &str, encoding: &str, schema| {
            let (topic, message_encoding) = (topic.to_owned(), encoding.to_owned());
            Arc::new(Channel { id, topic, schema, message_encoding, metadata: BTreeMap::new() })
        };
        let wheel = channel(1, "/wheel", "cdr", schema(1, "test_msgs/msg/Wheel", "ros2msg", WHEEL.as_bytes()));
        let gyro = channel(2, "/gyro", "json", schema(2, "Gyro", "jsonschema", b"{}"));
        for (sequence, (topic, log_time, data)) in (0..).zip(messages) {
            let channel = if topic == "/wheel" { &wheel } else { &gyro };
            let data = Cow::Borrowed(data.as_slice());
            let (log_time, publish_time) = (*log_time, *log_time);
            writer
                .write(&mcap::Message { channel: Arc::clone(channel), sequence, log_time, publish_time, data })
                .unwrap();
        }
        writer.finish().unwrap();
        drop(writer);
        out.into_inner()
    }
}

/// The messages and losses of a bag.
pub(crate) fn read(bytes: &[u8]) -> Result<(Vec<Kept>, Vec<Loss>), FileError> {
    let mut kept = Vec::new();
    let passed = bags::messages("a.mcap", &mut Cursor::new(bytes), &mut |message| {
        kept.push(keep(&message));
        Ok::<(), FileError>(())
    })?;
    Ok((kept, passed.losses))
}

/// A message as a test keeps it.
pub(crate) fn keep(message: &Message<'_>) -> Kept {
    (message.topic.name.clone(), message.log_time_ns as u64, message.bytes.to_vec())
}
