// Everything around the view: buttons, lists, legend, keys.
import { bodyColour, gradient } from "./colours.js";
import { quantitiesOf } from "./chart.js";
import { ARROW_COLOUR } from "./contacts.js";
import { SPEEDS } from "./player.js";
import { numberText, scaleFor, valueText } from "./units.js";

const $ = (id) => document.getElementById(id);
const PLAY = "M8.5 5.5v13l10-6.5Z";
const PAUSE = "M7 5.500h3.600v13H7ZM13.400 5.500H17v13h-3.600Z";
const NARROW = matchMedia("(max-width: 760px)");
const SHOWN_READINGS = 4;

function made(tag, properties = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

function speedText(speed) {
  if (speed >= 1) return `${speed}×`;
  const inverse = Math.round(1 / speed);
  return `1/${inverse}×`;
}

export class Controls {
  constructor(recording, stage, player, chart) {
    Object.assign(this, { recording, stage, player, chart });
    this.quantities = [];
    this.fillHeading();
    this.fillTransport();
    this.fillColours();
    this.fillBodies();
    this.fillSurroundings();
    this.addButtons();
    this.addKeys();
    this.followTheme();
    new ResizeObserver(() => this.resize()).observe($("stage"));
    new ResizeObserver(() => {
      this.chart.refresh();
      this.chart.draw(this.player.place);
    }).observe($("chart"));
    this.resize();
  }

  fillHeading() {
    const { title, program, bodies } = this.recording.description;
    $("title").textContent = title;
    const vertices = bodies.reduce((sum, body) => sum + body.vertices, 0).toLocaleString("en");
    $("subtitle").textContent = `${bodies.length === 1 ? "1 body" : `${bodies.length} bodies`} · ${vertices} vertices · ${this.recording.frames} frames`;
    if (program) $("subtitle").append(made("span", { className: "wide", textContent: ` · ${program}` }));
  }

  fillTransport() {
    $("scrub").max = this.recording.frames - 1;
    for (const speed of SPEEDS) $("speed").append(made("option", { value: speed, textContent: speedText(speed) }));
    $("speed").value = this.player.speed;
    this.clockScale = scaleFor(this.recording.times.at(-1), "s");
  }

  fillColours() {
    this.choices = [{ label: "bodies", index: -1 }, ...this.recording.fields.map((field, index) => ({ label: field.label, index }))];
    for (const choice of this.choices) {
      const button = made("button", { className: "chip", textContent: choice.label, onclick: () => this.paint(choice.index) });
      button.setAttribute("role", "radio");
      choice.button = button;
      $("colour-choices").append(button);
    }
    $("colours").hidden = this.choices.length < 2;
    $("legend-bar").style.background = gradient;
    this.markColour(-1);
  }

  paint(index) {
    this.stage.paint(index);
    this.markColour(index);
  }

  markColour(index) {
    for (const choice of this.choices) choice.button.setAttribute("aria-checked", choice.index === index);
    $("legend").hidden = index < 0;
    if (index < 0) return;
    const field = this.recording.fields[index];
    const scale = scaleFor(field.top, field.units);
    const beyond = field.most > 1.02 * field.top;
    $("legend-label").textContent = field.label;
    $("legend-most").textContent = beyond ? `largest ${valueText(field.most, scaleFor(field.most, field.units))}` : "";
    const middle = numberText(field.top / 2, scale);
    const ticks = ["0", middle, `${beyond ? "≥ " : ""}${numberText(field.top, scale)} ${scale.units}`];
    $("legend-ticks").replaceChildren(...ticks.map((text) => made("span", { textContent: text })));
  }

  toggleRow(object, colour, visible = true) {
    const box = made("input", { type: "checkbox", checked: visible });
    box.addEventListener("change", () => {
      this.stage.setVisible(object, box.checked);
      this.updateCurves();
    });
    const dot = made("span", { className: "dot" });
    dot.style.setProperty("--dot", colour);
    return { box, row: made("li", {}, made("label", {}, box, dot, made("span", { className: "name", textContent: object.name || "ground" }))) };
  }

  fillBodies() {
    this.boxes = this.stage.bodies.map(({ mesh }, index) => {
      const { box, row } = this.toggleRow(mesh, bodyColour(index));
      $("bodies").append(row);
      return box;
    });
    $("all-bodies").hidden = this.boxes.length < 3;
    $("all-bodies").onclick = () => {
      const show = !this.boxes.some((box) => box.checked);
      this.boxes.forEach((box, b) => {
        box.checked = show;
        this.stage.bodies[b].mesh.visible = show;
      });
      this.stage.show(this.player.place);
      this.updateCurves();
    };
  }

  fillSurroundings() {
    for (const object of [...this.stage.grounds, ...this.stage.obstacles]) $("obstacles").append(this.toggleRow(object, "var(--obstacle)").row);
    $("surroundings").hidden = false;
  }

  addContacts() {
    $("obstacles").append(this.toggleRow(this.stage.arrows, ARROW_COLOUR).row);
  }

  addQuantities() {
    this.quantities = quantitiesOf(this.recording.series);
    $("quantity").replaceChildren(...this.quantities.map(({ key }, index) => made("option", { value: index, textContent: key })));
    $("quantity").value = this.firstQuantity();
    $("plot").hidden = this.quantities.length === 0 || this.recording.frames < 2;
    this.updateCurves();
  }

  /** Contact forces if there are any; else the height if bodies rise or fall, or how far they are deformed. */
  firstQuantity() {
    const changes = (name, least) => this.quantities.findIndex(({ key, curves }) => key === name && curves.some(({ values }) => values.some((value) => Math.abs(value - values[0]) > least)));
    const found = [changes("contact force (length)", 0), changes("height", 0.05 * this.stage.radius), changes("largest displacement", 0)];
    return found.find((index) => index >= 0) ?? 0;
  }

  updateCurves() {
    const quantity = this.quantities[$("quantity").value];
    if (!quantity) return;
    const visible = quantity.curves.filter(({ body }) => this.stage.bodies[body].mesh.visible);
    this.chart.setCurves(
      quantity,
      visible.map(({ body, values }) => ({ values, name: this.recording.bodies[body].name, colour: bodyColour(body) })),
    );
    this.showReadings();
  }

  showReadings() {
    if (!this.chart.quantity) return;
    const readings = this.chart.readings(this.player.place).slice(0, SHOWN_READINGS);
    $("readings").replaceChildren(
      ...readings.map(({ name, colour, text }) => {
        const dot = made("span", { className: "dot" });
        dot.style.setProperty("--dot", colour);
        return made("span", { className: "reading" }, dot, `${name} `, made("b", { textContent: text }));
      }),
    );
    this.chart.draw(this.player.place);
  }

  /** Shows a place between frames everywhere. */
  show(place) {
    this.stage.show(place);
    const frame = Math.round(place);
    $("scrub").value = frame;
    this.fillTrack(place);
    const time = valueText(this.recording.timeOf(place), this.clockScale);
    $("clock").replaceChildren(made("b", { textContent: time }), made("span", { textContent: `frame ${frame}` }));
    document.body.dataset.frame = frame;
    document.body.dataset.playing = this.player.playing;
    $("play-shape").setAttribute("d", this.player.playing ? PAUSE : PLAY);
    $("play").setAttribute("aria-label", this.player.playing ? "Pause" : "Play");
    this.showReadings();
  }

  fillTrack(place) {
    const last = Math.max(1, this.recording.frames - 1);
    $("scrub").style.setProperty("--done", place / last);
    $("scrub").style.setProperty("--ready", (this.recording.ready - 1) / last);
  }

  showReady() {
    this.fillTrack(this.player.place);
  }

  addButtons() {
    $("play").onclick = () => this.player.toggle();
    $("back").onclick = () => this.player.step(-1);
    $("forward").onclick = () => this.player.step(1);
    $("scrub").oninput = () => {
      this.player.playing = false;
      this.player.goTo(Number($("scrub").value));
    };
    $("speed").onchange = () => (this.player.speed = Number($("speed").value));
    $("loop").onclick = () => this.toggleLoop();
    $("quantity").onchange = () => this.updateCurves();
    $("fold").onclick = () => this.toggleFold();
    $("frame-all").onclick = () => this.stage.frameAll();
    $("theme").onclick = () => this.setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
    $("open-help").onclick = () => this.toggleHelp();
    $("open-panel").onclick = () => this.togglePanel();
  }

  togglePanel() {
    const open = $("stage").classList.toggle("panel-open");
    $("open-panel").setAttribute("aria-expanded", open);
  }

  toggleLoop() {
    this.player.loop = !this.player.loop;
    $("loop").setAttribute("aria-pressed", this.player.loop);
  }

  toggleFold() {
    $("dock").classList.toggle("folded");
  }

  toggleHelp() {
    if ($("help").open) $("help").close();
    else $("help").showModal();
  }

  changeSpeed(by) {
    const at = SPEEDS.indexOf(this.player.speed) + by;
    this.player.speed = SPEEDS[Math.min(Math.max(0, at), SPEEDS.length - 1)];
    $("speed").value = this.player.speed;
  }

  nextColour() {
    const at = this.choices.findIndex(({ index }) => index === this.stage.painted);
    this.paint(this.choices[(at + 1) % this.choices.length].index);
  }

  addKeys() {
    const keys = {
      " ": () => this.player.toggle(),
      ArrowLeft: (event) => this.player.step(event.shiftKey ? -10 : -1),
      ArrowRight: (event) => this.player.step(event.shiftKey ? 10 : 1),
      Home: () => this.player.step(-Infinity),
      End: () => this.player.step(Infinity),
      ",": () => this.changeSpeed(-1),
      ".": () => this.changeSpeed(1),
      l: () => this.toggleLoop(),
      c: () => this.nextColour(),
      f: () => this.stage.frameAll(),
      p: () => this.toggleFold(),
      d: () => $("theme").click(),
      h: () => this.toggleHelp(),
    };
    window.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
      const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
      if (!act) return;
      event.preventDefault();
      if (document.activeElement instanceof HTMLButtonElement) document.activeElement.blur();
      act(event);
    });
  }

  followTheme() {
    const dark = matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", () => this.setTheme(dark.matches ? "dark" : "light"));
    this.setTheme(dark.matches ? "dark" : "light");
  }

  setTheme(name) {
    document.documentElement.dataset.theme = name;
    this.stage.setTheme(name);
    this.chart.refresh();
    this.chart.draw(this.player.place);
  }

  resize() {
    const { clientWidth, clientHeight } = $("stage");
    if (clientWidth === 0 || clientHeight === 0) return;
    const first = this.width === undefined;
    this.width = clientWidth;
    this.stage.resize(clientWidth, clientHeight, NARROW.matches ? 0 : $("panel").offsetWidth + 32);
    if (!first) this.stage.draw();
  }
}
