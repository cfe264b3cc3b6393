// Reads a LAS file with the package copc and prints a line of numbers per point: node read_las.mjs IN.las
//
// Modules are found from the working directory (npm install copc). Exit code 77: the module is missing.
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const require = createRequire(path.join(process.cwd(), "package.json"));
let las;
try {
  las = require("copc").Las;
} catch (error) {
  console.error(`something is missing: ${error.message.split("\n")[0]}`);
  process.exit(77);
}

const bytes = fs.readFileSync(process.argv[2]);
const header = las.Header.parse(bytes);
const { pointDataOffset, pointDataRecordLength, pointCount } = header;
const points = bytes.subarray(pointDataOffset, pointDataOffset + pointCount * pointDataRecordLength);
const view = las.View.create(points, header);
const isLegacy = header.pointDataRecordFormat < 6;
const value = (name, i) => (name in view.dimensions ? view.getter(name)(i) : 0);
for (let i = 0; i < view.pointCount; ++i) {
  const overlap = value("Overlap", i);
  // copc converts class 12 of older formats to a flag.
  const classification = isLegacy && overlap ? 12 : value("Classification", i);
  const flags = value("Synthetic", i) + 2 * value("KeyPoint", i) + 4 * value("Withheld", i);
  const channel = value("ScanChannel", i) + value("ScannerChannel", i);
  console.log(
    ["X", "Y", "Z", "Intensity", "ReturnNumber", "NumberOfReturns"].map((name) => value(name, i)).join(" "),
    isLegacy ? 0 : channel,
    classification,
    value("UserData", i),
    flags + (isLegacy ? 0 : 8 * overlap),
    ["ScanDirectionFlag", "EdgeOfFlightLine", "ScanAngle", "PointSourceId", "GpsTime", "Red", "Green", "Blue", "Infrared"]
      .map((name) => value(name, i))
      .join(" "),
  );
}
