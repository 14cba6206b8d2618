"""Names that the descriptions of the packages around a robot may have."""

from __future__ import annotations

import re
from pathlib import Path

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.model import Model


def names_around(model: Model, tag: str) -> list[str]:
    """Return patterns of the names that links or joints of any package around may have, arguments being as they like.

    Args:
        model: what is being linted.
        tag: ``link`` or ``joint``.
    """
    from urdfkit.description.surroundings import dependencies_in, manifest, neighbours, package_of
    from urdfkit.lint.entries import descriptions

    near = neighbours(model.package) if model.package is not None else {}
    folders: set[Path] = set()
    for file in model.around:
        package = package_of(Path(file))
        if package is not None:
            folders |= {package, *(near[name] for name in dependencies_in(manifest(package)) if name in near)}
    texts = {str(path.absolute()): text for folder in sorted(folders) for path, text in descriptions(folder)}
    own = {str(Path(file).absolute()): written.text for file, written in model.expanded.sources.items()}
    is_fixed = not any(re.search(r"<(?:xacro:)?(?:if|unless|arg)\b", text) for text in own.values())
    texts = {path: text for path, text in texts.items() if path not in own} if is_fixed else {**own, **texts}
    return [
        ".*".join(re.escape(part) for part in re.split(r"\$\([^()]*\)|\$\{[^{}]*\}", name))
        for text in texts.values()
        for name in re.findall(rf"<{tag}\b[^>]*?\bname\s*=\s*[\"']([^\"']*)", text)
    ]
