// Colours of bodies and of values.
import { Color } from "three";

const BODIES = ["#ff7d6b", "#2fb5a6", "#f6b13d", "#8a7df0", "#4a9cee", "#ec74aa", "#74bf60", "#c98d62"];

/** From paper to embers: what is at rest is pale, much is hot, and lightness falls all the way. */
const STOPS = ["#f2efe9", "#fbdc9a", "#fbb15f", "#f27c45", "#d8433f", "#a01f50", "#5b1453", "#2b0b3f"];
const LEVELS = 256;

export function bodyColour(index) {
  return BODIES[index % BODIES.length];
}

export const gradient = `linear-gradient(to right, ${STOPS.join(", ")})`;

/** [LEVELS x 3], linear: what the graphics card computes with. */
export const table = (() => {
  const out = new Float32Array(3 * LEVELS);
  const colours = STOPS.map((stop) => new Color(stop));
  const mixed = new Color();
  for (let i = 0; i < LEVELS; i++) {
    const place = (i / (LEVELS - 1)) * (STOPS.length - 1);
    const low = Math.min(Math.floor(place), STOPS.length - 2);
    mixed.copy(colours[low]).lerp(colours[low + 1], place - low).toArray(out, 3 * i);
  }
  return out;
})();

/** Writes the colour of `value`, from 0 to `top`, to out[at ... at + 2]. */
export function writeColour(value, top, out, at) {
  const level = 3 * Math.max(0, Math.min(LEVELS - 1, Math.round((value / (top || 1)) * (LEVELS - 1))));
  out[at] = table[level];
  out[at + 1] = table[level + 1];
  out[at + 2] = table[level + 2];
}
