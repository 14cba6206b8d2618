"""Who writes: what git knows of the user."""

from __future__ import annotations

import subprocess

from urdfkit.errors import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.scaffold import Template


def identity(template: Template) -> dict[str, str]:
    """Return maintainer and e-mail as git knows them, if it does and they will do.

    Args:
        template: which asks for them.
    """
    found: dict[str, str] = {}
    for name, key in (("maintainer", "user.name"), ("email", "user.email")):
        try:
            answer = subprocess.run(
                ["git", "config", "--get", key], capture_output=True, text=True, timeout=5, check=True
            )
            found[name] = template.question(name).accept(answer.stdout)
        except (OSError, subprocess.SubprocessError, UnicodeDecodeError, UsageError):
            continue
    return found
