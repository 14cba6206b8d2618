"""Controllers that a controller manager of ROS 2 loads."""

from contextlib import suppress
from pathlib import Path

from urdfkit.description.control.parameter_yaml import node_settings, read_settings
from urdfkit.description.control.ros1_controllers import packages_around
from urdfkit.description.control.settings import Settings
from urdfkit.errors import UrdfkitError


def configured_controllers(root: Settings, namespace: str, manager: Settings) -> dict[str, Settings]:
    """Return name → parameters of each controller with a ``type``, at the controller manager or at its own node.

    Args:
        root: the parameters of all nodes.
        namespace: namespace of the controller manager.
        manager: the parameters of the controller manager.
    """
    configured = {}
    for name, entry in manager.children.items():
        if (kind := entry.children.get("type")) is not None and kind.value:
            own = node_settings(root, namespace, name)
            children = {**own.children, "type": kind}
            configured[name] = Settings(name, own.position, None, None, children, own.key or entry.key)
    for path, _ in root.walk():
        node, _, last = path.rpartition("/")
        name = node.rpartition("/")[2]
        if last == "ros__parameters" and name not in configured:
            own = node_settings(root, namespace, name)
            if (kind := own.children.get("type")) is not None and "/" in (kind.value or ""):
                configured[name] = own
    return configured


def manager_files(description: Path) -> tuple[Path, ...]:
    """Return the YAML files that configure controllers of ``controller_manager``, in the nearest package with any.

    The ``config`` folders of the description's package, also those one folder below, and those of similarly named
    neighbouring packages are searched.
    """
    for folder in packages_around(description)[0]:
        found = []
        for path in sorted([*folder.glob("config/*.y*ml"), *folder.glob("*/config/*.y*ml")]):
            with suppress(UrdfkitError):  # a broken file may belong to another node
                root = read_settings(path, separator=".")
                if configured_controllers(root, "", node_settings(root, "", "controller_manager")):
                    found.append(path)
        if found:
            return tuple(found)
    return ()
