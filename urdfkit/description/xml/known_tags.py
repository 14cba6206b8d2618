# ruff: noqa: SIM905 - a list in words is easier to read and extend
"""The elements of URDF and SDF: tags that never call a macro of the same name."""

URDF_TAGS = frozenset(
    """
    robot link joint inertial visual collision origin mass inertia geometry box cylinder sphere capsule mesh material
    color texture parent child axis limit dynamics mimic safety_controller calibration contact_coefficients
    transmission type actuator hardwareInterface mechanicalReduction offset role gazebo ros2_control hardware plugin
    param state_interface command_interface sensor gpio verbose
    """.split()
)
"""The elements of URDF, ``<transmission>`` and ``<ros2_control>``."""

SDF_TAGS = frozenset(
    """
    sdf world model frame pose static include uri name light camera ray lidar scan horizontal vertical samples
    resolution min_angle max_angle range min max noise mean stddev image width height format clip near far
    horizontal_fov imu contact collide surface friction ode bullet mu mu2 mu1 fdir1 slip1 slip2 kp kd soft_cfm soft_erp
    max_vel min_depth bounce physics gravity wind atmosphere scene shadows ambient diffuse specular emissive script
    always_on update_rate visualize topic depth_camera rgbd_camera thermal_camera segmentation_camera gps navsat
    magnetometer altimeter air_pressure force_torque logical_camera wireless_receiver wireless_transmitter sonar
    projector polyline plane heightmap ellipsoid cone empty audio_source battery gripper actor animation trajectory
    """.split()
)
"""SDF elements that ``<gazebo>`` may contain."""

TAGS = URDF_TAGS | SDF_TAGS
"""Elements of URDF and SDF."""
