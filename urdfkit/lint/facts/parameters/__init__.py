"""Parameters of nodes in YAML: sensible ranges, and relations between parameters of one or of several files.

Input: YAML files and a `Model`; output: YAML nodes with messages.
"""
