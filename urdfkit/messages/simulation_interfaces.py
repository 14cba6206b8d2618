"""Definitions of simulation_interfaces 2.1, the standard services of simulators in ROS 2.

https://github.com/ros-simulation/simulation_interfaces
"""

_RESULT = "simulation_interfaces/Result result"
_FILTERS = "simulation_interfaces/EntityFilters filters"
_EMPTY = "uint8 structure_needs_at_least_one_member"

SIMULATION_INTERFACES: dict[str, str] = {
    "simulation_interfaces/msg/Result": "uint8 result\nstring error_message",
    "simulation_interfaces/msg/SimulatorFeatures": """
        uint16[] features
        string[] spawn_formats
        string custom_info
    """,
    "simulation_interfaces/msg/Bounds": "uint8 type\ngeometry_msgs/Vector3[] points",
    "simulation_interfaces/msg/TagsFilter": "string[] tags\nuint8 filter_mode",
    "simulation_interfaces/msg/EntityCategory": "uint8 category",
    "simulation_interfaces/msg/EntityFilters": """
        string filter
        simulation_interfaces/EntityCategory[] categories
        simulation_interfaces/TagsFilter tags
        simulation_interfaces/Bounds bounds
    """,
    "simulation_interfaces/msg/EntityState": """
        std_msgs/Header header
        geometry_msgs/Pose pose
        geometry_msgs/Twist twist
        geometry_msgs/Accel acceleration
    """,
    "simulation_interfaces/msg/EntityInfo": """
        simulation_interfaces/EntityCategory category
        string description
        string[] tags
    """,
    "simulation_interfaces/msg/SimulationState": "uint8 state",
    "simulation_interfaces/msg/Resource": "string uri\nstring resource_string",
    "simulation_interfaces/msg/WorldResource": """
        string name
        simulation_interfaces/Resource world_resource
        string description
        string[] tags
    """,
    "simulation_interfaces/srv/GetSimulatorFeatures_Request": _EMPTY,
    "simulation_interfaces/srv/GetSimulatorFeatures_Response": "simulation_interfaces/SimulatorFeatures features",
    "simulation_interfaces/srv/GetEntities_Request": _FILTERS,
    "simulation_interfaces/srv/GetEntities_Response": f"{_RESULT}\nstring[] entities",
    "simulation_interfaces/srv/GetEntitiesStates_Request": _FILTERS,
    "simulation_interfaces/srv/GetEntitiesStates_Response": (
        f"{_RESULT}\nstring[] entities\nsimulation_interfaces/EntityState[] states"
    ),
    "simulation_interfaces/srv/GetEntityInfo_Request": "string entity",
    "simulation_interfaces/srv/GetEntityInfo_Response": f"{_RESULT}\nsimulation_interfaces/EntityInfo info",
    "simulation_interfaces/srv/GetEntityState_Request": "string entity",
    "simulation_interfaces/srv/GetEntityState_Response": f"{_RESULT}\nsimulation_interfaces/EntityState state",
    "simulation_interfaces/srv/SetEntityState_Request": """
        string entity
        simulation_interfaces/EntityState state
        bool set_pose
        bool set_twist
        bool set_acceleration
    """,
    "simulation_interfaces/srv/SetEntityState_Response": _RESULT,
    "simulation_interfaces/srv/SpawnEntity_Request": """
        string name
        bool allow_renaming
        simulation_interfaces/Resource entity_resource
        string entity_namespace
        geometry_msgs/PoseStamped initial_pose
    """,
    "simulation_interfaces/srv/SpawnEntity_Response": f"{_RESULT}\nstring entity_name",
    "simulation_interfaces/srv/DeleteEntity_Request": "string entity",
    "simulation_interfaces/srv/DeleteEntity_Response": _RESULT,
    "simulation_interfaces/srv/ResetSimulation_Request": "uint8 scope",
    "simulation_interfaces/srv/ResetSimulation_Response": _RESULT,
    "simulation_interfaces/srv/GetSimulationState_Request": _EMPTY,
    "simulation_interfaces/srv/GetSimulationState_Response": (
        f"{_RESULT}\nsimulation_interfaces/SimulationState state"
    ),
    "simulation_interfaces/srv/SetSimulationState_Request": "simulation_interfaces/SimulationState state",
    "simulation_interfaces/srv/SetSimulationState_Response": _RESULT,
    "simulation_interfaces/srv/StepSimulation_Request": "uint64 steps",
    "simulation_interfaces/srv/StepSimulation_Response": _RESULT,
    "simulation_interfaces/srv/GetCurrentWorld_Request": _EMPTY,
    "simulation_interfaces/srv/GetCurrentWorld_Response": f"{_RESULT}\nsimulation_interfaces/WorldResource world",
    "simulation_interfaces/srv/GetAvailableWorlds_Request": """
        string[] additional_sources
        simulation_interfaces/TagsFilter filter
        bool offline_only
        bool continue_on_error
    """,
    "simulation_interfaces/srv/GetAvailableWorlds_Response": (
        f"{_RESULT}\nsimulation_interfaces/WorldResource[] worlds"
    ),
}
"""Name → definition."""
