"""M106 srdf-duplicate."""

from collections.abc import Hashable

from urdfkit.description.xml.element import Element
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import Findings, Model, RobotRule

_NAMED = ("group", "end_effector", "virtual_joint", "passive_joint")
_PAIRS = ("disable_collisions", "enable_collisions")


class SrdfDuplicate(RobotRule):
    """An SRDF defines a group, state or pair of links twice.

    ## What it does
    Reports groups, states of a group, end effectors, virtual joints and passive joints with the same name, two virtual
    joints of one link, and names that occur twice in a group. A pair of links that is disabled twice, and two SRDF
    files for one robot in the folder ``config``, are reported as notes. A link that is paired with itself is reported
    as a warning.

    ## Why is this bad?
    MoveIt uses only one of the definitions, and logs "A group named 'arm' already exists. Not adding."

    ## Example
    ```diff
     <robot name="arm">
       <group name="arm">
         <joint name="shoulder"/>
    -  </group>
    -  <group name="arm">
         <joint name="elbow"/>
       </group>
     </robot>
    ```
    """

    code = "M106"
    name = "srdf-duplicate"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each definition after the first."""
        from urdfkit.lint.facts.moveit.srdf import semantics_of, severity_for

        folders: dict[str, str] = {}
        for root in semantics_of(model):
            severity = severity_for(root, model)
            yield from self._repeated(root.children, model, severity)
            for part in root.children:
                if part.tag in ("group", "group_state"):
                    yield from self._repeated(part.children, model, severity, of=part.get("name") or "")
            file = root.origin.position.file
            folder = file.rpartition("/")[0]
            other = folders.setdefault(folder, file)
            if other != file and folder.endswith("config") and file.endswith(".srdf"):
                message = f"{other} describes the same robot `{model.robot.name}`; MoveIt reads one SRDF"
                yield self.at(model, root, message, severity="note")

    def _repeated(self, elements: list[Element], model: Model, severity: Severity | None, of: str = "") -> Findings:
        first: dict[Hashable, Element] = {}
        virtual: dict[str, Element] = {}
        for element in elements:
            shown = f"{element.tag.replace('_', ' ')} `{element.get('name')}`"
            key: Hashable = (element.tag, element.get("name"))
            is_pair = element.tag in _PAIRS and not of
            if is_pair:
                links = [element.get("link1") or "", element.get("link2") or ""]
                shown = f"pair `{links[0]}` and `{links[1]}`"
                key = (element.tag, *sorted(links))
                if links[0] == links[1] and links[0]:
                    message = f"link `{links[0]}` cannot collide with itself"
                    yield self.at(model, element, message, attribute="link2", link=links[0], severity=severity)
                    continue
            elif element.tag == "group_state":
                shown, key = f"state `{element.get('name')}`", (element.get("name"), element.get("group"))
            elif (not of and element.tag not in _NAMED) or element.get("name") is None:
                continue
            before = first.setdefault(key, element)
            child = element.get("child_link") if element.tag == "virtual_joint" and not of else None
            other = virtual.setdefault(child, element) if child else element
            if before is element and other is not element:
                message = (
                    f"second virtual joint of link `{child}`; the first is at {model.shown(other.origin.position)}"
                )
                yield self.at(model, element, message, attribute="child_link", link=child, severity=severity)
            if before is not element:
                where = f" in `{of}`" if of else ""
                message = f"duplicate {shown}{where}; the first is at {model.shown(before.origin.position)}"
                names: tuple[str, ...] = (of,) if of else (str(element.get("name")),) if element.tag == "group" else ()
                names = tuple(links) if is_pair else names
                kind = "pair" if is_pair else "passive" if element.tag == "passive_joint" else ""
                yield self.at(model, element, message, severity="note" if is_pair else severity, names=names, kind=kind)
