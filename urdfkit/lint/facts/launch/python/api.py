"""Names of the Python packages that launch files import: their modules, classes and keywords."""

import ast
from collections.abc import Iterable

from urdfkit.defect_message import Suggestion

_MODULES = """
launch: Action Condition Event EventHandler InvalidLaunchFileError LaunchContext LaunchDescription
LaunchDescriptionEntity LaunchDescriptionSource LaunchIntrospector LaunchService SomeActionsType SomeEntitiesType
SomeSubstitutionsType SomeSubstitutionsType_types_tuple Substitution;
launch.actions: AppendEnvironmentVariable ClearLaunchConfigurations DeclareBooleanLaunchArgument DeclareLaunchArgument
EmitEvent ExecuteLocal ExecuteProcess ForEach ForLoop GroupAction IncludeLaunchDescription Log LogDebug LogError LogInfo
LogWarning OpaqueCoroutine OpaqueFunction PopEnvironment PopLaunchConfigurations PushEnvironment
PushLaunchConfigurations RegisterEventHandler ReplaceEnvironmentVariables ResetEnvironment ResetLaunchConfigurations
SetEnvironmentVariable SetLaunchConfiguration Shutdown TimerAction UnregisterEventHandler UnsetEnvironmentVariable
UnsetLaunchConfiguration;
launch.conditions: AndCondition IfCondition InvalidConditionExpressionError LaunchConfigurationEquals
LaunchConfigurationNotEquals OrCondition UnlessCondition evaluate_condition_expression;
launch.event_handlers: OnActionEventBase OnExecutionComplete OnIncludeLaunchDescription OnProcessExit OnProcessIO
OnProcessStart OnShutdown;
launch.events: ExecutionComplete IncludeLaunchDescription Shutdown TimerEvent matches_action;
launch.launch_description_sources: AnyLaunchDescriptionSource FrontendLaunchDescriptionSource
InvalidFrontendLaunchFileError InvalidPythonLaunchFileError PythonLaunchDescriptionSource XMLLaunchDescriptionSource
YAMLLaunchDescriptionSource get_launch_description_from_any_launch_file
get_launch_description_from_frontend_launch_file get_launch_description_from_python_launch_file
load_python_launch_file_as_module;
launch.substitutions: AllSubstitution AndSubstitution AnonName AnySubstitution BooleanSubstitution Command
EnvironmentVariable EqualsSubstitution FileContent FindExecutable ForEachVar ForLoopIndex IfElseSubstitution
IsEmptySubstitution LaunchConfiguration LaunchLogDir LocalSubstitution NotEmptySubstitution NotEqualsSubstitution
NotSubstitution OrSubstitution PathJoinSubstitution PathSubstitution PythonExpression StringJoinSubstitution
StringStripSubstitution SubstitutionFailure TextSubstitution ThisLaunchFile ThisLaunchFileDir;
launch_ros.actions: ComposableNodeContainer LifecycleNode LifecycleTransition LoadComposableNodes Node PushROSNamespace
PushRosNamespace ROSTimer RosTimer SetParameter SetParametersFromFile SetROSLogDir SetRemap SetUseSimTime;
launch_ros.descriptions: ComposableLifecycleNode ComposableNode Node Parameter ParameterFile ParameterValue
RosExecutable;
launch_ros.event_handlers: OnStateTransition;
launch_ros.parameter_descriptions: Parameter ParameterFile ParameterValue;
launch_ros.substitutions: ExecutableInPackage FindPackage FindPackagePrefix FindPackageShare Parameter;
launch_xml.launch_description_sources: XMLLaunchDescriptionSource;
launch_yaml.launch_description_sources: YAMLLaunchDescriptionSource;
ament_index_python: PackageNotFoundError get_package_prefix get_package_share_directory get_package_share_path
get_packages_with_prefixes get_resource get_resource_types get_resources get_search_paths has_resource;
ament_index_python.packages: PackageNotFoundError get_package_prefix get_package_share_directory get_package_share_path
get_packages_with_prefixes;
moveit_configs_utils: MoveItConfigs MoveItConfigsBuilder;
moveit_configs_utils.launches: generate_demo_launch generate_move_group_launch generate_moveit_rviz_launch
generate_rsp_launch generate_setup_assistant_launch generate_spawn_controllers_launch
generate_static_virtual_joint_tfs_launch generate_warehouse_db_launch;
launch_param_builder: ParameterBuilder load_xacro load_yaml
"""
"""Module: its names; of Foxy to Rolling (ros2/launch, ros2/launch_ros, ament/ament_index, moveit/moveit2)."""

