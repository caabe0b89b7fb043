//! Messages of ROS 2 as bytes: CDR, little endian, and the definitions that a bag carries.

/// A message that is being encoded: every number stands at a multiple of its size behind the head.
pub(super) struct Cdr(Vec<u8>);

/// Bytes of encapsulation before a message.
const HEAD: usize = 4;

impl Cdr {
    pub(super) fn new() -> Self {
        Self(vec![0, 1, 0, 0])
    }

    fn put(mut self, bytes: &[u8]) -> Self {
        let filled = HEAD + (self.0.len() - HEAD).next_multiple_of(bytes.len());
        self.0.resize(filled, 0);
        self.0.extend_from_slice(bytes);
        self
    }

    fn length(self, count: usize) -> Self {
        self.put(&(count as u32).to_le_bytes())
    }

    pub(super) fn text(mut self, text: &str) -> Self {
        self = self.length(text.len() + 1);
        self.0.extend_from_slice(text.as_bytes());
        self.0.push(0);
        self
    }

    /// `std_msgs/Header`.
    pub(super) fn header(self, t_ns: u64, frame: &str) -> Self {
        let (seconds, ns) = ((t_ns / 1_000_000_000) as i32, (t_ns % 1_000_000_000) as u32);
        self.put(&seconds.to_le_bytes()).put(&ns.to_le_bytes()).text(frame)
    }

    /// Numbers one after another.
    pub(super) fn numbers(self, numbers: &[f64]) -> Self {
        numbers.iter().fold(self, |cdr, number| cdr.put(&number.to_le_bytes()))
    }

    /// A list of numbers.
    pub(super) fn list(self, numbers: &[f64]) -> Self {
        self.length(numbers.len()).numbers(numbers)
    }

    pub(super) fn texts(self, texts: &[&str]) -> Self {
        texts.iter().fold(self.length(texts.len()), |cdr, text| cdr.text(text))
    }

    pub(super) fn octets(mut self, octets: &[u8]) -> Self {
        self = self.length(octets.len());
        self.0.extend_from_slice(octets);
        self
    }

    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.0
    }
}

/// A message type with its definition.
#[derive(Debug, Clone, Copy)]
pub(super) struct MessageType {
    pub(super) name: &'static str,
    /// The message itself.
    own: &'static str,
    /// What it refers to.
    parts: &'static [(&'static str, &'static str)],
}

impl MessageType {
    /// The definition as bags carry it.
    pub(super) fn definition(&self) -> String {
        let line = "=".repeat(80);
        let parts = self.parts.iter().map(|(name, text)| format!("\n{line}\nMSG: {name}\n{text}"));
        parts.fold(self.own.to_owned(), |all, part| all + &part)
    }
}

const TIME: (&str, &str) = ("builtin_interfaces/Time", "int32 sec\nuint32 nanosec");
const HEADER: (&str, &str) = ("std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id");
const VECTOR: (&str, &str) = ("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z");
const QUATERNION: (&str, &str) = ("geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w");

pub(super) const JOINT_STATE: MessageType = MessageType {
    name: "sensor_msgs/msg/JointState",
    own: "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort",
    parts: &[HEADER, TIME],
};

pub(super) const IMU: MessageType = MessageType {
    name: "sensor_msgs/msg/Imu",
    own: "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n\
          geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n\
          geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance",
    parts: &[HEADER, TIME, QUATERNION, VECTOR],
};

pub(super) const ODOMETRY: MessageType = MessageType {
    name: "nav_msgs/msg/Odometry",
    own: "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n\
          geometry_msgs/TwistWithCovariance twist",
    parts: &[
        HEADER,
        TIME,
        ("geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance"),
        ("geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation"),
        ("geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z"),
        QUATERNION,
        ("geometry_msgs/TwistWithCovariance", "geometry_msgs/Twist twist\nfloat64[36] covariance"),
        ("geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular"),
        VECTOR,
    ],
};

pub(super) const COMPRESSED_IMAGE: MessageType = MessageType {
    name: "sensor_msgs/msg/CompressedImage",
    own: "std_msgs/Header header\nstring format\nuint8[] data",
    parts: &[HEADER, TIME],
};
