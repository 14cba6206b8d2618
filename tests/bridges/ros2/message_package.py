"""Compile a package of messages for rclpy, run by the Python of its environment: message_package.py SOURCE FOLDER.

FOLDER gets the package, for Python's path and LD_LIBRARY_PATH. Generators, headers and libraries are those of the
wheels; the commands are those of rosidl's CMake files, with Fast DDS as the only implementation and one library for all
generated code. Fast DDS 2 (ROS 2 Jazzy) describes types by their introspection.
"""

import json
import subprocess
import sys
import sysconfig
from pathlib import Path

import numpy
from rosidl_adapter import convert_to_idl
from rosidl_generator_c import generate_c
from rosidl_generator_py import generate_py
from rosidl_generator_type_description import generate_type_hash
from rosidl_typesupport_c import generate_c as generate_typesupport_c
from rosidl_typesupport_fastrtps_c import generate_typesupport_fastrtps_c
from rosidl_typesupport_introspection_c import generate_c as generate_introspection_c

NEEDS = "trajectory_msgs geometry_msgs std_msgs builtin_interfaces action_msgs service_msgs unique_identifier_msgs"
source, folder = (Path(word).resolve() for word in sys.argv[1:3])
needs, package = NEEDS.split(), source.name
target, prefix = folder / package, Path(sys.prefix)
share = prefix / "share"
for kind in ("msg", "action"):
    (target / kind).mkdir(parents=True)
    for each in sorted((source / kind).iterdir()):
        convert_to_idl(source, package, each.relative_to(source), target)
names = sorted(str(each.relative_to(target)) for each in target.glob("*/*.idl"))


def arguments(generator, **more):
    path = folder / f"{generator}.json"
    values = {
        "package_name": package,
        "output_dir": str(target),
        "template_dir": str(share / generator / "resource"),
        "idl_tuples": [f"{target}:{name}" for name in names],
        "ros_interface_dependencies": [f"{need}:{each}" for need in needs for each in (share / need).glob("*/*.idl")],
        "target_dependencies": [],
    }
    path.write_text(json.dumps(values | more))
    for template in (share / generator / "resource").glob("*__visibility_control.h.in"):
        text = template.read_text().replace("@PROJECT_NAME@", package).replace("@PROJECT_NAME_UPPER@", package.upper())
        (target / "msg" / template.stem).write_text(text)
    return str(path)


paths = [f"{need}:{share / need}" for need in needs]
hashes = generate_type_hash(arguments("rosidl_generator_type_description", include_paths=paths))
described_by = [f"{name}:{next(each for each in hashes if str(each).endswith(f'/{name[:-4]}.json'))}" for name in names]
files = [str(target / name) for name in names]
generate_c(arguments("rosidl_generator_c", type_description_tuples=described_by, ros_interface_files=files))
generate_typesupport_fastrtps_c(arguments("rosidl_typesupport_fastrtps_c"))
described = folder / "introspection"  # some files are named as those of rosidl_generator_c
generate_introspection_c(arguments("rosidl_typesupport_introspection_c", output_dir=str(described / package)))
kinds = ["rosidl_typesupport_fastrtps_c", "rosidl_typesupport_introspection_c"]
generate_typesupport_c(arguments("rosidl_typesupport_c"), kinds)
generate_py(arguments("rosidl_generator_py"), ["rosidl_typesupport_c"])
(target / "__init__.py").touch()

headers = (folder, described, sysconfig.get_paths()["include"], numpy.get_include(), prefix / "include")
include = [f"-I{each}" for each in (*headers, *(prefix / "include").iterdir())]
objects = []
for each in sorted([*folder.rglob("*.c"), *folder.rglob("*.cpp")]):
    compiler = ["gcc"] if each.suffix == ".c" else ["g++", "-std=c++17"]
    objects.append(f"{each}.o")
    subprocess.run([*compiler, "-c", "-fPIC", "-O0", *include, str(each), "-o", objects[-1]], check=True)
libraries = sorted(path for need in needs for path in (prefix / "lib").glob(f"lib{need}__rosidl_*_*.so"))
libraries = [str(each) for each in libraries if not each.stem.endswith("cpp")]
more = ("rosidl_runtime_c", "rosidl_typesupport_c", *kinds, "fastcdr", "rcutils")
linked = [*libraries, *(f"-l{each}" for each in (*more, "rosidl_typesupport_fastrtps_cpp"))]
output = target / f"{package}_s__rosidl_typesupport_c.so"
subprocess.run(["g++", "-shared", *objects, f"-L{prefix}/lib", *linked, "-o", str(output)], check=True)
for kind in kinds:  # the libraries that rosidl_typesupport_c opens
    (folder / f"lib{package}__{kind}.so").symlink_to(output)
