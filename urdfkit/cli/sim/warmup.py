"""`urdfkit sim warmup`: compile the physics kernels before their first use."""

import argparse
import sys
import time


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.epilog = "examples:\n  urdfkit sim warmup\n  urdfkit sim warmup && urdfkit sim run simpleton --for 10"


def run(arguments: argparse.Namespace) -> int:
    """Compile and cache."""
    from urdfkit.app.simulation.kernel_compilation import prepare_kernel, prepare_rays

    begin = time.perf_counter()
    compiled = [prepare_kernel(sys.stderr), prepare_kernel(sys.stderr, world=True), prepare_rays(sys.stderr)]
    spent = time.perf_counter() - begin
    ready = "the physics kernels were compiled already"
    print(f"the physics kernels are compiled and cached ({spent:.1f} s)" if any(compiled) else ready)
    return 0
