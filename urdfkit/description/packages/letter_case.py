"""Find files whose path differs from a written one in capital letters only."""

from pathlib import Path

from urdfkit.description.packages.existence import is_file, is_folder


def in_any_case(path: Path) -> Path | None:
    """Return the one existing file whose path differs in capital letters; None without one, or with several.

    Args:
        path: a path that does not exist.
    """
    missing: list[str] = []
    while not is_folder(path):
        if path == path.parent:
            return None
        missing.insert(0, path.name)
        path = path.parent
    for name in missing:
        try:
            found = [child for child in path.iterdir() if child.name.lower() == name.lower()]
        except OSError:
            return None
        exact = [child for child in found if child.name == name]
        if len(exact or found) != 1:
            return None
        path = (exact or found)[0]
    return path if is_file(path) else None
