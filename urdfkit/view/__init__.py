"""The browser app: a server that shows a scene and receives requests. It does not depend on the simulator.

`server.server.Server` runs in its own thread; `content.meshcat_objects.draw` sends a `urdfkit.scene.Scene` to it. The
caller publishes poses and reads `Server.inbox` and `Server.drive_lock` in its own thread, so that no browser can slow
it down.
"""
