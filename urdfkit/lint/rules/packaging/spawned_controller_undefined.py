"""K960 spawned-controller-undefined."""

from __future__ import annotations

import re

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.source import Source
    from urdfkit.lint.controllers import Named
    from urdfkit.lint.model import Model


_SPAWNERS = ("spawner", "spawner.py", "controller_spawner", "controller_spawner.py")


class SpawnedControllerUndefined(RobotRule):
    """A launch file spawns a controller that no settings define.

    ## What it does
    Compares the controllers that launch files hand to the spawner with those that the YAML around gives a type, where
    one of those has nearly that name. Launch files in Python are read, not run.

    ## Why is this bad?
    The spawner waits for the controller, then gives up; the robot does not move.

    ## Example
    ```xml
    <launch>
      <node name="spawner" pkg="controller_manager" type="spawner" args="arm_controler"/>
    </launch>
    ```

    ## Use instead
    ```xml
    <launch>
      <node name="spawner" pkg="controller_manager" type="spawner" args="arm_controller"/>
    </launch>
    ```
    """

    code = "K960"
    name = "spawned-controller-undefined"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each controller that is spawned and, but for a letter or so, defined."""
        from urdfkit.errors import did_you_mean
        from urdfkit.lint.controllers import controllers

        launches = [file for file in model.around.values() if re.search(r"spawner", file.text)]
        settings = [file for file in model.around.values() if file.file.endswith((".yaml", ".yml"))]
        if not launches or not settings:
            return
        known = [name for file in settings for name in controllers(file)]
        for source in launches:
            for named in _spawned(source):
                written = rf"(?<![\w-]){re.escape(named.name)}[\"']?\s*:"
                hint = did_you_mean(named.name, known)
                if named.name in known or not hint or any(re.search(written, file.text) for file in settings):
                    continue
                yield Finding(
                    self.code,
                    self.name,
                    self.severity,
                    f"no controller `{named.name}` has settings{hint}",
                    source.span(named.start, named.start + len(named.name)),
                )


def _spawned(source: Source) -> Iterator[Named]:
    """Yield what a launch file hands to spawners as constants; what follows an option is left out."""
    from urdfkit.lint.started import started

    for node in started(source):
        if node.program not in _SPAWNERS:
            continue
        for before, word in zip([None, *node.arguments], node.arguments, strict=False):
            is_option = before is not None and before.name.startswith("-")
            if word is not None and re.fullmatch(r"[A-Za-z]\w*", word.name) and not is_option:
                yield word
