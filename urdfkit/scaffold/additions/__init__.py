"""Add a sensor, an arm or controllers to a description that exists.

A robot and a request go in; changes to its files come out, all or none.
"""
