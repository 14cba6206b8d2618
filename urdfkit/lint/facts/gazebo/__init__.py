"""Contents of ``<gazebo>`` blocks: plugins and their specifications, libraries, drive wheels, sensor topics.

A `Model` goes in; plugin records, joints and topic names come out.
"""
