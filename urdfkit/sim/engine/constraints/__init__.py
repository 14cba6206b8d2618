"""Rows that constrain the next velocity: contacts, joint limits, motors, servos.

Contacts and targets go in; Jacobian rows with bias and bounds come out.
"""
