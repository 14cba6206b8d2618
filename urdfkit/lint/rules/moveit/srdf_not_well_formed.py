"""M101 srdf-not-well-formed."""

import re

from urdfkit.description.xml.source import Source
from urdfkit.lint.rule import Findings, Model, RobotRule


class SrdfNotWellFormed(RobotRule):
    """An SRDF file is not well-formed.

    ## What it does
    Parses the SRDF files (``.srdf``) of the robot's package and of neighbouring packages that depend on it. A file that
    names another robot of these packages is reported with that robot only.

    ## Why is this bad?
    MoveIt does not start: "Could not parse the SRDF XML File".

    ## Example
    ```diff
     <robot name="arm">
       <group name="arm">
    -    <joint name="elbow">
    +    <joint name="elbow"/>
       </group>
     </robot>
    ```
    """

    code = "M101"
    name = "srdf-not-well-formed"

    def check(self, model: Model) -> Findings:
        """Yield a finding at the first syntax error of each file."""
        from urdfkit.description.xml.reader import document_of
        from urdfkit.errors import XmlError

        for source in model.related_files.values():
            if not source.file.endswith(".srdf") or source.file in model.semantic_roots:
                continue
            try:
                document_of(source)
            except XmlError as error:
                if _is_of_another_robot(source, model):
                    continue
                at = error.position
                start = source.offset(at.line, at.column) if at is not None else 0
                yield self.at_span(source.span(start, min(start + 1, len(source.text))), error.message)


def _is_of_another_robot(source: Source, model: Model) -> bool:
    """Return whether a malformed SRDF names another robot of these packages, with which it is reported."""
    from urdfkit.lint.facts.moveit.srdf import NAME, robot_names

    name = re.search(NAME, source.text)
    if name is None or name[1] == model.robot.name:
        return False
    return any(re.fullmatch(pattern, name[1]) for pattern in robot_names(model))
