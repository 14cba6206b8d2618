"""The option `--renderer`, of every command that simulates."""

from __future__ import annotations

import argparse

SYNONYMS = {"gl": ("opengl", "egl", "gpu", "moderngl"), "ray": ("rays", "raycast", "raycaster", "raytracer", "cpu")}
"""What else the renderers are called."""


def _renderer(word: str) -> str:
    """Return the renderer that a word means."""
    plain = word.lower()
    return next((name for name, others in SYNONYMS.items() if plain in others), plain)


def add_renderer(parser: argparse.ArgumentParser) -> None:
    """Add the option."""
    parser.add_argument(
        "--renderer",
        type=_renderer,
        choices=("auto", "ray", "gl"),
        default="auto",
        help="who takes the cameras' pictures: ray casts rays (also rays, cpu), gl draws by OpenGL (also opengl, egl, "
        "gpu), auto whichever is quicker (default: auto)",
    )
