"""Cameras: colour, depth, several at once, segmentation and bounding boxes, the logical camera.

The scene as it stands goes in; images, clouds and camera info come out.
"""
