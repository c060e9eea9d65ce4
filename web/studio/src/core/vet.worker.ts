// Plays a stranger's take where it can be stopped: tells of every stretch of steps that it has made.
import Elastoon from "elastoon";
import { Player } from "./player.js";
import { durationOf, kStepsPerSecond, readTake } from "./take.js";

/** s of the take that are looked at. */
const kLooked = 30;

onmessage = async (event: MessageEvent<{ text: string; what: string }>) => {
  try {
    await Elastoon.init();
    postMessage({ kind: "progress" });
    const take = readTake(event.data.text, event.data.what);
    const player = new Player(take);
    const steps = Math.ceil(Math.min(durationOf(take), kLooked) * kStepsPerSecond);
    for (let step = 0; step < steps;) {
      step = Math.min(step + 1, steps);
      player.ensure(step);
      postMessage({ kind: "progress" });
    }
    postMessage({ kind: "done" });
  } catch (error) {
    postMessage({ kind: "refused", message: error instanceof Error ? error.message : String(error) });
  }
};
