// Writes messages as an MCAP with @mcap/core, or as lines for write_db3.py; serialises by @foxglove/rosmsg2-serialization:
// node write_ros2_bag.mjs IN.jsonl OUT.mcap|OUT.jsonl [none|zstd|lz4|plain|ros1]
//
// IN is in the format of write_ros1_bag.py. Modules are found from the working directory (npm install @mcap/core
// @foxglove/rosmsg @foxglove/rosmsg-msgs-common @foxglove/rosmsg2-serialization @foxglove/rosmsg-serialization).
// zstd and lz4 use the command-line programs. `plain` writes no chunks, `ros1` ROS 1 messages in chunks packed by zstd.
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";

const require = createRequire(path.join(process.cwd(), "package.json"));
const { McapWriter } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const common = require("@foxglove/rosmsg-msgs-common");
const cdr = require("@foxglove/rosmsg2-serialization");
const ros1 = require("@foxglove/rosmsg-serialization");

const [source, target, kind = "none"] = process.argv.slice(2);
const isRos1 = kind === "ros1";
const here = path.dirname(fileURLToPath(import.meta.url));
const custom = JSON.parse(fs.readFileSync(path.join(here, "definitions.json"), "utf-8"));

// The definitions of a type and of all its nested types.
const header = isRos1
  ? "MSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id"
  : "MSG: std_msgs/Header\ntime stamp\nstring frame_id";
const separator = "\n" + "=".repeat(80) + "\n";
function definitionsOf(type) {
  if (custom[type]) {
    const near = Object.keys(custom).filter((name) => name !== type && name.startsWith(type.split("/")[0] + "/"));
    const text = [custom[type], ...near.map((name) => `MSG: ${name}\n${custom[name]}`), header].join(separator);
    return { definitions: parse(text, { ros2: !isRos1 }), text };
  }
  const all = {
    ...(isRos1 ? common.ros1 : common.ros2humble),
    "tf2_msgs/TFMessage": {
      name: "tf2_msgs/TFMessage",
      definitions: [{ name: "transforms", type: "geometry_msgs/TransformStamped", isArray: true, isComplex: true }],
    },
  };
  const found = [];
  const add = (one) => {
    const definition = all[one.replace("/", "/msg/")] ?? all[one];
    if (!definition || found.includes(definition)) return;
    found.push(definition);
    for (const field of definition.definitions) if (field.isComplex) add(field.type);
  };
  add(type);
  if (found.length === 0) throw new Error(`no definition of ${type}`);
  return { definitions: found, text: `# ${type}` };
}

function valueOf(value) {
  if (Array.isArray(value)) return value.map(valueOf);
  if (value === null || typeof value !== "object") return value;
  if ("base64" in value) return new Uint8Array(Buffer.from(value.base64, "base64"));
  if ("time_ns" in value) {
    const ns = BigInt(value.time_ns);
    const [sec, rest] = [Number(ns / 1000000000n), Number(ns % 1000000000n)];
    return { sec, nsec: rest, nanosec: rest };
  }
  return Object.fromEntries(Object.entries(value).map(([key, one]) => [key, valueOf(one)]));
}

const writers = new Map();
function serialise(type, fields) {
  if (!writers.has(type)) {
    const { definitions, text } = definitionsOf(type);
    const Writer = isRos1 ? ros1.MessageWriter : cdr.MessageWriter;
    writers.set(type, { writer: new Writer(definitions), text });
  }
  return writers.get(type).writer.writeMessage(valueOf(fields));
}

const messages = fs.readFileSync(source, "utf-8").split("\n").filter(Boolean).map((line) => JSON.parse(line));
if (target.endsWith(".jsonl")) {
  const lines = messages.map((one) =>
    JSON.stringify({ ...one, fields: undefined, cdr: Buffer.from(serialise(one.type, one.fields)).toString("base64") }));
  fs.writeFileSync(target, lines.join("\n") + "\n");
} else {
  const file = fs.openSync(target, "w");
  let position = 0n;
  const writable = {
    async write(bytes) { fs.writeSync(file, bytes); position += BigInt(bytes.byteLength); },
    position: () => position,
  };
  const pack = {
    zstd: (bytes) => ({ compression: "zstd", compressedData: execFileSync("zstd", ["-q"], { input: bytes, maxBuffer: 1 << 30 }) }),
    lz4: (bytes) => ({ compression: "lz4", compressedData: execFileSync("lz4", ["-q"], { input: bytes, maxBuffer: 1 << 30 }) }),
  }[isRos1 ? "zstd" : kind];
  const mcap = new McapWriter({ writable, useChunks: kind !== "plain", chunkSize: 1 << 19, compressChunk: pack });
  await mcap.start({ profile: isRos1 ? "ros1" : "ros2", library: "write_ros2_bag.mjs" });
  const channels = new Map();
  for (const [sequence, one] of messages.entries()) {
    const data = serialise(one.type, one.fields);
    const key = one.topic + " " + one.type;
    if (!channels.has(key)) {
      const schemaId = await mcap.registerSchema({
        name: isRos1 ? one.type : one.type.replace("/", "/msg/"),
        encoding: isRos1 ? "ros1msg" : "ros2msg",
        data: new TextEncoder().encode(writers.get(one.type).text),
      });
      channels.set(key, await mcap.registerChannel({
        schemaId, topic: one.topic, messageEncoding: isRos1 ? "ros1" : "cdr", metadata: new Map(),
      }));
    }
    const time = BigInt(one.time_ns);
    await mcap.addMessage({ channelId: channels.get(key), sequence, logTime: time, publishTime: time, data });
  }
  await mcap.end();
  fs.closeSync(file);
}
