// Recorded plays in Node: the WebAssembly module must come to the hashes that native programs came to.
// Usage: node test/golden_node.mjs
import { readFileSync } from "node:fs";

const root = new URL("../../../", import.meta.url);
const read = (path) => readFileSync(new URL(path, root));
const module = new WebAssembly.Module(read("build/wasm/squashout.wasm"));
const imported = WebAssembly.Module.imports(module).map(({ name }) => name).sort().join(" ");
if (imported !== "fd_close fd_seek fd_write") throw new Error(`squashout.wasm imports ${imported}`);
const nothing = new Proxy({}, { get: () => () => 0 });
const { exports: wasm } = new WebAssembly.Instance(module, { wasi_snapshot_preview1: nothing });
wasm._initialize?.();

const text = (at) => {
  const bytes = new Uint8Array(wasm.memory.buffer);
  return Buffer.from(bytes.subarray(at, bytes.indexOf(0, at))).toString();
};
function give(bytes, use) {
  const at = wasm.malloc(bytes.length + 1);
  new Uint8Array(wasm.memory.buffer, at, bytes.length).set(bytes);
  const result = use(at, bytes.length);
  wasm.free(at);
  return result;
}
const load = (bytes) => give(bytes, (at, length) => wasm.squashoutLoadLevels(at, length));

if (load(Buffer.from("{}")) === 0) throw new Error("levels without levels were taken");
const wrong = load(read("apps/game/levels.json"));
if (wrong !== 0) throw new Error(text(wrong));
for (const name of ["flat", "gravity"]) {
  const play = read(`tests/golden/game-${name}.json`);
  const began = performance.now();
  const game = give(play, (at, length) => wasm.squashoutReplay(at, length));
  if (game === 0) throw new Error(`game-${name}: ${text(wasm.squashoutError())}`);
  const hash = text(wasm.squashoutHash(game));
  if (hash !== JSON.parse(play).hash) throw new Error(`game-${name}: ${hash}`);
  const steps = JSON.parse(play).inputs.reduce((sum, [count]) => sum + count, 0);
  const each = ((1000 * (performance.now() - began)) / steps).toFixed(0);
  console.log(`Node, game-${name}: hash=${hash}, ${each} us a step`);
  wasm.squashoutDestroy(game);
}
const changed = Buffer.from(read("tests/golden/game-flat.json").toString().replace(/"hash":"./, '"hash":"0'));
if (give(changed, (at, length) => wasm.squashoutReplay(at, length)) !== 0) throw new Error("another hash was taken");
