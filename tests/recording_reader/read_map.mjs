// Reads a LAS file with copc's reader, every point of it, and prints what it found as JSON. Any
// deviation from the format is an error.
import { readFile } from "node:fs/promises";
import { argv, stdout } from "node:process";

import { Las } from "copc";

const COLORS = ["Red", "Green", "Blue"];

function require(condition, message) {
  if (!condition) throw new Error(message);
}

function pointAt(view, getters, index) {
  return Object.fromEntries(Object.keys(view.dimensions).map((name) => [name, getters[name](index)]));
}

const bytes = await readFile(argv[2]);
const range = async (begin, end) => bytes.subarray(begin, end);
const header = Las.Header.parse(bytes.subarray(0, 375));
const vlrs = await Las.Vlr.walk(range, header);
const system = Las.Vlr.find(vlrs, "LASF_Projection", 2112);
require(system, "no coordinate system");
const wkt = (await Las.Vlr.fetch(range, system)).toString("utf8");

const points = bytes.subarray(header.pointDataOffset);
const view = Las.View.create(points, header);
require(view.pointCount === header.pointCount, "the header counts other points than there are");
require(header.pointCountByReturn[0] === header.pointCount, "not every point is a first return");
const getters = Object.fromEntries(Object.keys(view.dimensions).map((n) => [n, view.getter(n)]));
const low = [Infinity, Infinity, Infinity];
const high = [-Infinity, -Infinity, -Infinity];
const sums = { Intensity: 0, Red: 0, Green: 0, Blue: 0 };
for (let i = 0; i < view.pointCount; ++i) {
  ["X", "Y", "Z"].forEach((name, axis) => {
    low[axis] = Math.min(low[axis], getters[name](i));
    high[axis] = Math.max(high[axis], getters[name](i));
  });
  for (const name of ["Intensity", ...COLORS]) sums[name] += getters[name](i);
  require(getters.ReturnNumber(i) === 1 && getters.NumberOfReturns(i) === 1, "not the only return");
}
for (const axis of view.pointCount > 0 ? [0, 1, 2] : []) {
  require(Math.abs(low[axis] - header.min[axis]) < 1e-9, `the header's least ${"xyz"[axis]} is not`);
  require(Math.abs(high[axis] - header.max[axis]) < 1e-9, `the header's most ${"xyz"[axis]} is not`);
}
const found = { header, vlrs, wkt, sums };
if (view.pointCount > 0) found.first = pointAt(view, getters, 0);
if (view.pointCount > 0) found.last = pointAt(view, getters, view.pointCount - 1);
stdout.write(JSON.stringify(found));
