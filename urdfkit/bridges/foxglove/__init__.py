"""The protocol ``foxglove.websocket.v1``.

Foxglove and Lichtblick show topics and the robot, publish, and call services.
"""
