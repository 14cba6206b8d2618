"""Expand a xacro file, traced: every expanded element knows its file, line, column and chain of macro calls."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from urdfkit.description.expanded import Expanded

if TYPE_CHECKING:
    from urdfkit.description.packages import Packages


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
    raise NotImplementedError


def expand_leniently(
    path: str | Path,
    *,
    arguments: Mapping[str, str] | None = None,
    packages: Packages | None = None,
    run_xacro: bool | None = None,
    mend_prefixes: bool = True,
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

    Raises:
        ResourceError: no such file (the entry; a missing include is a fault).
    """
    raise NotImplementedError
