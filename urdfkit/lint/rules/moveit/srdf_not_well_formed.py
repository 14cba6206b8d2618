"""M101 srdf-not-well-formed."""

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import Findings, Model, RobotRule


class SrdfNotWellFormed(RobotRule):
    """An SRDF file is not well-formed.

    ## What it does
    Parses the SRDF files (``.srdf``) of the robot's package and of neighbouring packages that depend on it.

    ## Why is this bad?
    MoveIt does not start: "Could not parse the SRDF XML File".

    ## Example
    ```xml
    <robot name="arm">
      <group name="arm">
        <joint name="elbow">
      </group>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <group name="arm">
        <joint name="elbow"/>
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
                at = error.position
                start = source.offset(at.line, at.column) if at is not None else 0
                span = source.span(start, min(start + 1, len(source.text)))
                yield Finding(self.code, self.name, self.severity, error.message, span)
