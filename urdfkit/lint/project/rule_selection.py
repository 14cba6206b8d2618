"""Which rules are wanted: ``--select`` and ``--ignore`` take codes and their beginnings (``I``, ``I5``, ``I503``)."""

from __future__ import annotations

from urdfkit.errors import UsageError, did_you_mean

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable


def selection(
    select: Iterable[str], ignore: Iterable[str], codes: Callable[[], tuple[str, ...]]
) -> Callable[[str], bool]:
    """Return whether a code is wanted, as a function.

    Args:
        select: codes to report; all where it is empty.
        ignore: codes not to report, unless `select` names them more exactly.
        codes: the codes there are; called only to check what was given.

    Raises:
        UsageError: one of them is no code, nor the beginning of one.
    """
    chosen, left_out = checked("--select", select, codes), checked("--ignore", ignore, codes)

    def wanted(code: str) -> bool:
        for_it = max((len(prefix) for prefix in chosen if code.startswith(prefix)), default=0 if chosen else 0.5)
        against = max((len(prefix) for prefix in left_out if code.startswith(prefix)), default=0)
        return for_it > against

    return wanted


def checked(option: str, prefixes: Iterable[str], codes: Callable[[], tuple[str, ...]]) -> tuple[str, ...]:
    """Return codes, or beginnings of codes, one by one, in capitals.

    Args:
        option: what gave them.
        prefixes: the codes, several of which may stand in one text, with commas between.
        codes: the codes there are.

    Raises:
        UsageError: one of them is no code, nor the beginning of one.
    """
    wanted = tuple(word.strip().upper() for prefix in prefixes for word in prefix.split(",") if word.strip())
    for prefix in wanted:
        if not any(code.startswith(prefix) for code in codes()):
            raise UsageError(
                f"{option} {prefix}: there is no such rule{did_you_mean(prefix, codes())}; see urdfkit rule"
            )
    return wanted
