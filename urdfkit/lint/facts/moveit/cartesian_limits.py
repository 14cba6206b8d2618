"""Cartesian limits of the Pilz planner in MoveIt's YAML files.

Source: pilz_industrial_motion_planner (Noetic to Rolling): all four limits are required; the documentation and the
default of the deceleration are negative.
"""

from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest
from urdfkit.lint.facts.control.yaml_tree import Node, documents, not_a_number, number_of
from urdfkit.lint.facts.moveit.settings import unwrapped

_UNITS = {"max_trans_vel": "m/s", "max_trans_acc": "m/s²", "max_trans_dec": "m/s²", "max_rot_vel": "rad/s"}
_OTHERS = ("max_rot_acc", "max_rot_dec")
"""Parameters that some files have and the planner does not read."""


def cartesian_limit_defects(source: Source) -> Iterator[tuple[Node, str]]:
    """Yield misspelt and missing Cartesian limits, and those of the wrong sign or type."""
    if "cartesian_limits" not in source.text:
        return
    for document in documents(source):
        for top in unwrapped(document):
            for key, limits in top.entries:
                if key.text == "cartesian_limits" and limits.kind == "group":
                    yield from _defects(key, limits)


def _defects(section: Node, limits: Node) -> Iterator[tuple[Node, str]]:
    written = {key.text for key, _ in limits.entries}
    missing = [name for name in _UNITS if name not in written]
    for key, value in limits.entries:
        if key.text not in _UNITS:
            near = nearest(key.text, missing, cutoff=0.8) if key.text not in _OTHERS else None
            if near is not None:
                missing.remove(near)
                yield key, f"unknown Cartesian limit `{key.text}`" + Suggestion(near, key.text)
        elif problem := not_a_number(value):
            yield value, f"`{key.text}` is {problem}"
        elif value.kind == "text" and (number := number_of(value)) is not None:
            is_deceleration = key.text == "max_trans_dec"
            if number == 0.0 or (number > 0.0) is is_deceleration:
                sign = "negative" if is_deceleration else "positive"
                yield value, f"`{key.text}` is {number:g} {_UNITS[key.text]}; it must be {sign}"
    if missing and written & _UNITS.keys() and "<<" not in written:
        yield section, f"`cartesian_limits` has no `{missing[0]}`; the planner requires all four limits"
