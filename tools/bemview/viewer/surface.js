// A triangle surface that may be deformed: normals are computed here, with creases at sharp edges.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage } from "three";

const CREASE = Math.cos((50 * Math.PI) / 180);

function faceNormals(points, corners) {
  const out = new Float32Array(corners.length);
  for (let c = 0; c < corners.length; c += 3) {
    const i = 3 * corners[c];
    const j = 3 * corners[c + 1];
    const k = 3 * corners[c + 2];
    const ux = points[j] - points[i];
    const uy = points[j + 1] - points[i + 1];
    const uz = points[j + 2] - points[i + 2];
    const vx = points[k] - points[i];
    const vy = points[k + 1] - points[i + 1];
    const vz = points[k + 2] - points[i + 2];
    out[c] = uy * vz - uz * vy;
    out[c + 1] = uz * vx - ux * vz;
    out[c + 2] = ux * vy - uy * vx;
  }
  return out;
}

/** For every corner of every triangle the first of those that share its vertex across smooth edges. */
function smoothGroups(points, corners) {
  const normals = faceNormals(points, corners);
  const parent = Uint32Array.from(corners, (_, c) => c);
  const root = (c) => {
    while (parent[c] !== c) c = parent[c] = parent[parent[c]];
    return c;
  };
  const join = (a, b) => {
    const [low, high] = [root(a), root(b)].sort((x, y) => x - y);
    parent[high] = low;
  };
  const smooth = (f, g) => {
    const dot = normals[f] * normals[g] + normals[f + 1] * normals[g + 1] + normals[f + 2] * normals[g + 2];
    const sizes = Math.hypot(normals[f], normals[f + 1], normals[f + 2]) * Math.hypot(normals[g], normals[g + 1], normals[g + 2]);
    return dot >= CREASE * sizes;
  };
  const edges = new Map(); // of two vertices: the corner where a triangle's edge begins
  const vertices = points.length / 3;
  for (let c = 0; c < corners.length; c++) {
    const face = c - (c % 3);
    const next = face + ((c + 1) % 3);
    const other = edges.get(corners[next] * vertices + corners[c]);
    if (other === undefined) {
      edges.set(corners[c] * vertices + corners[next], c);
    } else {
      const otherFace = other - (other % 3);
      if (smooth(face, otherFace)) {
        join(c, otherFace + ((other + 1) % 3));
        join(next, other);
      }
    }
  }
  return parent.map((_, c) => root(c));
}

export class Surface {
  /** `points` [N x 3]: the shape by which creases are found. */
  constructor(points, corners) {
    const groups = smoothGroups(points, corners);
    const number = new Map();
    this.index = groups.map((group) => {
      if (!number.has(group)) number.set(group, number.size);
      return number.get(group);
    });
    this.vertexOf = new Uint32Array(number.size); // of every drawn vertex: the one of the mesh
    this.index.forEach((drawn, c) => (this.vertexOf[drawn] = corners[c]));
    this.geometry = new BufferGeometry();
    for (const name of ["position", "normal", "color"]) {
      const attribute = new BufferAttribute(new Float32Array(3 * number.size), 3);
      attribute.setUsage(DynamicDrawUsage);
      this.geometry.setAttribute(name, attribute);
    }
    this.geometry.setIndex(new BufferAttribute(this.index, 1));
    this.move(points);
  }

  /** Takes the positions of the mesh's vertices. */
  move(points) {
    const { position, normal } = this.geometry.attributes;
    const drawn = position.array;
    for (let i = 0; i < this.vertexOf.length; i++) {
      const v = 3 * this.vertexOf[i];
      drawn[3 * i] = points[v];
      drawn[3 * i + 1] = points[v + 1];
      drawn[3 * i + 2] = points[v + 2];
    }
    this.sumNormals(drawn, normal.array.fill(0));
    position.needsUpdate = true;
    normal.needsUpdate = true;
  }

  /** Normals are weighted by areas; the graphics card makes them as long as one. */
  sumNormals(drawn, sums) {
    const index = this.index;
    const faces = faceNormals(drawn, index);
    for (let c = 0; c < index.length; c++) {
      const at = 3 * index[c];
      const face = c - (c % 3);
      sums[at] += faces[face];
      sums[at + 1] += faces[face + 1];
      sums[at + 2] += faces[face + 2];
    }
    for (let i = 0; i < sums.length; i += 3) {
      const length = Math.hypot(sums[i], sums[i + 1], sums[i + 2]) || 1;
      sums[i] /= length;
      sums[i + 1] /= length;
      sums[i + 2] /= length;
    }
  }

  /** Calls `write(vertex, colours, at)` for all drawn vertices. */
  colour(write) {
    const { color } = this.geometry.attributes;
    this.vertexOf.forEach((vertex, i) => write(vertex, color.array, 3 * i));
    color.needsUpdate = true;
  }
}
