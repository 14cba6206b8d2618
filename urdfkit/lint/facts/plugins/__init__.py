"""Parameters of plugins, controllers and nodes, with the tables of their types.

Input: YAML files; output: YAML nodes with messages.
"""
