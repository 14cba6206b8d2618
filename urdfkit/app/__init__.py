"""Applications behind the commands, which scripts and notebooks can start too.

A robot or a simulation goes in; a running page with its address comes out.
"""
