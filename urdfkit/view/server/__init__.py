"""The server of the page: HTTP, websocket, access control, broadcast to every browser.

The scene and messages of the caller go in; requests of the browsers come out.
"""
