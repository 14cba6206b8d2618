"""K964 launch-not-well-formed."""

from urdfkit.description.xml.source import Source
from urdfkit.lint.rule import Findings, Model, RobotRule


class LaunchNotWellFormed(RobotRule):
    """A launch file or package.xml is not well-formed.

    ## What it does
    Parses the XML and Python launch files of the robot's package and of neighbouring packages that depend on it, and
    their package.xml. The rule executes none of these files.

    ## Why is this bad?
    The launch fails with "Invalid roslaunch XML syntax" or a SyntaxError. A package with a malformed package.xml cannot
    be built.

    ## Example
    ```diff
     <launch>
    -  <node name="rviz" pkg="rviz" type="rviz">
    +  <node name="rviz" pkg="rviz" type="rviz"/>
     </launch>
    ```
    """

    code = "K964"
    name = "launch-not-well-formed"

    def check(self, model: Model) -> Findings:
        """Yield a finding at the first syntax error of each launch file and package.xml."""
        for source in model.related_files.values():
            error = None
            if source.file.endswith((".launch", "launch.xml", "package.xml")):
                error = _in_xml(source) or _encoding(source)
            elif source.file.endswith("launch.py"):
                error = _in_python(source)
            if error is not None:
                line, column, message = error
                span = source.span(start := source.offset(line, column), min(start + 1, len(source.text)))
                yield self.at_span(span, message)


def _in_xml(source: Source) -> tuple[int, int, str] | None:
    from urdfkit.description.xml.reader import document_of
    from urdfkit.errors import XmlError

    try:
        document_of(source)
    except XmlError as error:
        position = error.position
        return (position.line, position.column, error.message) if position is not None else (1, 1, error.message)
    return None


def _encoding(source: Source) -> tuple[int, int, str] | None:
    """Return the error of a package.xml in another encoding; catkin_pkg decodes all of them as UTF-8."""
    if not source.file.endswith("package.xml") or source.flaw is None or not source.flaw[1].startswith("UTF-"):
        return None
    return 1, 1, f"package.xml is in {source.flaw[1]}; colcon and catkin read UTF-8 only"


def _in_python(source: Source) -> tuple[int, int, str] | None:
    import ast
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            ast.parse(source.text)
        except SyntaxError as error:
            last = len(source.line_starts)
            line = min(error.lineno or 1, last)
            return line, min(error.offset or 1, len(source.line(line)) + 1), f"invalid Python: {error.msg}"
        except (ValueError, RecursionError, MemoryError):
            return None
    return None
