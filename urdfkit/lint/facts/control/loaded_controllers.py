"""Controllers that a simulation of the robot loads, with the source positions of their parameters."""

from urdfkit.description.control import Settings, find_configuration, node_settings
from urdfkit.description.control.parameter_files import parameter_file
from urdfkit.description.control.parameter_yaml import parse_settings
from urdfkit.description.control.ros1_controllers import controllers
from urdfkit.description.control.ros2_controllers import configured_controllers, manager_files
from urdfkit.description.hardware_defects import mock_blocks
from urdfkit.description.plugins import match
from urdfkit.description.urdf.robot import Plugin
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Source
from urdfkit.errors import UrdfkitError
from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.model.model import Model


def loaded_controllers(model: Model) -> list[tuple[str, Settings, int]]:
    """Return name, parameters and version of ROS of each controller that a simulation of the robot loads.

    They are those of its Gazebo plugins, or for the target urdfkit of the only file that configures controllers of its
    mock hardware: outside of the simulator, that has any interface. Files that cannot be read have no controllers.
    """
    found: list[tuple[str, Settings, int]] = []
    for plugin, _, _ in plugins(model.robot):
        spec = match(plugin)
        if spec is not None and spec.kind == "ros2_control":
            found += [(name, settings, 2) for name, settings in _of_manager(model, plugin).items()]
        elif spec is not None and spec.kind == "gazebo_ros_control":
            found += [(name, settings, 1) for name, settings in _of_namespace(model, plugin).items()]
    if model.target == "urdfkit" and mock_blocks(model.robot):
        files = manager_files(model.expanded.path)
        source = model.related_files.get(shown_path(files[0])) if len(files) == 1 else None
        root = _read(source) if source is not None else None
        if root is not None:
            configured = configured_controllers(root, "", node_settings(root, "", "controller_manager"))
            found += [(name, settings, 2) for name, settings in configured.items()]
    return found


def _read(source: Source) -> Settings | None:
    try:
        return parse_settings(source, separator=".")
    except UrdfkitError:
        return None


def _of_manager(model: Model, plugin: Plugin) -> dict[str, Settings]:
    """Return the controllers in the parameter files of a plugin of ros2_control."""
    root: Settings | None = None
    for element in plugin.element.find_all("parameters"):
        try:
            path = parameter_file(element.text, model.expanded.packages, model.expanded.path.absolute().parent)
            source = model.related_files.get(shown_path(path))
            read = None if source is None else _read(source)
        except UrdfkitError:
            continue
        root = read if root is None or read is None else root.merged(read)
    if root is None:
        return {}
    ros, name = plugin.element.find("ros"), plugin.element.find("controller_manager_name")
    within = ros.find("namespace") if ros is not None else None
    namespace = "" if within is None else f"/{within.text.strip('/')}".rstrip("/")
    manager = name.text if name is not None and name.text else "controller_manager"
    return configured_controllers(root, namespace, node_settings(root, namespace, manager))


def _of_namespace(model: Model, plugin: Plugin) -> dict[str, Settings]:
    """Return the controllers that a launch file loads into the namespace of gazebo_ros_control."""
    element = plugin.element.find("robotNamespace")
    namespace = (element.text if element is not None else "") or model.robot.name or ""
    try:
        from dataclasses import replace

        robot = replace(model.robot, files=(model.expanded.path,), packages=model.expanded.packages)
        found = find_configuration(robot, f"/{namespace.strip('/')}".rstrip("/"))
    except UrdfkitError:
        return {}
    return {} if found is None else controllers(found.settings)
