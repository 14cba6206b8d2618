"""The document element of a robot description, and the formats that other document elements belong to."""

from urdfkit.description.xml.element import Element
from urdfkit.errors import ModelError, did_you_mean

OTHER_ROOTS = {
    "sdf": "an SDF file",
    "gazebo": "an SDF file",
    "mujoco": "an MJCF file (MuJoCo)",
    "mujocoinclude": "an MJCF file (MuJoCo)",
    "collada": "a COLLADA mesh",
    "launch": "a launch file",
    "package": "a package manifest",
}
"""Root element of a file that is no robot description → its format."""


def check_is_robot(root: Element) -> None:
    """Raise unless the document element is ``<robot>``.

    Args:
        root: the document element.

    Raises:
        ModelError: the document element is another one; the message contains its name.
    """
    if root.tag == "robot":
        return
    kind = OTHER_ROOTS.get(root.tag.lower())
    what = f"this is {kind}, not a robot description" if kind else f"the root element is <{root.tag}>, not <robot>"
    raise ModelError(f"{what}{'' if kind else did_you_mean(root.tag, ['robot'])}", position=root.origin.position)
