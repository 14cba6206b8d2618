"""Runs without a page, as of ``sim run`` and sweeps.

Options go in; a simulator with scheduled commands comes out. Expressions are evaluated in its state.
"""
