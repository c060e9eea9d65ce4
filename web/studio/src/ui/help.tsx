// The help sheet: how to throw, and what keys and fingers do.
import { X } from "lucide-preact";
import { useEffect, useRef } from "preact/hooks";
import type { Studio } from "../studio.js";
import { bindings } from "./keys.js";
import { IconButton } from "./parts.js";

const gestures: readonly (readonly [string, string])[] = [
  ["Pull a body back, let go", "Throw it; the dots tell where it will fly"],
  ["Escape while pulling", "Leave it where it is"],
  ["Drag beside the bodies", "Turn the camera"],
  ["Wheel, or two fingers", "Nearer and further; shift the picture"],
  ["Drop a file on the page", "Open a scene, a take or a mesh"],
];

export function Help({ studio }: { studio: Studio }) {
  const dialog = useRef<HTMLDialogElement>(null);
  const open = studio.help.value;
  useEffect(() => {
    if (open) dialog.current?.showModal();
    else dialog.current?.close();
  }, [open]);
  return (
    <dialog
      ref={dialog}
      class="sheet"
      aria-labelledby="help-title"
      onClose={() => (studio.help.value = false)}
      onClick={(event) => {
        if (event.target === dialog.current) studio.help.value = false;
      }}
    >
      <header>
        <h2 id="help-title">How it goes</h2>
        <IconButton icon={X} label="Close" onClick={() => (studio.help.value = false)} />
      </header>
      <div class="sheet-columns">
        <section>
          <h3>Mouse and fingers</h3>
          <dl>
            {gestures.map(([what, does]) => (
              <div key={what}>
                <dt>{what}</dt>
                <dd>{does}</dd>
              </div>
            ))}
          </dl>
        </section>
        <section>
          <h3>Keys</h3>
          <dl>
            {bindings.map(({ shown, text }) => (
              <div key={shown}>
                <dt>
                  <kbd>{shown}</kbd>
                </dt>
                <dd>{text}</dd>
              </div>
            ))}
          </dl>
        </section>
      </div>
      <p class="note">
        The simulation is the C++ library itself, as WebAssembly: the same scene gives the same bits here, on the
        command line and in your program. The model is that of Chenney, Pingel, Iverson and Szymanski, “Simulating
        Cartoon Style Animation”, 2002.
      </p>
    </dialog>
  );
}
