// The three-dimensional view: camera, light, ground, obstacles and bodies.
import {
  Box3,
  Color,
  DirectionalLight,
  DoubleSide,
  Group,
  HemisphereLight,
  Mesh,
  MeshStandardMaterial,
  NeutralToneMapping,
  PerspectiveCamera,
  Quaternion,
  Scene,
  Vector3,
  PCFShadowMap,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { BodyView, setPose } from "./body.js";
import { ContactArrows } from "./contacts.js";
import { Ground } from "./ground.js";
import { Surface } from "./surface.js";
import { roundStep } from "./units.js";

const Y = new Vector3(0, 1, 0);
const THEMES = {
  light: { sheet: "#ffffff", line: "#8d99b3", sheetOpacity: 0.55, lineOpacity: 0.5, shadow: "#3b4768", shadowOpacity: 0.3, sky: "#ffffff", earth: "#d9cfc6", ambient: 1.75, key: 2.3, obstacle: "#c5ccd9" },
  dark: { sheet: "#2b3142", line: "#7d8aa8", sheetOpacity: 0.5, lineOpacity: 0.4, shadow: "#000000", shadowOpacity: 0.5, sky: "#c9d4ee", earth: "#4a4350", ambient: 1.3, key: 2.2, obstacle: "#6c7488" },
};

export class Stage {
  constructor(canvas, recording) {
    this.canvas = canvas;
    this.recording = recording;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.scene = new Scene();
    this.world = new Group(); // turned so that up is y
    this.world.quaternion.setFromUnitVectors(new Vector3(...recording.description.up), Y);
    this.scene.add(this.world);
    this.measure();
    this.addCamera();
    this.addLights();
    this.addGrounds();
    this.bodies = recording.bodies.map((body, index) => new BodyView(body, index));
    for (const body of this.bodies) this.world.add(body.mesh);
    this.addObstacles();
    this.painted = -1;
    this.changed = true;
  }

  /** The box of everything over all frames, in the axes of the scene. */
  measure() {
    const { least, most } = this.recording.description;
    this.box = new Box3();
    this.corners = [];
    for (let i = 0; i < 8; i++) {
      const corner = new Vector3(...[0, 1, 2].map((axis) => ((i >> axis) & 1 ? most : least)[axis]));
      this.corners.push(corner.applyQuaternion(this.world.quaternion));
      this.box.expandByPoint(this.corners[i]);
    }
    this.centre = this.box.getCenter(new Vector3());
    this.radius = this.box.getSize(new Vector3()).length() / 2 || 1;
  }

  addCamera() {
    this.camera = new PerspectiveCamera(30, 1, 0.01 * this.radius, 100 * this.radius);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.minDistance = 0.05 * this.radius;
    this.controls.maxDistance = 30 * this.radius;
    this.controls.addEventListener("change", () => (this.changed = true));
  }

  addLights() {
    this.ambient = new HemisphereLight();
    this.key = new DirectionalLight("#fff7ec");
    const reach = 1.25 * this.radius;
    this.key.position.copy(this.centre).add(new Vector3(-0.55, 1.5, 0.75).multiplyScalar(2 * this.radius));
    this.key.target.position.copy(this.centre);
    this.key.castShadow = true;
    this.key.shadow.mapSize.set(1024, 1024);
    Object.assign(this.key.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.5 * this.radius, far: 6 * this.radius });
    this.key.shadow.radius = 4;
    this.key.shadow.bias = -0.0004;
    this.key.shadow.normalBias = 0.004 * this.radius;
    this.rim = new DirectionalLight("#dfe8ff", 0.55);
    this.rim.position.copy(this.centre).add(new Vector3(1, 0.35, -1).multiplyScalar(2 * this.radius));
    this.rim.target.position.copy(this.centre);
    this.scene.add(this.ambient, this.key, this.key.target, this.rim, this.rim.target);
  }

  /** The planes of the scene; without a floor among them, shadows fall just below everything. */
  addGrounds() {
    this.grounds = [];
    const cell = roundStep(this.radius, 6);
    const add = (point, normal, solid, name) => {
      const under = this.centre.clone().addScaledVector(normal, -normal.dot(this.centre.clone().sub(point)));
      const ground = new Ground(under, normal, (solid ? 1.6 : 5) * this.radius, cell, solid);
      ground.name = name;
      this.grounds.push(ground);
      this.scene.add(ground);
    };
    let floor = false;
    for (const plane of this.recording.obstacles.filter((o) => o.normal)) {
      const normal = new Vector3(...plane.normal).applyQuaternion(this.world.quaternion);
      const point = new Vector3(...plane.point).applyQuaternion(this.world.quaternion);
      const level = normal.dot(Y) > 0.98;
      floor ||= level;
      add(point, normal, !level, plane.name);
    }
    if (!floor) add(new Vector3(0, this.box.min.y - 0.012 * this.radius, 0), Y, false, "");
  }

  /** Like glass, because bodies may be inside. */
  addObstacles() {
    this.obstacles = [];
    for (const obstacle of this.recording.obstacles.filter((o) => !o.normal)) {
      const material = new MeshStandardMaterial({ roughness: 0.85, side: DoubleSide, transparent: true, opacity: 0.3, depthWrite: false });
      const mesh = new Mesh(new Surface(obstacle.points, obstacle.corners).geometry, material);
      mesh.name = obstacle.name;
      mesh.userData.poses = obstacle.poses;
      this.obstacles.push(mesh);
      this.world.add(mesh);
    }
  }

  addContacts(contacts) {
    this.arrows = new ContactArrows(contacts, 0.22 * this.radius);
    this.arrows.name = "contact forces";
    this.world.add(this.arrows);
    if (this.place !== undefined) this.show(this.place);
  }

  setTheme(name) {
    const theme = THEMES[name];
    this.theme = theme;
    for (const ground of this.grounds) ground.setTheme(theme);
    this.ambient.color.set(theme.sky);
    this.ambient.groundColor.set(theme.earth);
    this.setContrast();
    for (const mesh of this.obstacles) mesh.material.color = new Color(theme.obstacle);
    this.changed = true;
  }

  /** Less shading where colours stand for values. */
  setContrast() {
    this.ambient.intensity = this.theme.ambient * (this.painted < 0 ? 1 : 1.45);
    this.key.intensity = this.theme.key * (this.painted < 0 ? 1 : 0.65);
  }

  /** Shows a place between frames: 2.5 is in the middle of the frames 2 and 3. */
  show(place) {
    this.place = place;
    const frame = Math.min(Math.floor(place), this.recording.frames - 1);
    const part = frame < this.recording.frames - 1 ? place - frame : 0;
    for (const body of this.bodies) if (body.mesh.visible) this.showBody(body, frame, part);
    for (const mesh of this.obstacles) setPose(mesh, mesh.userData.poses, frame, Math.min(frame + 1, this.recording.frames - 1), part);
    this.arrows?.show(Math.round(place));
    this.changed = true;
  }

  showBody(body, frame, part) {
    body.show(frame, part);
    body.paint(this.recording, this.painted);
  }

  /** Colours by the field with this number; -1 are the bodies' own colours. */
  paint(fieldIndex) {
    this.painted = fieldIndex;
    this.setContrast();
    this.show(this.place);
  }

  setVisible(object, visible) {
    object.visible = visible;
    this.show(this.place);
  }

  resize(width, height, covered) {
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.covered = Math.min(covered, 0.5 * width);
    this.camera.setViewOffset(width, height, this.covered / 2, 0, width, height);
    this.changed = true;
  }

  /** Places the camera so that everything is in the free part of the view, and fills it. */
  frameAll() {
    const direction = new Vector3(0.62, 0.36, 1).normalize();
    const right = new Vector3().crossVectors(Y, direction).normalize();
    const above = new Vector3().crossVectors(direction, right);
    const tangent = Math.tan((this.camera.fov * Math.PI) / 360);
    const { width, height } = this.renderer.domElement;
    const ratio = this.renderer.getPixelRatio();
    const free = (width / ratio - this.covered) / (height / ratio);
    let distance = 0;
    for (const corner of this.corners) {
      const at = corner.clone().sub(this.centre);
      const needed = Math.max(Math.abs(at.dot(right)) / (tangent * free), Math.abs(at.dot(above)) / tangent);
      distance = Math.max(distance, 1.12 * needed + at.dot(direction));
    }
    this.controls.target.copy(this.centre);
    this.camera.position.copy(this.centre).addScaledVector(direction, distance);
    this.controls.update();
    this.changed = true;
  }

  /** Draws if anything has changed. */
  draw() {
    this.controls.update();
    if (!this.changed) return;
    this.changed = false;
    this.renderer.render(this.scene, this.camera);
  }
}
