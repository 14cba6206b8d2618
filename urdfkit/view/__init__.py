"""The browser app: a server that shows a scene and takes wishes. Knows nothing of the simulator.

`server.server.Server` runs in a thread of its own; `content.meshcat_objects.draw` puts a `urdfkit.scene.Scene` on it.
Whoever owns the robot publishes poses and drains `Server.inbox` and `Server.driver` in their own thread, so that no
browser can slow it down.
"""
