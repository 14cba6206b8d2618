"""Mistakes in links and joints of the description."""

from __future__ import annotations

import math
import random
import re
from collections.abc import Iterator
from dataclasses import replace

from tests.bench.package_mutants.mutant import (
    Mutant,
    Workspace,
    attribute,
    element,
    kind,
    literal,
    numbers,
    renamed_tag,
    typo,
    value,
    wrong_name,
)

_MODEL = kind("model")
Mutants = Iterator[Mutant]

_DEFAULTS = {("xyz", "0 0 0"), ("rpy", "0 0 0"), ("lower", "0"), ("upper", "0"), ("lower", "0.0")}
"""Values that a reader uses where the attribute is missing: without them nothing breaks."""


def _shown(values: list[float]) -> str:
    return " ".join(f"{each:.6g}" for each in values)


@_MODEL
def typo_in_parent_or_child(ws: Workspace, lot: random.Random) -> Mutants:
    """The joint refers to a link that does not exist: no parser loads the robot."""
    for file, tag in ws.model_tags("parent", "child"):
        name = literal(tag, "link")
        if name:
            yield wrong_name(file, tag, "link", typo(name, lot, ws.links))


@_MODEL
def renamed_joint(ws: Workspace, lot: random.Random) -> Mutants:
    """A joint has another name than in its controllers, transmissions or plugins: they do not find it."""
    for file, tag in ws.model_tags("joint"):
        name = literal(tag, "name")
        if (
            name
            and "type" in tag.attributes
            and ws.joints.get(name) not in (None, "fixed")
            and ws.uses(name, outside=file)
        ):
            yield wrong_name(file, tag, "name", typo(name, lot, ws.joints), uses=True)


@_MODEL
def renamed_link(ws: Workspace, lot: random.Random) -> Mutants:
    """A link has another name than in its joints."""
    for file, tag in ws.model_tags("link"):
        name = literal(tag, "name")
        if name and len(ws.links) > 1:
            yield wrong_name(file, tag, "name", typo(name, lot, ws.links), uses=True)


@_MODEL
def limit_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """A revolute or prismatic joint needs a limit: urdfdom refuses the robot."""
    for file, tag in ws.model_tags("limit", parent="joint"):
        if tag.parent is not None and literal(tag.parent, "type") in ("revolute", "prismatic"):
            yield element(file, tag)


@_MODEL
def limits_swapped(ws: Workspace, lot: random.Random) -> Mutants:
    """Lower is above upper: the joint cannot be anywhere."""
    for file, tag in ws.model_tags("limit", parent="joint"):
        lower, upper = tag.attributes.get("lower"), tag.attributes.get("upper")
        if lower is not None and upper is not None:
            middle = tag._text[lower.value_end : upper.value_start]
            new = f"{upper.value}{middle}{lower.value}"
            if lower.start < upper.start:
                yield Mutant(file, lower.value_start, upper.value_end, new, (tag.start, tag.end), (tag.start, tag.end))


@_MODEL
def limits_in_degrees(ws: Workspace, lot: random.Random) -> Mutants:
    """The joint turns dozens of times further than it can."""
    for file, tag in ws.model_tags("limit", parent="joint"):
        if tag.parent is None or literal(tag.parent, "type") != "revolute":
            continue
        lower, upper = literal(tag, "lower"), literal(tag, "upper")
        if lower and upper:
            low, high = tag.attributes["lower"], tag.attributes["upper"]
            middle = tag._text[low.value_end : high.value_start]
            new = f"{math.degrees(float(lower)):.0f}{middle}{math.degrees(float(upper)):.0f}"
            yield Mutant(file, low.value_start, high.value_end, new, (tag.start, tag.end), (tag.start, tag.end))
    for file, tag in ws.model_tags("xacro:turn"):
        if literal(tag, "limit"):
            yield value(file, tag, "limit", f"{math.degrees(float(literal(tag, 'limit'))):.0f}")


