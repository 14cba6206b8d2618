"""Expand a xacro file, traced: every expanded element knows its file, line, column and chain of macro calls.

This is stock xacro; nothing of its language is written anew. The files are parsed by a builder that stamps each
element with its place (minidom keeps the stamp as user data and hands it to clones), and a macro call renews the
stamps of the body it clones. This module is the only owner of xacro's module globals: it sets them for one expansion
and puts them back, under a lock, so that expansions can follow each other in any order, from any thread, after any
error.

Files come from strangers. xacro evaluates ``${…}`` and ``$(eval …)`` as Python, and its own precautions can be got
round (nested functions hide their names from its check; ``$(eval …)`` sees every builtin). Here the check covers
nested code, frames and ``vars``, and ``$(eval …)`` gets harmless builtins only; see `evaluation`. What stays possible,
as it is part of the language: reading YAML files anywhere (``load_yaml``), reading environment variables, including
XML files anywhere. What would take for ever or fill the memory (``${9**9**9}``) is refused; see `expressions.limits`.
"""

from __future__ import annotations

import sys
from _thread import RLock  # threading itself takes half a millisecond to import
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from types import ModuleType

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xml.reader import absolute, document_of, read_source, shown_path
from urdfkit.errors import ResourceError, XmlError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.xacro.expansion import Run
    from urdfkit.description.xacro.fast.incremental import Memory
    from urdfkit.description.xacro.recovery import RecoveringRun

_LATER = ("ast", "glob", "xacro.cli")
"""What xacro imports and needs for odd names, for includes with ``*``, and for its own command line."""

_LOCK = RLock()
_RECURSION_LIMIT = 10_000


def expand(
    path: str | Path,
    *,
    arguments: Mapping[str, str] | None = None,
    packages: Packages | None = None,
    run_xacro: bool | None = None,
) -> Expanded:
    """Expand a file; stop at the first error.

    Args:
        path: a xacro or URDF file.
        arguments: values for ``$(arg …)``.
        packages: resolves ``$(find …)``; by default what lies near the file and in the environment.
        run_xacro: whether to run xacro; by default on everything but ``.urdf`` files, which consumers read as they are.

    Raises:
        ResourceError: no such file.
        XmlError: it, or a file it includes, is not well-formed or is hostile.
        XacroError: xacro could not expand it.
    """
    _check_exists(path)
    packages = packages if packages is not None else Packages(near=path)
    if not (is_xacro(path) if run_xacro is None else run_xacro):
        return _read_plain(path, packages)
    from urdfkit.description.xacro.diagnosis import error_of
    from urdfkit.description.xacro.expansion import Run

    run = Run(str(path), arguments or {}, packages)
    with _xacro_for(run):
        try:
            run.expand()
        except XmlError:
            raise
        except Exception as error:
            raise error_of(error, run) from None
    return run.outcome()


def expand_leniently(
    path: str | Path,
    *,
    arguments: Mapping[str, str] | None = None,
    packages: Packages | None = None,
    run_xacro: bool | None = None,
    mend_prefixes: bool = True,
    texts: Mapping[str, str] | None = None,
    memory: Memory | None = None,
) -> Expanded:
    """Expand a file and go on after errors, which are in `Expanded.faults`.

    An undefined property leaves its expression standing, an undefined macro or a missing include is dropped, a
    property or macro defined too late is used all the same.

    Args:
        path: a xacro or URDF file.
        arguments: values for ``$(arg …)``.
        packages: resolves ``$(find …)``.
        run_xacro: see `expand`.
        mend_prefixes: read directives and macro calls without ``xacro:`` as if they had it.
        texts: contents to read instead of those on disk, by absolute path.
        memory: what is known of the files from when they were expanded before.

    Raises:
        ResourceError: no such file (the entry; a missing include is a fault).
    """
    _check_exists(path)
    packages = packages if packages is not None else Packages(near=path)
    if not (is_xacro(path) if run_xacro is None else run_xacro):
        return _read_plain_leniently(path, packages, texts or {}, memory)
    from urdfkit.description.xacro.fast.expansion import QuickRun
    from urdfkit.description.xacro.recovery import RecoveringRun

    first = QuickRun(str(path), arguments or {}, packages, mend_prefixes=mend_prefixes, texts=texts)
    first.memory = memory
    quick = recovered(first)
    if memory is not None:
        memory.settle(quick.root)
    if isinstance(quick, QuickRun) and quick.is_mixed:
        run = RecoveringRun(str(path), arguments or {}, packages, mend_prefixes=mend_prefixes, texts=texts)
        return recovered(run).outcome()
    return quick.outcome()


def recovered(run: RecoveringRun) -> RecoveringRun:
    """Expand by a run, and by others that know what the one before found defined too late; return the last."""
    for _ in range(3):
        with _xacro_for(run):
            run.expand()
        if (again := run.with_hindsight()) is None:
            break
        run = again
    return run


def is_xacro(path: str | Path) -> bool:
    """Whether a file is run through xacro: all but ``.urdf`` files are (which xacro leaves as they are if plain)."""
    return not str(path).lower().endswith(".urdf")


class _Later(ModuleType):
    """A module that is imported when somebody takes something from it."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        if sys.modules.get(self.__name__) is self:
            del sys.modules[self.__name__]
        return getattr(import_module(self.__name__), name)


def _process_args(*arguments: Any, **options: Any) -> Any:
    from xacro.cli import process_args

    return process_args(*arguments, **options)


def _stock() -> Any:
    """Import xacro without what most files do not need of it: that takes as long as expanding a small one."""
    if "xacro" not in sys.modules:
        later: dict[str, Any] = {name: _Later(name) for name in _LATER if name not in sys.modules}
        if "xacro.cli" in later:
            later["xacro.cli"].process_args = _process_args
        sys.modules.update(later)
        try:
            import xacro
        finally:
            for name, module in later.items():
                if sys.modules.get(name) is module:
                    del sys.modules[name]
    import xacro

    return xacro


@contextmanager
def _xacro_for(run: Run) -> Iterator[None]:
    """Lend xacro's module globals to one run."""
    xacro = _stock()
    with _LOCK:
        lent = run.take(xacro)
        saved = {name: getattr(xacro, name) for name in lent}
        recursion_limit = sys.getrecursionlimit()
        vars(xacro).update(lent)
        # The hooks add frames to every level of macro calls; what stock xacro can nest must still fit.
        sys.setrecursionlimit(max(recursion_limit, _RECURSION_LIMIT))
        try:
            yield
        finally:
            sys.setrecursionlimit(recursion_limit)
            vars(xacro).update(saved)


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
    path: str | Path, packages: Packages, texts: Mapping[str, str], memory: Memory | None
) -> Expanded:
    from urdfkit.description.xacro.faults import Fault

    try:
        return _read_plain(path, packages, texts, memory)
    except XmlError as error:
        if error.position is None:
            raise
        shown = shown_path(path)
        return Expanded(
            path=Path(path),
            root=None,
            files=(absolute(path),),
            sources={shown: read_source(Path(path), shown_as=shown, texts=texts)},
            packages=packages,
            faults=(Fault("xml", error.message, error.position),),
        )


def _check_exists(path: str | Path) -> None:
    """Refuse what is no file.

    Raises:
        ResourceError: it is a folder or not there, with the nearest name.
    """
    from urdfkit.description.packages.resolver import near_path

    path = Path(path)
    if path.is_dir():
        raise ResourceError(f"{path} is a folder, not a description")
    if not path.exists():
        raise ResourceError(f"no such file: {path}{near_path(path)}")
