"""One command of urdfkit in this process, which first gives up the rest of the file system.

Standard input holds the job as JSON: the folder to read, a folder for temporary files, the limit of the CPU time and
the command line. The command ``picture`` prints a PNG in base64; all others are commands of urdfkit.
"""

import json
import sys
from pathlib import Path
from typing import Any

MEMORY = 8 * 10**9
"""Limit of the address space [byte]."""

FILE_SIZE = 100 * 2**20
"""Limit of the size of a written file, such as compiled code [byte]."""


def main() -> int:
    """Run the job of standard input; return the exit code."""
    job = json.loads(sys.stdin.read())
    _limit(float(job["seconds"]))
    from urdfkit.compilation.native import cache_folders
    from urdfkit.lint.project.confinement import Confinement
    from urdfkit.scene.rays.bvh_cache import cache_folder

    here = Path(__file__).parent
    folders = [Path(job["root"]), Path(job["scratch"]), cache_folder(), *cache_folders(here), Path("/proc/self")]
    Confinement(folders).start()
    words = list(job["words"])
    if words[0] == "picture":
        return _picture(json.loads(words[1]))
    from urdfkit.cli import main as command

    return command(words)


def _limit(seconds: float) -> None:
    if sys.platform == "win32":
        return
    import resource

    cpu = int(seconds) + 1
    for kind, value in (
        (resource.RLIMIT_CPU, cpu),
        (resource.RLIMIT_AS, MEMORY),
        (resource.RLIMIT_FSIZE, FILE_SIZE),
        (resource.RLIMIT_CORE, 0),
    ):
        _, most = resource.getrlimit(kind)
        value = value if most == resource.RLIM_INFINITY else min(value, most)
        resource.setrlimit(kind, (value, value))


def _picture(options: dict[str, Any]) -> int:
    from base64 import b64encode

    from urdfkit import load
    from urdfkit.app.robot_picture import robot_picture
    from urdfkit.errors import UrdfkitError

    try:
        robot = load(options.pop("robot"), arguments=options.pop("arguments"))
        print(b64encode(robot_picture(robot, **options)).decode())
    except UrdfkitError as error:
        print(f"urdfkit: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
