"""What travels between page and server: messages, requests with their checks, and a client for programs.

Bytes and JSON go in; checked values come out (docs/protocol.md).
"""
