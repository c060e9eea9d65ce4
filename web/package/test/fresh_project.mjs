// A fresh Vite project takes in the packed package: its types, its development server, its build, and the README's page.
// Usage: node test/fresh_project.mjs TARBALL FOLDER [CHROMIUM]
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [tarball, folder, browser_path = "/usr/bin/chromium"] = process.argv.slice(2);
const run = (program, ...args) => execFileSync(program, args, { cwd: folder, stdio: "pipe", encoding: "utf8" });
const write = (name, text) => writeFileSync(join(folder, name), text);
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
write("package.json", JSON.stringify({ name: "fresh", private: true, type: "module" }));
run("npm", "install", "--no-audit", "--no-fund", tarball, "three@0.187.0");
run("npm", "install", "--no-audit", "--no-fund", "--save-dev", "vite@8", "typescript@7", "@types/three@0.187.0");

// The README's page; a program with its types checked, in the page's thread and in a worker.
const page_text = readFileSync(new URL("../README.md", import.meta.url), "utf8").match(/```html\n([\s\S]*?)```/)[1];
if (page_text.trim().split("\n").length > 25) throw new Error("the README's page should have twenty lines");
write("index.html", page_text.replace("binding.update();", "binding.update(); globalThis.frames_drawn = (globalThis.frames_drawn ?? 0) + 1;"));
write("program.html", '<!doctype html><script type="module" src="/main.ts"></script>');
write("motion.ts", `import Elastoon, { BodyDesc, ObstacleDesc, type ElastoonEvent, World } from "elastoon";
export async function motion(): Promise<string> {
  await Elastoon.init();
  const world = new World();
  world.createObstacle(ObstacleDesc.plane());
  world.createBody(BodyDesc.cylinder(0.3, 1).setTranslation(0, 3, 0).setLinvel(1, 0, 0).setStyle({ restitution: 0.7 }));
  for (let i = 0; i < 100; ++i) world.step();
  const events: readonly ElastoonEvent[] = world.events();
  return world.stateHash() + events.length;
}
`);
write("worker.ts", 'import { motion } from "./motion";\nmotion().then((found) => postMessage(found), (error) => postMessage(String(error)));\n');
write("main.ts", `import { motion } from "./motion";
const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
worker.onmessage = async (event) => Object.assign(globalThis, { found: [await motion(), event.data] });
`);
write("vite.config.js", `import { defineConfig } from "vite";
export default defineConfig({ worker: { format: "es" }, build: { target: "esnext", rollupOptions: { input: ["index.html", "program.html"] } } });
`);
run("npx", "tsc", "--noEmit", "--strict", "--target", "es2022", "--module", "esnext", "--moduleResolution", "bundler",
  "--lib", "es2022,dom", "motion.ts", "main.ts", "worker.ts");
run("npx", "vite", "build");
write("node.mjs", 'import Elastoon, { World } from "elastoon"; await Elastoon.init(); new World().step();');
run("node", "node.mjs");

const { createServer, preview } = await import(pathToFileURL(join(folder, "node_modules/vite/dist/node/index.js")));
const options = { root: folder, logLevel: "error", server: { port: 0 }, preview: { port: 0 } };
const browser = await chromium.launch({ executablePath: browser_path,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
const hashes = new Set();
try {
  for (const [kind, start] of [["development", async () => (await createServer(options)).listen()], ["build", () => preview(options)]]) {
    const server = await start();
    const address = server.resolvedUrls.local[0];
    const page = await browser.newPage({ viewport: { width: 320, height: 200 } });
    const errors = [];
    page.on("pageerror", (error) => errors.push(error.message));
    await page.goto(`${address}program.html`);
    const found = await (await page.waitForFunction(() => globalThis.found, null, { timeout: 120000 })).jsonValue();
    found.forEach((hash) => hashes.add(hash));
    await page.goto(address);
    await page.waitForFunction(() => globalThis.frames_drawn > 20, null, { timeout: 120000 });
    const orange = await page.evaluate(() => {
      const gl = document.querySelector("canvas").getContext("webgl2");
      const pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
      gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      let count = 0;
      for (let i = 0; i < pixels.length; i += 4) count += pixels[i] > 60 && pixels[i] > 1.5 * pixels[i + 2] ? 1 : 0;
      return count;
    });
    if (errors.length > 0) throw new Error(`${kind}: ${errors.join("; ")}`);
    if (orange < 500) throw new Error(`${kind}: the README's page shows no balls: ${orange} pixels`);
    await page.close();
    await server.close();
    console.log(`Vite, ${kind}: page, worker and the README's page (${orange} pixels of balls)`);
  }
  if (hashes.size !== 1) throw new Error(`page, worker, development and build should agree: ${[...hashes].join(" ")}`);
} finally {
  await browser.close();
}
process.exit(0);
