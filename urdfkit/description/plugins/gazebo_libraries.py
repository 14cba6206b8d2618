"""Names of existing Gazebo libraries, and suggestions for misspelt names.

`ALL_SPECS` lists the libraries with a specification; this module adds other common libraries.
"""

import re
from collections.abc import Iterable
from functools import cache

from urdfkit.description.plugins.lookup import ALL_SPECS, tables_of
from urdfkit.errors import nearest

_CLASSIC = """
gazebo_ros_api_plugin gazebo_ros_paths_plugin gazebo_ros_init gazebo_ros_factory gazebo_ros_state
gazebo_ros_properties gazebo_ros_force_system
gazebo_ros_bumper gazebo_ros_camera_utils gazebo_ros_elevator gazebo_ros_f3d gazebo_ros_force
gazebo_ros_ft_sensor gazebo_ros_gps gazebo_ros_hand_of_god gazebo_ros_harness gazebo_ros_joint_effort
gazebo_ros_joint_pose_trajectory gazebo_ros_joint_trajectory gazebo_ros_logical_camera
gazebo_ros_magnetometer_sensor gazebo_ros_mimic_joint gazebo_ros_projector gazebo_ros_prosilica gazebo_ros_range
gazebo_ros_template gazebo_ros_time gazebo_ros_tricycle_drive gazebo_ros_triggered_camera
gazebo_ros_triggered_multicamera gazebo_ros_utils gazebo_ros_vacuum_gripper gazebo_ros_video gazebo_ros_wheel_slip
gazebo_ros_power_monitor gazebo_ros_controller_manager gazebo_ros_gripper gazebo_ros_joint_animation
hector_gazebo_thermal_camera hector_servo_plugin hector_gazebo_reset_plugin diffdrive_plugin_4w diffdrive_plugin_6w
diffdrive_plugin_multi_wheel gazebo_rtt_plugin
roboticsgroup_gazebo_mimic_joint_plugin roboticsgroup_gazebo_disable_link_plugin
roboticsgroup_upatras_gazebo_mimic_joint_plugin roboticsgroup_upatras_gazebo_disable_link_plugin
gazebo_mimic_joint_plugin gazebo_grasp_fix gazebo_ros_link_attacher
"""
"""Stems of libraries of gazebo_ros, gazebo_plugins (Hydro to Noetic, Humble), PR2, Hector and other packages."""

_OWN = """
Actor Actuator AmbientOcclusionVisual ArduCopter AttachLight BlinkVisual BreakableJoint Buoyancy Camera CartDemo Cessna
Contact Contain DepthCamera DiffDrive Elevator FiducialCamera FlashLight Flocking Follower ForceTorque GimbalSmall2d
GpuRay GravityCompensation Harness HeightmapLOD Hydra HydraDemo ImuSensor InitialVelocity JointControl JointTrajectory
Joy KeysToCmdVel KeysToJoints Led LensFlareSensor LiftDrag LinearBattery LinearBatteryConsumer LinkPlot3D LookAtDemo
Misalignment Mud MultiCamera PlaneDemo Pressure RandomVelocity Ray RaySensorNoise Reflectance Rubble ShaderParam
SimEvents SimpleTrackedVehicle SkidSteerDrive Sonar SphereAtlasDemo StaticMap StopWorld Touch TrackedVehicle
Transporter Treads VariableGearbox Vehicle WheelSlip WheelTrackedVehicle Wind
"""
"""Libraries of Gazebo Classic (gazebo 11, folder plugins), without the last word ``Plugin``."""

_SYSTEMS = """
acoustic-comms=AcousticComms advanced-lift-drag=AdvancedLiftDrag air-pressure=AirPressure air-speed=AirSpeed
altimeter=Altimeter apply-joint-force=ApplyJointForce apply-link-wrench=ApplyLinkWrench
linearbatteryplugin=LinearBatteryPlugin breadcrumbs=Breadcrumbs buoyancy=Buoyancy buoyancy-engine=
camera-video-recorder=CameraVideoRecorder collada-world-exporter= comms-endpoint=CommsEndpoint contact=Contact
detachable-joint=DetachableJoint drive-to-pose-controller= dvl= elevator= environment-preload= environmental-sensor=
follow-actor=FollowActor force-torque=ForceTorque global-illumination= hydrodynamics=Hydrodynamics imu=Imu
joint-trajectory-controller=JointTrajectoryController kinetic-energy-monitor=KineticEnergyMonitor label=Label
lens-flare= lift-drag=LiftDrag log= log-playback= log-video-recorder= logical-audio-sensor-plugin=
logical-camera=LogicalCamera magnetometer=Magnetometer model-photo-shoot= multicopter-control=
multicopter-motor-model=MulticopterMotorModel navsat=NavSat optical-tactile-plugin= particle-emitter=
perfect-comms= performer-detector= physics=Physics pose-publisher=PosePublisher python-system-loader= reset= rf-comms=
scene-broadcaster=SceneBroadcaster sensors=Sensors shader-param= spacecraft-thruster-model= thermal=Thermal
thermal-sensor=ThermalSensor thruster=Thruster touchplugin=TouchPlugin track-controller=TrackController
tracked-vehicle=TrackedVehicle trajectory-follower=TrajectoryFollower triggered-publisher=TriggeredPublisher
user-commands=UserCommands velocity-control=VelocityControl wheel-slip=WheelSlip wind-effects=WindEffects
"""
"""``<name>=<class>``: ``gz-sim-<name>-system`` and its class in ``gz::sim::systems``; no class if any name is valid."""


