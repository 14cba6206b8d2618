"""Camera sensors: colour, depth, multicamera, segmentation, bounding boxes and the logical camera.

Each sensor renders the current scene and publishes images, point clouds and camera info.
"""
