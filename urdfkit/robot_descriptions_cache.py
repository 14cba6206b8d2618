"""Find robots of the Python package robot_descriptions in its cache; nothing is imported from it or downloaded.

Its modules clone a repository when they are imported, so their constants are read from their source instead.
Source: robot_descriptions 3.3.0, _cache.py and _xacro.py.
"""

import ast
import os
from importlib.util import find_spec
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.errors import ResourceError, did_you_mean, nearest
from urdfkit.record import record

_MAX_DEPTH = 20


@record
class CachedDescription:
    """A robot in the cache.

    Attributes:
        path: its URDF or xacro file.
        arguments: xacro arguments to expand it with.
        packages: folders of further packages that it uses.
    """

    path: Path
    arguments: dict[str, str]
    packages: tuple[Path, ...]


def cached_description(name: str) -> CachedDescription | None:
    """Return a robot of robot_descriptions; None if the package is not installed.

    Args:
        name: name of the robot's module, such as ``panda_description``.

    Raises:
        ResourceError: the package has no such robot, no URDF of it, or it is not in the cache.
    """
    folder = _package()
    if folder is None:
        return None
    module = folder / f"{name}.py"
    if not module.is_file():
        hint = did_you_mean(name, description_names())
        raise ResourceError(f"no robot `{name}` in the package robot_descriptions{hint}")
    constants = _Constants(module, folder / "_repositories.py")
    text = constants.text("URDF_PATH") or constants.text("XACRO_PATH")
    if text is None:
        raise ResourceError(f"`{name}` of robot_descriptions has no URDF; name a description that has one")
    path = Path(text)
    if not path.is_file():
        raise ResourceError(
            f"`{name}` is not in the cache of robot_descriptions ({_cache()}); "
            f"download it with `python -m robot_descriptions pull {name}`"
        )
    arguments = {} if constants.text("URDF_PATH") else constants.mapping("XACRO_ARGS")
    packages = tuple(Path(folder) for folder in constants.mapping("XACRO_PACKAGE_PATHS").values())
    return CachedDescription(path, arguments, packages)


def how_to_get(word: str) -> str:
    """Return the end of a message about an unknown robot: how to get it from robot_descriptions, if it may be one."""
    stem, _, end = word.rpartition("_")
    if not stem or nearest(end, ["description"], cutoff=0.8) is None:
        return ""
    meant = nearest(word, description_names()) or f"{stem}_description"
    return (
        f"; for robots of the package robot_descriptions run `pip install robot_descriptions` "
        f"and `python -m robot_descriptions pull {meant}`{Suggestion(meant) if meant != word else ''}"
    )


def description_names() -> list[str]:
    """Return the names of the robots of robot_descriptions; none if the package is not installed."""
    folder = _package()
    return [] if folder is None else sorted(path.stem for path in folder.glob("*_description.py"))


def _package() -> Path | None:
    """Return the folder of the package; None if it is not installed."""
    spec = find_spec("robot_descriptions")
    folders = [Path(folder) for folder in (spec.submodule_search_locations if spec else None) or ()]
    # Another folder may have that name.
    return folders[0] if folders and (folders[0] / "_repositories.py").is_file() else None


def _cache() -> Path:
    folder = os.environ.get("ROBOT_DESCRIPTIONS_CACHE", "~/.cache/robot_descriptions")
    return Path(os.path.expanduser(folder))  # noqa: PTH111 (Path.expanduser() fails for unknown users)


class _Constants:
    """The constants of a module that are texts, paths in the cache, or dictionaries of these."""

    def __init__(self, module: Path, repositories: Path) -> None:
        self._values = _assigned(module)
        self._repositories = _assigned(repositories).get("REPOSITORIES")

    def text(self, name: str) -> str | None:
        """Return the text of a constant; None if it does not exist or is computed in another way."""
        return self._text(self._values.get(name))

    def mapping(self, name: str) -> dict[str, str]:
        """Return a dictionary of texts, without the values that are computed in another way."""
        node = self._values.get(name)
        pairs = zip(node.keys, node.values, strict=True) if isinstance(node, ast.Dict) else ()
        found = {self._text(key): self._text(value) for key, value in pairs}
        return {key: value for key, value in found.items() if key is not None and value is not None}

    def _text(self, node: ast.expr | None, depth: int = 0) -> str | None:
        if depth > _MAX_DEPTH:
            return None
        if isinstance(node, ast.Constant):
            return node.value if isinstance(node.value, str) else None
        if isinstance(node, ast.Name):
            return self._text(self._values.get(node.id), depth + 1)
        if not isinstance(node, ast.Call):
            return None
        called = getattr(node.func, "attr", getattr(node.func, "id", ""))
        parts = [self._text(argument, depth + 1) for argument in node.args]
        if called == "join" and parts and None not in parts:
            return str(Path(*(part for part in parts if part is not None)))
        if called.endswith("clone_to_cache") and parts and parts[0] is not None:
            return self._clone(parts[0])
        return None

    def _clone(self, repository: str) -> str | None:
        """Return the folder of a repository in the cache."""
        node = self._repositories
        for key, value in zip(node.keys, node.values, strict=True) if isinstance(node, ast.Dict) else ():
            if isinstance(key, ast.Constant) and key.value == repository and isinstance(value, ast.Call):
                fields = {word.arg: self._text(word.value) for word in value.keywords}
                folder = fields.get("cache_path")
                commit = os.environ.get("ROBOT_DESCRIPTION_COMMIT")
                if folder is not None:
                    return str(_cache() / (f"{folder}-{commit}/{folder}" if commit else folder))
        return None


def _assigned(file: Path) -> dict[str, ast.expr]:
    """Return name → value of the assignments of a module."""
    try:
        tree = ast.parse(file.read_text("utf-8"))
    except (OSError, SyntaxError, ValueError):
        return {}
    found: dict[str, ast.expr] = {}
    for node in tree.body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            found[node.targets[0].id] = node.value
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.value is not None:
            found[node.target.id] = node.value
    return found
