"""Sensors of motion and place: IMU, GPS, true pose, magnetometer, altimeter and barometer.

The motion of a link goes in; messages with the noise that is configured come out.
"""
