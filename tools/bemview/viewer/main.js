// The page of bemview: reads the data, then connects view, time, plot and controls.
import { Chart } from "./chart.js";
import { Controls } from "./controls.js";
import { Player } from "./player.js";
import { Recording } from "./recording.js";
import { Stage } from "./stage.js";

const $ = (id) => document.getElementById(id);

/** Lets the browser draw and take input before the next piece of work. */
const breath = () => new Promise((resolve) => setTimeout(resolve));

async function start() {
  const recording = new Recording(document);
  document.title = recording.description.title;
  await recording.readScene();
  await recording.readFrames();
  performance.mark("first frame decoded");
  const stage = new Stage($("view"), recording);
  const player = new Player(recording, (place) => controls.show(place));
  const chart = new Chart($("chart"), recording, (time) => player.goToTime(time));
  const controls = new Controls(recording, stage, player, chart);
  player.goTo(0);
  stage.frameAll();
  stage.draw();
  document.body.dataset.state = "shown";
  performance.mark("first frame");
  window.bemview = { recording, stage, player }; // for the browser's console
  animate(stage, player);
  await readRest(recording, stage, controls);
  document.body.dataset.state = "ready";
  performance.mark("all frames");
}

async function readRest(recording, stage, controls) {
  await recording.readSeries();
  controls.addQuantities();
  await recording.readContacts();
  if (recording.contacts?.forces.length) {
    stage.addContacts(recording.contacts);
    controls.addContacts();
  }
  while (await recording.readFrames()) {
    controls.showReady();
    await breath();
  }
  controls.showReady();
}

function animate(stage, player) {
  let before = performance.now();
  const tick = (now) => {
    player.advance(Math.min(0.1, (now - before) / 1000));
    before = now;
    stage.draw();
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}

function fail(error) {
  console.error(error);
  document.body.dataset.state = "failed";
  const old = typeof DecompressionStream === "undefined" ? " This browser is too old: Chrome 103, Firefox 113 or Safari 16.4 can show it." : "";
  $("loading").textContent = `The page cannot be shown: ${error.message}.${old}`;
}

start().catch(fail);
