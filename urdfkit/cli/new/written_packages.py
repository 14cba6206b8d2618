"""Report of written packages, and a warning where no build tool finds them."""

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from urdfkit.errors import ResourceError


def misplaced(into: Path, files: Iterable[Path], *, robot: bool = False) -> str:
    """Return why packages should be elsewhere; empty where their place is right, or where none were written.

    colcon and catkin find no packages inside a package; catkin_make searches only a workspace's ``src``.

    Args:
        into: the folder that was written to.
        files: the written files.
        robot: whether a robot was written, whose package has no ``package.xml`` without ROS.
    """
    ros = any(file.name == "package.xml" for file in files)
    if not (ros or robot):
        return ""
    into = into.resolve()
    for folder in (into, *into.parents):
        if any((folder / name).is_file() for name in ("package.xml", "urdfkit-new.toml")):
            tools = ", where colcon and catkin find no packages" if ros else ""
            return f"written inside the package {folder.name}{tools}; use --into {folder.parent}"
    if ros and (into / "src").is_dir():
        return "written next to `src`: if this folder is a workspace, use --into src"
    return ""


@contextmanager
def report_written(into: Path) -> Iterator[None]:
    """Print the written packages in the block; where printing fails, report that they were written nevertheless.

    Args:
        into: the folder that was written to.

    Raises:
        ResourceError: the report could not be printed, e.g. because the disk is full.
        BrokenPipeError: the reader has closed the pipe.
    """
    try:
        yield
        sys.stdout.flush()
    except BrokenPipeError:
        raise
    except OSError as error:
        # Output that could not be printed stays in the buffer and would be printed at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise ResourceError(
            f"all files were written to {into}, but the report could not be printed: {error.strerror}"
        ) from error
