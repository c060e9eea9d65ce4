// The page begins here: what the browser can do, the WebAssembly module, then the studio.
import "./style.css";
import Elastoon from "elastoon";
import { render } from "preact";
import { capability } from "stage";
import { App } from "./ui/app.js";
import { Failure } from "./ui/failure.js";
import { Studio } from "./studio.js";

const root = document.getElementById("app")!;

async function begin(): Promise<void> {
  const can = capability();
  if (can.missing !== "") {
    render(<Failure title="This browser cannot draw the studio" text={can.missing} />, root);
    return;
  }
  await Elastoon.init();
  const studio = new Studio();
  document.documentElement.dataset["theme"] = studio.theme.value;
  // For the browser's console, and for tests.
  Object.assign(globalThis, { studio });
  root.replaceChildren();
  render(<App studio={studio} capability={can} />, root);
}

begin().catch((error: unknown) => {
  root.replaceChildren();
  render(
    <Failure title="The studio could not begin" text={error instanceof Error ? error.message : String(error)} />,
    root,
  );
});

if (import.meta.env.PROD && "serviceWorker" in navigator) {
  addEventListener("load", () => void navigator.serviceWorker.register("sw.js").catch(() => undefined));
}
