"""Expand a xacro file: every expanded element has its file, line, column and chain of macro calls.

`expand` stops at the first error, `expand_leniently` records it and continues. Both use the evaluator in `evaluation`.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xml.misplaced_declaration import without_declaration
from urdfkit.description.xml.reader import document_of, read_source, shown_path
from urdfkit.description.xml.source import absolute
from urdfkit.errors import ResourceError, XmlError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.xacro.memory import Memory

_PASSES = 3
"""Expansions of one file by `expand_leniently`, each with the late definitions that the one before found."""


def expand(
    path: str | Path,
    *,
    arguments: Mapping[str, str] | None = None,
    packages: Packages | None = None,
    run_xacro: bool | None = None,
    texts: Mapping[str, str] | None = None,
) -> Expanded:
    """Expand a file; stop at the first error.

    Args:
        path: a xacro or URDF file.
        arguments: values for ``$(arg …)``.
        packages: resolves ``$(find …)``; by default what lies near the file and in the environment.
        run_xacro: whether to run xacro; by default on everything but ``.urdf`` files, which consumers read as they are.
        texts: contents to read instead of those on disk, by absolute path.

    Raises:
        ResourceError: no such file.
        XmlError: it, or a file it includes, is not well-formed or is hostile.
        XacroError: xacro could not expand it.
    """
    if str(absolute(path)) not in (texts or {}):
        _check_exists(path)
    packages = packages if packages is not None else Packages(near=path)
    if not (is_xacro(path) if run_xacro is None else run_xacro):
        return _read_plain(path, packages, texts)
    from urdfkit.description.xacro.evaluation.evaluator import Evaluator

    return Evaluator(str(path), arguments or {}, packages, texts=texts).expand()


def expand_leniently(
    path: str | Path,
    *,
    arguments: Mapping[str, str] | None = None,
    packages: Packages | None = None,
    run_xacro: bool | None = None,
    add_prefixes: bool = True,
    texts: Mapping[str, str] | None = None,
    memory: Memory | None = None,
) -> Expanded:
    """Expand a file and continue after errors, which are in `Expanded.faults`.

    What uses an undefined property keeps its expression; a call of an undefined macro and the include of a missing file
    are dropped. If a property or macro is defined after its use, the file is expanded again with the definitions of the
    first pass.

    Args:
        path: a xacro or URDF file.
        arguments: values for ``$(arg …)``.
        packages: resolves ``$(find …)``.
        run_xacro: see `expand`.
        add_prefixes: read directives and macro calls without ``xacro:`` as if they had it.
        texts: contents to read instead of those on disk, by absolute path.
        memory: elements of the last expansion of the file, to be used again where they are the same.

    Raises:
        ResourceError: no such file (the entry; a missing include is a fault).
    """
    _check_exists(path)
    packages = packages if packages is not None else Packages(near=path)
    if not (is_xacro(path) if run_xacro is None else run_xacro):
        return _read_plain_leniently(path, packages, texts, memory)
    from urdfkit.description.xacro.evaluation.reuse import MixedContent
    from urdfkit.description.xacro.recovery.recovering_calls import LateDefinitions
    from urdfkit.description.xacro.recovery.recovering_evaluator import RecoveringEvaluator

    def expanded(memory: Memory | None) -> Expanded:
        late = LateDefinitions()
        for number in range(_PASSES):
            evaluator = RecoveringEvaluator(
                str(path), arguments or {}, packages, late, add_prefixes=add_prefixes, texts=texts, memory=memory
            )
            evaluator.run_all()
            if number == _PASSES - 1 or not evaluator.learn():
                break
        return evaluator.outcome()

    try:
        return expanded(memory)
    except MixedContent:
        return expanded(None)


def is_xacro(path: str | Path) -> bool:
    """Whether a file is run through xacro: all but ``.urdf`` files are (which xacro leaves as they are if plain)."""
    return not str(path).lower().endswith(".urdf")


def _read_plain(
    path: str | Path, packages: Packages, texts: Mapping[str, str] | None = None, memory: Memory | None = None
) -> Expanded:
    source = read_source(Path(path), shown_as=shown_path(path), texts=texts)
    return Expanded(
        path=Path(path),
        root=document_of(source) if memory is None else memory.element(source),
        files=(absolute(path),),
        sources={source.file: source},
        packages=packages,
        _print=lambda: expand(path, packages=packages, run_xacro=True).xml,
    )


def _read_plain_leniently(
    path: str | Path, packages: Packages, texts: Mapping[str, str] | None, memory: Memory | None
) -> Expanded:
    from urdfkit.description.xacro.faults import Fault

    try:
        return _read_plain(path, packages, texts, memory)
    except XmlError as error:
        if error.position is None:
            raise
        fault = Fault("xml", error.message, error.position, details={"cause": error.cause})
        shown = shown_path(path)
        sources = {shown: read_source(Path(path), shown_as=shown, texts=texts)}
        text = without_declaration(sources[shown].text, error)
        if text is not None:
            rest = _read_plain_leniently(path, packages, {**(texts or {}), str(absolute(path)): text}, memory)
            return Expanded(**{**rest.__dict__, "sources": sources, "faults": (fault, *rest.faults)})
        files = (absolute(path),)
        return Expanded(path=Path(path), root=None, files=files, sources=sources, packages=packages, faults=(fault,))


def _check_exists(path: str | Path) -> None:
    """Refuse a path that is not a file.

    Raises:
        ResourceError: it is a folder or not there, with the nearest name.
    """
    from urdfkit.missing_files import missing_path

    path = Path(path)
    if path.is_dir():
        raise ResourceError(f"{path} is a folder, not a description")
    if not path.exists():
        raise ResourceError(missing_path(path))
