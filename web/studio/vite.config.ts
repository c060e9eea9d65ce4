// The studio's build: one page, its worker, and a service worker that keeps all of it for when there is no network.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { defineConfig, type Plugin } from "vite";

const at = (path: string) => fileURLToPath(new URL(path, import.meta.url));

/** Scripts come from this page alone, and nothing is sent anywhere. */
const policy =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; " +
  "img-src 'self' blob: data:; font-src 'self'; connect-src 'self' blob: data:; worker-src 'self' blob:; " +
  "media-src blob:; manifest-src 'self'; base-uri 'none'; form-action 'none'";

function contentPolicy(): Plugin {
  return {
    name: "content-policy",
    apply: "build",
    transformIndexHtml: () => [
      { tag: "meta", attrs: { "http-equiv": "Content-Security-Policy", content: policy }, injectTo: "head-prepend" },
    ],
  };
}

/** Emits sw.js with the list of the build's files; a change of any of them makes a new cache. */
function serviceWorker(): Plugin {
  return {
    name: "service-worker",
    apply: "build",
    generateBundle(_options, bundle) {
      const files = [
        "./",
        "manifest.webmanifest",
        "icon.svg",
        ...Object.keys(bundle).filter((name) => name !== "index.html"),
      ];
      const hash = createHash("sha256");
      for (const [name, item] of Object.entries(bundle)) {
        hash.update(name).update(item.type === "chunk" ? item.code : item.source);
      }
      const source = readFileSync(at("./src/sw.js"), "utf8")
        .replace("/* files */ []", JSON.stringify(files))
        .replace("VERSION", hash.digest("hex").slice(0, 12));
      this.emitFile({ type: "asset", fileName: "sw.js", source });
    },
  };
}

export default defineConfig({
  root: at("."),
  base: "./",
  plugins: [contentPolicy(), serviceWorker()],
  resolve: {
    alias: [
      { find: /^elastoon\/three$/, replacement: at("../package/dist/three.js") },
      { find: /^elastoon$/, replacement: at("../package/dist/index.js") },
      { find: /^stage$/, replacement: at("../stage/src/index.ts") },
    ],
    dedupe: ["three"],
  },
  worker: { format: "es" },
  build: { target: "es2022", assetsInlineLimit: 0, chunkSizeWarningLimit: 1200 },
  server: { fs: { allow: [at("../..")] } },
  test: { include: ["test/**/*.test.ts"], environment: "node" },
} as Parameters<typeof defineConfig>[0]);
