"""Elements and attributes of XML launch files: of roslaunch (ROS 1) and of launch_xml (ROS 2)."""

from collections.abc import Mapping

from urdfkit.record import record

ANY = "*"
"""Parent that accepts each action."""


@record(eq=False)
class LaunchElement:
    """An element of a launch file.

    Attributes:
        attributes: its attributes, without ``if`` and ``unless``.
        required: the attributes that it needs; of names joined with ``|``, one.
        children: the elements in it; `ANY` if it contains actions.
    """

    attributes: tuple[str, ...]
    required: tuple[str, ...] = ()
    children: tuple[str, ...] = ()


def _table(text: str) -> dict[str, LaunchElement]:
    """Read lines of the form ``element: attributes, with ! if required > children``."""
    found = {}
    for line in text.strip().splitlines():
        name, _, rest = line.partition(":")
        attributes, _, children = rest.partition(">")
        words = attributes.split()
        required = tuple(word.strip("!") for word in words if word.endswith("!"))
        names = tuple(name for word in words for name in word.strip("!").split("|"))
        found[name.strip()] = LaunchElement(names, required, tuple(children.split()))
    return found


_NODE1 = "pkg! type! machine args output respawn respawn_delay cwd ns clear_params launch-prefix required"
_PROCESS2 = (
    "cwd name launch-prefix output output_format respawn respawn_delay respawn_max_retries shell emulate_tty log_cmd"
    " cached_output sigterm_timeout sigkill_timeout additional_env"
)
_NODE2 = f"pkg exec! namespace args ros_args exec_name node-name node_name {_PROCESS2}"

ELEMENTS: Mapping[int, Mapping[str, LaunchElement]] = {
    1: _table(
        f"""launch: deprecated > *
        group: ns clear_params > *
        node: name! {_NODE1} > remap param rosparam env
        test: test-name! name time-limit retry {_NODE1} > remap param rosparam env
        machine: name! address! env-loader ssh-port user password default timeout ros-root ros-package-path > env
        include: file! ns clear_params pass_all_args > env arg
        arg: name! value default doc
        remap: from! to!
        env: name! value!
        param: name! type value|textfile|binfile|command!
        rosparam: command ns file param subst_value
        master: auto type uri"""
    ),
    2: _table(
        f"""launch: version deprecated > *
        group: scoped forwarding > * keep
        keep: name! value!
        node: {_NODE2} > param remap env
        lifecycle_node: {_NODE2} autostart > param remap env
        node_container: {_NODE2} > param remap env composable_node
        load_composable_node: target! > composable_node
        composable_node: pkg! plugin! name namespace > param remap extra_arg
        extra_arg: name! value!
        executable: cmd! args {_PROCESS2} > env
        include: file! > arg let
        arg: name! default description value > choice
        choice: value!
        let: name! value!
        param: name|from! value type sep value-sep allow_substs > param
        remap: from! to!
        env: name! value!
        set_env: name! value! separator
        unset_env: name!
        append_env: name! value! prepend separator
        push-ros-namespace: namespace!
        push_ros_namespace: namespace!
        set_parameter: name! value!
        set_parameters_from_file: filename! node_name
        set_remap: from! to!
        set_use_sim_time: value!
        timer: period! > *
        ros_timer: period! > *
        log: message level
        log_info: message
        shutdown: reason
        reset: > keep
        unset: name!"""
    ),
}
"""ROS version → element → its parts; packages can add actions in ROS 2."""

ACTIONS: Mapping[int, frozenset[str]] = {
    1: frozenset(ELEMENTS[1]) - {"launch"},
    2: frozenset(ELEMENTS[2]) - {"launch", "keep", "extra_arg", "choice", "env", "param", "remap"},
}
"""ROS version → the elements that are actions."""

OTHER_WORDS: Mapping[int, Mapping[str, str]] = {
    1: {"exec": "type", "namespace": "ns", "launch_prefix": "launch-prefix", "description": "doc"},
    2: {"type": "exec", "ns": "namespace", "launch_prefix": "launch-prefix", "doc": "description"},
}
"""ROS version → attribute of the other version or of Python → attribute in this version."""

OTHER_SUBSTITUTIONS: Mapping[int, Mapping[str, str]] = {
    1: {"find-pkg-share": "find", "var": "arg"},
    2: {"find": "find-pkg-share", "arg": "var", "optenv": "env"},
}
"""ROS version → substitution of the other version → substitution of this version."""

SUBSTITUTIONS: Mapping[int, tuple[str, ...]] = {
    1: ("anon", "arg", "dirname", "env", "eval", "find", "optenv"),
    2: (
        *("and", "anon", "any", "all", "command", "dirname", "env", "equals", "eval", "exec-in-pkg", "find-exec"),
        *("file-content", "find-pkg-prefix", "find-pkg-share", "if", "not", "not-equals", "or", "var"),
    ),
}
"""ROS version → substitutions; in ROS 2, packages may register others.

Sources: http://wiki.ros.org/roslaunch/XML and https://design.ros2.org/articles/roslaunch_xml.html, launch 3.8.
"""

OTHER_ELEMENTS: Mapping[int, Mapping[str, str]] = {
    1: {"let": "arg", "executable": "node", "set_env": "env", "push-ros-namespace": "group ns"},
    2: {
        "rosparam": "param from",
        "machine": "",
        "test": "",
        "param": "set_parameter",
        "remap": "set_remap",
        "env": "set_env",
    },
}
"""ROS version → element that is no action in it → what to use instead."""

OUTPUTS: Mapping[int, tuple[str, ...]] = {1: ("screen", "log"), 2: ("screen", "log", "both", "own_log", "full")}
"""ROS version → values of ``output`` (roslaunch: xmlloader.py; launch: logging/__init__.py)."""


def is_output(text: str, version: int) -> bool:
    """Return whether a text is a value of ``output``, or computed."""
    return "$" in text or text in OUTPUTS[version]
