"""Wrap a bare URDF into packages with meshes, launch files, tests and a picture.

A URDF goes in; a description, a Gazebo and a bringup package come out.
"""
