// Arrows of the contact forces of a frame.
import { BufferAttribute, BufferGeometry, ConeGeometry, CylinderGeometry, InstancedMesh, Matrix4, MeshStandardMaterial, Quaternion, Vector3 } from "three";

export const ARROW_COLOUR = "#2f6bff";
const UP = new Vector3(0, 1, 0);

/** From the origin to (0, 1, 0): a shaft and a head. */
function arrowGeometry() {
  const shaft = new CylinderGeometry(0.022, 0.022, 0.74, 8).translate(0, 0.37, 0);
  const head = new ConeGeometry(0.07, 0.28, 14).translate(0, 0.86, 0);
  const merged = new BufferGeometry();
  for (const name of ["position", "normal"]) {
    const parts = [shaft.attributes[name].array, head.attributes[name].array];
    merged.setAttribute(name, new BufferAttribute(Float32Array.from([...parts[0], ...parts[1]]), 3));
  }
  const shift = shaft.attributes.position.count;
  merged.setIndex([...shaft.index.array, ...Array.from(head.index.array, (i) => i + shift)]);
  return merged;
}

/** The value that one in twenty exceeds. */
function large(values) {
  const sorted = Float32Array.from(values).sort();
  return sorted[Math.floor(0.95 * (sorted.length - 1))] || 1;
}

export class ContactArrows extends InstancedMesh {
  /** `longest` [m]: length of an arrow of a large force. */
  constructor(contacts, longest) {
    const begins = Uint32Array.from(contacts.ends, (_, k) => (k === 0 ? 0 : contacts.ends[k - 1]));
    const most = contacts.ends.reduce((m, end, k) => Math.max(m, end - begins[k]), 1);
    super(arrowGeometry(), new MeshStandardMaterial({ color: ARROW_COLOUR, roughness: 0.5, transparent: true, depthTest: false, depthWrite: false }), most);
    this.contacts = contacts;
    this.begins = begins;
    this.longest = longest;
    this.frustumCulled = false;
    this.renderOrder = 1; // over everything: most arrows are inside bodies
    const sizes = Float32Array.from({ length: contacts.forces.length / 3 }, (_, i) => Math.hypot(...contacts.forces.subarray(3 * i, 3 * i + 3)));
    this.large = large(sizes.filter((size) => size > 0));
  }

  show(frame) {
    const force = new Vector3();
    const at = new Vector3();
    const size = new Vector3();
    const turn = new Quaternion();
    const matrix = new Matrix4();
    let shown = 0;
    for (let row = this.begins[frame]; row < this.contacts.ends[frame]; row++) {
      force.fromArray(this.contacts.forces, 3 * row);
      const length = this.longest * Math.min(1.6, force.length() / this.large);
      if (length < 0.01 * this.longest) continue;
      const width = Math.min(length, 0.7 * this.longest);
      at.fromArray(this.contacts.points, 3 * row);
      matrix.compose(at, turn.setFromUnitVectors(UP, force.normalize()), size.set(width, length, width));
      this.setMatrixAt(shown++, matrix);
    }
    this.count = shown;
    this.instanceMatrix.needsUpdate = true;
  }
}
