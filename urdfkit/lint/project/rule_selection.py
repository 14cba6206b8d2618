"""Rule selection: ``--select`` and ``--ignore`` accept codes and prefixes of codes (``I``, ``I5``, ``I503``)."""

from collections.abc import Callable, Iterable

from urdfkit.defect_message import Suggestion
from urdfkit.errors import UsageError, did_you_mean


def selection(
    select: Iterable[str], ignore: Iterable[str], codes: Callable[[], tuple[str, ...]]
) -> Callable[[str], bool]:
    """Return the predicate that accepts the codes to report.

    Args:
        select: codes to report; all if empty.
        ignore: codes not to report, unless `select` has a longer prefix of the code.
        codes: returns the existing codes; called only to validate prefixes.

    Raises:
        UsageError: a prefix matches no code.
    """
    chosen, left_out = checked("--select", select, codes), checked("--ignore", ignore, codes)

    def wanted(code: str) -> bool:
        for_it = max((len(prefix) for prefix in chosen if code.startswith(prefix)), default=0 if chosen else 0.5)
        against = max((len(prefix) for prefix in left_out if code.startswith(prefix)), default=0)
        return for_it > against

    return wanted


def similar_code(code: str, codes: Iterable[str]) -> str:
    """Return the `Suggestion` of the rule that a code resembles, first of all with a zero for each letter O."""
    rules = tuple(codes)
    zeros = code[:1] + code[1:].upper().replace("O", "0")
    return Suggestion(zeros, code) if zeros in rules else did_you_mean(code, rules)


def checked(option: str, prefixes: Iterable[str], codes: Callable[[], tuple[str, ...]]) -> tuple[str, ...]:
    """Return validated codes and prefixes of codes, in capitals.

    Args:
        option: the option or setting, for messages.
        prefixes: codes or prefixes; one text may hold several, separated by commas.
        codes: returns the existing codes.

    Raises:
        UsageError: a prefix matches no code.
    """
    wanted = tuple(word.strip().upper() for prefix in prefixes for word in prefix.split(",") if word.strip())
    for prefix in wanted:
        if not any(code.startswith(prefix) for code in codes()):
            near = similar_code(prefix, codes()) or "; `urdfkit rule` lists the rules"
            raise UsageError(f"{option} {prefix}: unknown rule{near}")
    return wanted
