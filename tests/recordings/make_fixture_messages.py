#!/usr/bin/env python3
"""Writes the messages of the fixtures in tests/recordings/data, one of each supported type: make_fixture_messages.py OUT.jsonl

A cloud has the points (i, 2 i, -i / 2), ring i % 16 and time i ms, i from 1 to 20; other numbers are listed below.
"""
import base64
import json
import struct
import sys

T0 = 1700000000 * 10**9
messages = []


def add(topic, kind, seconds, **fields):
    messages.append({"topic": topic, "type": kind, "time_ns": T0 + int(seconds * 1e9), "fields": fields})


def header(seconds, frame):
    return {"stamp": {"time_ns": T0 + int(seconds * 1e9)}, "frame_id": frame}


def raw(data):
    return {"base64": base64.b64encode(data).decode()}


def transform(parent, child, seconds, x, y, z, qx=0, qy=0, qz=0, qw=1):
    return {"header": header(seconds, parent), "child_frame_id": child,
            "transform": {"translation": {"x": x, "y": y, "z": z},
                          "rotation": {"x": qx, "y": qy, "z": qz, "w": qw}}}


def pose(x, y, z):
    return {"position": {"x": x, "y": y, "z": z}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}


# The LiDAR is 2 m above and 1 m ahead of base_link.
add("/tf_static", "tf2_msgs/TFMessage", 0,
    transforms=[transform("base_link", "mast", 0, 1, 0, 1.5), transform("mast", "lidar", 0, 0, 0, 0.5)])
for i in range(6):
    # Odometry moves the vehicle along x at 10 m/s, but tf moves it along y.
    t = 0.1 * i
    add("/odom", "nav_msgs/Odometry", t, header=header(t, "odom"), child_frame_id="base_link",
        pose={"pose": pose(i, 0, 5), "covariance": [0.0] * 36},
        twist={"twist": {"linear": {"x": 10, "y": 0, "z": 0}, "angular": {"x": 0, "y": 0, "z": 0}},
               "covariance": [0.0] * 36})
    add("/pose", "geometry_msgs/PoseStamped", t, header=header(t, "map"), pose=pose(0, 0, i))
    add("/tf", "tf2_msgs/TFMessage", t, transforms=[transform("odom", "base_link", t, 0, i, 5)])
    add("/imu", "sensor_msgs/Imu", t, header=header(t, "base_link"),
        orientation={"x": 0.0998334166468, "y": 0, "z": 0, "w": 0.995004165278},  # roll 0.2
        orientation_covariance=[0.0] * 9, angular_velocity={"x": 0, "y": 0, "z": 0},
        angular_velocity_covariance=[0.0] * 9, linear_acceleration={"x": 0, "y": 0, "z": 9.81},
        linear_acceleration_covariance=[0.0] * 9)

FLOAT32, UINT16, UINT32 = 7, 4, 6
points = b"".join(struct.pack("<ffffHxxI", i, 2 * i, -i / 2, 10 * i, i % 16, 1000000 * i) for i in range(1, 21))
add("/cloud", "sensor_msgs/PointCloud2", 0.2, header=header(0.2, "lidar"), height=1, width=20,
    fields=[{"name": name, "offset": at, "datatype": kind, "count": 1} for name, at, kind in
            [("x", 0, FLOAT32), ("y", 4, FLOAT32), ("z", 8, FLOAT32), ("intensity", 12, FLOAT32),
             ("ring", 16, UINT16), ("t", 20, UINT32)]],
    is_bigendian=False, point_step=24, row_step=480, data=raw(points), is_dense=True)
# Two rows of big-endian doubles with 4 bytes of padding and reordered fields.
rows = b"".join(b"".join(struct.pack(">ddd", -i / 2, i, 2 * i) for i in range(10 * row + 1, 10 * row + 11)) + b"\xff" * 4
                for row in range(2))
add("/organised", "sensor_msgs/PointCloud2", 0.25, header=header(0.25, "other"), height=2, width=10,
    fields=[{"name": name, "offset": at, "datatype": 8, "count": 1} for name, at in [("z", 0), ("x", 8), ("y", 16)]],
    is_bigendian=True, point_step=24, row_step=244, data=raw(rows), is_dense=True)
for name, kind in [("/livox", "livox_ros_driver2/CustomMsg"), ("/livox1", "livox_ros_driver/CustomMsg")]:
    add(name, kind, 0.3, header=header(0.3, "livox_frame"), timebase=T0, point_num=20, lidar_id=1, rsvd=[0, 0, 0],
        points=[{"offset_time": 1000000 * i, "x": i, "y": 2 * i, "z": -i / 2, "reflectivity": i, "tag": 0, "line": i % 4}
                for i in range(1, 21)])
# A VLP-16 packet with a return at 5 m for each laser.
packet = b"".join(struct.pack("<HH", 0xeeff, 40 * block) + struct.pack("<HB", 2500, 100) * 32 for block in range(12))
packet += struct.pack("<IBB", 1000, 0x37, 0x22)
add("/velodyne_packets", "velodyne_msgs/VelodyneScan", 0.4, header=header(0.4, "velodyne"),
    packets=[{"stamp": {"time_ns": T0 + 350000000}, "data": raw(packet)}])
add("/ouster/metadata", "std_msgs/String", 0.45, data='{"prod_line": "OS-0-32-U1"}')
add("/ouster/lidar_packets", "ouster_ros/PacketMsg", 0.45, buf=raw(bytes(range(100))))
add("/camera/image", "std_msgs/String", 0.5, data="of something else")

with open(sys.argv[1], "w", encoding="utf-8") as file:
    for message in messages:
        file.write(json.dumps(message) + "\n")
