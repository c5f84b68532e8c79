// The messages of formats/snapshot.fbs as plain objects of arrays, by the code that flatc writes for the schema: all
// fields, under flatc's names, so that a new field of the schema needs no line here.

import { Frame } from "schema/frame";
import { Full } from "schema/full";
import { Header } from "schema/header";

const empty = new Float64Array(0);
const kept = new Map(); // names of the fields, by the class of the table

/** Methods of flatc's class that are fields; a vector has a NAMELength, one of numbers up to 53 bits a NAMEArray beside. */
function fieldsOf(table) {
  const methods = Object.getPrototypeOf(table);
  if (!kept.has(methods)) {
    const names = Object.getOwnPropertyNames(methods).filter((name) => !["constructor", "__init"].includes(name));
    kept.set(methods, names.filter((name) => {
      const helped = name.match(/(.+)(Length|Array)$/)?.[1];
      return !names.includes(helped) && !names.includes(`${helped}_`);
    }));
  }
  return kept.get(methods);
}

/**
 * As flatc calls its helpers: a field with the name of a keyword ("interface") has an underscore behind it, they have
 * not.
 */
const stem = (name) => name.replace(/_$/, "");

function vector(table, name) {
  const array = table[`${stem(name)}Array`], length = table[`${stem(name)}Length`].call(table);
  if (array) return array.call(table) ?? empty;
  const items = Array.from({ length }, (_, k) => plain(table[name](k)));
  return typeof items[0] === "bigint" ? Float64Array.from(items, Number) : items;
}

/** A table as an object of its fields; what is no table as it is. */
function plain(table) {
  if (table === null || typeof table !== "object") return table;
  return Object.fromEntries(fieldsOf(table).map((name) =>
    [stem(name), table[`${stem(name)}Length`] ? vector(table, name) : plain(table[name]())]));
}

/** { name: [..], friction: [..] } as [{ name, friction }, ..]. */
const rows = (columns, length) => Array.from({ length }, (_, k) =>
  Object.fromEntries(Object.entries(columns).map(([name, values]) => [name, values[k]])));

export function decodeHeader(buffer) {
  const header = plain(Header.getRootAsHeader(buffer));
  return {
    ...header,
    ...header.geometry,
    scenarioPath: header.scenarioPath ?? "",
    scenarioText: header.scenarioText ?? "",
    build: { version: header.build?.version ?? "", gitHash: header.build?.gitHash ?? "" },
    names: header.geometry.name,
    joints: rows(header.joints ?? {}, header.joints?.name.length ?? 0),
    waters: header.waters.map(waterOf),
    failure: failureOf(header.failure),
  };
}

/** Results of the search that kept this run; null for others. */
const failureOf = (failure) => failure && {
  ...failure,
  analysis: failure.analysis ?? "",
  mode: ["none", "sliding", "toppling", "mixed"][failure.mode] ?? "none",
  factor: failure.factor ?? [],
};

const waterOf = (water) => ({
  ...water,
  kind: ["depth", "elevation", "head"][water.level] ?? "depth",
  field: water.field ?? "water",
});

export function decodeFrame(buffer) {
  const frame = plain(Frame.getRootAsFrame(buffer));
  return {
    ...frame,
    ...frame.energies,
    step: Number(frame.step),
    stateHash: frame.stateHash.toString(16).padStart(16, "0"),
    waterLevel: frame.water?.level ?? empty,
    waterTable: frame.water?.table ?? empty,
    waterDrained: frame.water?.drained ?? empty,
  };
}

/** `interfaces.origin`, `e1` and `e2` are those of the reference face, a's. */
export function decodeFull(buffer) {
  const full = plain(Full.getRootAsFull(buffer));
  return {
    ...full,
    force: full.blocks.force,
    interfaces: {
      ...full.interfaces,
      count: full.interfaces.blockA.length,
      origin: full.interfaces.originA,
      e1: full.interfaces.e1A,
      e2: full.interfaces.e2A,
    },
    wet: { ...full.wet, count: full.wet.block.length },
  };
}
