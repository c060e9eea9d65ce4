// Golden hashes in Chromium, in a page and in a worker, from the files of the package as they are.
// Usage: node test/golden_browser.mjs [CHROMIUM]
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname } from "node:path";
import { chromium } from "playwright-core";

const root = new URL("../../../", import.meta.url);
const types = { ".js": "text/javascript", ".mjs": "text/javascript", ".json": "application/json", ".wasm": "application/wasm" };
const run = `
  import * as elastoon from "/web/package/dist/index.js";
  import { runGoldens } from "/web/package/test/golden.mjs";
  const text = async (path) => (await fetch(path)).text();
  const result = runGoldens(elastoon, await text("/tests/golden/hashes.txt"), (name) => text("/scenes/" + name));`;
const made = {
  "/": ["text/html", `<!doctype html><script type="module">${run}
    window.page = await result;
    const worker = new Worker("/worker.mjs", { type: "module" });
    worker.onmessage = (event) => { window.worker = event.data; };
    worker.onerror = (event) => { window.worker = { met: 0, differing: [event.message] }; };
  </script>`],
  "/worker.mjs": ["text/javascript", `${run} result.then((done) => postMessage(done));`],
};
const server = createServer((request, response) => {
  try {
    const path = new URL(request.url, "http://x").pathname;
    const [type, body] = made[path] ?? [types[extname(path)] ?? "text/plain", readFileSync(new URL(`.${path}`, root))];
    response.writeHead(200, { "content-type": type }).end(body);
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
const browser = await chromium.launch({ executablePath: process.argv[2] ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
let failed = false;
try {
  const page = await browser.newPage();
  page.on("pageerror", (error) => console.error(error.message));
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  for (const where of ["page", "worker"]) {
    const handle = await page.waitForFunction((name) => window[name], where, { timeout: 300000 });
    const { met, differing } = await handle.jsonValue();
    differing.forEach((line) => console.error(line));
    failed ||= differing.length > 0 || met === 0;
    console.log(`Chromium ${browser.version()}, ${where}: ${met} golden hashes are met`);
  }
} finally {
  await browser.close();
  server.close();
}
process.exit(failed ? 1 : 0);
