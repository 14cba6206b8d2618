"""Formats of findings: text for people; JSON, SARIF, JUnit and GitHub annotations for programs.

Findings go in; text comes out.
"""
