//! Definitions of standard ROS 2 messages, for recordings that contain no definitions.

/// Names (`package/Name`) of standard messages, and their definitions in the syntax of `.msg` files.
pub(super) const KNOWN: [(&str, &str); 43] = [
    ("builtin_interfaces/Time", "int32 sec\nuint32 nanosec"),
    ("builtin_interfaces/Duration", "int32 sec\nuint32 nanosec"),
    (
        "std_msgs/Header",
        "builtin_interfaces/Time stamp\nstring frame_id",
    ),
    ("std_msgs/Bool", "bool data"),
    ("std_msgs/String", "string data"),
    ("std_msgs/Float32", "float32 data"),
    ("std_msgs/Float64", "float64 data"),
    ("std_msgs/Int8", "int8 data"),
    ("std_msgs/Int16", "int16 data"),
    ("std_msgs/Int32", "int32 data"),
    ("std_msgs/Int64", "int64 data"),
    ("std_msgs/UInt8", "uint8 data"),
    ("std_msgs/UInt16", "uint16 data"),
    ("std_msgs/UInt32", "uint32 data"),
    (
        "std_msgs/MultiArrayDimension",
        "string label\nuint32 size\nuint32 stride",
    ),
    (
        "std_msgs/MultiArrayLayout",
        "MultiArrayDimension[] dim\nuint32 data_offset",
    ),
    (
        "std_msgs/Float32MultiArray",
        "MultiArrayLayout layout\nfloat32[] data",
    ),
    (
        "std_msgs/Float64MultiArray",
        "MultiArrayLayout layout\nfloat64[] data",
    ),
    (
        "std_msgs/Int16MultiArray",
        "MultiArrayLayout layout\nint16[] data",
    ),
    (
        "std_msgs/Int32MultiArray",
        "MultiArrayLayout layout\nint32[] data",
    ),
    (
        "std_msgs/UInt8MultiArray",
        "MultiArrayLayout layout\nuint8[] data",
    ),
    (
        "std_msgs/UInt16MultiArray",
        "MultiArrayLayout layout\nuint16[] data",
    ),
    ("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z"),
    ("geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z"),
    (
        "geometry_msgs/Quaternion",
        "float64 x\nfloat64 y\nfloat64 z\nfloat64 w",
    ),
    (
        "geometry_msgs/Pose",
        "Point position\nQuaternion orientation",
    ),
    ("geometry_msgs/Wrench", "Vector3 force\nVector3 torque"),
    ("geometry_msgs/Twist", "Vector3 linear\nVector3 angular"),
    (
        "geometry_msgs/Transform",
        "Vector3 translation\nQuaternion rotation",
    ),
    (
        "geometry_msgs/WrenchStamped",
        "std_msgs/Header header\nWrench wrench",
    ),
    (
        "geometry_msgs/PoseStamped",
        "std_msgs/Header header\nPose pose",
    ),
    (
        "geometry_msgs/TwistStamped",
        "std_msgs/Header header\nTwist twist",
    ),
    (
        "geometry_msgs/PointStamped",
        "std_msgs/Header header\nPoint point",
    ),
    (
        "geometry_msgs/Vector3Stamped",
        "std_msgs/Header header\nVector3 vector",
    ),
    (
        "geometry_msgs/QuaternionStamped",
        "std_msgs/Header header\nQuaternion quaternion",
    ),
    (
        "geometry_msgs/TransformStamped",
        "std_msgs/Header header\nstring child_frame_id\nTransform transform",
    ),
    (
        "sensor_msgs/Image",
        "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\nuint8[] data",
    ),
    (
        "sensor_msgs/CompressedImage",
        "std_msgs/Header header\nstring format\nuint8[] data",
    ),
    (
        "sensor_msgs/JointState",
        "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort",
    ),
    (
        "sensor_msgs/Imu",
        "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n\
         geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n\
         geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance",
    ),
    (
        "sensor_msgs/MagneticField",
        "std_msgs/Header header\ngeometry_msgs/Vector3 magnetic_field\nfloat64[9] magnetic_field_covariance",
    ),
    (
        "sensor_msgs/Temperature",
        "std_msgs/Header header\nfloat64 temperature\nfloat64 variance",
    ),
    (
        "sensor_msgs/FluidPressure",
        "std_msgs/Header header\nfloat64 fluid_pressure\nfloat64 variance",
    ),
];

/// Definition of the message `name`, such as `sensor_msgs/msg/Image`; `None` if it is not a standard message.
pub(crate) fn known_definition(name: &str) -> Option<&'static str> {
    let short = super::schema::short(name);
    let found = KNOWN.iter().find(|(known, _)| *known == short);
    found.map(|(_, text)| *text)
}