@_MODEL
def limit_attribute_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """Effort and velocity are required; without lower and upper the joint stays at 0."""
    for file, tag in ws.model_tags("limit", parent="joint"):
        revolute = tag.parent is not None and literal(tag.parent, "type") in ("revolute", "prismatic")
        for name in ("effort", "velocity", "upper") if revolute else ("effort", "velocity"):
            if name in tag.attributes:
                yield attribute(file, tag, name, "")


@_MODEL
def limit_zero_or_negative(ws: Workspace, lot: random.Random) -> Mutants:
    """A joint without effort or speed does not move."""
    for file, tag in ws.model_tags("limit", parent="joint"):
        for name in ("effort", "velocity"):
            if literal(tag, name):
                yield value(file, tag, name, lot.choice(["0", "-1", "-10"]))


@_MODEL
def joint_origin_in_millimetres(ws: Workspace, lot: random.Random) -> Mutants:
    """The next link is dozens of metres away."""
    for file, tag in ws.model_tags("origin", parent="joint"):
        xyz = numbers(literal(tag, "xyz"))
        if any(abs(each) >= 0.02 for each in xyz):
            yield value(file, tag, "xyz", _shown([1000 * each for each in xyz]))


@_MODEL
def inertial_origin_in_millimetres(ws: Workspace, lot: random.Random) -> Mutants:
    """The centre of mass is metres outside of the link."""
    for file, tag in ws.model_tags("origin"):
        xyz = numbers(literal(tag, "xyz"))
        if tag.parent is not None and tag.parent.name.endswith(("inertial", "inertia")) and any(xyz):
            yield value(file, tag, "xyz", _shown([1000 * each for each in xyz]))


@_MODEL
def angles_in_degrees(ws: Workspace, lot: random.Random) -> Mutants:
    """An angle of 90 rad is a wild one."""
    for file, tag in ws.model_tags("origin"):
        if "rpy" in tag.attributes:
            written = tag.attributes["rpy"].value
            turned = re.sub(r"\$\{(-?)pi/2\}", r"\g<1>90", written)
            yield value(file, tag, "rpy", turned if turned != written else lot.choice(["0 0 90", "0 90 0", "180 0 0"]))


@_MODEL
def vector_of_wrong_length(ws: Workspace, lot: random.Random) -> Mutants:
    """A vector needs three numbers, separated by spaces."""
    for file, tag in ws.model_tags("origin", "axis"):
        for name in ("xyz", "rpy"):
            words = literal(tag, name).split()
            if len(words) == 3:
                yield value(
                    file, tag, name, lot.choice([" ".join(words[:2]), ",".join(words), " ".join([*words, "0"])])
                )


@_MODEL
def unreadable_number(ws: Workspace, lot: random.Random) -> Mutants:
    """A decimal comma, a unit or a letter is no number."""
    for file, tag in ws.model_tags("mass", "cylinder", "sphere", "limit", "dynamics", "inertia"):
        for name, written in tag.attributes.items():
            if "." in written.value and numbers(written.value):
                wrong = [written.value.replace(".", ","), f"{written.value}m", written.value.replace("0", "O", 1)]
                yield value(file, tag, name, lot.choice([each for each in wrong if each != written.value]))


@_MODEL
def bad_axis(ws: Workspace, lot: random.Random) -> Mutants:
    """An axis of length 0 has no direction."""
    for file, tag in ws.model_tags("axis"):
        yield value(file, tag, "xyz", "0 0 0")


