// A body in the scene: its shape, place and colours at any time.
import { Color, Mesh, MeshStandardMaterial, Quaternion, Vector3 } from "three";
import { bodyColour, writeColour } from "./colours.js";
import { Surface } from "./surface.js";

const VALUE_LEVELS = 4095; // of stored fields
const NEUTRAL = new Color("#c9ccd3"); // of bodies without the field that is shown

/** Sets the place of an object between two poses of 7 numbers. */
export function setPose(object, poses, frame, next, part) {
  object.position.fromArray(poses, 7 * frame);
  object.quaternion.fromArray(poses, 7 * frame + 3);
  if (part > 0) {
    object.position.lerp(new Vector3().fromArray(poses, 7 * next), part);
    object.quaternion.slerp(new Quaternion().fromArray(poses, 7 * next + 3), part);
  }
}

export class BodyView {
  constructor(body, index) {
    this.body = body;
    this.colour = bodyColour(index);
    this.points = new Float32Array(3 * body.vertices);
    this.first = this.decoded(0, new Float32Array(3 * body.vertices));
    this.surface = new Surface(this.first, body.corners);
    this.material = new MeshStandardMaterial({ color: this.colour, roughness: 0.62, metalness: 0 });
    this.mesh = new Mesh(this.surface.geometry, this.material);
    this.mesh.castShadow = true;
    this.mesh.receiveShadow = true;
    this.mesh.frustumCulled = false;
    this.mesh.name = body.name;
  }

  /** Positions in the axes of the body's frame. */
  decoded(frame, out) {
    const { origin, step, positions } = this.body;
    const start = frame * out.length;
    for (let i = 0; i < out.length; i += 3)
      for (let axis = 0; axis < 3; axis++) out[i + axis] = origin[axis] + step[axis] * positions[start + i + axis];
    return out;
  }

  /** Shows a place between frames: the number of a frame, and the part of the way to the next. */
  show(frame, part) {
    const next = part > 0 ? frame + 1 : frame;
    this.frame = frame;
    this.next = next;
    this.part = part;
    this.decoded(frame, this.points);
    if (part > 0) {
      const { step, positions } = this.body;
      const length = this.points.length;
      const a = frame * length;
      const b = next * length;
      for (let i = 0; i < length; i++) this.points[i] += part * step[i % 3] * (positions[b + i] - positions[a + i]);
    }
    this.surface.move(this.points);
    setPose(this.mesh, this.body.poses, frame, next, part);
  }

  /** Colours by a field of the recording, or by the body's own colour. */
  paint(recording, fieldIndex) {
    const has = fieldIndex >= 0 && this.body.fields[fieldIndex];
    this.setPainted(has, fieldIndex < 0);
    if (!has) return;
    const { top } = recording.fields[fieldIndex];
    const value = this.valueOf(recording, fieldIndex);
    this.surface.colour((vertex, out, at) => writeColour(value(vertex), top, out, at));
  }

  setPainted(painted, own) {
    if (this.material.vertexColors !== painted) {
      this.material.vertexColors = painted;
      this.material.needsUpdate = true;
    }
    if (painted) this.material.color.set("white");
    else this.material.color.set(own ? this.colour : NEUTRAL);
  }

  valueOf(recording, fieldIndex) {
    const field = recording.fields[fieldIndex];
    if (field.stored) return this.storedValue(fieldIndex, field.most / VALUE_LEVELS);
    if (field.name === "displacement") return (v) => this.distance(this.points, this.first, 3 * v);
    return this.speedOf(recording);
  }

  storedValue(fieldIndex, level) {
    const values = this.body.values[fieldIndex];
    const a = this.frame * this.body.vertices;
    const b = this.next * this.body.vertices;
    return (v) => level * (values[a + v] + this.part * (values[b + v] - values[a + v]));
  }

  distance(a, b, i) {
    return Math.hypot(a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]);
  }

  /** By the positions of the two frames around the time. */
  speedOf(recording) {
    const from = Math.max(0, Math.min(this.part > 0 ? this.frame : this.frame - 1, recording.frames - 2));
    const interval = recording.times[from + 1] - recording.times[from];
    const [a, b] = [this.world(from), this.world(from + 1)];
    return (v) => this.distance(a, b, 3 * v) / interval;
  }

  world(frame) {
    const out = this.decoded(frame, new Float32Array(3 * this.body.vertices));
    const rotation = new Quaternion().fromArray(this.body.poses, 7 * frame + 3);
    const translation = new Vector3().fromArray(this.body.poses, 7 * frame);
    const point = new Vector3();
    for (let i = 0; i < out.length; i += 3) point.fromArray(out, i).applyQuaternion(rotation).add(translation).toArray(out, i);
    return out;
  }
}
