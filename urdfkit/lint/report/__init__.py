"""Output formats of findings: text, JSON, SARIF, JUnit and GitHub annotations.

Input: findings; output: text.
"""
