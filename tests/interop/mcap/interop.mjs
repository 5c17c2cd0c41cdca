// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
// interop.mjs check FOLDER   reads ours_*.mcap with @mcap/core, compares with ours_*.json
//             write FOLDER   writes theirs_*.mcap from what ours_zstd.mcap holds
import assert from "node:assert/strict";
import { open, readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { McapIndexedReader, McapStreamReader, McapWriter } from "@mcap/core";
import protobuf from "protobufjs";
import descriptor from "protobufjs/ext/descriptor/index.js";
import zstd from "@foxglove/wasm-zstd";

const decompressHandlers = {
  zstd: (buffer, size) => new Uint8Array(zstd.decompress(buffer, Number(size))),
};

class FileReadable {
  constructor(handle) { this.handle = handle; }
  async size() { return BigInt((await this.handle.stat()).size); }
  async read(offset, length) {
    const buffer = new Uint8Array(Number(length));
    const { bytesRead } = await this.handle.read(buffer, 0, buffer.length, Number(offset));
    assert.equal(bytesRead, buffer.length);
    return buffer;
  }
}

class MemoryWritable {
  parts = [];
  length = 0n;
  async write(bytes) { this.parts.push(Uint8Array.from(bytes)); this.length += BigInt(bytes.length); }
  position() { return this.length; }
  bytes() { return Buffer.concat(this.parts); }
}

/** The message type that an embedded schema describes. */
function typeOf(schema) {
  assert.equal(schema.encoding, "protobuf");
  const set = descriptor.FileDescriptorSet.decode(schema.data);
  return protobuf.Root.fromDescriptor(set).lookupType(schema.name);
}

const kinds = {
  "/accelerometer": "accelerometer", "/gyroscope": "gyroscope", "/magnetometer": "magnetometer",
  "/accelerometer_uncalibrated": "uncalibrated_accelerometer",
  "/gyroscope_uncalibrated": "uncalibrated_gyroscope",
  "/magnetometer_uncalibrated": "uncalibrated_magnetometer", "/rotation": "rotation",
  "/barometer": "barometer", "/wifi_scan": "wifi_scan", "/ble": "ble", "/gnss": "gnss",
  "/waypoint": "waypoint",
};

function transmitterText(packed) {
  const digits = BigInt(packed.toString()).toString(16).padStart(16, "0");
  const address = digits.slice(4).match(/../g).join(":");
  if (digits.startsWith("00")) return address;
  return digits.startsWith("01") ? `ble:${address}` : `column:${BigInt(`0x${digits.slice(4)}`)}`;
}

const vector = (m, stem, unit) => ["x", "y", "z"].map((axis) => m[`${stem}_${axis}_${unit}`]);

/** A decoded message in the words of the JSON files. */
function describe(kind, m) {
  const base = { kind, device_time_ns: m.device_time_ns.toString() };
  const [stem, unit] = kind.endsWith("accelerometer") ? ["specific_force", "mps2"]
    : kind.endsWith("gyroscope") ? ["angular_rate", "radps"] : ["field", "ut"];
  switch (kind) {
    case "accelerometer":
    case "gyroscope":
      return { ...base, [`${stem}_${unit}`]: vector(m, stem, unit) };
    case "magnetometer":
      return { ...base, field_ut: vector(m, stem, unit),
               accuracy: Object.hasOwn(m, "accuracy") ? m.accuracy : -1 };
    case "rotation":
      return { ...base, enu_from_device_wxyz: ["w", "x", "y", "z"].map((a) => m[`enu_from_device_${a}`]) };
    case "barometer":
      return { ...base, pressure_hpa: m.pressure_hpa };
    case "wifi_scan":
      return { ...base, readings: m.readings.map((r) => ({
        transmitter: transmitterText(r.transmitter), rssi_dbm: r.rssi_dbm,
        frequency_mhz: r.frequency_mhz, last_seen_ns: r.last_seen_ns.toString(),
        ssid_hex: Buffer.from(r.ssid).toString("hex") })) };
    case "ble":
      return { ...base, transmitter: transmitterText(m.transmitter), rssi_dbm: m.rssi_dbm,
               ...(Object.hasOwn(m, "tx_power_dbm") ? { tx_power_dbm: m.tx_power_dbm } : {}),
               beacon: m.beacon };
    case "gnss":
      return { ...base, latitude_deg: m.latitude_deg, longitude_deg: m.longitude_deg,
               accuracy_m: m.accuracy_m };
    case "waypoint":
      return { ...base,
               ...(m.floor_position ? { position_m: [m.floor_position.x_m, m.floor_position.y_m] } : {}),
               ...(m.geo_position ? { latitude_deg: m.geo_position.latitude_deg,
                                      longitude_deg: m.geo_position.longitude_deg } : {}),
               floor: m.floor };
    default:
      return { ...base, [`${stem}_${unit}`]: vector(m, stem, unit),
               [`bias_${unit}`]: vector(m, "bias", unit) };
  }
}

/** Every record, each checksum compared by the reader. */
function streamRecords(bytes) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(bytes);
  const records = [];
  for (let record; (record = reader.nextRecord()); ) records.push(record);
  assert.ok(reader.done());
  return records;
}

