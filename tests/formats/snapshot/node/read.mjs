// Reads a Talus snapshot file with readers that are not ours and prints what they found, as JSON lines: first the
// container's summary, then one line a message, every value of it. `node read.mjs FILE [FROM_NS]` seeks by time.
import { open } from "node:fs/promises";
import { McapIndexedReader } from "@mcap/core";
import { decompress } from "fzstd";
import { ByteBuffer } from "flatbuffers";
import reflection from "flatbuffers_reflection";

const { Parser, Schema, Table } = reflection;
const [path, from] = process.argv.slice(2);
const file = await open(path);
const readable = {
  size: async () => BigInt((await file.stat()).size),
  read: async (offset, length) => {
    const bytes = new Uint8Array(Number(length));
    await file.read(bytes, 0, bytes.length, Number(offset));
    return bytes;
  },
};
// JSON has neither bigints nor nan and infinity.
const plain = (_, value) =>
  typeof value === "bigint" ? value.toString()
  : value instanceof Uint8Array ? [...value]
  : typeof value === "number" && !Number.isFinite(value) ? String(value)
  : value;
const print = (value) => process.stdout.write(JSON.stringify(value, plain) + "\n");

const reader = await McapIndexedReader.Initialize({
  readable,
  decompressHandlers: { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) },
});
const metadata = [];
for await (const record of reader.readMetadata()) metadata.push({ name: record.name, values: [...record.metadata] });
print({
  profile: reader.header.profile,
  messages: reader.statistics.messageCount,
  chunks: reader.chunkIndexes.length,
  start: reader.statistics.messageStartTime,
  end: reader.statistics.messageEndTime,
  metadata,
});
const parsers = new Map();
for (const { id, name, data } of reader.schemasById.values()) {
  const schema = Schema.getRootAsSchema(new ByteBuffer(data.slice()));
  parsers.set(id, { name, schema, parser: new Parser(schema) });
}
for await (const message of reader.readMessages(from ? { startTime: BigInt(from) } : {})) {
  const channel = reader.channelsById.get(message.channelId);
  const { name, schema, parser } = parsers.get(channel.schemaId);
  // FlatBuffers wants its numbers aligned: slice() copies into a buffer of its own.
  const bytes = new ByteBuffer(message.data.slice());
  const index = Table.getNamedTable(bytes, schema, name);
  print({ topic: channel.topic, time: message.logTime, values: parser.toObject(index, true) });
}
await file.close();
