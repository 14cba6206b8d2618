"""One scene table for sensors and viewer: bodies, shapes, colours, meshes.

A robot or a world goes in; shapes on bodies come out, and pictures and distances by rays or OpenGL.
"""

from urdfkit.meshes.loader import MeshLoader
from urdfkit.meshes.triangle_mesh import TriMesh
from urdfkit.scene.extent import bounds, lowest_point
from urdfkit.scene.scene_table import Role, Scene, Shape, scene_of

__all__ = ["MeshLoader", "Role", "Scene", "Shape", "TriMesh", "bounds", "lowest_point", "scene_of"]
