"""Contents of ``<gazebo>`` blocks: plugins and their specifications, libraries, drive wheels, sensor topics.

Input: a `Model`; output: plugin records, joints and topic names.
"""
