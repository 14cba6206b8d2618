"""The rosbridge v2 protocol.

Clients such as roslibjs and roslibpy subscribe, publish and call services over a WebSocket.
"""
