"""Read and write worlds in SDF.

Input: SDF files; output: models and lights with resolved poses and source positions.
"""

from urdfkit.description.sdf.model import WorldAxis, WorldInertial, WorldJoint, WorldLink, WorldMimic, WorldModel
from urdfkit.description.sdf.model_library import model_names, world_names
from urdfkit.description.sdf.reader.load import load_model, load_world, model_of_text
from urdfkit.description.sdf.shapes import Cone, Ellipsoid, Kept, Light, Plane, Surface, WorldGeometry, WorldShape
from urdfkit.description.sdf.world import GRAVITY, GROUND_MU, Ground, Physics, World, WorldRobot, ground_of
from urdfkit.description.sdf.world_edits import add_model, remove_model
from urdfkit.description.sdf.writer import model_to_sdf, save_world, to_sdf

__all__ = [
    "GRAVITY",
    "GROUND_MU",
    "Cone",
    "Ellipsoid",
    "Ground",
    "Kept",
    "Light",
    "Physics",
    "Plane",
    "Surface",
    "World",
    "WorldAxis",
    "WorldGeometry",
    "WorldInertial",
    "WorldJoint",
    "WorldLink",
    "WorldMimic",
    "WorldModel",
    "WorldRobot",
    "WorldShape",
    "add_model",
    "ground_of",
    "load_model",
    "load_world",
    "model_names",
    "model_of_text",
    "model_to_sdf",
    "remove_model",
    "save_world",
    "to_sdf",
    "world_names",
]
