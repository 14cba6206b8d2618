"""Every command shows its help where only the dependencies of lint, expand and new are installed."""

from __future__ import annotations

import subprocess
import sys

from urdfkit.cli import COMMANDS

WITHOUT = (
    "numpy pinocchio coal trimesh meshcat tornado numba PIL rosbags moderngl pygls mcp distributed pyarrow matplotlib"
    " gymnasium umsgpack collada scipy"
)
PROGRAM = f"""
import contextlib, io, sys
sys.modules.update(dict.fromkeys({WITHOUT!r}.split()))
from urdfkit.cli import main
for command in sys.argv[1:]:
    shown = io.StringIO()
    with contextlib.redirect_stdout(shown), contextlib.redirect_stderr(shown):
        try:
            code = main([command, "--help"])
        except SystemExit as end:
            code = end.code
    if code or "usage: urdfkit " + command not in shown.getvalue():
        print(command, code, shown.getvalue()[-300:])
"""


def test_every_command_shows_its_help_in_a_core_install() -> None:
    done = subprocess.run([sys.executable, "-c", PROGRAM, *COMMANDS], capture_output=True, text=True, check=True)
    assert done.stdout == ""
