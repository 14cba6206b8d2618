"""Launch files and descriptions that receive arguments: the names that they accept."""

from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.packages.existence import is_file
from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.reader import read_source, shown_path
from urdfkit.errors import ResourceError
from urdfkit.lint.facts.launch.actions import actions_of
from urdfkit.lint.facts.launch.records import Call, LaunchActions
from urdfkit.lint.model.model import Model

_GZ = "gz_args gz_version ign_args ign_version debugger on_exit_shutdown"
_EMPTY_WORLD = (
    "paused use_sim_time gui headless world_name debug verbose physics respawn_gazebo recording use_clock_frequency"
    " pub_clock_frequency enable_ros_network server_required gui_required extra_gazebo_args command_arg1 command_arg2"
    " command_arg3 script_type output"
)
_GZSERVER = (
    "world version verbose lockstep help pause initial_sim_time physics play record record_encoding record_path"
    " record_period record_filter seed iters minimal_comms profile extra_gazebo_args params_file gdb valgrind init"
    " factory force_system server_required"
)
_GZCLIENT = "version verbose help extra_gazebo_args gdb valgrind gui_required"
_NAV2 = "namespace use_sim_time params_file autostart use_composition container_name use_respawn log_level graph"
_SLAM = "use_sim_time slam_params_file autostart use_lifecycle_manager namespace"
OUTSIDE = {
    **dict.fromkeys(
        (("slam_toolbox", f"{name}_launch.py") for name in ("online_async", "online_sync", "localization", "lifelong")),
        _SLAM,
    ),
    ("nav2_bringup", "bringup_launch.py"): f"{_NAV2} use_namespace slam map use_localization keepout_mask speed_mask",
    ("nav2_bringup", "localization_launch.py"): f"{_NAV2} map",
    ("nav2_bringup", "navigation_launch.py"): _NAV2,
    ("gazebo_ros", "empty_world.launch"): _EMPTY_WORLD,
    ("gazebo_ros", "gazebo.launch.py"): f"gui server {_GZSERVER} {_GZCLIENT}",
    ("gazebo_ros", "gzserver.launch.py"): _GZSERVER,
    ("gazebo_ros", "gzclient.launch.py"): _GZCLIENT,
    ("ros_gz_sim", "gz_sim.launch.py"): _GZ,
    ("ros_gz_sim", "gz_spawn_model.launch.py"): "world file string model_string topic entity_name allow_renaming"
    " x y z R P Y",
    ("ros_ign_gazebo", "ign_gazebo.launch.py"): _GZ,
}
"""Launch files from outside → their arguments.

Sources: gazebo_ros (Noetic and Foxy to Humble), ros_gz (Jazzy), nav2_bringup and slam_toolbox (Humble to Jazzy).
"""

COMPLETE = frozenset(("gazebo_ros", f"{each}.launch.py") for each in ("gazebo", "gzserver", "gzclient"))
"""Launch files of ROS 2 from outside of which `OUTSIDE` has all arguments of all releases."""

EVERYWHERE = ("use_sim_time",)
"""Arguments that many files pass to launch files that do not declare them, without effect and without harm."""

_FILES = {
    "gazebo_ros": "empty_world.launch gazebo.launch.py gzserver.launch.py gzclient.launch.py mud_world.launch"
    " elevator_world.launch range_world.launch rubble_world.launch shapes_world.launch willowgarage_world.launch",
    "ros_gz_sim": "gz_sim.launch.py gz_server.launch.py gz_spawn_model.launch.py ros_gz_sim.launch.py"
    " ros_gz_spawn_model.launch.py gz_remove_model.launch.py",
    "nav2_bringup": "bringup_launch.py navigation_launch.py localization_launch.py slam_launch.py rviz_launch.py",
    "slam_toolbox": "online_async_launch.py online_sync_launch.py offline_launch.py localization_launch.py",
    "urdf_launch": "display.launch.py description.launch.py",
}
"""Package from outside → some of its launch files."""

_WHOLE = ("gazebo_ros", "ros_gz_sim")
"""Packages of which all launch files in all releases are known."""

_MAX_FILES = 50


def receiver(call: Call, model: Model) -> Path | None:
    """Return the file of a call in the packages next to the robot's; None if it is elsewhere."""
    package = neighbours(model.package).get(call.package) if model.package is not None and call.package else None
    if package is None:
        return None
    model.expanded.packages.watch(package)
    file = package / call.path
    return file if is_file(file) else None


def misspelt_file(call: Call) -> str | None:
    """Return the launch file of a package from outside that a call misspells; None without one.

    If only some files of the package are known, the names must differ by one letter.
    """
    from urdfkit.lint.facts.ros_packages import is_slip
    from urdfkit.lint.fix_builders import nearest

    files, written = _FILES.get(call.package, "").split(), call.path.rpartition("/")[2]
    is_whole = call.package in _WHOLE and written.endswith((".launch", ".py"))
    near = nearest(written, files, cutoff=0.6 if is_whole else 0.8) if written and written not in files else None
    is_near = near is not None and (is_whole or is_slip(written.replace(".", "_"), near.replace(".", "_")))
    return near if is_near else None


def actions_at(path: Path, model: Model) -> LaunchActions | None:
    """Return the actions of an included launch file; None if it cannot be read."""
    name = shown_path(path)
    try:
        return actions_of(model.related_files.get(name) or read_source(path, shown_as=name, texts=model.texts))
    except ResourceError:
        return None


def included_files(first: LaunchActions, model: Model) -> Iterator[LaunchActions | None]:
    """Yield a launch file and the files that it includes, directly or indirectly; None for each that is not found."""
    pending, seen = [first], set[str]()
    while pending and len(seen) < _MAX_FILES:
        file = pending.pop()
        if file.source.file in seen:
            continue
        seen.add(file.source.file)
        yield file
        for call in file.includes:
            path = receiver(call, model)
            actions = actions_at(path, model) if path is not None else None
            if actions is None and (call.package, call.path.rpartition("/")[2]) not in OUTSIDE:
                yield None
            elif actions is None:
                continue
            else:
                pending.append(actions)
