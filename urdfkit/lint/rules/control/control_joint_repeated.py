"""C721 control-joint-repeated."""

from __future__ import annotations

from urdfkit.description.urdf.queries import UNDRIVEN
from urdfkit.lint.facts.root_cause import call_of
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.xml.element import Element

    Named = tuple[str, Element]


class ControlJointRepeated(RobotRule):
    """Two entries of ``<ros2_control>``, or two transmissions, name the same joint.

    ## What it does
    Checks for a joint that one ``<ros2_control>`` names twice, and for two transmissions of one joint with the same
    hardware interface. The message names the likely intended joint if exactly one moving joint of the robot has no
    entry.

    ## Why is this bad?
    The hardware component is not loaded, or the second entry is ignored. Usually the entry was copied without changing
    the joint name, so another joint has no entry.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="upper"/>
       <link name="lower"/>
       <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
       <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><axis xyz="0 1 0"/></joint>
       <ros2_control name="arm" type="system">
         <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
         <joint name="shoulder"><command_interface name="position"/><state_interface name="position"/></joint>
    -    <joint name="shoulder"><command_interface name="position"/><state_interface name="position"/></joint>
    +    <joint name="elbow"><command_interface name="position"/><state_interface name="position"/></joint>
       </ros2_control>
     </robot>
    ```
    """

    code = "C721"
    name = "control-joint-repeated"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each repeated joint, at the entry whose place in the list suits another joint."""
        robot = model.robot
        for block in robot.ros2_control:
            entries = [(part.get("name") or "", part) for part in block.element.find_all("joint")]
            what = f"two entries of <ros2_control> `{block.name}` name joint"
            yield from self._repeated(entries, entries, what, model)
        by_interface: dict[tuple[str, ...], list[Named]] = {}
        for one in robot.transmissions:
            if len(one.joints) == 1:
                joint = one.joints[0]
                interfaces = tuple(name.rpartition("/")[2] for name in joint.hardware_interfaces)
                by_interface.setdefault(interfaces, []).append((joint.name or "", joint.element))
        every = [entry for entries in by_interface.values() for entry in entries]
        for entries in by_interface.values():
            yield from self._repeated(entries, every, "two transmissions drive joint", model)

    def _repeated(self, entries: list[Named], every: list[Named], what: str, model: Model) -> Findings:
        joints = model.robot.joint_by_name
        names = [name for name, _ in entries]
        repeated = [name for name in dict.fromkeys(names) if names.count(name) == 2 and name in joints]
        repeated = [name for name in repeated if joints[name].type not in UNDRIVEN]
        if not repeated or any("$" in name for name in names):
            return
        order = {joint.name: index for index, joint in enumerate(model.robot.joints)}
        written = {name for name, _ in every}
        lacking = [name for name in _driven(model) if name not in written]
        places: set[object] = set()
        for name in repeated:
            first, second = (index for index, each in enumerate(names) if each == name)
            lacks = _nearest(name, lacking)
            wrong = second if lacks is None or _is_sorted(names, second, lacks, order) else first
            if lacks is not None and call_of(entries[first][1], [entries[second][1]]) is not None:
                wrong = second if order[lacks] > order[name] else first  # a call repeats more than one joint
            element, other = entries[wrong][1], entries[first + second - wrong][1]
            message = f"{what} `{name}`" + (f"; joint `{lacks}` is missing" if lacks is not None else "")
            place = call_of(element, [other]) or element
            if (position := getattr(place, "origin", place)) in places:
                continue  # The other side, from the same macro.
            places.add(position)
            listed = () if lacks is None else (lacks,) if place is element else tuple(lacking)
            yield self.at(model, place, message, attribute="name", joint=name, names=listed)


def _driven(model: Model) -> Iterator[str]:
    for joint in model.robot.joints:
        if joint.is_movable and joint.type not in UNDRIVEN and joint.mimic is None:
            yield joint.name


def _nearest(name: str, lacking: list[str]) -> str | None:
    """Return the only joint without an entry, or the one whose name is most similar to that of the repeated joint."""
    from urdfkit.lint.fix_builders import nearest

    return lacking[0] if len(lacking) == 1 else nearest(name, lacking, cutoff=0.5)


def _is_sorted(names: list[str], index: int, name: str, order: dict[str, int]) -> bool:
    """Return whether a name in place of the one at an index keeps the order of the joints in the robot."""
    near = [order.get(each, -1) for each in names[max(index - 1, 0) : index + 2]]
    near[min(index, 1)] = order[name]
    return near == sorted(near)
