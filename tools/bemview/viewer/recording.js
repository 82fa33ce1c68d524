// What the page shows: bodies in all frames, obstacles, series and contacts. ../page.hpp describes the data.
import { readSection } from "./unpacking.js";

const POSE = 7; // numbers: translation, quaternion (x, y, z, w)

export class Recording {
  constructor(root) {
    this.root = root;
    this.description = JSON.parse(root.getElementById("description").textContent);
    this.frames = this.description.frames;
    this.fields = this.description.fields;
    this.bodies = this.description.bodies.map((body) => ({
      ...body,
      positions: new Uint16Array(3 * body.vertices * this.frames),
      values: this.fields.map((field, f) => (field.stored && body.fields[f] ? new Uint16Array(body.vertices * this.frames) : null)),
    }));
    this.ready = 0; // frames that can be shown
    this.contacts = null;
    this.series = [];
  }

  sections(kind) {
    return [...this.root.querySelectorAll(`script.${kind}`)];
  }

  /** Everything but frames, series and contacts. */
  async readScene() {
    const section = await readSection(this.sections("scene")[0]);
    this.times = section.numbers(Float64Array, this.frames);
    for (const body of this.bodies) body.corners = section.numbers(Uint32Array, 3 * body.triangles);
    const poses = section.numbers(Float32Array, this.bodies.length * this.frames * POSE);
    this.bodies.forEach((body, b) => {
      body.poses = poses.subarray(b * this.frames * POSE, (b + 1) * this.frames * POSE);
    });
    this.obstacles = this.description.obstacles.map((obstacle) => {
      if (obstacle.normal) return { ...obstacle };
      return {
        ...obstacle,
        points: section.numbers(Float32Array, 3 * obstacle.vertices),
        corners: section.numbers(Uint32Array, 3 * obstacle.triangles),
        poses: section.numbers(Float32Array, this.frames * POSE),
      };
    });
  }

  /** The next frames that are not ready; false if all are. */
  async readFrames() {
    const element = this.sections("frames")[0];
    if (!element) return false;
    const section = await readSection(element);
    const first = this.ready;
    const count = Math.min(this.description.segmentFrames, this.frames - first);
    for (const body of this.bodies) {
      const part = (numbers, width) => numbers.subarray(first * width, (first + count) * width);
      section.predictedFrames(part(body.positions, 3 * body.vertices), count, 3);
      for (const values of body.values) if (values) section.predictedFrames(part(values, body.vertices), count, 1);
    }
    this.ready = first + count;
    return this.ready < this.frames;
  }

  async readSeries() {
    const section = await readSection(this.sections("series")[0]);
    this.series = this.description.series.map((series) => ({
      ...series,
      numbers: section.numbers(Float32Array, this.frames * series.components),
    }));
  }

  async readContacts() {
    const section = await readSection(this.sections("contacts")[0]);
    if (section.bytes.length === 0) return;
    const ends = section.numbers(Uint32Array, this.frames);
    const rows = ends[this.frames - 1];
    this.contacts = { ends, points: section.numbers(Float32Array, 3 * rows), forces: section.numbers(Float32Array, 3 * rows) };
  }

  get duration() {
    return this.times[this.frames - 1] - this.times[0];
  }

  /** The frame before a time, as a number with the part of the way to the next one. */
  placeOf(time) {
    let low = 0;
    let high = this.frames - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.times[middle] <= time) low = middle;
      else high = middle;
    }
    if (high === low) return low;
    const part = (time - this.times[low]) / (this.times[high] - this.times[low]);
    return low + Math.min(1, Math.max(0, part));
  }

  timeOf(place) {
    const low = Math.floor(place);
    const high = Math.min(low + 1, this.frames - 1);
    return this.times[low] + (place - low) * (this.times[high] - this.times[low]);
  }
}
