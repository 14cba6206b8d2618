"""MoveIt's settings in YAML: solvers by group, limits by joint, and controllers.

Sources: moveit2, moveit_ros/planning/kinematics_plugin_loader, moveit_core/joint_limits (common),
moveit_plugins/moveit_simple_controller_manager (Noetic to Rolling).
"""

from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.packages.related_files import package_of
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, documents, yamls
from urdfkit.lint.model.model import Model
from urdfkit.record import record

SOLVER_KEYS = (
    *("kinematics_solver", "kinematics_solver_search_resolution", "kinematics_solver_timeout", "position_only_ik"),
    *(
        "kinematics_solver_attempts",
        "kinematics_solver_ik_links",
        "epsilon",
        "solve_type",
        "mode",
        "orientation_vs_position",
    ),
    *("goal_joint_tolerance", "goal_position_tolerance", "goal_orientation_tolerance", "max_solver_iterations"),
)
SOLVERS = (
    *("kdl_kinematics_plugin/KDLKinematicsPlugin", "lma_kinematics_plugin/LMAKinematicsPlugin"),
    *("srv_kinematics_plugin/SrvKinematicsPlugin", "cached_ik_kinematics_plugin/CachedKDLKinematicsPlugin"),
    *("cached_ik_kinematics_plugin/CachedTRACKinematicsPlugin", "trac_ik_kinematics_plugin/TRAC_IKKinematicsPlugin"),
    *("pick_ik/PickIkPlugin", "bio_ik/BioIKKinematicsPlugin"),
)
LIMIT_KEYS = (
    *(f"has_{name}_limits" for name in ("position", "velocity", "acceleration", "deceleration", "jerk", "effort")),
    *(f"max_{name}" for name in ("position", "velocity", "acceleration", "deceleration", "jerk", "effort")),
    *("min_position", "min_velocity", "has_soft_limits", "k_position", "k_velocity", "soft_lower_limit"),
    *("soft_upper_limit", "angle_wraparound"),
)
CONTROLLER_KEYS = ("name", "type", "action_ns", "default", "joints", "max_effort", "parallel", "command_joint", "ns")
CONTROLLER_TYPES = ("FollowJointTrajectory", "GripperCommand", "ParallelGripperCommand")
OTHER_CONTROLLER_TYPES = ("fake", "interpolate", "via points", "last point", "Empty")
_WRAPPERS = ("ros__parameters", "robot_description_planning", "robot_description_kinematics")


@record(eq=False)
class MoveitEntry:
    """The settings of one group, joint or controller.

    Attributes:
        kind: ``group``, ``joint`` or ``controller``.
        name: YAML node of the name.
        settings: its settings.
    """

    kind: str
    name: Node
    settings: Node


def moveit_yamls(model: Model) -> Iterator[tuple[Source, Element]]:
    """Yield the YAML files in packages with an SRDF of the robot, with the root element of the SRDF."""
    from urdfkit.lint.facts.moveit.srdf import semantics_of

    packages = {package_of(Path(root.origin.position.file)): root for root in semantics_of(model)}
    if packages:
        for source in yamls(model):
            root = packages.get(package_of(Path(source.file)))
            if root is not None:
                yield source, root


def entries(source: Source) -> Iterator[MoveitEntry]:
    """Yield the groups, joints and controllers that a MoveIt YAML file configures."""
    for document in documents(source):
        for top in unwrapped(document):
            for key, value in top.entries:
                if key.text == "joint_limits":
                    yield from (
                        MoveitEntry("joint", name, each) for name, each in value.entries if each.kind == "group"
                    )
                elif key.text == "controller_list":
                    names = ((item.find("name"), item) for item in value.items)
                    yield from (MoveitEntry("controller", name, item) for name, item in names if name is not None)
                elif key.text == "moveit_simple_controller_manager":
                    for name, each in value.entries:
                        if each.find("type") is not None or each.find("joints") is not None:
                            yield MoveitEntry("controller", name, each)
                elif any(name.text.startswith("kinematics_solver") for name, _ in value.entries):
                    yield MoveitEntry("group", key, value)


def controller_names(source: Source) -> Iterator[tuple[list[Node], list[Node]]]:
    """Yield the names in ``controller_names`` of moveit_simple_controller_manager, and the names of its sections."""
    for document in documents(source):
        for top in unwrapped(document):
            value = top.find("moveit_simple_controller_manager")
            names = value.find("controller_names") if value is not None else None
            if value is not None and names is not None:
                yield list(names.items), [name for name, each in value.entries if each.kind == "group"]


def unwrapped(document: Node) -> Iterator[Node]:
    """Yield the mappings of a document without the names of the node and of ``ros__parameters``."""
    yield document
    for key, value in document.entries:
        if key.text in _WRAPPERS or value.find("ros__parameters") is not None:
            yield from unwrapped(value)


def integer_limits(source: Source) -> Iterator[tuple[Node, str]]:
    """Yield the limits of joints and of Cartesian motion that are integers, with their names; MoveIt 2 reads doubles.

    Its setup assistant writes such integers (moveit2, issue 2776).
    """
    for document in documents(source):
        for top in unwrapped(document):
            groups = [each.settings for each in entries(source) if each.kind == "joint"] if top is document else []
            groups += [value for key, value in top.entries if key.text == "cartesian_limits"]
            for group, name, value in ((each, key.text, value) for each in groups for key, value in each.entries):
                flag = group.find(f"has_{name[4:]}_limits")
                is_read = name.startswith(("max_", "min_")) and (flag is None or flag.text.lower() != "false")
                if is_read and value.is_plain and value.text.lstrip("+-").isdecimal():
                    yield value, name
