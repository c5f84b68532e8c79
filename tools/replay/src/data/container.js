// From the page's text to the messages of the snapshot file: base64, MCAP, zstd, FlatBuffers. Everything stays in memory.

import { McapIndexedReader } from "@mcap/core";
import { ByteBuffer } from "flatbuffers";
import { decompress } from "fzstd";
import { decodeFrame, decodeFull, decodeHeader } from "./messages.js";

const kPauseMs = 30; // between two updates of the page while a long file is read

/** Bytes of the base64 texts in elements of this class, in the document's order; each text is whole in itself. */
export function embeddedBytes(selector) {
  const parts = [...document.querySelectorAll(selector)].map((element) => {
    const bytes = bytesOfBase64(element.textContent.trim());
    element.remove(); // the text is as large as the file
    return bytes;
  });
  const whole = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) whole.set(part, at), (at += part.length);
  return whole;
}

function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let k = 0; k < letters.length; ++k) bytes[k] = letters.charCodeAt(k);
  return bytes;
}

/** A FlatBuffers message wants its numbers aligned: slice() copies them into a buffer of their own. */
const messageOf = (data) => new ByteBuffer(data.slice());

/**
 * Opens a snapshot file held in memory. Returns {header, frames, fullTimes, end, full(k)}: all light frames are decoded,
 * full states when they are asked for. Throws when the bytes are no such file.
 */
export async function openSnapshots(bytes, onProgress) {
  const reader = await McapIndexedReader.Initialize({
    readable: {
      size: async () => BigInt(bytes.length),
      read: async (offset, length) => bytes.subarray(Number(offset), Number(offset) + Number(length)),
    },
    decompressHandlers: { zstd: (part, size) => decompress(part, new Uint8Array(Number(size))) },
  });
  const messages = Number(reader.statistics?.messageCount ?? 0n);
  const file = { header: null, frames: [], fullTimes: [], end: await endOf(reader) };
  let count = 0, last = performance.now();
  for await (const message of reader.readMessages()) {
    const topic = reader.channelsById.get(message.channelId).topic;
    if (topic === "header") file.header = decodeHeader(messageOf(message.data));
    if (topic === "frame") file.frames.push(decodeFrame(messageOf(message.data)));
    if (topic === "full") file.fullTimes.push(message.logTime);
    ++count;
    if (performance.now() - last < kPauseMs) continue;
    onProgress(count / Math.max(1, messages));
    await new Promise((resolve) => setTimeout(resolve));
    last = performance.now();
  }
  if (!file.header || file.frames.length === 0) throw new Error("the file holds no frames of a run");
  file.full = fullReader(reader, file.fullTimes);
  return file;
}

/** How the run ended: the metadata record "talus.end" as a Map, or null. */
async function endOf(reader) {
  for await (const record of reader.readMetadata({ name: "talus.end" })) return record.metadata;
  return null;
}

/** Reads full states by number and keeps the last few: they are large. */
function fullReader(reader, times) {
  const kept = new Map();
  const read = async (k) => {
    const range = { startTime: times[k], endTime: times[k], topics: ["full"] };
    for await (const message of reader.readMessages(range)) return decodeFull(messageOf(message.data));
    throw new Error(`full state ${k} is not in the file`);
  };
  return (k) => {
    if (!kept.has(k)) kept.set(k, read(k));
    const found = kept.get(k);
    kept.delete(k), kept.set(k, found); // the youngest last
    if (kept.size > 4) kept.delete(kept.keys().next().value);
    return found;
  };
}
