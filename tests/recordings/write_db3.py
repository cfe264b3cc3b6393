#!/usr/bin/env python3
"""Writes the database of a ROS 2 bag like rosbag2: write_db3.py IN.jsonl OUT.db3, with IN from write_ros2_bag.mjs."""
import base64
import json
import sqlite3
import sys

SCHEMA = """
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL,
                    offered_qos_profiles TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
INSERT INTO schema VALUES (3, 'humble');
"""

source, target = sys.argv[1:3]
database = sqlite3.connect(target)
database.executescript(SCHEMA)
topics = {}
with open(source, encoding="utf-8") as lines:
    for line in lines:
        one = json.loads(line)
        key = one["topic"], one["type"].replace("/", "/msg/")
        if key not in topics:
            topics[key] = len(topics) + 1
            database.execute("INSERT INTO topics VALUES (?, ?, ?, 'cdr', '')", (topics[key], *key))
        database.execute("INSERT INTO messages (topic_id, timestamp, data) VALUES (?, ?, ?)",
                         (topics[key], one["time_ns"], base64.b64decode(one["cdr"])))
database.commit()
database.close()
