"""Content of the page as messages: meshcat objects, meshes, joints, properties of links.

Input: a robot or a scene. Output: commands for the browser.
"""