_SINGLE_FILES = frozenset(("ament_index_python.packages", "launch_ros.parameter_descriptions"))
"""Modules that also have the names that they import."""

_SINGULAR = frozenset(
    f"launch.{name}" for name in ("action", "condition", "event_handler", "launch_description_source", "substitution")
)
"""Modules that define a base class; the other classes are in the module with the plural name."""

_PROCESS = (
    "additional_env cached_output cmd condition cwd emulate_tty env log_cmd name on_exit output output_format prefix"
    " respawn respawn_delay respawn_max_retries shell sigkill_timeout sigterm_timeout"
)
_NODE = f"{_PROCESS} arguments exec_name executable namespace package parameters remappings ros_arguments"
_KEYWORDS = {
    "Command": "command on_stderr",
    "ComposableNode": "condition extra_arguments name namespace package parameters plugin remappings",
    "ComposableNodeContainer": f"{_NODE} composable_node_descriptions",
    "DeclareLaunchArgument": "choices condition default_value description name",
    "EmitEvent": "condition event",
    "ExecuteProcess": _PROCESS,
    "FindExecutable": "name",
    "FindPackageShare": "package",
    "GroupAction": "actions condition forwarding launch_configurations scoped",
    "IncludeLaunchDescription": "condition launch_arguments launch_description_source",
    "LaunchConfiguration": "default variable_name",
    "LifecycleNode": f"{_NODE} autostart",
    "LogInfo": "condition msg",
    "LoadComposableNodes": "composable_node_descriptions condition target_container",
    "Node": _NODE,
    "OnExecutionComplete": "handle_once on_completion target_action",
    "OnProcessExit": "handle_once on_exit target_action",
    "OnProcessIO": "handle_once on_stderr on_stdin on_stdout target_action",
    "OnProcessStart": "handle_once on_start target_action",
    "OnShutdown": "handle_once on_shutdown",
    "OpaqueFunction": "args condition function kwargs",
    "ParameterFile": "allow_substs param_file",
    "ParameterValue": "value value_type",
    "PushRosNamespace": "condition namespace",
    "RewrittenYaml": "convert_types key_rewrites param_rewrites root_key source_file value_rewrites",
    "RegisterEventHandler": "condition event_handler",
    "SetEnvironmentVariable": "condition name value",
    "SetParameter": "condition name value",
    "SetRemap": "condition dst src",
    "TimerAction": "actions cancel_on_shutdown condition period",
}
"""Class → keywords (Galactic to Rolling)."""

_REQUIRED = {
    "ComposableNode": "*package plugin",
    "ComposableNodeContainer": "*executable name namespace",
    "EmitEvent": "*event",
    "ExecuteProcess": "*cmd",
    "FindExecutable": "*name",
    "IncludeLaunchDescription": "launch_description_source",
    "LifecycleNode": "*executable name namespace",
    "LoadComposableNodes": "*composable_node_descriptions target_container",
    "LogInfo": "*msg",
    "Node": "*executable",
    "OpaqueFunction": "*function",
    "RegisterEventHandler": "event_handler",
    "RewrittenYaml": "source_file param_rewrites",
    "SetEnvironmentVariable": "name value",
    "SetParameter": "name value",
    "SetRemap": "src dst",
    "TimerAction": "*period actions",
}
"""Class → arguments that a call needs, in order; after a star, arguments that only a keyword passes."""

_OF_XML = {
    "args": "arguments",
    "default": "default_value",
    "exec": "executable",
    "launch_prefix": "prefix",
    "ns": "namespace",
    "param": "parameters",
    "params": "parameters",
    "pkg": "package",
    "remap": "remappings",
    "remapping": "remappings",
    "type": "executable",
}
"""Attribute or element of XML launch files → keyword in Python."""

