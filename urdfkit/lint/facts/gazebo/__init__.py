"""What ``<gazebo>`` blocks mean: plugins and their tables, libraries, drive wheels, topics of sensors.

A `Model` goes in; plugin records, joints and topic names come out.
"""
