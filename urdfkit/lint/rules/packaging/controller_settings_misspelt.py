"""K962 controller-settings-misspelt."""

from __future__ import annotations

import re
from itertools import pairwise

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.source import Source
    from urdfkit.lint.model import Model

_KEY = r"(?m)^([ \t]*)[\"']?([\w/]+)[\"']?[ \t]*:[ \t]*\r?$"
_GROUP = r"(?m)(?:^|[{,])[ \t]*[\"']?(ros_*[A-Za-z_]+)[\"']?[ \t]*:[ \t]*(?=\r?$|[{&*])"
_PARAMETERS = "ros__parameters"
_TAB = r"(?m)^ *\t[ \t]*(?=[^\s#])"
_ENDS = 2
"""Letters that a name may have more or less than the one that is meant."""


class ControllerSettingsMisspelt(RobotRule):
    """Settings of controllers in YAML are misspelt: their type, their section, or ``ros__parameters``.

    ## What it does
    Looks in the YAML of the robot's package, and of those beside it that depend on it, where controllers have settings:
    for types that are nearly one of ros_controllers' or ros2_controllers', for sections of ROS 2 that are nearly called
    like a controller, for keys that are nearly ``ros__parameters`` (with two underscores), for parameters that
    are nearly one that the controller reads, and for tabs.

    ## Why is this bad?
    "Loader for controller not found", or a controller that starts without its joints: what is under a key that nobody
    asks for is not read, and not missed. YAML with tabs is not read at all.

    ## Example
    ```yaml
    controller_manager:
      ros__parameters:
        arm_controller:
          type: joint_trajectory_controllers/JointTrajectoryController
    arm_controller:
      ros__parameters:
        joints: [elbow]
    ```

    ## Use instead
    ```yaml
    controller_manager:
      ros__parameters:
        arm_controller:
          type: joint_trajectory_controller/JointTrajectoryController
    arm_controller:
      ros__parameters:
        joints: [elbow]
    ```
    """

    code = "K962"
    name = "controller-settings-misspelt"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each name that is nearly the right one, and the first tab of a file."""
        from urdfkit.lint.controllers import typed
        from urdfkit.lint.launch import uncommented

        for source in model.around.values():
            if not source.file.endswith((".yaml", ".yml")):
                continue
            text = uncommented(source)
            types = list(typed(source))
            if not types and "controller" not in text:
                continue
            for named in types:
                meant = _type_meant(named.name)
                if meant is not None:
                    message = f"there is no controller of type `{named.name}`; did you mean `{meant}`?"
                    yield self._at(source, named.start, named.name, message)
            yield from self._keys(source, text)
            yield from self._parameters(source)
            if (tab := re.search(_TAB, text)) is not None:
                yield self._at(source, tab.start(), tab[0], "YAML has no tabs: write blanks")

    def _keys(self, source: Source, text: str) -> Iterator[Finding]:
        from urdfkit.lint.controllers import controllers
        from urdfkit.lint.edits import nearest

        keys = [(key[2], key.start(2), len(key[1])) for key in re.finditer(_KEY, text)]
        for name, start in ((key[1], key.start(1)) for key in re.finditer(_GROUP, text)):
            if name != _PARAMETERS and nearest(name, [_PARAMETERS], likeness=0.85) is not None:
                yield self._at(source, start, name, f"`{name}` is read by nobody; did you mean `{_PARAMETERS}`?")
        declared = set(controllers(source))
        sections = [
            (name, name.rpartition("/")[2], start)
            for (name, start, indent), (below, _, _) in pairwise(keys)
            if indent == 0 and below == _PARAMETERS
        ]
        lost = declared - {called for _, called, _ in sections}
        for name, called, start in sections:
            meant = nearest(called, lost, likeness=0.85) if called not in (*declared, "controller_manager") else None
            if meant is not None:
                yield self._at(source, start, name, f"no controller is called `{name}`; did you mean `{meant}`?")

    def _parameters(self, source: Source) -> Iterator[Finding]:
        from urdfkit.lint.controller_settings import misspelt
        from urdfkit.lint.yaml_tree import span_of

        for key, meant, controller in misspelt(source):
            message = f"`{key.text}` of `{controller.name}` is read by nobody; did you mean `{meant}`?"
            yield Finding(self.code, self.name, self.severity, message, span_of(source, key))

    def _at(self, source: Source, start: int, written: str, message: str) -> Finding:
        return Finding(self.code, self.name, self.severity, message, source.span(start, start + len(written)))


def _type_meant(name: str) -> str | None:
    """Return the type that one must have meant; None where it is one, or may be somebody's own."""
    from urdfkit.lint.controllers import TYPES
    from urdfkit.lint.edits import nearest

    if name in TYPES:
        return None
    near = nearest(name, TYPES, likeness=0.9)
    if near is None:
        return None
    parts = zip(name.split("/"), near.split("/"), strict=False)
    return near if all(abs(len(one) - len(other)) <= _ENDS for one, other in parts) else None
