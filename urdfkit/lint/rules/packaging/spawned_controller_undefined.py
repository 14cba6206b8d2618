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
    from urdfkit.lint.controllers import Named
    from urdfkit.lint.launch import uncommented

    if source.file.endswith(".py"):
        yield from _in_python(source)
        return
    text = uncommented(source)
    for tag in re.finditer(r"<node\b[^>]*>", text):
        if not re.search(r"\b(?:type|exec)\s*=\s*[\"'](?:controller_)?spawner(?:\.py)?[\"']", tag[0]):
            continue
        arguments = re.search(r"\bargs\s*=\s*([\"'])(.*?)\1", tag[0], re.DOTALL)
        words = list(re.finditer(r"\S+", arguments[2])) if arguments is not None else []
        for before, word in zip([None, *words], words, strict=False):
            is_option = before is not None and before[0].startswith("-")
            if re.fullmatch(r"[A-Za-z]\w*", word[0]) and not is_option and arguments is not None:
                yield Named(word[0], tag.start() + arguments.start(2) + word.start())


def _in_python(source: Source) -> Iterator[Named]:
    import ast

    from urdfkit.lint.controllers import Named
    from urdfkit.lint.launch import Reader, name_of, parsed, place

    tree = parsed(source)
    if tree is None:
        return
    reader = Reader(tree)
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call) or name_of(node.func) != "Node":
            continue
        given = {word.arg: word.value for word in node.keywords}
        program, arguments = given.get("executable"), given.get("arguments")
        if (
            program is None
            or reader.text(program) not in ("spawner", "spawner.py")
            or not isinstance(arguments, ast.List)
        ):
            continue
        for before, word in zip([None, *arguments.elts], arguments.elts, strict=False):
            name = word.value if isinstance(word, ast.Constant) else None
            is_option = before is not None and (reader.text(before) or "-").startswith("-")
            if isinstance(name, str) and re.fullmatch(r"[A-Za-z]\w*", name) and not is_option:
                yield Named(name, place(source, word)[0] + 1)
