"""Drive Simpleton forward until a white barrier fills enough of its camera image."""

from pathlib import Path
from typing import Any

from urdfkit.messages import TWIST, twist
from urdfkit.sim import Simulator

CAMERA, COMMAND = "/simpleton/camera1/image_raw", "/simpleton/cmd_vel"
WHITE = 200  # of 255: minimum of the three colour channels of a white pixel
STOP_SHARE = 0.4  # share of white pixels in the image


def on_image(image: Any) -> None:
    """Drive on, or stop, depending on one image."""
    pixels = image.data.reshape(image.height, image.width, 3)
    white = (pixels.min(axis=2) > WHITE).mean()
    speed = 0.5 if white < STOP_SHARE else 0.0
    simulator.publish(COMMAND, TWIST, twist((speed, 0.0, 0.0), (0.0, 0.0, 0.0)))
    if not speed:
        print(f"{simulator.t:.2f} s: {white:.0%} of the image is white. Stopping!")
        subscription.close()


simulator = Simulator("simpleton", world=Path(__file__).with_name("white_barrier.sdf"))
subscription = simulator.subscribe(CAMERA, "sensor_msgs/msg/Image", on_image)
simulator.run(3.5)