function decodeAll(records) {
  const types = new Map();
  const channels = new Map();
  const rows = [];
  for (const record of records) {
    if (record.type === "Schema") types.set(record.id, typeOf(record));
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type === "Message") {
      const channel = channels.get(record.channelId);
      rows.push(describe(kinds[channel.topic], types.get(channel.schemaId).decode(record.data)));
    }
  }
  return rows;
}

const plain = (value) => JSON.parse(JSON.stringify(value));

async function checkOurs(folder, name) {
  const path = join(folder, `${name}.mcap`);
  const expected = JSON.parse(await readFile(join(folder, `${name}.json`), "utf8"));
  const records = streamRecords(await readFile(path));
  // JSON has no negative zero and prints a float's nearest double: compare what both can say.
  assert.deepEqual(plain(decodeAll(records)), expected);
  assert.deepEqual(records.find((r) => r.type === "Header"),
                   { type: "Header", profile: "waylode", library: "waylode" });

  const handle = await open(path);
  const reader = await McapIndexedReader.Initialize({ readable: new FileReadable(handle), decompressHandlers });
  assert.deepEqual([...reader.channelsById.values()].map((c) => c.topic), Object.keys(kinds));
  assert.equal(reader.statistics.messageCount, BigInt(expected.length));
  assert.equal(reader.statistics.chunkCount, reader.chunkIndexes.length);
  assert.ok(reader.chunkIndexes.length > 1);
  assert.equal(reader.summaryOffsetsByOpcode.size, 5);
  const metadata = [];
  for await (const record of reader.readMetadata({ name: "waylode.recording" })) metadata.push(record);
  assert.deepEqual([...metadata[0].metadata], [["device_brand", "Acme"], ["device_model", "Pocket 3"],
    ["floor", "F2"], ["schema_version", "1.0"], ["site", "Main Building"],
    ["start_utc_ns", "1700000000123456789"]]);

  // By the index: all messages in order of log time, then one topic of one span.
  const all = [];
  for await (const message of reader.readMessages()) all.push(message);
  assert.equal(all.length, expected.length);
  for (let i = 1; i < all.length; ++i) assert.ok(all[i - 1].logTime <= all[i].logTime);
  const scans = [];
  for await (const message of reader.readMessages({ topics: ["/wifi_scan"] })) scans.push(message);
  assert.equal(scans.length, expected.filter((row) => row.kind === "wifi_scan").length);
  await handle.close();
  console.log(`${name}: ${expected.length} messages, ${reader.chunkIndexes.length} chunks, ` +
              `${reader.channelsById.size} topics agree`);
}

async function writeTheirs(folder, name, options) {
  const records = streamRecords(await readFile(join(folder, "ours_zstd.mcap")));
  const writable = new MemoryWritable();
  const writer = new McapWriter({ writable, chunkSize: 10000, ...options });
  await writer.start({ profile: "", library: "interop" });
  const schemas = new Map();
  const channels = new Map();
  for (const record of records) {
    if (record.type === "DataEnd") break;
    if (record.type === "Metadata") await writer.addMetadata(record);
    if (record.type === "Schema" && !schemas.has(record.id)) {
      schemas.set(record.id, await writer.registerSchema(record));
    }
    if (record.type === "Channel" && !channels.has(record.id)) {
      const schemaId = schemas.get(record.schemaId);
      channels.set(record.id, await writer.registerChannel({ ...record, schemaId }));
    }
    if (record.type === "Message") {
      await writer.addMessage({ ...record, channelId: channels.get(record.channelId) });
    }
  }
  await writer.end();
  await writeFile(join(folder, `${name}.mcap`), writable.bytes());
}

const compressChunk = (chunk) =>
  ({ compression: "zstd", compressedData: new Uint8Array(zstd.compress(chunk)) });

const [verb, folder] = process.argv.slice(2);
await zstd.isLoaded;
if (verb === "check") {
  await checkOurs(folder, "ours_zstd");
  await checkOurs(folder, "ours_plain");
} else {
  await writeTheirs(folder, "theirs_chunked_zstd", { compressChunk });
  await writeTheirs(folder, "theirs_chunked_plain", {});
  await writeTheirs(folder, "theirs_unchunked", { useChunks: false });
}
