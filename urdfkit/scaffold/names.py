"""Package names: what ROS accepts, and the nearest name that it would."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from itertools import count

from urdfkit.errors import UsageError

_VALID = re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")
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
    if not _VALID.fullmatch(name) or len(name) < 2:
        hint = f"; did you mean `{nearest}`?" if nearest != name else ""
        raise UsageError(
            f"name `{name}` is no ROS package name: lower case letters, digits and single underscores, a letter first, "
            f"at least two{hint}"
        )
    if len(name) > _LONGEST:
        raise UsageError(f"name `{name}` has {len(name)} characters; at most {_LONGEST}")
    return name


def sanitised(name: str) -> str:
    """Return the ROS package name nearest to `name`.

    Args:
        name: anything.
    """
    words = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name)
    words = re.sub(r"[^a-z0-9]+", "_", words.lower()).strip("_")
    if not words or not words[0].isalpha():
        words = f"robot_{words}".rstrip("_")
    return words[:_LONGEST].rstrip("_") if len(words) > 1 else f"{words}_robot"


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
