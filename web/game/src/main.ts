// The page's beginning: looks whether it can run here, loads the rules, and starts the course of frames.
import { capability } from "../../stage/src/quality.ts";
import { App } from "./app.ts";
import { Engine } from "./engine.ts";
import { element } from "./screens.ts";
import "./style.css";

function tellTrouble(why: string): void {
  element("why").textContent = why;
  element<HTMLDialogElement>("trouble").showModal();
}

async function begin(): Promise<void> {
  const can = capability();
  if (can.missing !== "") {
    tellTrouble(can.missing);
    return;
  }
  const engine = await Engine.load();
  const app = new App(engine, element<HTMLCanvasElement>("view"), can);
  // For tests and the curious: docs/game.md.
  Object.assign(window, { squashout: { app, engine } });
  const frame = (now: number) => {
    app.frame(now);
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
  if (import.meta.env.PROD && "serviceWorker" in navigator) {
    navigator.serviceWorker.register("./sw.js").catch(() => undefined); // offline only
  }
}

begin().catch((error: unknown) => tellTrouble(error instanceof Error ? error.message : String(error)));
