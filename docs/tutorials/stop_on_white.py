"""Stop on white: Simpleton drives ahead until its camera sees enough of a white barrier."""

from pathlib import Path
from typing import Any

from urdfkit.messages import TWIST, twist
from urdfkit.sim import Simulator

CAMERA, COMMAND = "/simpleton/camera1/image_raw", "/simpleton/cmd_vel"
WHITE = 200  # of 255: how bright all three colours of a white pixel are
ENOUGH = 0.4  # of the picture


def look(image: Any) -> None:
    """Go on, or stop, by one picture."""
    pixels = image.data.reshape(image.height, image.width, 3)
    white = (pixels.min(axis=2) > WHITE).mean()
    speed = 0.5 if white < ENOUGH else 0.0
    simulator.bus.publish(COMMAND, TWIST, twist((speed, 0.0, 0.0), (0.0, 0.0, 0.0)))
    if not speed:
        print(f"{simulator.t:.2f} s: {white:.0%} of the picture is white. Stopping!")
        camera.close()  # seen enough


simulator = Simulator("simpleton", world=Path(__file__).with_name("white_barrier.sdf"))
camera = simulator.subscribe(CAMERA, "sensor_msgs/msg/Image", look)
simulator.run(3.5)
