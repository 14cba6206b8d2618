"""Missing ``xacro:`` prefixes, and the edits that add them."""

import re
from collections.abc import Iterator

from urdfkit.description.xacro.recovery.missing_prefix import FOREIGN as FOREIGN
from urdfkit.description.xacro.recovery.missing_prefix import is_directive, may_be_directive_inside
from urdfkit.description.xml.element import Element
from urdfkit.lint.finding import Edit
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.record import record

NAMESPACE = "http://www.ros.org/wiki/xacro"
"""Namespace URI of ``xmlns:xacro``."""

URDF_CHILDREN: dict[str, frozenset[str]] = {
    "robot": frozenset(("link", "joint", "material", "transmission", "gazebo", "ros2_control", "sensor")),
    "link": frozenset(("inertial", "visual", "collision", "contact", "type")),
    "inertial": frozenset(("origin", "mass", "inertia")),
    "visual": frozenset(("origin", "geometry", "material")),
    "collision": frozenset(("origin", "geometry", "material", "verbose")),
    "geometry": frozenset(("box", "cylinder", "sphere", "capsule", "mesh")),
    "material": frozenset(("color", "texture")),
    "joint": frozenset(
        ("origin", "parent", "child", "axis", "limit", "dynamics", "mimic", "safety_controller", "calibration")
    ),
}
"""URDF element → its allowed children (http://wiki.ros.org/urdf/XML)."""

_NAME = ("name",)
URDF_ATTRIBUTES: dict[str, tuple[str, ...]] = {
    "link": ("name", "type"),
    "joint": ("name", "type"),
    "inertial": (),
    "visual": _NAME,
    "collision": _NAME,
    "geometry": (),
    "origin": ("xyz", "rpy", "quat_xyzw"),
    "mass": ("value",),
    "inertia": ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"),
    "box": ("size",),
    "cylinder": ("radius", "length"),
    "sphere": ("radius",),
    "capsule": ("radius", "length"),
    "mesh": ("filename", "scale"),
    "material": _NAME,
    "color": ("rgba",),
    "texture": ("filename",),
    "parent": ("link",),
    "child": ("link",),
    "axis": ("xyz",),
    "limit": ("lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk"),
    "dynamics": ("damping", "friction"),
    "mimic": ("joint", "multiplier", "offset"),
    "safety_controller": ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"),
    "calibration": ("rising", "falling", "reference_position"),
}
"""Attributes of the URDF elements (urdfdom 4.0 and http://wiki.ros.org/urdf/XML)."""

URDF_ELEMENTS = frozenset(URDF_CHILDREN).union(*URDF_CHILDREN.values())

_CUTOFF = 0.8
"""Minimum similarity to the name of an element (`difflib.SequenceMatcher.ratio`): `lnk`, `joit`, `gazeebo`."""

# Compiled on first use; most files need none of these patterns.
_XACRO_URI = r"https?://(www\.)?(wiki\.)?ros\.org/(wiki/)?xacro/?"
_DEFINITION = r"<(?:xacro:)?macro\s[^<>]*?\bname\s*=\s*[\"'](?:xacro:)?([^\"']+)[\"'][^<>]*>"
_PARAMS = r"\bparams\s*=\s*(?:\"([^\"]*)\"|'([^']*)')"
_PARAMETER = r"([^\s:=,;]+)(\s*:?=\s*(?:\^\|?)?(?:'[^']*'|\"[^\"]*\"|[^\s]*))?"


@record
class Signature:
    """The parameters of a macro, without blocks.

    Attributes:
        names: all parameters.
        required: parameters without default.
    """

    names: frozenset[str]
    required: frozenset[str]


def signatures(text: str) -> Iterator[tuple[str, Signature]]:
    """Yield name and parameters of each macro that a text defines, with prefix or without."""
    if "macro" not in text:
        return
    for definition in re.finditer(_DEFINITION, text):
        params = re.search(_PARAMS, definition[0])
        written = re.findall(_PARAMETER, (params[1] or params[2] or "") if params else "")
        values = [(name, default) for name, default in written if not name.startswith("*")]
        required = frozenset(name for name, default in values if not default)
        yield definition[1], Signature(frozenset(name for name, _ in values), required)


def is_unprefixed_directive(tag: Tag) -> bool:
    """Return whether the tag is a xacro directive that lacks its prefix."""
    attributes = tag.attributes
    if not is_directive(tag.name, attributes):
        return False
    value = attributes["value"].value if "value" in attributes else ""
    return may_be_directive_inside((above.name for above in tag.ancestors()), tag.name, value)


def declares_xacro(document: Document) -> bool:
    """Return whether the root element binds the prefix."""
    return any("xmlns:xacro" in root.attributes for root in document.roots[:1])


def has_xacro_as_default(document: Document) -> bool:
    """Return whether the root element declares xacro's namespace as the default namespace."""
    default = document.roots[0].attributes.get("xmlns") if document.roots else None
    return default is not None and re.fullmatch(_XACRO_URI, default.value) is not None


def declaration(document: Document) -> tuple[Edit, ...]:
    """Return the edit that binds the prefix on the root element; empty if it is bound.

    A default namespace with the URI of xacro (``xmlns="http://www.ros.org/wiki/xacro"``) is renamed.
    """
    if declares_xacro(document) or not document.roots:
        return ()
    root, source = document.roots[0], document.source
    attributes = root.attributes
    if has_xacro_as_default(document):
        start = attributes["xmlns"].start
        return (Edit(source.span(start, start + len("xmlns")), "xmlns:xacro"),)
    end = max((attribute.end for attribute in attributes.values()), default=root.start + 1 + len(root.name))
    return (Edit(source.span(end, end), f' xmlns:xacro="{NAMESPACE}"'),)


def prefixing(document: Document, tag: Tag) -> tuple[Edit, ...]:
    """Return the edits that add the prefix to a tag and its end tag, and bind the prefix if necessary."""
    source = document.source
    edits = [*declaration(document), Edit(source.span(tag.start + 1, tag.start + 1), "xacro:")]
    if tag.close is not None:
        edits.append(Edit(source.span(tag.close + 2, tag.close + 2), "xacro:"))
    return tuple(edits)


def misspelt_in_robot(element: Element) -> str | None:
    """Return the child of ``<robot>`` most similar to a misspelt element; None if the element is valid or unlike all.

    Args:
        element: a child of ``<robot>``.
    """
    tag = element.tag
    if tag in URDF_CHILDREN["robot"] or tag in URDF_ELEMENTS or ":" in tag or len(tag) < 3:
        return None
    if tag.endswith("s") and "name" not in element.attributes:
        return None  # <joints> as a container: an extension
    from difflib import get_close_matches

    candidates = URDF_CHILDREN["robot"]
    return next(iter(get_close_matches(tag.lower(), sorted(candidates), n=1, cutoff=_CUTOFF)), None)
