"""Import Pinocchio, or raise an error with the command that installs it."""

import platform
import sys
from typing import Any

from urdfkit.errors import MissingDependencyError

INSTALL = "pip install 'urdfkit[view]'"


def require_pinocchio(needed_by: str = "tf, view and sim") -> Any:
    """Return the module ``pinocchio``.

    Args:
        needed_by: the subject of the error message.

    Raises:
        MissingDependencyError: Pinocchio is not installed, has no wheel for this platform, a shared library that its
            wheel uses is missing, or another package of that name shadows it.
    """
    verb = "need" if " and " in needed_by else "needs"
    try:
        import pinocchio
    except ImportError as error:
        if "libgomp.so.1" in str(error):  # its wheel leaves OpenMP to the system
            remedy = "apt-get install libgomp1 on Debian and Ubuntu, dnf install libgomp on Fedora"
            raise MissingDependencyError(f"{needed_by} {verb} the library libgomp.so.1: {remedy}") from error
        raise MissingDependencyError(f"{needed_by} {verb} pinocchio: {_remedy()}") from error
    if not hasattr(pinocchio, "SE3"):
        raise MissingDependencyError(
            f"{needed_by} {verb} pinocchio, but the package installed under that name is not the robotics library: "
            f"pip uninstall pinocchio && {_remedy()}"
        )
    return pinocchio


def _remedy() -> str:
    """Return the command to run; ``pin`` has wheels for Linux x86-64 and arm64 and for macOS arm64."""
    machine = platform.machine().lower()
    if sys.platform == "win32":
        return f"it has no wheels for Windows; inside WSL (wsl --install) run {INSTALL}"
    if sys.platform == "darwin" and machine == "x86_64":
        return f"it has no wheels for macOS on Intel; use Linux (a container; on Windows, WSL) and run {INSTALL}"
    return INSTALL
