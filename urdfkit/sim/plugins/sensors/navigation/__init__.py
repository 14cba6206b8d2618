"""Navigation sensors: IMU, GPS, ground-truth pose, magnetometer, altimeter and barometer.

Each sensor measures the motion of a link and publishes messages with the configured noise.
"""
