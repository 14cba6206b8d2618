"""Speed in scenes with many contacts: legged robots, grasps and heaps, compared with MuJoCo.

Scenes and models go in; a table of CPU times per step comes out.
"""
