// Bundles the page of bemview and writes it as a C++ source.
//
//     node bundle.mjs NODE_MODULES OUT.cpp
//
// The page is one text: page.html with the styles and the bundled program in place of their marks.
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const [modules, output] = process.argv.slice(2).map((path) => resolve(path));
const esbuild = createRequire(join(modules, "x.js"))("esbuild");

async function bundled(entry, loader) {
  const result = await esbuild.build({
    entryPoints: [join(here, entry)],
    bundle: true,
    minify: true,
    write: false,
    format: loader === "js" ? "iife" : undefined,
    target: ["chrome103", "firefox113", "safari16.4"],
    nodePaths: [modules],
    legalComments: "inline",
    charset: "ascii",
    logLevel: "warning",
  });
  return result.outputFiles[0].text;
}

/** Raw string literals: compilers take long ones, but not with the closing mark inside. */
function literal(text) {
  const mark = "BEMVIEW";
  if (text.includes(`)${mark}"`)) throw new Error("the page holds the mark of its literal");
  return `R"${mark}(${text})${mark}"`;
}

const style = await bundled("style.css", "css");
const program = await bundled("main.js", "js");
if (/<\/script/i.test(program)) throw new Error("the program would end its own script element");
const page = readFileSync(join(here, "page.html"), "utf8")
  .replace("/* style */", () => style.trim())
  .replace("/* program */", () => program.trim());
writeFileSync(
  output,
  `#include "viewer_shell.hpp"

// Written by bundle.mjs; three.js in it is under the MIT licence.
namespace bem {

const std::string& viewer_shell() {
  static const std::string text = ${literal(page)};
  return text;
}

}  // namespace bem
`,
);
