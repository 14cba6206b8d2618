"""The errors of urdfkit, as a tree of classes.

::

    UrdfkitError                 root of all errors of urdfkit; the command line prints it in one line and exits with 2
    ├── UsageError               an argument or option makes no sense
    ├── ResourceError            a robot, world, package or file name resolves to nothing
    ├── DescriptionError         the description cannot be read as a robot
    │   ├── XmlError             not well-formed XML, or XML that is hostile
    │   ├── XacroError           xacro could not expand the file
    │   └── ModelError           well-formed, but no tree of links and joints (two roots, a cycle, ...)
    ├── KinematicsError          unknown frame or joint, a value outside the model
    │   └── JointLimitError      carries joint, value, lower, upper (urdfkit.kinematics)
    ├── SimulationError          the robot or the world cannot be simulated
    │   └── UnknownNameError     unknown name in a simulation; also a KeyError
    └── MissingDependencyError   an optional package is not installed; carries the command to run

A message is one line. It states the defect, the value with its unit, the position (``file:line:column``) and the
nearest valid alternative.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextvars import ContextVar

from urdfkit.defect_message import Suggestion

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection

    from urdfkit.position import Position


class UrdfkitError(Exception):
    """Root of all errors meant for the user.

    Args:
        message: the defect and the valid alternative, without the position.
        position: the position in the source file, if there is one.
        code: code of the lint rule that reports the same defect; None if unknown.

    Examples:
        >>> import urdfkit
        >>> try:
        ...     urdfkit.load("simpelton")
        ... except urdfkit.UrdfkitError as error:
        ...     print(error)
        no robot, file or folder `simpelton`; did you mean `simpleton`?
    """

    def __init__(self, message: str, *, position: Position | None = None, code: str | None = None) -> None:
        self.message = message
        self.position = position
        self.code = code
        super().__init__(f"{position}: {message}" if position is not None else message)

    def __str__(self) -> str:
        """Return the message with its position, in one line."""
        return one_line(Exception.__str__(self))


class UsageError(UrdfkitError):
    """An argument or option makes no sense."""


class ResourceError(UrdfkitError):
    """A robot, world, package or file name resolves to nothing.

    Args:
        message: see `UrdfkitError`.
        position: see `UrdfkitError`.
        kind: ``name`` for an empty one, ``package`` or ``file`` for a missing one, ``format`` for an unsupported format
            of a file, otherwise empty.
        near: for a missing file, the similar name of a file or folder that the message suggests.
        package: name of a missing package.
    """

    def __init__(
        self,
        message: str,
        *,
        position: Position | None = None,
        kind: str = "",
        near: str | None = None,
        package: str = "",
    ) -> None:
        super().__init__(message, position=position)
        self.kind, self.near, self.package = kind, near, package

    def at(self, position: Position | None) -> ResourceError:
        """Return the error with a position."""
        return ResourceError(self.message, position=position, kind=self.kind, near=self.near, package=self.package)


class DescriptionError(UrdfkitError):
    """The description cannot be read as a robot."""


class XmlError(DescriptionError):
    """Not well-formed XML, or XML that is hostile (entity declarations, external entities).

    Args:
        message: see `UrdfkitError`.
        position: see `UrdfkitError`.
        cause: the error of the parser, such as ``unbound prefix``; empty for hostile XML.
    """

    def __init__(self, message: str, *, position: Position | None = None, cause: str = "") -> None:
        super().__init__(message, position=position)
        self.cause = cause


class XacroError(DescriptionError):
    """xacro could not expand the file."""


class ModelError(DescriptionError):
    """Well-formed, but not one tree of links and joints that can be loaded."""


class KinematicsError(UrdfkitError):
    """An unknown frame or joint, or a joint value outside the model."""


class SimulationError(UrdfkitError):
    """The robot or the world cannot be simulated."""


class UnknownNameError(SimulationError, KeyError):
    """Unknown name in a simulation; also a KeyError, as users of mappings expect."""


class MissingDependencyError(UrdfkitError):
    """An optional dependency is not installed."""


_MAX_MESSAGE = 1_000


def shortened(message: str) -> str:
    """Return a message of at most 1,000 characters, without its middle: names can be as long as a file."""
    return message if len(message) <= _MAX_MESSAGE else f"{message[: _MAX_MESSAGE - 100]} … {message[-90:]}"


def short_lines(text: str) -> str:
    """Return a text of several lines, each shortened."""
    return "\n".join(map(shortened, text.split("\n")))


def one_line(text: str) -> str:
    """Return a text, shortened, with characters that control a terminal as escape sequences.

    Names of files, links and joints come from others: line ends would forge messages, and escape sequences would run.
    """
    text = shortened(text)
    if text.isprintable():
        return text
    return "".join(letter if letter.isprintable() else repr(letter)[1:-1] for letter in text)


def bug(error: BaseException, package: str = "urdfkit") -> str:
    """Return one line about an unexpected error: the package at fault, its message, and where it was raised.

    Args:
        error: as it was caught.
        package: the package at fault.
    """
    frame = error.__traceback__
    while frame is not None and frame.tb_next is not None:
        frame = frame.tb_next
    place = f"{frame.tb_frame.f_code.co_filename}:{frame.tb_lineno}" if frame is not None else "unknown place"
    what = " ".join(str(error).split())
    return f"a bug in {package}, not in your files: {type(error).__name__}: {what} ({place})"


MAX_COMPARED = 40_000
"""Names compared for all suggestions of one run; a lint of a large robot with some typos compares a few thousand."""
MAX_COMPARED_LENGTH = 200
"""Characters of the longest name that is compared: the time grows with the square of the length."""
MAX_CANDIDATES = 500
"""Names of one pool whose similarity is estimated by their letters: those with the most equal letters at both ends."""
MAX_RATED = 50
"""Names of one pool whose similarity is computed, those with the largest estimates."""
_MAX_POOLS = 50


class LimitedSuggestions:
    """Compares at most `MAX_COMPARED` names for the suggestions of a block, in which pools of names do not change.

    Comparing each of many misspelt names with each of many others takes minutes. Names beyond the limit get no
    suggestion, unless they differ by case only.
    """

    def __init__(self) -> None:
        self.left = 0
        self._pools: dict[int, tuple[Collection[str], int, dict[str, str]]] = {}

    def __enter__(self) -> None:
        self.left = MAX_COMPARED
        self._token = _limits.set(self)

    def __exit__(self, *_: object) -> None:
        _limits.reset(self._token)
        self._pools.clear()

    def by_lower_case(self, pool: Collection[str]) -> dict[str, str]:
        """Return the names of a pool by their lower-case forms, computed once for a pool."""
        cached, size, found = self._pools.get(id(pool), (None, 0, {}))
        if cached is not pool or size != len(pool):
            if len(self._pools) >= _MAX_POOLS:
                self._pools.clear()
            found = _by_lower_case(pool)
            self._pools[id(pool)] = pool, len(pool), found
        return found


_limits: ContextVar[LimitedSuggestions | None] = ContextVar("_limits", default=None)


def may_suggest() -> bool:
    """Return whether names may still be compared in the `LimitedSuggestions` around; checked before collecting them."""
    limits = _limits.get()
    return limits is None or limits.left > 0


def similar(name: str, pool: Collection[str], *, count: int = 1, cutoff: float = 0.6) -> list[str]:
    """Return the names of a pool that are most similar to a name, the most similar first.

    In a pool of more than `MAX_CANDIDATES` names, names whose first and last letters differ may be missed.

    Args:
        name: the name that the user wrote.
        pool: the valid names.
        count: maximum number of results.
        cutoff: minimum similarity, 1 for equal names (`difflib.SequenceMatcher.ratio`).
    """
    if len(name) > MAX_COMPARED_LENGTH:
        return []
    limits = _limits.get()
    if limits is not None:
        if limits.left < len(pool):
            limits.left = 0
            return []
        limits.left -= len(pool)
    from difflib import SequenceMatcher
    from heapq import nlargest

    names: Collection[str] = [one for one in pool if len(one) <= MAX_COMPARED_LENGTH]
    if len(names) > MAX_CANDIDATES:
        names = nlargest(MAX_CANDIDATES, names, key=lambda one: _equal_ends(name, one) / (len(name) + len(one) or 1))
    matcher = SequenceMatcher()
    matcher.set_seq2(name)
    estimates = []
    for one in names:
        matcher.set_seq1(one)
        if matcher.real_quick_ratio() >= cutoff and (estimate := matcher.quick_ratio()) >= cutoff:
            estimates.append((estimate, _equal_ends(name, one), one))
    found: list[tuple[float, str]] = []
    for estimate, _, one in sorted(estimates, reverse=True)[: max(MAX_RATED, count)]:
        if len(found) >= count and estimate < found[-1][0]:  # the estimate is an upper bound
            break
        matcher.set_seq1(one)
        if (ratio := matcher.ratio()) >= cutoff:
            found = sorted([*found, (ratio, one)], reverse=True)[:count]
    return [one for _, one in found]


def _equal_ends(one: str, other: str) -> int:
    """Return the number of equal letters at the starts and the ends of two names; one more letter does not count."""
    if one == other:
        return len(one)
    start = max(_equal(one, other), _equal(one[1:], other), _equal(one, other[1:]))
    one, other = one[::-1], other[::-1]
    end = max(_equal(one, other), _equal(one[1:], other), _equal(one, other[1:]))
    return min(start + end, len(one), len(other))


def _equal(one: str, other: str) -> int:
    """Return the number of equal letters at the starts of two names."""
    count = 0
    for letter, its in zip(one, other, strict=False):
        if letter != its:
            break
        count += 1
    return count


def _by_lower_case(names: Iterable[str]) -> dict[str, str]:
    return {name.lower(): name for name in names}


def nearest(name: str, candidates: Iterable[str], *, cutoff: float = 0.6) -> str | None:
    """Return the candidate most similar to `name`, or equal except for case; None if none is similar.

    Args:
        name: the name the user wrote.
        candidates: the valid names.
        cutoff: see `similar`.
    """
    pool: Collection[str] = candidates if isinstance(candidates, (dict, frozenset)) else dict.fromkeys(candidates)
    limits = _limits.get()
    lowered = _by_lower_case(pool) if limits is None or pool is not candidates else limits.by_lower_case(pool)
    if name.lower() in lowered:
        return lowered[name.lower()]
    return next(iter(similar(name, pool, cutoff=cutoff)), None)


def did_you_mean(name: str, candidates: Iterable[str]) -> str:
    """Return the `Suggestion` of the candidate nearest to `name`; empty if none is similar.

    Args:
        name: the name the user wrote.
        candidates: the valid names.
    """
    return Suggestion(nearest(name, candidates), name)
