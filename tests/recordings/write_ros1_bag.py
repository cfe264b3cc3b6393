#!/usr/bin/python3
"""Writes messages as a ROS 1 bag by Debian's python3-rosbag: write_ros1_bag.py IN.jsonl OUT.bag [none|bz2|lz4]

Each line of IN is a message: {"topic", "type", "time_ns", "fields"}. Bytes are {"base64"}, times are {"time_ns"}.
"""
import base64
import json
import os
import sys

import genpy
import rosbag
import roslib.message

with open(os.path.join(os.path.dirname(__file__), "definitions.json"), encoding="utf-8") as file:
    DEFINITIONS = json.load(file)
HEADER = "MSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id"
SEPARATOR = "\n" + "=" * 80 + "\n"


def class_of(name):
    if name not in DEFINITIONS:
        return roslib.message.get_message_class(name)
    package = name.split("/")[0]
    parts = [DEFINITIONS[name]]
    parts += ["MSG: %s\n%s" % (other, text) for other, text in DEFINITIONS.items()
              if other != name and other.startswith(package + "/")]
    return genpy.dynamic.generate_dynamic(name, SEPARATOR.join(parts + [HEADER]))[name]


def time_of(time_ns):
    return genpy.Time(time_ns // 10**9, time_ns % 10**9)


def fill(message, fields):
    types = dict(zip(message.__slots__, message._slot_types))
    for name, value in fields.items():
        if isinstance(value, dict) and "base64" in value:
            value = base64.b64decode(value["base64"])
        elif isinstance(value, dict) and "time_ns" in value:
            value = time_of(value["time_ns"])
        elif isinstance(value, dict):
            value = fill(getattr(message, name), value)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            element = class_of_element(message, types[name].split("[")[0])
            value = [fill(element(), one) for one in value]
        setattr(message, name, value)
    return message


def class_of_element(message, name):
    if name in DEFINITIONS:
        return CLASSES.setdefault(name, all_of(message._type, name))
    return roslib.message.get_message_class(name)


def all_of(parent, name):
    package = parent.split("/")[0]
    parts = [DEFINITIONS[parent]]
    parts += ["MSG: %s\n%s" % (other, text) for other, text in DEFINITIONS.items()
              if other != parent and other.startswith(package + "/")]
    return genpy.dynamic.generate_dynamic(parent, SEPARATOR.join(parts + [HEADER]))[name]


CLASSES = {}


def main():
    source, target = sys.argv[1:3]
    compression = sys.argv[3] if len(sys.argv) > 3 else "none"
    with rosbag.Bag(target, "w", compression=compression) as bag, open(source, encoding="utf-8") as lines:
        for line in lines:
            one = json.loads(line)
            kind = CLASSES.setdefault(one["type"], class_of(one["type"]))
            kind._full_text = "# " + one["type"]  # the full definition is larger than a small bag
            bag.write(one["topic"], fill(kind(), one["fields"]), time_of(one["time_ns"]))


main()
