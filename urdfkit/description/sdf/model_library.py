"""Bundled models and worlds by name, and the bundled replacements of well-known Gazebo models."""

from pathlib import Path

from urdfkit.description.packages.existence import is_file

FOLDER = Path(__file__).resolve().parent.parent / "library"

STANDS_IN = {
    **dict.fromkeys(("robocup_3d_simulator_ball", "robocup_spl_ball"), "ball"),
    **dict.fromkeys(("first_2015_trash_can", "trash_bin", "trash_can"), "bin"),
    "cardboard_box": "box",
    **dict.fromkeys(("hatchback", "hatchback_blue", "hatchback_red", "prius_hybrid", "suv"), "car"),
    **dict.fromkeys(("office_chair", "wood_chair"), "chair"),
    **dict.fromkeys(("beer", "coke", "pepsi_can"), "coke_can"),
    **dict.fromkeys(("cone", "traffic_cone"), "construction_cone"),
    "dumpster": "container",
    **dict.fromkeys(("big_box", "big_box2", "big_box3", "big_box4", "large_crate"), "crate"),
    **dict.fromkeys(("wooden_case", "wooden_case_wo_top", "wooden_crate"), "crate"),
    "cabinet": "cupboard",
    **dict.fromkeys(("desk_yellow", "office_desk"), "desk"),
    "asphalt_plane": "ground_plane",
    "drc_practice_orange_jersey_barrier": "jersey_barrier",
    "postbox": "mailbox",
    **dict.fromkeys(("person_standing", "person_walking", "standing_person", "walking_person"), "person"),
    "sofa_1": "sofa",
    "table_marble": "table",
    **dict.fromkeys(("oak_tree", "pine_tree"), "tree"),
    **dict.fromkeys(("unit_box_1", "unit_cube"), "unit_box"),
    **dict.fromkeys(("grey_wall", "nist_maze_wall_120"), "wall"),
    "drc_practice_white_jersey_barrier": "white_jersey_barrier",
}
"""Name of a model in Gazebo's collection → bundled model of similar size and purpose."""

ALIKE = frozenset(
    (
        *("bookshelf", "brick_box_3x1x3", "cafe_table", "cinder_block", "coke_can", "construction_barrel"),
        *("construction_cone", "fire_hydrant", "jersey_barrier", "lamp_post", "mailbox", "table"),
    )
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
