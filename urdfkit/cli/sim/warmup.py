"""`urdfkit sim warmup`: compile the physics kernel ahead of its first use."""

from __future__ import annotations

import argparse
import sys
import time


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.epilog = "examples:\n  urdfkit sim warmup\n  urdfkit sim warmup && urdfkit sim run simpleton --for 10"


def run(arguments: argparse.Namespace) -> int:
    """Compile and cache."""
    from urdfkit.cli.sim.kernel import prepare_kernel

    begin = time.perf_counter()
    compiled = prepare_kernel(sys.stderr)
    spent = time.perf_counter() - begin
    print(f"the physics kernel is compiled and cached ({spent:.1f} s)" if compiled else "the physics kernel was ready")
    return 0