OF_FOXY = {"node_executable": "executable", "node_name": "name", "node_namespace": "namespace", "node_plugin": "plugin"}
"""Keyword of nodes until Foxy, which Galactic removed → the keyword that replaces it (launch_ros 0.12)."""

_OF_OTHER_EVENT = {"on_exit": "on_start", "on_start": "on_exit"}
"""Keyword of the handler of one event of a process → keyword of the other handler."""

LISTS = frozenset(("arguments", "cmd", "parameters", "remappings", "ros_arguments"))
"""Keywords of nodes and processes whose values are lists."""


def modules() -> dict[str, frozenset[str]]:
    """Return module → its names."""
    pairs = (entry.partition(":") for entry in _MODULES.split(";"))
    return {name.strip(): frozenset(names.split()) for name, _, names in pairs}


def wrong_module(name: str) -> str | None:
    """Return the known module that an imported module misspells; None for other modules."""
    by_module = modules()
    return first_slip(name, by_module) if name not in by_module and name not in _SINGULAR else None


def wrong_import(module: str, name: str) -> str | None:
    """Return the message for a wrong ``from module import name``; None for other imports."""
    by_module = modules()
    names = by_module.get(module)
    if (names is not None and name in names) or f"{module}.{name}" in by_module:
        return None
    if names is not None:
        near = first_slip(name, names)
        if near is not None:
            return f"module `{module}` has no `{name}`" + Suggestion(near, name)
        is_closed = module not in _SINGLE_FILES
    else:
        root, _, rest = module.partition(".")
        is_root = root in ("launch", "launch_ros") and any(other.partition(".")[2] == rest for other in by_module)
        is_closed = is_root or module in _SINGULAR
    homes = [other for other, each in by_module.items() if name in each and "." in other]
    if module in _SINGULAR:
        homes = [other for other in homes if other == f"{module}s"]
    homes.sort(key=lambda other: other.partition(".")[2] != module.partition(".")[2])
    return f"module `{module}` has no `{name}`" + Suggestion(homes[0], name) if is_closed and homes else None


def wrong_keyword(kind: str, word: str) -> str | None:
    """Return the keyword of a class that a word misspells; None for correct and for unknown words."""
    from urdfkit.lint.fix_builders import nearest

    valid = _KEYWORDS.get(kind, "").split()
    if not valid or word in valid:
        return None
    meant = _OF_XML.get(word) or OF_FOXY.get(word) or _OF_OTHER_EVENT.get(word)
    return meant if meant in valid else nearest(word, valid, cutoff=0.75)


def incomplete_call(kind: str, call: ast.Call) -> tuple[ast.expr, str] | None:
    """Return the place and message for a call that passes an argument without its keyword, or lacks one."""
    if kind in ("OnExecutionComplete", "OnProcessExit", "OnProcessIO", "OnProcessStart") and call.args:
        return call.args[0], f"`{kind}` accepts this argument only by keyword; write `target_action=` before it"
    required = _REQUIRED.get(kind, "")
    names, words = required.lstrip("*").split(), {word.arg for word in call.keywords}
    if not names or None in words or any(isinstance(each, ast.Starred) for each in call.args):
        return None
    if required.startswith("*") and call.args:
        return call.args[0], f"`{kind}` accepts this argument only by keyword; write `{names[0]}=` before it"
    lacking = [name for name in names[len(call.args) :] if name not in words]
    if not lacking or any(word not in _KEYWORDS[kind].split() for word in words if word is not None):
        return None
    return call.func, f"`{kind}` needs the argument `{lacking[0]}`"


def differs_by_a_letter(name: str, other: str) -> bool:
    """Return whether two names differ by one letter, by a separator, or by the order of letters in one place."""
    from urdfkit.lint.facts.ros_packages import is_slip

    return name != other and (is_slip(name, other) or name == f"{other}s" or other == f"{name}s")


def first_slip(name: str, others: Iterable[str]) -> str | None:
    """Return the first name that differs from a name by a letter; None without one."""
    return next((other for other in sorted(others) if differs_by_a_letter(name, other)), None)
