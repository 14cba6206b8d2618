"""Names of packages and worlds: what ROS and Gazebo accept, and the nearest name that they would."""

from __future__ import annotations

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
    """Return `name` if packages may be called that.

    REP 144: lower case letters, digits and single underscores, a letter first, at least two characters.

    Args:
        name: what was asked for.
        suffixes: what the packages' names will end in; `name` must not bring it along.

    Raises:
        UsageError: it is no such name; says which near one is.
    """
    nearest = sanitised(name)
    for suffix in suffixes:
        if name.endswith(suffix):
            raise UsageError(
                f"name `{name}`: `{suffix}` is put behind it by itself; did you mean `{_stripped(name, suffix)}`?"
            )
    if not _is_package(name):
        hint = f"; did you mean `{_into(name, _is_package(PurePosixPath(name).name)) or nearest}`?"
        raise UsageError(
            f"name `{name}` is no ROS package name: lower case letters, digits and single underscores, a letter first, "
            f"at least two{hint}"
        )
    if len(name) > _LONGEST:
        raise UsageError(f"name `{name}` has {len(name)} characters; at most {_LONGEST}")
    return name


def check_world_name(name: str) -> str:
    """Return `name` if a world may be called that: its file, and in topics of Gazebo the word behind ``/world/``.

    Args:
        name: what was asked for.

    Raises:
        UsageError: it is no such name; says which near one is.
    """
    if _WORLD.fullmatch(name) and len(name) <= _LONGEST:
        return name
    bare = _WORLD_FILE.sub("", name)
    last = PurePosixPath(bare).name
    words = re.sub(r"\W+", "_", ascii_letters(bare), flags=re.ASCII).strip("_")
    near = f"world_{words}".rstrip("_") if not words[:1].isalpha() else words
    hint = _into(bare, _WORLD.fullmatch(last) is not None) or near[:_LONGEST].rstrip("_")
    raise UsageError(
        f"name `{name}` is no name of a world: at most {_LONGEST} letters, digits and underscores, a letter first; "
        f"did you mean `{hint}`?"
    )


def _is_package(name: str) -> bool:
    return len(name) > 1 and _VALID.fullmatch(name) is not None


def _into(name: str, is_name: bool) -> str:
    """Return the words that were meant by a path to something that is to be; none where its end is no name."""
    path = PurePosixPath(name)
    return f"{path.name} --into {path.parent}" if is_name and len(path.parts) > 1 and ".." not in path.parts else ""


def ascii_letters(name: str) -> str:
    """Return a name with letters in the place of those with accents, and without what has none.

    Args:
        name: anything.
    """
    return unicodedata.normalize("NFKD", name.replace("ß", "ss")).encode("ascii", "ignore").decode()


def sanitised(name: str) -> str:
    """Return the ROS package name nearest to `name`.

    Args:
        name: anything.
    """
    words = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", ascii_letters(name))
    words = re.sub(r"[^a-z0-9]+", "_", words.lower()).strip("_")
    if not words or not words[0].isalpha():
        words = f"robot_{words}".rstrip("_")
    return words[:_LONGEST].rstrip("_") if len(words) > 1 else f"{words}_robot"


def plain(name: str) -> str:
    """Return the name of a link or joint nearest to `name` that every tool takes; empty for none.

    Those are letters, digits, ``_``, ``-`` and ``.``, and ``/`` but in front.

    Args:
        name: anything.
    """
    if _PLAIN.fullmatch(name):
        return name
    return re.sub(r"[^\w./-]+", "_", ascii_letters(name), flags=re.ASCII).strip("_/")


def free(name: str, is_taken: Callable[[str], bool]) -> str:
    """Return `name`, or with the first number behind it that makes it one that is not taken: ``lidar_2``.

    Args:
        name: what it would be.
        is_taken: whether there is one of that name.
    """
    if not is_taken(name):
        return name
    return next(each for number in count(2) if not is_taken(each := f"{name}_{number}"))


def _stripped(name: str, suffix: str) -> str:
    return sanitised(name.removesuffix(suffix))
