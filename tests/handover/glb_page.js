// A page that reads a glTF file with three.js: `data` is the file in base 64.
import { AnimationMixer, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

const bytes = Uint8Array.from(atob(globalThis.data), (c) => c.charCodeAt(0));
new GLTFLoader().parse(
  bytes.buffer,
  "",
  ({ scene, animations, parser }) => {
    const mixer = new AnimationMixer(scene);
    for (const clip of animations) mixer.clipAction(clip).play();

    /** Positions and normals of a mesh in the world at a time, as a graphics card computes them. */
    function at(name, time) {
      // A time just before the end: the end itself is the beginning again.
      mixer.setTime(Math.min(time, ...animations.map((clip) => clip.duration * (1 - 1e-9))));
      scene.updateMatrixWorld(true);
      const mesh = scene.getObjectByName(name);
      const { position, normal } = mesh.geometry.attributes;
      const changes = mesh.geometry.morphAttributes.normal ?? [];
      const points = [];
      const normals = [];
      for (let i = 0; i < position.count; i++) {
        points.push(...mesh.localToWorld(mesh.getVertexPosition(i, new Vector3())));
        const n = new Vector3().fromBufferAttribute(normal, i);
        changes.forEach((change, k) => n.addScaledVector(new Vector3().fromBufferAttribute(change, i), mesh.morphTargetInfluences[k]));
        normals.push(...n.transformDirection(mesh.matrixWorld));
      }
      return { points, normals };
    }

    function describe(name) {
      const { geometry, material } = scene.getObjectByName(name);
      const { index, attributes, morphAttributes } = geometry;
      return {
        corners: Array.from(index.array),
        uvs: attributes.uv ? Array.from(attributes.uv.array) : null,
        targets: morphAttributes.position?.length ?? 0,
        colour: material.color.toArray(),
        roughness: material.roughness,
        metalness: material.metalness,
      };
    }

    const names = [];
    scene.traverse((object) => object.isMesh && names.push(object.name));
    globalThis.glb = { at, describe, names, duration: animations[0]?.duration, generator: parser.json.asset.generator };
    document.body.dataset.state = "ready";
  },
  (error) => {
    console.error(error);
    document.body.dataset.state = "failed";
  },
);
