"""The option `--renderer` of every command that simulates."""

import argparse

SYNONYMS = {"gl": ("opengl", "egl", "gpu", "moderngl"), "ray": ("rays", "raycast", "raycaster", "raytracer", "cpu")}
"""Other names of the renderers."""


def _renderer(word: str) -> str:
    """Return the renderer with a name or synonym."""
    plain = word.lower()
    return next((name for name, others in SYNONYMS.items() if plain in others), plain)


def add_renderer(parser: argparse.ArgumentParser) -> None:
    """Add the option."""
    parser.add_argument(
        "--renderer",
        type=_renderer,
        choices=("auto", "ray", "gl"),
        default="auto",
        help="renderer of camera images: ray casts rays (also rays, cpu), gl uses OpenGL (also opengl, egl, "
        "gpu), auto selects the faster one (default: auto)",
    )
