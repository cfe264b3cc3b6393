// Reads an MCAP by @mcap/core, its indexed and its streaming reader, and its messages by the schemas in the file with
// @foxglove/rosmsg2-serialization. Prints a line of JSON per message, in the order of the file, then one with the
// summary: node read_mcap.mjs IN.mcap
//
// Modules are found from the folder that HAGEN_NODE_MODULES names, or else from the working directory (npm install
// @mcap/core @foxglove/rosmsg @foxglove/rosmsg2-serialization fzstd). Exit code 77: they are not there.
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const folder = process.env.HAGEN_NODE_MODULES ?? path.join(process.cwd(), "node_modules");
const require = createRequire(path.join(folder, "none.js"));
let core, rosmsg, cdr, fzstd;
try {
  core = require("@mcap/core");
  rosmsg = require("@foxglove/rosmsg");
  cdr = require("@foxglove/rosmsg2-serialization");
  fzstd = require("fzstd");
} catch (error) {
  console.error(`a package is missing: ${error.message.split("\n")[0]}`);
  process.exit(77);
}

const bytes = fs.readFileSync(process.argv[2]);
const decompressHandlers = { zstd: (packed, size) => fzstd.decompress(packed, new Uint8Array(Number(size))) };

// As it streams: every CRC is checked.
const streamed = [];
const stream = new core.McapStreamReader({ decompressHandlers, validateCrcs: true });
stream.append(bytes);
for (let record; (record = stream.nextRecord()); ) {
  if (record.type === "Message") streamed.push(record);
}
if (!stream.done()) throw new Error("the file does not end where it should");

// By its index.
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
};
const indexed = await core.McapIndexedReader.Initialize({ readable, decompressHandlers });
let found = 0;
for await (const message of indexed.readMessages({ validateCrcs: true })) {
  const same = streamed.find((one) => one.channelId === message.channelId && one.sequence === message.sequence);
  if (!same || same.logTime !== message.logTime || Buffer.compare(same.data, message.data) !== 0) {
    throw new Error(`the index leads to another message (${message.channelId}, ${message.sequence})`);
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
