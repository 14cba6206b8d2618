"""Names that descriptions in neighbouring packages may define."""

import re
from pathlib import Path

from urdfkit.errors import ResourceError
from urdfkit.lint.model.model import Model


def neighbouring_names(model: Model, tag: str) -> list[str]:
    """Return patterns of the link or joint names in neighbouring packages, for any values of the arguments.

    Args:
        model: the linted model.
        tag: ``link`` or ``joint``.
    """
    texts = _descriptions(model)
    own = {str(Path(file).absolute()): written.text for file, written in model.expanded.sources.items()}
    is_fixed = not any(re.search(r"<(?:xacro:)?(?:if|unless|arg)\b", text) for text in own.values())
    texts = {path: text for path, text in texts.items() if path not in own} if is_fixed else {**own, **texts}
    every = "\n".join(texts.values())
    # An element whose first child is an interface belongs to ros2_control or a transmission.
    tags = re.findall(rf"(<{tag}\b[^>]*>)(?!\s*<(?:command_interface|state_interface|hardwareInterface)\b)", every)
    names = [name for found in tags for name in re.findall(r"\bname\s*=\s*[\"']([^\"']*)", found)[:1]]
    calls = "\n".join((*re.findall(_CALL, every), *re.findall(_DEFAULTS, every)))
    return [_pattern(name, calls, every) for name in dict.fromkeys(names)]


def unresolved_package(model: Model) -> str:
    """Return a package that descriptions in neighbouring packages include files from and that is not found here."""
    texts = "\n".join(_descriptions(model).values())
    for name in dict.fromkeys(re.findall(r"<xacro:include\b[^<>]*\$\(find\s+([\w-]+)\)", texts)):
        try:
            model.expanded.packages.find(str(name))
        except ResourceError:
            return str(name)
    return ""


def _descriptions(model: Model) -> dict[str, str]:
    """Return the texts of the descriptions in the packages of related files and in their dependencies."""
    from urdfkit.description.packages.related_files import dependencies_in, manifest, neighbours, package_of
    from urdfkit.lint.project.entry_files import SUFFIXES, descriptions

    near = neighbours(model.package) if model.package is not None else {}
    folders: set[Path] = set()
    for file in model.related_files:
        package = package_of(Path(file))
        if package is not None:
            folders |= {package, *(near[name] for name in dependencies_in(manifest(package)) if name in near)}
    for folder in folders:
        model.expanded.packages.watch(folder, *SUFFIXES)
    return {str(path.absolute()): text for folder in sorted(folders) for path, text in descriptions(folder)}


def is_conditional(text: str, pattern: str) -> bool:
    """Return whether a pattern matches inside of a xacro condition.

    Args:
        text: text of a description.
        pattern: a regular expression without groups.
    """
    depth = 0
    for at in re.finditer(rf"<(/?)xacro:(?:if|unless)\b|{pattern}", text):
        if at[1] is None:
            if depth:
                return True
        else:
            depth = max(depth - 1, 0) if at[1] else depth + 1
    return False


def _pattern(name: str, calls: str, texts: str) -> str:
    """Return the pattern of a name; literal arguments of the macro's calls replace its parameters."""
    parts = []
    for part in re.split(r"(\$\([^()]*\)|\$\{[^{}]*\})", name):
        if not part.startswith("$"):
            parts.append(re.escape(part))
            continue
        word = re.fullmatch(r"\$\{\s*(\w+)\s*\}", part)
        values = set(re.findall(rf"(?<![\w:]){word[1]}\s*:?=\s*[\"']?([^\"'\s]*)", calls)) if word else set()
        is_written = values and len(values) <= _MAX_VALUES and not any("$" in value or "^" in value for value in values)
        is_set = word is not None and re.search(rf"property\s+name\s*=\s*[\"']{word[1]}[\"']", texts)
        parts.append(f"(?:{'|'.join(map(re.escape, sorted(values)))})" if is_written and not is_set else ".*")
    return "".join(parts)


_CALL = r"<xacro:(?!macro\b|property\b|arg\b|include\b|if\b|unless\b)[^<>]*>"
_DEFAULTS = r"\bparams\s*=\s*(?:\"[^\"]*\"|'[^']*')"
"""Calls of macros, and the defaults of their parameters."""

_MAX_VALUES = 200
"""Maximum number of values of one parameter."""
