"""States of groups that the fake controllers of MoveIt 1 start with: ``initial`` lists groups and their poses.

The list is that of moveit_fake_controller_manager (Noetic); its source was not compared.
"""

from collections.abc import Iterator

from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, documents


def undefined_poses(source: Source, semantics: Element) -> Iterator[tuple[Node, str, list[str]]]:
    """Yield each pose that the SRDF does not define for its group, the message and the states of the group."""
    states: dict[str, list[str]] = {}
    for state in semantics.find_all("group_state"):
        states.setdefault(state.get("group") or "", []).append(state.get("name") or "")
    for root in documents(source):
        initial = root.find("initial")
        for entry in initial.items if initial is not None else ():
            group, pose = entry.find("group"), entry.find("pose")
            if group is None or pose is None or "$" in f"{group.text}{pose.text}" or not pose.text:
                continue
            defined = states.get(group.text, [])
            if pose.text not in defined and group.text:
                yield pose, f"the SRDF has no state `{pose.text}` of group `{group.text}`", defined