@_MODEL
def axis_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The joint turns about x instead of its own axis, along the arm or through the wheel."""
    for file, tag in ws.model_tags("axis"):
        if literal(tag, "xyz") in ("0 0 1", "0 1 0"):
            yield element(file, tag)


@_MODEL
def unknown_joint_type(ws: Workspace, lot: random.Random) -> Mutants:
    """Parsers refuse an unknown type of joint."""
    for file, tag in ws.model_tags("joint"):
        kind_ = literal(tag, "type")
        if kind_:
            yield wrong_name(file, tag, "type", lot.choice([typo(kind_, lot), kind_.capitalize(), "hinge", "rotary"]))


@_MODEL
def commanded_joint_is_fixed(ws: Workspace, lot: random.Random) -> Mutants:
    """A controller commands a joint that cannot move; its axis and its limit contradict the type."""
    for file, tag in ws.model_tags("joint"):
        names = ws.expanded_names(file, tag)
        used = any(ws.uses(name, outside=file) for name in names)
        if literal(tag, "type") in ("revolute", "prismatic", "continuous") and used:
            whole = (tag.start, tag.close_end)
            yield replace(value(file, tag, "type", "fixed", names=names, uses=True), also=whole)


@_MODEL
def joint_type_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """A joint needs a type."""
    for file, tag in ws.model_tags("joint"):
        if "type" in tag.attributes:
            yield attribute(file, tag, "type", "")


@_MODEL
def duplicated_name(ws: Workspace, lot: random.Random) -> Mutants:
    """Two links or joints of one name, as after copying: parsers refuse the robot."""
    for file, tag in ws.model_tags("link", "joint"):
        if literal(tag, "name") and (tag.name == "link" or "type" in tag.attributes):
            others = [
                literal(other, "name")
                for other in ws.document(file).walk()
                if other.name == tag.name and other is not tag and ("type" in other.attributes or tag.name == "link")
            ]
            others = [name for name in others if name]
            if others:
                yield wrong_name(file, tag, "name", lot.choice(others), uses=True)


@_MODEL
def unknown_attribute(ws: Workspace, lot: random.Random) -> Mutants:
    """A misspelt attribute is not read, so the value is missing or a default."""
    required = {
        "xyz",
        "rpy",
        "radius",
        "length",
        "size",
        "value",
        "lower",
        "upper",
        "filename",
        "link",
        "rgba",
        "ixx",
        "izz",
    }
    for file, tag in ws.model_tags():
        if not tag.name.startswith("xacro:"):
            for name, written in tag.attributes.items():
                if name in required and (name, written.value) not in _DEFAULTS:
                    yield attribute(file, tag, name, typo(name, lot))


@_MODEL
def unknown_element(ws: Workspace, lot: random.Random) -> Mutants:
    """A misspelt element is not read: the link loses its shape, mass or frame."""
    names = (
        "visual",
        "collision",
        "inertial",
        "origin",
        "geometry",
        "limit",
        "axis",
        "mass",
        "inertia",
        "child",
        "mimic",
    )
    for file, tag in ws.model_tags(*names):
        if any((name, written.value) not in _DEFAULTS for name, written in tag.attributes.items()) or tag.children:
            yield renamed_tag(file, tag, typo(tag.name, lot))


@_MODEL
def end_tag_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The file is no XML."""
    for file, tag in ws.model_tags("link", "joint", "visual", "collision", "geometry", "inertial", "gazebo", "plugin"):
        if tag.close is not None:
            whole = (tag.start, tag.parent.close_end if tag.parent is not None else tag.close_end)
            yield Mutant(file, tag.close, tag.close_end, "", (tag.start, tag.end), whole)


@_MODEL
def no_xml(ws: Workspace, lot: random.Random) -> Mutants:
    """An unquoted value, a missing bracket or a bare ampersand: the file is no XML."""
    for file, tag in ws.model_tags("origin", "mass", "parent", "box", "cylinder", "axis"):
        text = tag._text[tag.start : tag.end]
        first = next(iter(tag.attributes.values()), None)
        if first is None:
            continue
        quote = first.value_end - tag.start
        broken = [text[:-2] if text.endswith("/>") else text[:-1], text[:quote] + text[quote + 1 :]]
        broken.append(text.replace('="', "=", 1))
        whole = (tag.start, tag.parent.close_end if tag.parent is not None else tag.end)
        yield Mutant(file, tag.start, tag.end, lot.choice(broken), None, whole)


