"""Run the rules: expand each entry file, run the rules, drop suppressed findings, merge, sort and cache.

Input: files and options; output: findings.
"""
