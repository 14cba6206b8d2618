"""Messages of gazebo_msgs and ros_gz_interfaces that rosbags lacks; a service's request goes by its ROS 2 name."""

MODEL_STATE = "gazebo_msgs/msg/ModelState"
MODEL_STATES = "gazebo_msgs/msg/ModelStates"
SPAWN = "gazebo_msgs/srv/SpawnModel_Request"
DELETE = "gazebo_msgs/srv/DeleteModel_Request"
WRENCH = "gazebo_msgs/srv/ApplyBodyWrench_Request"
CLEAR = "gazebo_msgs/srv/BodyRequest_Request"
CREATE = "ros_gz_interfaces/msg/EntityFactory"
SET_POSE = "ros_gz_interfaces/srv/SetEntityPose_Request"
ENTITY = "ros_gz_interfaces/msg/Entity"
WRENCH_ENTITY = "ros_gz_interfaces/msg/EntityWrench"

WORLD_MESSAGES = {
    MODEL_STATE: """
        string model_name
        geometry_msgs/Pose pose
        geometry_msgs/Twist twist
        string reference_frame
    """,
    MODEL_STATES: """
        string[] name
        geometry_msgs/Pose[] pose
        geometry_msgs/Twist[] twist
    """,
    SPAWN: """
        string model_name
        string model_xml
        string robot_namespace
        geometry_msgs/Pose initial_pose
        string reference_frame
    """,
    DELETE: "string model_name",
    WRENCH: """
        string body_name
        string reference_frame
        geometry_msgs/Point reference_point
        geometry_msgs/Wrench wrench
        builtin_interfaces/Time start_time
        builtin_interfaces/Duration duration
    """,
    CLEAR: "string body_name",
    ENTITY: """
        uint64 id
        string name
        uint8 type
    """,
    WRENCH_ENTITY: """
        std_msgs/Header header
        ros_gz_interfaces/Entity entity
        geometry_msgs/Wrench wrench
    """,
    CREATE: """
        string name
        bool allow_renaming
        string sdf
        string sdf_filename
        string clone_name
        geometry_msgs/Pose pose
        string relative_to
    """,
    SET_POSE: """
        ros_gz_interfaces/Entity entity
        geometry_msgs/Pose pose
    """,
}
"""Name → definition."""
