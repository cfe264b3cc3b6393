// Reads a stream of MAVLink messages with node-mavlink, which has its own definitions and checks every CRC. Prints a
// JSON line per message, then one with the counts: node read_mavlink.mjs FILE
//
// Modules are found from the working directory (npm install node-mavlink). Exit code 77: the module is missing.
import { createRequire } from "node:module";
import fs from "node:fs";
import path from "node:path";
import { Readable } from "node:stream";

const require = createRequire(path.join(process.cwd(), "package.json"));
let mavlink;
try {
  mavlink = require("node-mavlink");
} catch (error) {
  console.error(`something is missing: ${error.message.split("\n")[0]}`);
  process.exit(77);
}

const { MavLinkPacketSplitter, MavLinkPacketParser, minimal, common, ardupilotmega } = mavlink;
const registry = { ...minimal.REGISTRY, ...common.REGISTRY, ...ardupilotmega.REGISTRY };
const counts = { bad: 0, bytes: 0 };
const splitter = new MavLinkPacketSplitter({}, { onCrcError: () => ++counts.bad });
const parser = new MavLinkPacketParser();
parser.on("data", (packet) => {
  const Message = registry[packet.header.msgid];
  counts.bytes += packet.buffer.length;
  const { seq, sysid, compid, magic } = packet.header;
  const value = Message ? packet.protocol.data(packet.payload, Message) : {};
  console.log(JSON.stringify({ name: Message?.MSG_NAME ?? packet.header.msgid, seq, sysid, compid, magic, value },
    (_, each) => (typeof each === "bigint" ? Number(each) : each)));
});
parser.on("end", () => {
  counts.valid = splitter.validPackages;
  console.log(JSON.stringify({ counts }));
});
Readable.from([fs.readFileSync(process.argv[2])]).pipe(splitter).pipe(parser);
