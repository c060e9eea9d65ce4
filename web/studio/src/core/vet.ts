// Takes from files and links are played in a worker first: one that would hang the page is refused instead.
import { InputError } from "./limits.js";

/** ms without a sign of life, once the worker has begun, and before that: it has to be loaded. */
const kPatience = 3000;
const kStartPatience = 20_000;
/** ms between two looks. */
const kTick = 250;
/** ms after which a take that goes on steadily is taken as it is. */
const kEnough = 5000;

/** Resolves where the text is a take that can be played; rejects with what is wrong with it. */
export function vet(text: string, what: string): Promise<void> {
  if (typeof Worker === "undefined") return Promise.resolve();
  return new Promise((resolve, reject) => {
    const worker = new Worker(new URL("./vet.worker.ts", import.meta.url), { type: "module", name: "vet" });
    const began = performance.now();
    // Silence is counted by looks: a page that stood still itself has not heard what was said meanwhile.
    let silent = 0;
    let patience = kStartPatience;
    const end = (settle: () => void) => {
      clearInterval(watch);
      worker.terminate();
      settle();
    };
    const advice = "use fewer or slower bodies, or softer styles";
    const watch = setInterval(() => {
      silent += kTick;
      if (silent <= patience) return;
      end(() => reject(new InputError(`${what}: working out how it moves takes too long; ${advice}`)));
    }, kTick);
    worker.onmessage = (event: MessageEvent<{ kind: string; message?: string }>) => {
      silent = 0;
      patience = kPatience;
      if (event.data.kind === "refused") end(() => reject(new InputError(event.data.message ?? "refused")));
      else if (event.data.kind === "done" || performance.now() - began > kEnough) end(resolve);
    };
    worker.onerror = (event) => end(() => reject(new InputError(event.message || `${what} could not be looked at`)));
    worker.postMessage({ text, what });
  });
}
