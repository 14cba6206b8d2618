"""Expand a file and continue after failures.

If a property or macro is defined after its use, the file is expanded again with the definitions of the first pass.
"""

from __future__ import annotations

from collections.abc import Mapping

from urdfkit.description.xacro.evaluation.reuse import MixedContent
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xacro.recovery.late_definitions import LateDefinitions
from urdfkit.description.xacro.recovery.recovering_evaluator import RecoveringEvaluator

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.packages.resolver import Packages
    from urdfkit.description.xacro.memory import Memory

_PASSES = 3
"""Expansions of one file, each with the late definitions that the one before found."""


def expand_with_recovery(
    path: str,
    arguments: Mapping[str, str],
    packages: Packages,
    *,
    add_prefixes: bool,
    texts: Mapping[str, str] | None = None,
    memory: Memory | None = None,
) -> Expanded:
    """Expand a file as far as possible; the failures are in `Expanded.faults`.

    Args:
        path: as the user named it.
        arguments: values of ``$(arg …)``.
        packages: resolves ``$(find …)``.
        add_prefixes: read directives and macro calls without ``xacro:`` as if they had it.
        texts: contents to read instead of those on disk, by absolute path.
        memory: what earlier expansions of the file read.

    Raises:
        ResourceError: the file cannot be read.
    """
    try:
        return _expanded(path, arguments, packages, add_prefixes, texts, memory)
    except MixedContent:
        return _expanded(path, arguments, packages, add_prefixes, texts, None)


def _expanded(
    path: str,
    arguments: Mapping[str, str],
    packages: Packages,
    add_prefixes: bool,
    texts: Mapping[str, str] | None,
    memory: Memory | None,
) -> Expanded:
    late = LateDefinitions()
    for number in range(_PASSES):
        evaluator = RecoveringEvaluator(
            path, arguments, packages, late, add_prefixes=add_prefixes, texts=texts, memory=memory
        )
        evaluator.run_all()
        if number == _PASSES - 1 or not evaluator.learn():
            break
    return evaluator.outcome()
