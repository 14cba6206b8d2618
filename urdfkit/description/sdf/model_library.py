"""Bundled models and worlds by name, and the bundled replacements of well-known Gazebo models."""

from pathlib import Path

from urdfkit.description.packages.existence import is_file

FOLDER = Path(__file__).resolve().parent.parent / "library"

STANDS_IN = {
    "asphalt_plane": "ground_plane",
    "beer": "coke_can",
    "big_box": "crate",
    "big_box2": "crate",
    "big_box3": "crate",
    "big_box4": "crate",
    "cabinet": "cupboard",
    "cardboard_box": "box",
    "coke": "coke_can",
    "cone": "construction_cone",
    "desk_yellow": "desk",
    "drc_practice_orange_jersey_barrier": "jersey_barrier",
    "drc_practice_white_jersey_barrier": "white_jersey_barrier",
    "dumpster": "container",
    "first_2015_trash_can": "bin",
    "grey_wall": "wall",
    "hatchback": "car",
    "hatchback_blue": "car",
    "hatchback_red": "car",
    "large_crate": "crate",
    "nist_maze_wall_120": "wall",
    "oak_tree": "tree",
    "office_chair": "chair",
    "office_desk": "desk",
    "pepsi_can": "coke_can",
    "person_standing": "person",
    "person_walking": "person",
    "pine_tree": "tree",
    "postbox": "mailbox",
    "prius_hybrid": "car",
    "robocup_3d_simulator_ball": "ball",
    "robocup_spl_ball": "ball",
    "sofa_1": "sofa",
    "standing_person": "person",
    "suv": "car",
    "table_marble": "table",
    "traffic_cone": "construction_cone",
    "trash_bin": "bin",
    "trash_can": "bin",
    "unit_box_1": "unit_box",
    "unit_cube": "unit_box",
    "walking_person": "person",
    "wood_chair": "chair",
    "wooden_case": "crate",
    "wooden_case_wo_top": "crate",
    "wooden_crate": "crate",
}
"""Name of a model in Gazebo's collection → bundled model of similar size and purpose."""

ALIKE = frozenset(
    {
        "bookshelf",
        "brick_box_3x1x3",
        "cafe_table",
        "cinder_block",
        "coke_can",
        "construction_barrel",
        "construction_cone",
        "fire_hydrant",
        "jersey_barrier",
        "lamp_post",
        "mailbox",
        "table",
    }
)
"""Bundled models named after a model in Gazebo's collection, of similar size and purpose but different shape."""


def model_names() -> list[str]:
    """Return the names of the bundled models, sorted."""
    return sorted(path.parent.name for path in FOLDER.glob("models/*/model.sdf"))


def world_names() -> list[str]:
    """Return the names of the bundled worlds, sorted."""
    return sorted(path.stem for path in FOLDER.glob("worlds/*.sdf"))


def model_file(name: str) -> Path | None:
    """Return the SDF file of a bundled model; None for an unknown name."""
    path = FOLDER / "models" / name / "model.sdf"
    return path if name and is_file(path) else None


def world_file(name: str) -> Path | None:
    """Return the SDF file of a bundled world; None for an unknown name."""
    path = FOLDER / "worlds" / f"{name}.sdf"
    return path if name and "/" not in name and is_file(path) else None


def replacement_of(name: str) -> tuple[str, Path] | None:
    """Return the name and file of the bundled replacement of a Gazebo model; None for other models."""
    plain = name.lower().replace(" ", "_").replace("-", "_")
    ours = plain if model_file(plain) else STANDS_IN.get(plain, "")
    path = model_file(ours)
    return None if path is None else (ours, path)
