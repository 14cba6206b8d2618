"""Listening addresses, access control and limits of servers.

The page and the bridges accept connections by the same rules.
"""
