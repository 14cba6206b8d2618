"""WebSocket server of the bridges.

Peers connect, are checked by Host, Origin and token, and get queues of bounded size.
"""
