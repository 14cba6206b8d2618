"""Where packages were written to: a word where no build tool looks for them, and where saying so is all that failed."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from urdfkit.errors import ResourceError


def misplaced(into: Path, files: Iterable[Path], *, robot: bool = False) -> str:
    """Return why packages should be elsewhere; empty where they should not, or where none were written.

    colcon and catkin look for no packages inside a package; catkin_make looks in a workspace's ``src`` only.

    Args:
        into: where they were written to.
        files: that were written.
        robot: whether it is one, which is a package without ``package.xml`` where it is for no ROS.
    """
    ros = any(file.name == "package.xml" for file in files)
    if not (ros or robot):
        return ""
    into = into.resolve()
    for folder in (into, *into.parents):
        if any((folder / name).is_file() for name in ("package.xml", "urdfkit-new.toml")):
            tools = ": colcon and catkin look for none in there" if ros else ""
            return f"written inside the package {folder.name}{tools}; they belong beside it, in {folder.parent}"
    if ros and (into / "src").is_dir():
        return "written beside `src`: if this is a workspace, its packages belong in there (--into src)"
    return ""


@contextmanager
def told_of_what_is_written(into: Path) -> Iterator[None]:
    """Print what was written, in the block; where it cannot be printed, say that it is there all the same.

    Args:
        into: where it was written to.

    Raises:
        ResourceError: what was printed could not be, e.g. for want of space.
        BrokenPipeError: nobody reads it any more.
    """
    try:
        yield
        sys.stdout.flush()
    except BrokenPipeError:
        raise
    except OSError as error:
        # What could not be printed is still to be printed when the program ends.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise ResourceError(
            f"all was written to {into}; only what was done could not be printed: {error.strerror}"
        ) from error
