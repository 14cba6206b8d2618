"""Connections between the nodes that the launch files of a workspace start together, in their namespaces.

Input: the nodes of launch files with their evaluated namespaces, and the code of nodes; output: nodes that do not reach
each other, and messages and answers in code that other nodes reject.
"""
