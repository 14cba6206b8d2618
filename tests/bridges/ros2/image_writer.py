"""Publish images of 800 × 800 pixels by the node that ``--ros2`` opens.

Argument: the number of images; the last one is repeated until the program is killed.
"""

import sys
import time

import numpy as np

from urdfkit.bridges.node.node import Quality
from urdfkit.bridges.ros2.node_selection import open_node
from urdfkit.messages import from_fields
from urdfkit.messages.conversion import encode_cdr

IMAGE = "sensor_msgs/msg/Image"
count = int(sys.argv[1])
node = open_node(None, "")
writer = node.writer("/image", IMAGE, Quality())
image = from_fields(IMAGE, {"height": 800, "width": 800, "encoding": "rgb8", "step": 2400})
image.data = np.zeros(800 * 2400, np.uint8)
while not writer.is_matched():
    time.sleep(0.05)
time.sleep(1.0)  # the reader matches too
while True:
    image.header.stamp.sec = min(image.header.stamp.sec + 1, count)
    writer.publish(encode_cdr(image, IMAGE))
    time.sleep(1 / 30)
