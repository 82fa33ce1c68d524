// Bundles a program for a page.
//
//     node bundle.mjs NODE_MODULES ENTRY.js OUT.js
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [modules, entry, output] = process.argv.slice(2).map((path) => resolve(path));
const esbuild = createRequire(join(modules, "x.js"))("esbuild");
await esbuild.build({ entryPoints: [entry], bundle: true, format: "iife", nodePaths: [modules], outfile: output, logLevel: "warning" });
