"""Mistakes in whole ROS packages: does the linter find each, at its line, and nothing else?"""
