"""Run the rules: expand each entry file, run the rules, drop suppressed findings, merge, sort and cache.

Files and options go in; findings come out.
"""
