"""Names of packages and worlds: validation by the rules of ROS and Gazebo, and the nearest valid name."""

import re
import unicodedata
from collections.abc import Callable, Iterable
from itertools import count
from pathlib import PurePosixPath

from urdfkit.errors import UsageError

_VALID = re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")
_WORLD = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_WORLD_FILE = re.compile(r"\.(sdf|world)$", re.IGNORECASE)
_PLAIN = re.compile(r"[A-Za-z0-9_.-][A-Za-z0-9_./-]*")
_LONGEST = 60


def check_package_name(name: str, *, suffixes: Iterable[str] = ()) -> str:
    """Return `name` if it is a valid name of a ROS package.

    By REP 144: lower-case letters, digits and single underscores, starting with a letter, at least two characters.

    Args:
        name: the requested name.
        suffixes: suffixes that the template appends to the name; `name` must not contain them.

    Raises:
        UsageError: the name is invalid; the message suggests a valid one.
    """
    nearest = sanitised(name)
    for suffix in suffixes:
        if name.endswith(suffix):
            raise UsageError(
                f"name `{name}`: `{suffix}` is appended automatically; did you mean `{_stripped(name, suffix)}`?"
            )
    if not _is_package(name):
        hint = f"; did you mean `{_into(name, _is_package(PurePosixPath(name).name)) or nearest}`?"
        raise UsageError(
            f"`{name}` is not a valid ROS package name: use lower-case letters, digits and single underscores, "
            f"start with a letter, and use at least two characters{hint}"
        )
    if len(name) > _LONGEST:
            raise UsageError(f"name `{name}` has {len(name)} characters; use at most {_LONGEST}")
    return name


def check_world_name(name: str) -> str:
    """Return `name` if it is a valid name of a world, for its file and for ``/world/NAME`` in Gazebo's topics.

    Args:
        name: the requested name.

    Raises:
        UsageError: the name is invalid; the message suggests a valid one.
    """
    if _WORLD.fullmatch(name) and len(name) <= _LONGEST:
        return name
    bare = _WORLD_FILE.sub("", name)
    last = PurePosixPath(bare).name
    words = re.sub(r"\W+", "_", ascii_letters(bare), flags=re.ASCII).strip("_")
    near = f"world_{words}".rstrip("_") if not words[:1].isalpha() else words
    hint = _into(bare, _WORLD.fullmatch(last) is not None) or near[:_LONGEST].rstrip("_")
    raise UsageError(
        f"`{name}` is not a valid world name: use at most {_LONGEST} letters, digits and underscores, and start with "
        f"a letter; did you mean `{hint}`?"
    )


def _is_package(name: str) -> bool:
    return len(name) > 1 and _VALID.fullmatch(name) is not None


def _into(name: str, is_name: bool) -> str:
    """Return ``NAME --into FOLDER`` for a path whose last component is a valid name; otherwise an empty text."""
    path = PurePosixPath(name)
    return f"{path.name} --into {path.parent}" if is_name and len(path.parts) > 1 and ".." not in path.parts else ""


def ascii_letters(name: str) -> str:
    """Return `name` in ASCII: accents are removed from letters, and characters without an ASCII form are dropped.

    Args:
        name: any text.
    """
    return unicodedata.normalize("NFKD", name.replace("ß", "ss")).encode("ascii", "ignore").decode()


def sanitised(name: str) -> str:
    """Return the ROS package name nearest to `name`.

    Args:
        name: any text.
    """
    words = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", ascii_letters(name))
    words = re.sub(r"[^a-z0-9]+", "_", words.lower()).strip("_")
    if not words or not words[0].isalpha():
        words = f"robot_{words}".rstrip("_")
    return words[:_LONGEST].rstrip("_") if len(words) > 1 else f"{words}_robot"


def portable_name(name: str) -> str:
    """Return the nearest name of a link or joint that every tool accepts; empty if there is no such name.

    Every tool accepts letters, digits, ``_``, ``-`` and ``.``, and ``/`` except as the first character.

    Args:
        name: any text.
    """
    if _PLAIN.fullmatch(name):
        return name
    return re.sub(r"[^\w./-]+", "_", ascii_letters(name), flags=re.ASCII).strip("_/")


def unused_name(name: str, is_used: Callable[[str], bool]) -> str:
    """Return `name`, or `name` with the lowest number appended that makes it unused: ``lidar_2``.

    Args:
        name: the preferred name.
        is_used: returns whether a name is in use.
    """
    if not is_used(name):
        return name
    return next(each for number in count(2) if not is_used(each := f"{name}_{number}"))


def _stripped(name: str, suffix: str) -> str:
    return sanitised(name.removesuffix(suffix))
