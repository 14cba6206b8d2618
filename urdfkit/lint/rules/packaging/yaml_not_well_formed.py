"""K966 yaml-not-well-formed."""

from __future__ import annotations

import re

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.source import Source
    from urdfkit.lint.model import Model
    from urdfkit.lint.yaml_tree import Broken, Node

_TEMPLATE = r"\{%|\{\{|\$\{"
_BARE = r"\s*(?:-\s+)?([A-Za-z_][\w/.-]*)(?:\s+[^\s:#]\S*)?\s*(?:#.*)?$"
_ITEM = r"\s*-\s+[^\s:]+\s*(?:#.*)?$"
_CLOSE = r"\s*(?:-\s+)?([A-Za-z_][\w/.-]*):[^\s:/]\S*\s*(?:#.*)?$"
_UNFINISHED = r"mapping values|expected (?:':'|key|block|<block|'?-'? indicator)"
"""What libyaml says where a line is no ``name: value`` (scanner.c, parser.c)."""

_SETTINGS = (
    "type joint joints update_rate use_sim_time publish_rate command_interfaces state_interfaces wheel_separation"
    " wheel_radius left_wheel_names right_wheel_names base_frame_id odom_frame_id"
)
"""Parameters that a line without its colon is taken for where it may well be text."""


class YamlNotWellFormed(RobotRule):
    """Settings are no YAML, or their lines run into each other where a colon is missing.

    ## What it does
    Reads the YAML of the robot's package, and of those beside it that depend on it. Where that ends it looks for the
    line that lacks its colon, or the blank behind it. Templates (``{{ … }}``) are left alone.

    ## Why is this bad?
    "Error parsing yaml file", and nothing is launched; or a parameter and its value become one text that nobody reads.

    ## Example
    ```yaml
    controller_manager:
      ros__parameters:
        update_rate 100
        use_sim_time: true
    ```

    ## Use instead
    ```yaml
    controller_manager:
      ros__parameters:
        update_rate: 100
        use_sim_time: true
    ```
    """

    code = "K966"
    name = "yaml-not-well-formed"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each file that cannot be read, and for each text that was to be a parameter."""
        from urdfkit.lint.yaml_tree import documents, span_of, walk, yamls

        for source in yamls(model):
            if re.search(_TEMPLATE, source.text):
                continue
            roots, broken = documents(source)
            if broken is not None:
                has_tab = "\t" in source.line(min(broken.line, len(source.line_starts)))
                if not has_tab or "controller" not in source.text:  # there controller-settings-misspelt tells of tabs
                    yield self._where(source, broken)
                continue
            for root in roots:
                for node in walk(root):
                    for key, value in node.entries:
                        word = _lost(key, value)
                        if word is not None:
                            message = f"a colon is missing behind `{word}`: `{key.text}` is the text `{value.text}`"
                            if value.text.startswith(f"{word}:"):
                                message = (
                                    f"a blank is missing behind `{word}:`: `{key.text}` is the text `{value.text}`"
                                )
                            yield Finding(self.code, self.name, self.severity, message, span_of(source, value))

    def _where(self, source: Source, broken: Broken) -> Finding:
        """Return the finding, at the line that lacks its colon where there is one, else where reading ends."""
        last = len(source.line_starts)
        line, column = min(broken.line, last), broken.column
        message = f"this is no YAML: {broken.why}"
        if re.search(_UNFINISHED, broken.why):
            above = range(line, 0, -1)
            lines = [number for number in above if not re.match(_ITEM, source.line(number))]
            for number in lines[:4]:
                text = source.line(number).rstrip()
                bare, close = re.match(_BARE, text), re.match(_CLOSE, text)
                if bare is None and close is None:
                    continue
                word = (bare or close)[1]  # type: ignore[index]
                line, column = number, len(text) - len(text.lstrip()) + 1
                what = f"a colon behind `{word}`" if bare is not None else f"a blank behind `{word}:`"
                message = f"this is no YAML: {what} is missing"
                break
        start = source.offset(line, min(column, len(source.line(line)) + 1))
        return Finding(
            self.code, self.name, self.severity, message, source.span(start, min(start + 1, len(source.text)))
        )


def _lost(key: Node, value: Node) -> str | None:
    """Return the name of the parameter that a text on lines of its own was to be; None where it may well be text."""
    if not value.is_plain or value.line <= key.line:
        return None
    at = re.fullmatch(r"([A-Za-z_]\w*)(?::\S+|\s+\S+)", value.text)
    return at[1] if at is not None and at[1] in _SETTINGS.split() else None
