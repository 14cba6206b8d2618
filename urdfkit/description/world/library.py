"""The models and worlds we ship, found by name; and which of ours stand in for well-known ones of Gazebo."""

from __future__ import annotations

from pathlib import Path

FOLDER = Path(__file__).resolve().parent.parent / "library"

STANDS_IN = {
    "asphalt_plane": "ground_plane",
    "beer": "coke_can",
    "big_box": "big_crate",
    "big_box2": "big_crate",
    "big_box3": "big_crate",
    "big_box4": "big_crate",
    "cabinet": "cupboard",
    "cafe_table": "round_table",
    "cardboard_box": "box",
    "coke": "coke_can",
    "concrete_ramp_radius_25": "ramp",
    "construction_cone": "cone",
    "construction_barrel": "barrel",
    "drc_practice_orange_jersey_barrier": "jersey_barrier",
    "drc_practice_white_jersey_barrier": "jersey_barrier",
    "dumpster": "container",
    "first_2015_trash_can": "bin",
    "grey_wall": "wall",
    "nist_maze_wall_120": "wall",
    "office_chair": "chair",
    "office_desk": "desk",
    "pepsi_can": "coke_can",
    "standing_person": "person",
    "table_marble": "table",
    "trash_can": "bin",
    "unit_box": "box_1m",
    "unit_cylinder": "cylinder_1m",
    "unit_sphere": "sphere_1m",
    "walking_person": "person",
    "wood_cube_10cm": "cube_10cm",
    "wooden_case": "crate",
    "wooden_case_wo_top": "crate",
    "wooden_crate": "crate",
}
"""Name of a model in Gazebo's own collection → ours that is near it in size and use."""


def model_names() -> list[str]:
    """Return the names of the models we ship, sorted."""
    return sorted(path.parent.name for path in FOLDER.glob("models/*/model.sdf"))


def world_names() -> list[str]:
    """Return the names of the worlds we ship, sorted."""
    return sorted(path.stem for path in FOLDER.glob("worlds/*.sdf"))


def model_file(name: str) -> Path | None:
    """Return the SDF file of a model we ship; None where there is none of that name."""
    path = FOLDER / "models" / name / "model.sdf"
    return path if name and path.is_file() else None


def world_file(name: str) -> Path | None:
    """Return the SDF file of a world we ship; None where there is none of that name."""
    path = FOLDER / "worlds" / f"{name}.sdf"
    return path if name and "/" not in name and path.is_file() else None


def stand_in(name: str) -> tuple[str, Path] | None:
    """Return the name and file of the model of ours that comes nearest to one of Gazebo's; None where none does."""
    plain = name.lower().replace(" ", "_").replace("-", "_")
    ours = plain if model_file(plain) else STANDS_IN.get(plain, "")
    path = model_file(ours)
    return None if path is None else (ours, path)
