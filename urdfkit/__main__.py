"""``python -m urdfkit``."""

from urdfkit.cli import program

program()
