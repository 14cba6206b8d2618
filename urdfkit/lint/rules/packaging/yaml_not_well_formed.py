"""K966 yaml-not-well-formed."""

import re

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Broken, Node, documents, span_of, syntax_error, walk, yamls
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import Findings, Model, RobotRule

_TEMPLATE = r"\{%|\{\{|\$\{"
_WITHOUT_COLON = r"\s*(?:-\s+)?([A-Za-z_][\w/.-]*)(?:\s+[^\s:#]\S*)?\s*(?:#.*)?$"
_ITEM = r"\s*-\s+[^\s:]+\s*(?:#.*)?$"
_WITHOUT_SPACE = r"\s*(?:-\s+)?([A-Za-z_][\w/.-]*):[^\s:/]\S*\s*(?:#.*)?$"
_NOT_A_MAPPING = r"mapping values|expected (?:':'|key|block|<block|'?-'? indicator)"
"""Matches the errors of libyaml for a line that is not ``name: value`` (scanner.c, parser.c)."""

_PARAMETERS = (
    "type joint joints update_rate use_sim_time publish_rate command_interfaces state_interfaces wheel_separation"
    " wheel_radius left_wheel_names right_wheel_names base_frame_id odom_frame_id"
)
"""Parameters that are recognised in a multi-line string, where other words may be ordinary text."""


class YamlNotWellFormed(RobotRule):
    """A YAML file is not well-formed, or a missing colon merges a parameter with its value.

    ## What it does
    Parses the YAML files of the robot's package and of neighbouring packages that depend on it. For a syntax error, the
    rule locates the line with a missing colon, or a missing space after it. Templates (``{{ … }}``) are not checked.

    ## Why is this bad?
    The launch fails with "Error parsing yaml file", or a parameter and its value become a single string that no node
    reads.

    ## Example
    ```diff
     controller_manager:
       ros__parameters:
    -    update_rate 100
    +    update_rate: 100
         use_sim_time: true
    ```
    """

    code = "K966"
    name = "yaml-not-well-formed"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each malformed file, and for each string that should be a parameter."""
        for source in yamls(model):
            if re.search(_TEMPLATE, source.text):
                continue
            roots, broken = documents(source), syntax_error(source)
            if broken is not None:
                has_tab = "\t" in source.line(min(broken.line, len(source.line_starts)))
                # In files with controllers, tabs are reported by controller-settings-misspelt.
                if not has_tab or "controller" not in source.text:
                    yield self._syntax_error(source, broken)
                continue
            for root in roots:
                for node in walk(root):
                    for key, value in node.entries:
                        word = _unseparated_parameter(key, value)
                        if word is not None:
                            missing = (
                                f"space after `{word}:`"
                                if value.text.startswith(f"{word}:")
                                else f"colon after `{word}`"
                            )
                            message = f"missing {missing}: `{key.text}` is parsed as the string `{value.text}`"
                            yield self.at_span(span_of(source, value), message, help=f"write `{word}: …`")

    def _syntax_error(self, source: Source, broken: Broken) -> Finding:
        """Return the finding at the line that lacks a colon, or else at the position of the syntax error."""
        last = len(source.line_starts)
        line, column = min(broken.line, last), broken.column
        message = f"invalid YAML: {broken.why}"
        if re.search(_NOT_A_MAPPING, broken.why):
            above = range(line, 0, -1)
            lines = [number for number in above if not re.match(_ITEM, source.line(number))]
            for number in lines[:4]:
                text = source.line(number).rstrip()
                without_colon, without_space = re.match(_WITHOUT_COLON, text), re.match(_WITHOUT_SPACE, text)
                if without_colon is None and without_space is None:
                    continue
                word = (without_colon or without_space)[1]  # type: ignore[index]
                line, column = number, len(text) - len(text.lstrip()) + 1
                missing = f"colon after `{word}`" if without_colon is not None else f"space after `{word}:`"
                message = f"invalid YAML: missing {missing}"
                break
        if (indented := _indented_above(source, line)) is not None:
            key, column = indented
            line, message = line - 1, f"invalid YAML: `{key}` is indented more than the entries below it"
        start = source.offset(line, min(column, len(source.line(line)) + 1))
        return self.at_span(source.span(start, min(start + 1, len(source.text))), message)


def _indented_above(source: Source, line: int) -> tuple[str, int] | None:
    """Return key and column of the first entry of a mapping if it is indented more than the second one, at a line."""
    if line < 3 or line > len(source.line_starts):
        return None
    owner, first, second = (re.match(r"( *)([\w/~-]+):(.*)", source.line(line - back)) for back in (2, 1, 0))
    if owner is None or first is None or second is None or owner[3].strip():
        return None
    is_indented = len(owner[1]) < len(second[1]) < len(first[1])
    return (first[2], len(first[1]) + 1) if is_indented else None


def _unseparated_parameter(key: Node, value: Node) -> str | None:
    """Return the parameter that a string on a separate line should be; None if it may be ordinary text."""
    if not value.is_plain or value.line <= key.line:
        return None
    match = re.fullmatch(r"([A-Za-z_]\w*)(?::\S+|\s+\S+)", value.text)
    return match[1] if match is not None and match[1] in _PARAMETERS.split() else None
