"""The server of the page: HTTP, WebSocket, access control, broadcast to every browser.

Input: the scene and the messages of the caller. Output: the requests of the browsers.
"""
