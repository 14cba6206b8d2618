"""Requests and responses of services that rosbags lacks, by the names that ROS 2 gives these messages."""

_EMPTY = "uint8 structure_needs_at_least_one_member"
_DONE = "bool success"
_REPORT = "bool success\nstring status_message"

SERVICE_MESSAGES: dict[str, str] = {
    "std_srvs/srv/Empty_Request": _EMPTY,
    "std_srvs/srv/Empty_Response": _EMPTY,
    "std_srvs/srv/SetBool_Request": "bool data",
    "std_srvs/srv/SetBool_Response": "bool success\nstring message",
    "std_srvs/srv/Trigger_Request": _EMPTY,
    "std_srvs/srv/Trigger_Response": "bool success\nstring message",
    "visualization_msgs/srv/GetInteractiveMarkers_Request": _EMPTY,
    "visualization_msgs/srv/GetInteractiveMarkers_Response": """
        uint64 sequence_number
        visualization_msgs/InteractiveMarker[] markers
    """,
    "gazebo_msgs/srv/SpawnModel_Response": _REPORT,
    "gazebo_msgs/srv/DeleteModel_Response": _REPORT,
    "gazebo_msgs/srv/SetModelState_Request": "gazebo_msgs/ModelState model_state",
    "gazebo_msgs/srv/SetModelState_Response": _REPORT,
    "gazebo_msgs/srv/ApplyBodyWrench_Response": _REPORT,
    "gazebo_msgs/srv/BodyRequest_Response": _EMPTY,
    "ros_gz_interfaces/msg/WorldReset": "bool all\nbool time_only\nbool model_only",
    "ros_gz_interfaces/msg/WorldControl": """
        bool pause
        bool step
        uint32 multi_step
        ros_gz_interfaces/WorldReset reset
        uint32 seed
        builtin_interfaces/Time run_to_sim_time
    """,
    "ros_gz_interfaces/srv/ControlWorld_Request": "ros_gz_interfaces/WorldControl world_control",
    "ros_gz_interfaces/srv/ControlWorld_Response": _DONE,
    "ros_gz_interfaces/srv/SpawnEntity_Request": "ros_gz_interfaces/EntityFactory entity_factory",
    "ros_gz_interfaces/srv/SpawnEntity_Response": _DONE,
    "ros_gz_interfaces/srv/DeleteEntity_Request": "ros_gz_interfaces/Entity entity",
    "ros_gz_interfaces/srv/DeleteEntity_Response": _DONE,
    "ros_gz_interfaces/srv/SetEntityPose_Response": _DONE,
}
"""Name → definition."""
