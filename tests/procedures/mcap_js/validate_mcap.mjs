// Reads an MCAP file from end to end with checksums on, then again through its index; prints what it found as JSON.
import { readFileSync } from "node:fs";
import zstd from "@foxglove/wasm-zstd";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";

await zstd.isLoaded;
const decompressHandlers = { zstd: (data, size) => zstd.decompress(data, Number(size)) };
const bytes = readFileSync(process.argv[2]);

const topics = new Map();
const found = { streamed: {}, indexed: 0, metadata: {}, attachments: {}, done: false };

const stream = new McapStreamReader({ validateCrcs: true, decompressHandlers });
stream.append(bytes);
for (let record; (record = stream.nextRecord()); ) {
  if (record.type === "Channel") topics.set(record.id, record.topic);
  if (record.type === "Metadata") found.metadata[record.name] = Object.fromEntries(record.metadata);
  if (record.type === "Attachment") found.attachments[record.name] = new TextDecoder().decode(record.data);
  if (record.type === "Message") {
    const topic = topics.get(record.channelId);
    (found.streamed[topic] ??= []).push(JSON.parse(new TextDecoder().decode(record.data)));
  }
}
found.done = stream.done();

const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
};
const indexed = await McapIndexedReader.Initialize({ readable, decompressHandlers });
for (const schema of indexed.schemasById.values()) JSON.parse(new TextDecoder().decode(schema.data));
for await (const _ of indexed.readMessages()) found.indexed += 1;

console.log(JSON.stringify(found));
