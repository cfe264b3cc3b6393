// Reads an MCAP with the indexed and the streaming reader of @mcap/core, and decodes its messages by the schemas in the
// file with @foxglove/rosmsg2-serialization. Prints a line of JSON per message in file order, then one with the summary:
// node read_mcap.mjs IN.mcap
//
// Modules are found from the working directory (npm install @mcap/core @foxglove/rosmsg
// @foxglove/rosmsg2-serialization). zstd is the command-line program. Exit code 77: one of them is missing.
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const require = createRequire(path.join(process.cwd(), "package.json"));
let core, rosmsg, cdr;
try {
  core = require("@mcap/core");
  rosmsg = require("@foxglove/rosmsg");
  cdr = require("@foxglove/rosmsg2-serialization");
  execFileSync("zstd", ["-q", "--version"], { stdio: "ignore" });
} catch (error) {
  console.error(`something is missing: ${error.message.split("\n")[0]}`);
  process.exit(77);
}

const bytes = fs.readFileSync(process.argv[2]);
const unpack = (packed) => new Uint8Array(execFileSync("zstd", ["-dq"], { input: packed, maxBuffer: 1 << 30 }));
const decompressHandlers = { zstd: unpack };

// The streaming reader checks every CRC.
const streamed = [];
const stream = new core.McapStreamReader({ decompressHandlers, validateCrcs: true });
stream.append(bytes);
for (let record; (record = stream.nextRecord()); ) {
  if (record.type === "Message") streamed.push(record);
}
if (!stream.done()) throw new Error("the file has an unexpected end");

// The indexed reader.
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
};
const indexed = await core.McapIndexedReader.Initialize({ readable, decompressHandlers });
let found = 0;
for await (const message of indexed.readMessages({ validateCrcs: true })) {
  const same = streamed.find((one) => one.channelId === message.channelId && one.sequence === message.sequence);
  if (!same || same.logTime !== message.logTime || Buffer.compare(same.data, message.data) !== 0) {
    throw new Error(`the index points to another message (${message.channelId}, ${message.sequence})`);
  }
  ++found;
}
if (found !== streamed.length) throw new Error(`${found} of ${streamed.length} messages are in the index`);

const readers = new Map();
for (const message of streamed) {
  const channel = indexed.channelsById.get(message.channelId);
  const schema = indexed.schemasById.get(channel.schemaId);
  if (!readers.has(schema.id)) {
    const definitions = rosmsg.parse(new TextDecoder().decode(schema.data), { ros2: true });
    readers.set(schema.id, new cdr.MessageReader(definitions));
  }
  const value = readers.get(schema.id).readMessage(message.data);
  const line = { topic: channel.topic, type: schema.name, time_ns: String(message.logTime), value };
  console.log(JSON.stringify(line, (key, one) =>
    one instanceof Uint8Array ? Buffer.from(one).toString("base64")
      : typeof one === "bigint" ? String(one) : ArrayBuffer.isView(one) ? Array.from(one) : one));
}
const statistics = indexed.statistics;
console.log(JSON.stringify({
  profile: indexed.header.profile,
  messages: String(statistics.messageCount),
  chunks: statistics.chunkCount,
  chunkIndexes: indexed.chunkIndexes.length,
  summaryOffsets: indexed.summaryOffsetsByOpcode.size,
  start_ns: String(statistics.messageStartTime),
  end_ns: String(statistics.messageEndTime),
  topics: [...indexed.channelsById.values()].map((channel) => channel.topic),
}));
