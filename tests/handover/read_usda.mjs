// Reads a USD file with TinyUSDZ and prints as JSON what it has read.
//
//     node read_usda.mjs NODE_MODULES FILE.usda
//
// `text` is the whole layer as TinyUSDZ writes it again, with the samples of all times; `meshes` is what it makes of the scene at
// the first time.
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [modules, file] = process.argv.slice(2).map((path) => resolve(path));
const folder = join(modules, "tinyusdz");
// The package is built for browsers.
process.type = "renderer";
globalThis.window = globalThis;
const { default: start } = await import(pathToFileURL(join(folder, "tinyusdz.js")));
const program = readFileSync(join(folder, "tinyusdz.wasm"));
const usd = await start({
  print: () => {},
  instantiateWasm(imports, done) {
    WebAssembly.instantiate(program, imports).then(({ instance, module }) => done(instance, module));
    return {};
  },
});

function load(method) {
  const loader = new usd.TinyUSDZLoaderNative();
  if (!loader[method](new Uint8Array(readFileSync(file)), file)) throw new Error(`${file}: ${loader.error()}`);
  return loader;
}

const text = load("loadAsLayerFromBinary").layerToString();
const scene = load("loadFromBinary");
const meshes = {};
for (let i = 0; i < scene.numMeshes(); i++) {
  const mesh = scene.getMesh(i);
  const numbers = (name) => (mesh[name] ? Array.from(mesh[name]) : null);
  meshes[mesh.absPath] = Object.fromEntries(
    ["points", "faceVertexCounts", "faceVertexIndices", "texcoords"].map((name) => [name, numbers(name)]),
  );
}
process.stdout.write(JSON.stringify({ text, meshes }));