@_MODEL
def mass_zero_or_negative(ws: Workspace, lot: random.Random) -> Mutants:
    """A moving link without mass: engines refuse it or it explodes. A fixed link without mass is harmless."""
    for file, tag in ws.model_tags():
        link = next((above for above in tag.ancestors() if above.name == "link"), None)
        for name in ("value",) if tag.name == "mass" else ("mass", "m") if tag.name.startswith("xacro:") else ():
            if name in tag.attributes and link is not None:
                moves = all(ws.movable_links & {each} for each in ws.expanded_names(file, link))
                yield value(file, tag, name, lot.choice(["0", "0.0", "-1"] if moves else ["-1", "-0.5"]))


@_MODEL
def mass_in_grams(ws: Workspace, lot: random.Random) -> Mutants:
    """The link is a thousand times too heavy for its size and its tensor."""
    for file, tag in ws.model_tags("mass"):
        if numbers(literal(tag, "value")):
            yield value(file, tag, "value", f"{1000 * float(literal(tag, 'value')):g}")


@_MODEL
def impossible_tensor(ws: Workspace, lot: random.Random) -> Mutants:
    """No distribution of mass has such moments of inertia."""
    for file, tag in ws.model_tags("inertia"):
        for name in ("ixx", "iyy", "izz"):
            if name in tag.attributes:
                old = literal(tag, name)
                wrong = ["0", "-0.001", f"{100 * float(old):g}"] if numbers(old) else ["0", "-0.001"]
                yield value(file, tag, name, lot.choice(wrong))


@_MODEL
def placeholder_tensor(ws: Workspace, lot: random.Random) -> Mutants:
    """A unit tensor makes a small part as inert as a vehicle."""
    for file, tag in ws.model_tags("inertia"):
        yield element(file, tag, '<inertia ixx="1.0" ixy="0" ixz="0" iyy="1.0" iyz="0" izz="1.0"/>')


@_MODEL
def inertial_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """Gazebo drops a moving link without inertial; any line of the link is right."""
    for file, tag in ws.model_tags():
        calls = tag.name.startswith("xacro:") and tag.name.endswith(("_inertial", "_inertia"))
        if (calls or tag.name == "inertial") and tag.parent is not None and tag.parent.name == "link":
            yield replace(element(file, tag), also=(tag.parent.start, tag.parent.close_end))


@_MODEL
def mesh_file_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The mesh is not found."""
    for file, tag in ws.model_tags("mesh"):
        folder, _, name = literal(tag, "filename").rpartition("/")
        wrong = lot.choice([typo(name[:-4], lot) + name[-4:], name[:-4] + ".STL", name[:-4] + ".dae"])
        yield wrong_name(file, tag, "filename", f"{folder}/{wrong}")


@_MODEL
def mesh_package_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The package of the mesh is not found."""
    for file, tag in ws.model_tags("mesh"):
        written = literal(tag, "filename")
        package = written.split("/")[2]
        wrong = [written.replace(package, typo(package, lot)), written.replace("package://", "package:/")]
        wrong.append(written.replace("package://", ""))
        yield wrong_name(file, tag, "filename", lot.choice(wrong))


@_MODEL
def mesh_scale_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """A mesh in millimetres is shown a thousand times too large."""
    for file, tag in ws.model_tags("mesh"):
        if "scale" in tag.attributes:
            yield attribute(file, tag, "scale", "")


@_MODEL
def size_negative_or_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """A shape without a size."""
    for file, tag in ws.model_tags("cylinder", "sphere", "box"):
        for name in ("radius", "length", "size"):
            if name in tag.attributes:
                wrong = ["0", "-0.1"] if name != "size" else ["0 0 0", "0.1 -0.1 0.1", "0.1", "0.1 0.1"]
                new = lot.choice([*wrong, ""])
                yield value(file, tag, name, new) if new else attribute(file, tag, name, "")


@_MODEL
def size_in_millimetres(ws: Workspace, lot: random.Random) -> Mutants:
    """The shape is as large as a house."""
    for file, tag in ws.model_tags("cylinder", "sphere", "box"):
        for name in ("radius", "length", "size"):
            if numbers(literal(tag, name)):
                yield value(file, tag, name, _shown([1000 * each for each in numbers(literal(tag, name))]))


