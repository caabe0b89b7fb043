//! What a bag holds: topics and messages.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::loss::Loss;

/// What a bag says about a topic.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Topic {
    /// Its name: `/imu/data`.
    pub name: String,
    /// The type of its messages: `sensor_msgs/msg/Imu`.
    pub message_type: String,
    /// How messages are encoded: `cdr`, `json`.
    pub encoding: String,
    /// How the schema is written: `ros2msg`, `jsonschema`; empty without a schema.
    pub schema_encoding: String,
    /// The schema, as it stands in the file; empty where the file has none.
    pub schema: Arc<[u8]>,
    /// What an MCAP channel says of itself beside: `offered_qos_profiles`; the first one's where several carry the topic.
    pub metadata: BTreeMap<String, String>,
}

impl Topic {
    /// True for the same topic, whatever its channels say beside.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        let identity = |topic: &'_ Self| {
            [&topic.name, &topic.message_type, &topic.encoding, &topic.schema_encoding].map(String::clone)
        };
        identity(self) == identity(other) && self.schema == other.schema
    }
}

/// One message of a bag.
#[derive(Debug, Clone, Copy)]
pub struct Message<'a> {
    /// The topic's place in the order in which topics were first met.
    pub topic_index: usize,
    /// The topic.
    pub topic: &'a Topic,
    /// When the recorder got it, in ns.
    pub log_time_ns: i64,
    /// The encoded message.
    pub bytes: &'a [u8],
}

/// What becomes of each message.
pub(crate) type Sink<'s, E> = dyn FnMut(Message<'_>) -> Result<(), E> + 's;

/// What passing over a bag gives beside its messages.
#[derive(Debug, Clone, PartialEq)]
pub struct Passed {
    /// All topics, in the order in which they were first met.
    pub topics: Vec<Topic>,
    /// What could not be read.
    pub losses: Vec<Loss>,
    /// Messages that no checksum of the file covers: changed bytes in them would not show.
    pub unchecked: u64,
    /// Length of the file in bytes.
    pub bytes: u64,
    /// SHA-256 of the file, 64 hexadecimal digits.
    pub sha256: String,
}
