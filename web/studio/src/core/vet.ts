// Takes from files and links are played in a worker first: one that would hang the page is refused instead.
import { InputError } from "./limits.js";

/** ms without a sign of life. */
const kPatience = 3000;
/** ms after which a take that goes on steadily is taken as it is. */
const kEnough = 5000;

/** Resolves where the text is a take that can be played; rejects with what is wrong with it. */
export function vet(text: string, what: string): Promise<void> {
  if (typeof Worker === "undefined") return Promise.resolve();
  return new Promise((resolve, reject) => {
    const worker = new Worker(new URL("./vet.worker.ts", import.meta.url), { type: "module", name: "vet" });
    const began = performance.now();
    let heard = began;
    const end = (settle: () => void) => {
      clearInterval(watch);
      worker.terminate();
      settle();
    };
    const watch = setInterval(() => {
      if (performance.now() - heard > kPatience) {
        end(() =>
          reject(
            new InputError(
              `${what}: working out how it moves takes too long; use fewer or slower bodies, or ` + "softer styles",
            ),
          ),
        );
      }
    }, 250);
    worker.onmessage = (event: MessageEvent<{ kind: string; message?: string }>) => {
      heard = performance.now();
      if (event.data.kind === "refused") end(() => reject(new InputError(event.data.message ?? "refused")));
      else if (event.data.kind === "done" || heard - began > kEnough) end(resolve);
    };
    worker.onerror = (event) => end(() => reject(new InputError(event.message || `${what} could not be looked at`)));
    worker.postMessage({ text, what });
  });
}