@_MODEL
def wrong_size_attribute(ws: Workspace, lot: random.Random) -> Mutants:
    """A cylinder has a radius and a length, as in no other format."""
    for file, tag in ws.model_tags("cylinder", "sphere"):
        if "length" in tag.attributes:
            yield attribute(file, tag, "length", "height")
        if "radius" in tag.attributes:
            yield attribute(file, tag, "radius", "diameter")


@_MODEL
def robot_name_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """A robot needs a name."""
    for file, tag in ws.tags(r"/urdf/\w+\.urdf", "robot"):
        if "name" in tag.attributes:
            yield attribute(file, tag, "name", "")


@_MODEL
def mimic_of_unknown_joint(ws: Workspace, lot: random.Random) -> Mutants:
    """The joint mimics a joint that does not exist, or itself."""
    for file, tag in ws.model_tags("mimic"):
        name = tag.attributes["joint"].value
        for _ in range(3):
            wrong = typo("left_finger_joint", lot, ws.joints) if "$" in name else typo(name, lot, ws.joints)
            yield wrong_name(file, tag, "joint", wrong)
    for file, tag in ws.model_tags("xacro:finger"):
        if literal(tag, "leader"):
            yield wrong_name(file, tag, "leader", typo(literal(tag, "leader"), lot, ws.joints))


@_MODEL
def two_parents_or_a_loop(ws: Workspace, lot: random.Random) -> Mutants:
    """The robot is no tree."""
    for file, tag in ws.model_tags("child"):
        name = literal(tag, "link")
        others = [literal(o, "link") for o in ws.document(file).walk() if o.name == "child" and o is not tag]
        others = [other for other in others if other and other != name]
        parent = next((o for o in tag.parent.children if o.name == "parent"), None) if tag.parent is not None else None
        if name and others:
            yield wrong_name(file, tag, "link", lot.choice(others), uses=True)
        if name and parent is not None and literal(parent, "link"):
            yield wrong_name(file, tag, "link", literal(parent, "link"), uses=True)


@_MODEL
def joint_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The robot falls into two parts."""
    for file, tag in ws.model_tags("joint"):
        child = next((literal(o, "link") for o in tag.children if o.name == "child"), "")
        parent = next((literal(o, "link") for o in tag.children if o.name == "parent"), "")
        if child and parent and tag.parent is not None and parent not in ("world", "base_footprint"):
            yield element(file, tag, names=(literal(tag, "name"), child), uses=True)


@_MODEL
def parent_or_child_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """A joint needs both links."""
    for file, tag in ws.model_tags("parent", "child"):
        yield element(file, tag)


@_MODEL
def wrong_nesting(ws: Workspace, lot: random.Random) -> Mutants:
    """An element outside of its parent is not read."""
    for file, tag in ws.model_tags("inertial", "collision", "limit", "mesh", "geometry"):
        above = tag.parent
        if above is None or above.close is None:
            continue
        moved = tag._text[tag.start : tag.close_end]
        text = tag._text[above.start : tag.start] + tag._text[tag.close_end : above.close_end] + "\n" + moved
        whole = above.parent or above
        around = (whole.start, whole.close_end)
        yield Mutant(file, above.start, above.close_end, text, (above.start, above.end), around)


@_MODEL
def unknown_material(ws: Workspace, lot: random.Random) -> Mutants:
    """The material is not defined: the part has no colour."""
    for file, tag in ws.model_tags("material", parent="visual"):
        name = literal(tag, "name")
        if name and not tag.children:
            yield wrong_name(file, tag, "name", typo(name, lot))


@_MODEL
def color_out_of_range(ws: Workspace, lot: random.Random) -> Mutants:
    """Colours are four numbers from 0 to 1."""
    for file, tag in ws.model_tags("color"):
        rgba = numbers(literal(tag, "rgba"))
        if len(rgba) == 4:
            wrong = [_shown([255 * each for each in rgba]), _shown(rgba[:3])]
            yield value(file, tag, "rgba", lot.choice(wrong))
