//! A bag of the wanted size.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::Path;

use anyhow::{Context, Result};
use mcap::records::MessageHeader;
use mcap::{Compression, WriteOptions, Writer};

use super::drive::{self, Noise};
use super::ros2::{self, MessageType};

/// When the drive begins, s since 1970.
const START: u64 = 1_700_000_000;
const SECOND_NS: u64 = 1_000_000_000;

/// A topic: its messages and how often they come.
struct Topic {
    name: &'static str,
    message_type: MessageType,
    rate_hz: u64,
    message: fn(u64, &mut Noise) -> Vec<u8>,
}

const TOPICS: [Topic; 3] = [
    Topic { name: "/joint_states", message_type: ros2::JOINT_STATE, rate_hz: 100, message: drive::joint_states },
    Topic { name: "/imu/data", message_type: ros2::IMU, rate_hz: 200, message: drive::imu },
    Topic { name: "/odom", message_type: ros2::ODOMETRY, rate_hz: 50, message: drive::odometry },
];

const CAMERA: Topic = Topic {
    name: "/camera/image/compressed",
    message_type: ros2::COMPRESSED_IMAGE,
    rate_hz: 30,
    message: drive::picture,
};

/// What was written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Written {
    pub(super) bytes: u64,
    pub(super) messages: u64,
    /// Length of the drive.
    pub(super) seconds: f64,
}

/// Writes whole seconds of a drive until the file has this many bytes.
pub(super) fn write(path: &Path, bytes: u64, camera: bool) -> Result<Written> {
    let shown = path.display();
    let file = File::create_new(path).with_context(|| format!("cannot write '{shown}'"))?;
    let mut writer = WriteOptions::new()
        .profile("ros2")
        .library("xtask bag")
        .compression(Some(Compression::Zstd))
        .create(BufWriter::new(file))?;
    let mut topics: Vec<(u16, Topic)> = Vec::new();
    for topic in TOPICS.into_iter().chain(camera.then_some(CAMERA)) {
        let definition = topic.message_type.definition();
        let schema = writer.add_schema(topic.message_type.name, "ros2msg", definition.as_bytes())?;
        topics.push((writer.add_channel(schema, topic.name, "cdr", &BTreeMap::new())?, topic));
    }
    let (mut noise, mut messages, mut seconds) = (Noise::new(1), 0, 0);
    while fs::metadata(path)?.len() < bytes {
        messages += second(&mut writer, &topics, (START + seconds) * SECOND_NS, &mut noise)
            .with_context(|| format!("cannot write '{shown}'"))?;
        seconds += 1;
    }
    writer.finish()?;
    writer.into_inner().into_inner().with_context(|| format!("cannot write '{shown}'"))?;
    Ok(Written { bytes: fs::metadata(path)?.len(), messages, seconds: seconds as f64 })
}

/// Writes one second of the drive, all topics in the order of time; the number of messages.
fn second(
    writer: &mut Writer<BufWriter<File>>,
    topics: &[(u16, Topic)],
    from_ns: u64,
    noise: &mut Noise,
) -> Result<u64> {
    let mut all: Vec<(u64, u16, &Topic)> = Vec::new();
    for (id, topic) in topics {
        all.extend((0..topic.rate_hz).map(|k| (from_ns + k * SECOND_NS / topic.rate_hz, *id, topic)));
    }
    all.sort_by_key(|&(t_ns, ..)| t_ns);
    for &(t_ns, channel_id, topic) in &all {
        let header = MessageHeader { channel_id, sequence: 0, log_time: t_ns, publish_time: t_ns };
        writer.write_to_known_channel(&header, &(topic.message)(t_ns, noise))?;
    }
    Ok(all.len() as u64)
}

#[cfg(test)]
mod tests {
    use std::fs::File;

    use recordings::contents;

    use super::super::iterate::iterate;
    use super::write;

    #[test]
    fn a_bag_has_its_size_and_reads_back_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("drive.mcap");
        let wanted = 4 << 20;
        let written = write(&path, wanted, true).expect("written");
        assert!((wanted..wanted + (4 << 20)).contains(&written.bytes), "{written:?}");
        let inside = contents("drive.mcap", &mut File::open(&path).expect("is there")).expect("is a bag");
        assert_eq!((inside.bytes, inside.losses.as_slice(), inside.unchecked), (written.bytes, &[][..], 0));
        let told: Vec<_> =
            inside.topics.iter().map(|t| (t.name.as_str(), t.count as f64 / written.seconds, t.undecodable)).collect();
        let rates = [
            ("/joint_states", 100.0, 0),
            ("/imu/data", 200.0, 0),
            ("/odom", 50.0, 0),
            ("/camera/image/compressed", 30.0, 0),
        ];
        assert_eq!(told, rates);
        let velocity = inside.topics[0].fields.as_ref().expect("decodes").iter().find(|f| f.path == "velocity");
        assert_eq!(velocity.expect("is there").names[2], "rear_left_wheel_joint");
        let counted = iterate(&path).expect("iterates");
        assert_eq!(counted.messages, written.messages);
        assert!(counted.bytes > wanted / 2, "{counted:?}");
    }
}
