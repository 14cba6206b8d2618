"""The protocol between page and server: messages, requests with their checks, and a client for programs.

Input: bytes and JSON. Output: checked values (docs/protocol.md).
"""
