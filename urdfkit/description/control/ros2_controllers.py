"""Controllers that a controller manager of ROS 2 loads."""

from urdfkit.description.control.parameter_yaml import node_settings
from urdfkit.description.control.settings import Settings


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
