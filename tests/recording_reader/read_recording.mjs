// Reads a recording front to back and by its index, decodes every message, checks every checksum,
// and prints what it found as JSON. Any deviation is an error.
import { readFile } from "node:fs/promises";
import { argv, stdout } from "node:process";

import { crc32 } from "@foxglove/crc";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { loadDecompressHandlers } from "@mcap/support";

const DATA_END_BYTES = 1 + 8 + 4;

function require(condition, message) {
  if (!condition) throw new Error(message);
}

function decoderOf(channel, schema) {
  require(schema?.encoding === "ros2msg", `${channel.topic}: schema is not ros2msg`);
  require(channel.messageEncoding === "cdr", `${channel.topic}: messages are not CDR`);
  require(channel.metadata.get("offered_qos_profiles"), `${channel.topic}: no QoS profiles`);
  const text = new TextDecoder().decode(schema.data);
  return new MessageReader(parse(text, { ros2: true }));
}

// Everything of a message that a test may want to compare, without the bulk.
function abridged(message) {
  return JSON.parse(
    JSON.stringify(message, (_key, value) => {
      if (typeof value === "bigint") return value.toString();
      if (ArrayBuffer.isView(value) && !(value instanceof Float64Array)) {
        return { length: value.length, crc: crc32(value) };
      }
      return value instanceof Float64Array ? [...value] : value;
    }),
  );
}

async function stream(bytes, decompressHandlers) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true, includeChunks: true });
  reader.append(bytes);
  const found = { records: {}, topics: {}, attachments: {}, metadata: {} };
  const schemas = new Map();
  const channels = new Map();
  const decoders = new Map();
  for (let record; (record = reader.nextRecord()); ) {
    found.records[record.type] = (found.records[record.type] ?? 0) + 1;
    if (record.type === "Header") found.header = { profile: record.profile };
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type === "Attachment") {
      found.attachments[record.name] = new TextDecoder().decode(record.data);
    }
    if (record.type === "Metadata") {
      found.metadata[record.name] = Object.fromEntries(record.metadata);
    }
    if (record.type === "Chunk") require(record.uncompressedCrc !== 0, "a chunk has no CRC");
    if (record.type !== "Message") continue;
    const channel = channels.get(record.channelId);
    if (!decoders.has(channel.id)) {
      decoders.set(channel.id, decoderOf(channel, schemas.get(channel.schemaId)));
    }
    const message = decoders.get(channel.id).readMessage(record.data);
    const topic = (found.topics[channel.topic] ??= { count: 0, bytes: record.data.length });
    if (topic.count++ === 0) {
      topic.type = schemas.get(channel.schemaId).name;
      topic.first = { logTime: record.logTime.toString(), ...abridged(message) };
    }
  }
  require(reader.done(), "the file does not end as it should");
  return found;
}

async function checkIndex(bytes, decompressHandlers, streamed) {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  require(reader.footer.summaryCrc !== 0, "the summary has no CRC");
  require(reader.dataSectionCrc, "the data section has no CRC");
  const dataEnd = Number(reader.footer.summaryStart) - DATA_END_BYTES;
  require(
    crc32(bytes.subarray(0, dataEnd)) === reader.dataSectionCrc,
    "the CRC of the data section does not fit",
  );
  const counts = {};
  let last = 0n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    require(message.logTime >= last, "the index is not in the order of time");
    last = message.logTime;
    const topic = reader.channelsById.get(message.channelId).topic;
    counts[topic] = (counts[topic] ?? 0) + 1;
  }
  for (const [topic, { count }] of Object.entries(streamed.topics)) {
    require(counts[topic] === count, `${topic}: ${count} in the file, ${counts[topic]} by the index`);
  }
  for (const [id, count] of reader.statistics.channelMessageCounts) {
    const topic = reader.channelsById.get(id).topic;
    require(BigInt(counts[topic]) === count, `${topic}: the statistics are wrong`);
  }
  const attachments = [];
  for await (const attachment of reader.readAttachments()) attachments.push(attachment.name);
  require(
    attachments.length === Object.keys(streamed.attachments).length,
    "an attachment is not in the index",
  );
  return { chunks: reader.chunkIndexes.length, summaryOffsets: reader.summaryOffsetsByOpcode.size };
}

const bytes = new Uint8Array(await readFile(argv[2]));
const decompressHandlers = await loadDecompressHandlers();
const found = await stream(bytes, decompressHandlers);
found.index = await checkIndex(bytes, decompressHandlers, found);
stdout.write(JSON.stringify(found, null, 1) + "\n");
