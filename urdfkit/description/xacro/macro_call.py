"""Call one macro of a file that defines macros only, so that the file describes a robot."""

import re
from collections.abc import Mapping
from pathlib import Path
from xml.sax.saxutils import quoteattr

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.expand import expand_leniently
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xacro.faults import MacroDefinition
from urdfkit.description.xml.extended_text import ExtendedText
from urdfkit.description.xml.reader import read_source, shown_path
from urdfkit.description.xml.source import absolute
from urdfkit.errors import UsageError, did_you_mean, nearest

_ORIGIN = '<origin xyz="0 0 0" rpy="0 0 0"/>'
_LISTED = 8


def text_with_call(path: Path, macro: str, arguments: Mapping[str, str], packages: Packages) -> dict[str, str]:
    """Return the text of a file with a call of one of its macros at the end, by the absolute path of the file.

    Each block parameter receives an ``<origin>`` of zeros. Links that joints of the macro name as parents, and that
    the file does not define, are added. The position of all of these elements is that of the macro.

    Args:
        path: the file.
        macro: name of the macro.
        arguments: values of the parameters; other arguments are ignored.
        packages: resolves ``$(find …)``.

    Raises:
        ResourceError: the file cannot be read.
        UsageError: unknown macro, or a required parameter without a value.
    """
    expanded = expand_leniently(path, arguments=arguments, packages=packages, run_xacro=True)
    definition = expanded.macros.get(macro)
    shown = shown_path(path)
    if definition is None:
        hint = did_you_mean(macro, expanded.macros) or f"; its macros: {listed(expanded) or 'none'}"
        raise UsageError(f"no macro `{macro}` in {shown}{hint}")
    names = [name for name in definition.parameters if not name.startswith("*")]
    if missing := [name for name in names if name not in arguments and name not in definition.defaults]:
        words = " ".join(f"{name}:=VALUE" for name in missing)
        unknown = {name: nearest(name, missing) for name in arguments if name not in definition.parameters}
        typo = next((name for name, near in unknown.items() if near is not None), None)
        hint = "" if typo is None else f"; it has no parameter `{typo}`{Suggestion(unknown[typo])}"
        raise UsageError(f"macro `{macro}` requires {', '.join(f'`{name}`' for name in missing)}: pass {words}{hint}")
    values = "".join(f" {name}={quoteattr(arguments[name])}" for name in names if name in arguments)
    blocks = "".join(_block(name) for name in definition.parameters if name.startswith("*"))
    call = f"<xacro:{macro}{values}>{blocks}</xacro:{macro}>"
    source = read_source(path, shown_as=shown)
    where = source.text.rfind("</robot")
    root = re.search(r"<robot\b[^>]*?(?=\s*/?>)", source.text)
    if where < 0 or root is None:
        raise UsageError(f"{shown} has no <robot>, so --macro cannot call a macro in it")
    is_named = expanded.root is not None and expanded.root.get("name")
    name = (root.end(), "" if is_named else f" name={quoteattr(macro)}")
    key, place = str(absolute(path)), definition.position
    texts = {key: ExtendedText.of(source, [name, (where, call)], place)}
    called = expand_leniently(path, arguments=arguments, packages=packages, run_xacro=True, texts=texts)
    links = "".join(f"<link name={quoteattr(name)}/>" for name in _undefined_parents(called))
    return {key: ExtendedText.of(source, [name, (where, links + call)], place)}


def listed(expanded: Expanded) -> str:
    """Return the macros of a file with their parameters, for messages; empty without any."""
    own = [macro for macro in expanded.macros.values() if macro.position.file == shown_path(expanded.path)]
    macros = own or list(expanded.macros.values())
    more = f" and {len(macros) - _LISTED} more" if len(macros) > _LISTED else ""
    return ", ".join(_signature(macro) for macro in macros[:_LISTED]) + more


def _signature(macro: MacroDefinition) -> str:
    """Return a macro with its parameters; optional parameters are in brackets."""
    words = (f"[{name}]" if name in macro.defaults else name for name in macro.parameters)
    return f"`{macro.name}` ({' '.join(words)})"


def _block(parameter: str) -> str:
    return f"<block>{_ORIGIN}</block>" if parameter.startswith("**") else _ORIGIN


def _undefined_parents(expanded: Expanded) -> list[str]:
    children = expanded.root.children if expanded.root is not None else []
    links = {child.get("name") for child in children if child.tag == "link"}
    parents = [child.find("parent") for child in children if child.tag == "joint"]
    named = (parent.get("link") for parent in parents if parent is not None)
    return list(dict.fromkeys(name for name in named if name and name not in links))