@cache
def classes() -> dict[str, tuple[str, ...]]:
    """Return library stem → valid plugin class names; empty if any name is valid."""
    found: dict[str, tuple[str, ...]] = dict.fromkeys(_CLASSIC.split(), ())
    found.update(dict.fromkeys([f"{name}Plugin" for name in _OWN.split()], ()))
    for word in _SYSTEMS.split():
        name, _, kind = word.partition("=")
        names = (f"gz::sim::systems::{kind}", f"ignition::gazebo::systems::{kind}") if kind else ()
        found[f"gz-sim-{name}-system"] = found[f"ignition-gazebo-{name}-system"] = names
    for spec in ALL_SPECS:
        found.update(dict.fromkeys(spec.filenames, spec.class_names))
    return found


def meant_library(stem: str) -> str | None:
    """Return the library stem that a misspelt name stands for; None if the name may be a different library.

    A name is a misspelling of a library if each word equals, resembles or abbreviates a word of the library's name, if
    the names differ in dashes, underscores and at most one letter, if their words have another order, if the name
    has an additional generic word, or if it lacks the word before the last one (``gazebo_ros_kinect``). Libraries of
    installed packages with a table are no misspellings.
    """
    if not stem or stem in classes() or tables_of(stem):
        return None
    whole = _with_ending(stem.replace("_", "-")) if _SYSTEM.match(stem) else stem
    if whole in classes():
        return whole
    near = [(similarity, candidate) for candidate in classes() if (similarity := _similarity(whole, candidate))]
    if near:
        return max(near)[1]
    longer = [candidate for candidate in classes() if candidate.startswith(f"{stem}_")]
    if len(longer) == 1 and stem.count("_") >= 3:
        return longer[0]
    return _with_missing_word(stem) or _without_ending(stem)


def meant_class(name: str, candidates: Iterable[str]) -> str | None:
    """Return the class that a misspelt name stands for; None if the name may be a different class."""
    return nearest(name, candidates, cutoff=0.9) if "::" in name else None


def _with_ending(stem: str) -> str:
    """Return the name of a system with a corrected or added last word ``system``."""
    name, _, last = stem.rpartition("-")
    return f"{name}-system" if last == "plugin" or _is_like(last, "system", 0.65) else f"{stem}-system"


def _with_missing_word(stem: str) -> str | None:
    """Return the only library of gazebo_plugins with one more word before the last one; None if no or several match."""
    family, _, last = stem.rpartition("_")
    pattern = re.compile(f"gazebo_ros_[a-z]+_{re.escape(last)}")
    longer = [name for name in classes() if family == "gazebo_ros" and pattern.fullmatch(name)]
    return longer[0] if len(longer) == 1 else None


def _without_ending(stem: str) -> str | None:
    """Return the library whose name is extended by a generic last word; None if no library matches."""
    name, _, last = stem.rpartition("_")
    return name if name in classes() and any(_is_like(last, word, 0.8) for word in _GENERAL) else None


def _is_like(one: str, other: str, similarity: float) -> bool:
    return _ratio(one, other, similarity) >= similarity


def _ratio(one: str, other: str, least: float) -> float:
    """Return the similarity of two texts; 0 if it is below a bound."""
    from difflib import SequenceMatcher

    if one == other:
        return 1.0
    if 2.0 * min(len(one), len(other)) < least * (len(one) + len(other)):
        return 0.0
    matcher = SequenceMatcher(None, one, other, autojunk=False)
    return ratio if matcher.quick_ratio() >= least and (ratio := matcher.ratio()) >= least else 0.0


_GENERAL = ("controller", "plugin", "driver", "sensor", "scanner", "system")
"""Generic words often appended to the names of gazebo_plugins: ``libgazebo_ros_laser_controller.so``."""

_SYSTEM = re.compile("(gz|ign|ignition)[-_](sim|gazebo)[-_]")
_WORDS = re.compile("[-_]")
_DIGITS = re.compile("[0-9]")


_LONG = 12
"""Least number of letters of a name that is not meant to differ from another name by one letter."""


def _is_one_slip(name: str, other: str) -> bool:
    """Return whether two names differ by one letter that is added, missing or different, or by two in reverse order."""
    if abs(len(name) - len(other)) > 1:
        return False
    start = next((n for n, (a, b) in enumerate(zip(name, other, strict=False)) if a != b), min(len(name), len(other)))
    ours, theirs = name[start:], other[start:]
    swapped = ours[1:2] + ours[:1] + ours[2:]
    return theirs in (ours[1:], swapped) or ours == theirs[1:] or (ours[1:] == theirs[1:])


def _similarity(name: str, candidate: str) -> float:
    """Return the similarity of two names; 0 if they are different names."""
    ours, theirs = (_WORDS.split(one.lower()) for one in (name, candidate))
    if _DIGITS.findall(name) != _DIGITS.findall(candidate):
        return 0.0
    if sorted(ours) == sorted(theirs) or (len(name) >= _LONG and _is_one_slip(name.lower(), candidate.lower())):
        return 0.99
    if len(theirs) == 1:  # `LinkPlot3DPlugin` has no words, and names such as `SolarPlugin` are of other packages.
        return 0.0
    if len(ours) != len(theirs):
        similarity = _ratio("".join(ours), "".join(theirs), 0.95)
        return similarity if similarity > 0.95 else 0.0
    total = 1.0
    for one, other in zip(ours, theirs, strict=True):
        begins = min(len(one), len(other)) >= 4 and (one.startswith(other) or other.startswith(one))
        similarity = _ratio(one, other, 0.0 if begins else 0.8)
        if not similarity:
            return 0.0
        total *= similarity
    return total
