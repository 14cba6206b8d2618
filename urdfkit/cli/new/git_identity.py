"""Name and e-mail address of the user, from the configuration of git."""

import subprocess

from urdfkit.errors import UsageError
from urdfkit.scaffold import Template


def identity(template: Template) -> dict[str, str]:
    """Return the maintainer and e-mail address that git is configured with and the template accepts.

    Args:
        template: the template with the questions `maintainer` and `email`.
    """
    answers: dict[str, str] = {}
    for name, key in (("maintainer", "user.name"), ("email", "user.email")):
        try:
            answer = subprocess.run(
                ["git", "config", "--get", key], capture_output=True, text=True, timeout=5, check=True
            )
            answers[name] = template.question(name).accept(answer.stdout)
        except (OSError, subprocess.SubprocessError, UnicodeDecodeError, UsageError):
            continue
    return answers
