"""Definitions of control_msgs and controller_manager_msgs as of Humble, which rosbags lacks.

Actions are the messages that actionlib and ROS 2 make of them, services their requests and responses as in ROS 2.
"""

GOAL_STATUSES = "actionlib_msgs/msg/GoalStatusArray"
GOAL_ID = "actionlib_msgs/msg/GoalID"
LOAD = "controller_manager_msgs/srv/LoadController_Request"
CONFIGURE = "controller_manager_msgs/srv/ConfigureController_Request"
UNLOAD = "controller_manager_msgs/srv/UnloadController_Request"
SWITCH = "controller_manager_msgs/srv/SwitchController_Request"
LIST = "controller_manager_msgs/srv/ListControllers"

_POINT = "trajectory_msgs/JointTrajectoryPoint"
_MANY = "trajectory_msgs/MultiDOFJointTrajectoryPoint"
_ROLES = ("reference", "feedback", "error", "output", "desired", "actual")


def _action(name: str, goal: str, feedback: str, result: str) -> dict[str, str]:
    """Return the messages of an action by type: its three parts, and each in its envelopes (actionlib, ROS 2)."""
    parts = {"Goal": goal, "Feedback": feedback, "Result": result}
    found = {f"control_msgs/msg/{name}{part}": text for part, text in parts.items()}
    for part in parts:
        label = "actionlib_msgs/GoalID goal_id" if part == "Goal" else "actionlib_msgs/GoalStatus status"
        found[f"control_msgs/msg/{name}Action{part}"] = (
            f"std_msgs/Header header\n{label}\ncontrol_msgs/{name}{part} {part.lower()}"
        )
    uuid = "unique_identifier_msgs/UUID goal_id"
    found[f"control_msgs/action/{name}_SendGoal_Request"] = f"{uuid}\ncontrol_msgs/{name}Goal goal"
    found[f"control_msgs/action/{name}_FeedbackMessage"] = f"{uuid}\ncontrol_msgs/{name}Feedback feedback"
    found[f"control_msgs/action/{name}_GetResult_Response"] = f"int8 status\ncontrol_msgs/{name}Result result"
    return found


_GRIPPED = "float64 position\nfloat64 effort\nbool stalled\nbool reached_goal"

CONTROL_MESSAGES = {
    "control_msgs/msg/JointControllerState": """
        std_msgs/Header header
        float64 set_point
        float64 process_value
        float64 process_value_dot
        float64 error
        float64 time_step
        float64 command
        float64 p
        float64 i
        float64 d
        float64 i_clamp
        bool antiwindup
    """,
    "control_msgs/msg/JointTrajectoryControllerState": "\n".join(
        [
            "std_msgs/Header header",
            "string[] joint_names",
            *(f"{_POINT} {role}" for role in _ROLES),
            "string[] multi_dof_joint_names",
            *(f"{_MANY} multi_dof_{role}" for role in _ROLES),
        ]
    ),
    "control_msgs/msg/JointTolerance": "string name\nfloat64 position\nfloat64 velocity\nfloat64 acceleration",
    "control_msgs/msg/GripperCommand": "float64 position\nfloat64 max_effort",
    **_action(
        "FollowJointTrajectory",
        goal="""
        trajectory_msgs/JointTrajectory trajectory
        control_msgs/JointTolerance[] path_tolerance
        control_msgs/JointTolerance[] goal_tolerance
        builtin_interfaces/Duration goal_time_tolerance
        """,
        feedback=f"std_msgs/Header header\nstring[] joint_names\n{_POINT} desired\n{_POINT} actual\n{_POINT} error",
        result="""
        int32 SUCCESSFUL=0
        int32 INVALID_GOAL=-1
        int32 INVALID_JOINTS=-2
        int32 OLD_HEADER_TIMESTAMP=-3
        int32 PATH_TOLERANCE_VIOLATED=-4
        int32 GOAL_TOLERANCE_VIOLATED=-5
        int32 error_code
        string error_string
        """,
    ),
    "action_msgs/srv/CancelGoal_Request": "action_msgs/GoalInfo goal_info",
    **dict.fromkeys((LOAD, CONFIGURE, UNLOAD), "string name"),
    **{each.replace("_Request", "_Response"): "bool ok" for each in (LOAD, CONFIGURE, UNLOAD, SWITCH)},
    f"{LIST}_Request": "uint8 structure_needs_at_least_one_member",
    f"{LIST}_Response": "controller_manager_msgs/ControllerState[] controller",
    "controller_manager_msgs/msg/ControllerState": """
        string name
        string state
        string type
        string[] claimed_interfaces
        string[] required_command_interfaces
        string[] required_state_interfaces
        bool is_chainable
        bool is_chained
        string[] reference_interfaces
        controller_manager_msgs/ChainConnection[] chain_connections
    """,
    "controller_manager_msgs/msg/ChainConnection": "string name\nstring[] reference_interfaces",
    SWITCH: """
        string[] activate_controllers
        string[] deactivate_controllers
        string[] start_controllers
        string[] stop_controllers
        int32 strictness
        bool start_asap
        bool activate_asap
        builtin_interfaces/Duration timeout
    """,
    **_action("GripperCommand", goal="control_msgs/GripperCommand command", feedback=_GRIPPED, result=_GRIPPED),
    **_action(  # of Jazzy; missing in Humble
        "ParallelGripperCommand",
        goal="sensor_msgs/JointState command",
        feedback="sensor_msgs/JointState state",
        result="sensor_msgs/JointState state\nbool stalled\nbool reached_goal",
    ),
}
"""Type → definition."""
