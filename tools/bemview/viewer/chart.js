// The plot of one quantity of the visible bodies over time; a click goes to a time.
import { decimalsOf, numberText, roundStep, scaleFor, valueText } from "./units.js";

const MARGIN = { left: 72, right: 18, top: 10, bottom: 22 };

/** What can be plotted: every quantity, of vectors the length and the components. */
export function quantitiesOf(series) {
  const found = new Map();
  for (const one of series) {
    const parts = one.components === 1 ? [""] : [" (length)", " x", " y", " z"];
    parts.forEach((part, p) => {
      const key = one.name + part;
      if (!found.has(key)) found.set(key, { key, units: one.units, curves: [] });
      found.get(key).curves.push({ body: one.body, values: component(one, p - 1) });
    });
  }
  return [...found.values()];
}

function component({ numbers, components }, which) {
  if (components === 1) return numbers;
  const out = new Float32Array(numbers.length / components);
  for (let k = 0; k < out.length; k++) {
    const vector = numbers.subarray(k * components, (k + 1) * components);
    out[k] = which < 0 ? Math.hypot(...vector) : vector[which];
  }
  return out;
}

export class Chart {
  constructor(canvas, recording, goTo) {
    this.canvas = canvas;
    this.recording = recording;
    this.quantity = null;
    const jump = (event) => goTo(this.timeAt(event.offsetX));
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      jump(event);
    });
    canvas.addEventListener("pointermove", (event) => event.buttons && jump(event));
  }

  get inner() {
    return { width: this.canvas.clientWidth - MARGIN.left - MARGIN.right, height: this.canvas.clientHeight - MARGIN.top - MARGIN.bottom };
  }

  timeAt(x) {
    const part = Math.min(1, Math.max(0, (x - MARGIN.left) / this.inner.width));
    return this.recording.times[0] + part * this.recording.duration;
  }

  xOf(time) {
    return MARGIN.left + (this.inner.width * (time - this.recording.times[0])) / (this.recording.duration || 1);
  }

  /** `curves`: those of the visible bodies, with their colours. */
  setCurves(quantity, curves) {
    this.quantity = quantity;
    this.curves = curves;
    let low = Infinity;
    let high = -Infinity;
    for (const { values } of curves)
      for (const value of values) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    if (!(low <= high)) [low, high] = [0, 1];
    if (low > 0 && low < 0.4 * high) low = 0;
    const size = Math.max(Math.abs(low), Math.abs(high));
    if (high - low < 1e-6 * size || high === low) [low, high] = [low - 0.1 * (size || 1), high + 0.1 * (size || 1)];
    this.step = roundStep(high - low, 3);
    this.low = Math.floor(low / this.step + 1e-6) * this.step;
    this.high = Math.ceil(high / this.step - 1e-6) * this.step;
    this.scale = scaleFor(size, quantity?.units ?? "");
    this.refresh();
  }

  yOf(value) {
    return MARGIN.top + this.inner.height * (1 - (value - this.low) / (this.high - this.low));
  }

  /** Forgets what was drawn: size, colours or curves are others. */
  refresh() {
    this.still = null;
  }

  draw(place) {
    const { canvas } = this;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (!this.quantity || width === 0) return;
    const style = getComputedStyle(document.body);
    this.still ??= this.drawn(style, width, height);
    if (canvas.width !== this.still.width) canvas.width = this.still.width;
    if (canvas.height !== this.still.height) canvas.height = this.still.height;
    const context = canvas.getContext("2d");
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.drawImage(this.still, 0, 0);
    context.scale(canvas.width / width, canvas.height / height);
    this.drawMarker(context, style, place);
  }

  /** Axes and curves, which do not depend on the time. */
  drawn(style, width, height) {
    const still = document.createElement("canvas");
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    still.width = Math.round(width * ratio);
    still.height = Math.round(height * ratio);
    const context = still.getContext("2d");
    context.scale(ratio, ratio);
    context.font = `12px ${style.fontFamily}`;
    this.drawAxes(context, style);
    for (const curve of this.curves) this.drawCurve(context, curve);
    return still;
  }

  drawAxes(context, style) {
    context.strokeStyle = style.getPropertyValue("--hairline");
    context.fillStyle = style.getPropertyValue("--quiet");
    context.lineWidth = 1;
    context.textBaseline = "middle";
    context.textAlign = "right";
    const decimals = decimalsOf(this.step / this.scale.factor);
    for (let value = this.low; value <= this.high + 0.5 * this.step; value += this.step) {
      const y = Math.round(this.yOf(value)) + 0.5;
      this.line(context, MARGIN.left, y, this.canvas.clientWidth - MARGIN.right, y);
      const text = numberText(Math.abs(value) < 1e-9 * this.step ? 0 : value, this.scale, decimals);
      const units = value + 0.5 * this.step > this.high ? ` ${this.scale.units}` : "";
      context.fillText(text + units, MARGIN.left - 10, y);
    }
    this.drawTimes(context);
  }

  drawTimes(context) {
    const { times, duration } = this.recording;
    const step = roundStep(duration, Math.max(2, this.inner.width / 110));
    const scale = scaleFor(times.at(-1), "s");
    const decimals = decimalsOf(step / scale.factor);
    context.textAlign = "center";
    context.textBaseline = "alphabetic";
    for (let time = Math.ceil(times[0] / step - 1e-9) * step; time <= times.at(-1) + 1e-9 * step; time += step) {
      const text = `${numberText(time, scale, decimals)} ${scale.units}`;
      const furthest = this.canvas.clientWidth - context.measureText(text).width / 2;
      context.fillText(text, Math.min(this.xOf(time), furthest), this.canvas.clientHeight - 4);
    }
  }

  drawCurve(context, { values, colour }) {
    const { times } = this.recording;
    context.strokeStyle = colour;
    context.lineWidth = 1.75;
    context.lineJoin = "round";
    context.beginPath();
    for (let k = 0; k < values.length; k++) context.lineTo(this.xOf(times[k]), this.yOf(values[k]));
    context.stroke();
  }

  drawMarker(context, style, place) {
    const x = this.xOf(this.recording.timeOf(place));
    context.strokeStyle = style.getPropertyValue("--ink");
    context.lineWidth = 1.25;
    this.line(context, x, MARGIN.top - 4, x, MARGIN.top + this.inner.height);
    for (const { values, colour } of this.curves) {
      context.fillStyle = colour;
      context.strokeStyle = style.getPropertyValue("--card");
      context.lineWidth = 2;
      context.beginPath();
      context.arc(x, this.yOf(this.valueAt(values, place)), 4.5, 0, 7);
      context.fill();
      context.stroke();
    }
  }

  line(context, x0, y0, x1, y1) {
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.stroke();
  }

  valueAt(values, place) {
    const low = Math.floor(place);
    const high = Math.min(low + 1, values.length - 1);
    return values[low] + (place - low) * (values[high] - values[low]);
  }

  /** What the curves say at a place: colours and texts. */
  readings(place) {
    return this.curves.map((curve) => ({ name: curve.name, colour: curve.colour, text: valueText(this.valueAt(curve.values, place), this.scale) }));
  }
}
