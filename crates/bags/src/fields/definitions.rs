//! Definitions of common messages (ROS 2 Humble), for bags of sqlite3 that do not carry their own.

/// The definition of a message by its short name, `sensor_msgs/Imu`.
pub(super) fn of(name: &str) -> Option<&'static str> {
    DEFINITIONS.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

const DEFINITIONS: &[(&str, &str)] = &[
    ("builtin_interfaces/Time", "int32 sec\nuint32 nanosec"),
    ("builtin_interfaces/Duration", "int32 sec\nuint32 nanosec"),
    ("std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id"),
    ("std_msgs/Bool", "bool data"),
    ("std_msgs/Byte", "byte data"),
    ("std_msgs/Char", "char data"),
    ("std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a"),
    ("std_msgs/Empty", ""),
    ("std_msgs/Float32", "float32 data"),
    ("std_msgs/Float64", "float64 data"),
    ("std_msgs/Int8", "int8 data"),
    ("std_msgs/Int16", "int16 data"),
    ("std_msgs/Int32", "int32 data"),
    ("std_msgs/Int64", "int64 data"),
    ("std_msgs/String", "string data"),
    ("std_msgs/UInt8", "uint8 data"),
    ("std_msgs/UInt16", "uint16 data"),
    ("std_msgs/UInt32", "uint32 data"),
    ("std_msgs/UInt64", "uint64 data"),
    ("std_msgs/MultiArrayDimension", "string label\nuint32 size\nuint32 stride"),
    ("std_msgs/MultiArrayLayout", "MultiArrayDimension[] dim\nuint32 data_offset"),
    ("std_msgs/ByteMultiArray", "MultiArrayLayout layout\nbyte[] data"),
    ("std_msgs/Float32MultiArray", "MultiArrayLayout layout\nfloat32[] data"),
    ("std_msgs/Float64MultiArray", "MultiArrayLayout layout\nfloat64[] data"),
    ("std_msgs/Int8MultiArray", "MultiArrayLayout layout\nint8[] data"),
    ("std_msgs/Int16MultiArray", "MultiArrayLayout layout\nint16[] data"),
    ("std_msgs/Int32MultiArray", "MultiArrayLayout layout\nint32[] data"),
    ("std_msgs/Int64MultiArray", "MultiArrayLayout layout\nint64[] data"),
    ("std_msgs/UInt8MultiArray", "MultiArrayLayout layout\nuint8[] data"),
    ("std_msgs/UInt16MultiArray", "MultiArrayLayout layout\nuint16[] data"),
    ("std_msgs/UInt32MultiArray", "MultiArrayLayout layout\nuint32[] data"),
    ("std_msgs/UInt64MultiArray", "MultiArrayLayout layout\nuint64[] data"),
    ("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z"),
    ("geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z"),
    ("geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1"),
    ("geometry_msgs/Pose", "Point position\nQuaternion orientation"),
    ("geometry_msgs/PoseStamped", "std_msgs/Header header\nPose pose"),
    ("geometry_msgs/PoseWithCovariance", "Pose pose\nfloat64[36] covariance"),
    ("geometry_msgs/PoseWithCovarianceStamped", "std_msgs/Header header\nPoseWithCovariance pose"),
    ("geometry_msgs/Twist", "Vector3 linear\nVector3 angular"),
    ("geometry_msgs/TwistStamped", "std_msgs/Header header\nTwist twist"),
    ("geometry_msgs/TwistWithCovariance", "Twist twist\nfloat64[36] covariance"),
    ("geometry_msgs/TwistWithCovarianceStamped", "std_msgs/Header header\nTwistWithCovariance twist"),
    (
        "nav_msgs/Odometry",
        "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n\
         geometry_msgs/TwistWithCovariance twist",
    ),
    (
        "sensor_msgs/Imu",
        "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n\
         geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n\
         geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance",
    ),
    (
        "sensor_msgs/JointState",
        "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort",
    ),
    (
        "sensor_msgs/BatteryState",
        "std_msgs/Header header\nfloat32 voltage\nfloat32 temperature\nfloat32 current\nfloat32 charge\n\
         float32 capacity\nfloat32 design_capacity\nfloat32 percentage\nuint8 power_supply_status\n\
         uint8 power_supply_health\nuint8 power_supply_technology\nbool present\nfloat32[] cell_voltage\n\
         float32[] cell_temperature\nstring location\nstring serial_number",
    ),
];

#[cfg(test)]
mod tests {
    use super::super::schema::parse;
    use super::*;

    #[test]
    fn every_definition_parses_with_what_it_refers_to() {
        for (name, text) in DEFINITIONS {
            let layout = parse(name, text).unwrap_or_else(|message| panic!("{name}: {message}"));
            assert!(!layout.fields.is_empty(), "{name}");
        }
        assert!(of("std_msgs/Nothing").is_none());
    }
}
