"""K964 launch-not-well-formed."""

from __future__ import annotations

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.source import Source
    from urdfkit.lint.model import Model


class LaunchNotWellFormed(RobotRule):
    """A launch file, or the package.xml, cannot be read.

    ## What it does
    Reads the launch files in XML and Python of the robot's package, and of those beside it that depend on it, without
    running anything; also its package.xml.

    ## Why is this bad?
    "Invalid roslaunch XML syntax", or a SyntaxError: nothing is launched. A package whose package.xml is no XML
    is built by no tool.

    ## Example
    ```xml
    <launch>
      <node name="rviz" pkg="rviz" type="rviz">
    </launch>
    ```

    ## Use instead
    ```xml
    <launch>
      <node name="rviz" pkg="rviz" type="rviz"/>
    </launch>
    ```
    """

    code = "K964"
    name = "launch-not-well-formed"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each launch file or package.xml that is no XML, or no Python, where reading it ends."""
        for source in model.around.values():
            wrong = None
            if source.file.endswith((".launch", ".launch.xml", "package.xml")):
                wrong = _in_xml(source)
            elif source.file.endswith(".launch.py"):
                wrong = _in_python(source)
            if wrong is not None:
                line, column, message = wrong
                span = source.span(start := source.offset(line, column), min(start + 1, len(source.text)))
                yield Finding(self.code, self.name, self.severity, message, span)


def _in_xml(source: Source) -> tuple[int, int, str] | None:
    from urdfkit.description.reading import document_of
    from urdfkit.errors import XmlError

    try:
        document_of(source)
    except XmlError as error:
        at = error.position
        return (at.line, at.column, error.message) if at is not None else (1, 1, error.message)
    return None


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
            return line, min(error.offset or 1, len(source.line(line)) + 1), f"this is no Python: {error.msg}"
        except (ValueError, RecursionError, MemoryError):
            return None
    return None
