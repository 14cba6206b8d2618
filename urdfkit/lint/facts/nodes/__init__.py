"""Nodes that launch files start: their names, parameter files and topics.

Input: launch files and YAML; output: nodes with source positions.
"""
