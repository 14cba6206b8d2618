"""The page of `urdfkit view`: a robot, its lint findings, and links from elements to the source.

A description goes in, messages for the page come out; the server itself is `urdfkit.view`.
"""
