"""Messages of sensors that rosbags lacks: gazebo_msgs, ros_gz_interfaces and hector_uav_msgs."""

CONTACT_STATE = "gazebo_msgs/msg/ContactState"
CONTACTS_STATE = "gazebo_msgs/msg/ContactsState"
GZ_JOINT_WRENCH = "ros_gz_interfaces/msg/JointWrench"
GZ_CONTACT = "ros_gz_interfaces/msg/Contact"
GZ_CONTACTS = "ros_gz_interfaces/msg/Contacts"
GZ_ALTIMETER = "ros_gz_interfaces/msg/Altimeter"
GZ_LOGICAL_MODEL = "ros_gz_interfaces/msg/LogicalCameraImageModel"
GZ_LOGICAL_IMAGE = "ros_gz_interfaces/msg/LogicalCameraImage"
HECTOR_ALTIMETER = "hector_uav_msgs/msg/Altimeter"

SENSOR_MESSAGES = {
    CONTACT_STATE: """
        string info
        string collision1_name
        string collision2_name
        geometry_msgs/Wrench[] wrenches
        geometry_msgs/Wrench total_wrench
        geometry_msgs/Vector3[] contact_positions
        geometry_msgs/Vector3[] contact_normals
        float64[] depths
    """,
    CONTACTS_STATE: """
        std_msgs/Header header
        gazebo_msgs/ContactState[] states
    """,
    GZ_JOINT_WRENCH: """
        std_msgs/Header header
        std_msgs/String body_1_name
        std_msgs/UInt32 body_1_id
        std_msgs/String body_2_name
        std_msgs/UInt32 body_2_id
        geometry_msgs/Wrench body_1_wrench
        geometry_msgs/Wrench body_2_wrench
    """,
    GZ_CONTACT: """
        ros_gz_interfaces/Entity collision1
        ros_gz_interfaces/Entity collision2
        geometry_msgs/Vector3[] positions
        geometry_msgs/Vector3[] normals
        float64[] depths
        ros_gz_interfaces/JointWrench[] wrenches
    """,
    GZ_CONTACTS: """
        std_msgs/Header header
        ros_gz_interfaces/Contact[] contacts
    """,
    GZ_ALTIMETER: """
        std_msgs/Header header
        float64 vertical_position
        float64 vertical_velocity
        float64 vertical_reference
    """,
    GZ_LOGICAL_MODEL: """
        string name
        geometry_msgs/Pose pose
    """,
    GZ_LOGICAL_IMAGE: """
        std_msgs/Header header
        geometry_msgs/Pose pose
        ros_gz_interfaces/LogicalCameraImageModel[] model
    """,
    HECTOR_ALTIMETER: """
        std_msgs/Header header
        float32 altitude
        float32 pressure
        float32 qnh
    """,
}
"""Name → definition."""
