"""Displays of topics in the 3-D view: messages as drawings in the frames of their headers.

A drawing is a list of lines, shapes, maps and points as JSON values, which the page turns into objects of its scene.
The lights and planes of the world are sent for a page that shows the scene as the simulated cameras do.
"""
