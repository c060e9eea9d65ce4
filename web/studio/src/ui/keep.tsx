// Keep: files, pictures, films, code and links of the take. All of it is made on the visitor's machine.
import { Clapperboard, FileJson, Image, Link2, Package, Square } from "lucide-preact";
import { useRef, useState } from "preact/hooks";
import { bodiesOf } from "../core/edit.js";
import { limits } from "../core/limits.js";
import { linkTo, packTake } from "../core/link.js";
import { sceneText, takeText } from "../core/take.js";
import { cppSnippet, jsonSnippet, tsSnippet } from "../keep/snippet.js";
import { fileStem, save } from "../keep/save.js";
import type { Studio } from "../studio.js";
import { CopyButton, Section, Segmented } from "./parts.js";

const sizes: Readonly<Record<string, readonly [number, number]>> = {
  "720p": [1280, 720],
  "1080p": [1920, 1080],
  square: [1080, 1080],
  upright: [1080, 1920],
  small: [640, 360],
};

export function KeepPanel({ studio }: { studio: Studio }) {
  const [language, setLanguage] = useState<"ts" | "cpp" | "json">("ts");
  const [size, setSize] = useState("720p");
  const [rate, setRate] = useState("24");
  const [progress, setProgress] = useState<number | null>(null);
  const cancel = useRef<AbortController | null>(null);
  const take = studio.take.value;
  const stem = fileStem(take.scene.name);
  const body = bodiesOf(take)[studio.bodyIndex.value];
  const style = studio.shownStyle();
  const code =
    language === "ts"
      ? tsSnippet(style)
      : language === "cpp"
        ? cppSnippet(style)
        : jsonSnippet(body?.style ?? "my style", style);
  const [width, height] = sizes[size] ?? [1280, 720];
  const attempt = async (what: string, work: () => Promise<void>) => {
    try {
      await work();
      studio.tell(`${what}: saved`);
    } catch (error) {
      if ((error as Error).name !== "AbortError") studio.tell(`${what}: ${(error as Error).message}`, "error");
    }
  };
  const film = (as_pictures: boolean) =>
    attempt("Film", async () => {
      studio.setPlaying(false);
      cancel.current = new AbortController();
      setProgress(0);
      studio.director.pause();
      try {
        const { filmOf } = await import("../keep/film.js");
        const made = await filmOf(
          studio.director,
          {
            width,
            height,
            rate: Number(rate),
            from: 0,
            to: studio.duration.value,
            overlay: studio.overlay.value,
            onProgress: setProgress,
            signal: cancel.current.signal,
          },
          as_pictures,
        );
        save(made.data, `${stem}.${made.ending}`, made.type);
      } finally {
        studio.director.resume();
        setProgress(null);
      }
    });
  const packed = packTake(take).length;
  const inputs = take.inputs.length;
  const brought = studio.meshes.value.size > 0;
  return (
    <>
      <p class="note">Everything stays on your machine.</p>
      <Section title="The scene">
        <div class="row wrap">
          <button
            type="button"
            class="button"
            onClick={() => save(sceneText(take.scene), `${stem}.json`, "application/json")}
          >
            <FileJson size="1.1em" aria-hidden="true" /> Scene file
          </button>
          {inputs === 0 ? null : (
            <button
              type="button"
              class="button"
              onClick={() => save(takeText(take), `${stem}.take.json`, "application/json")}
            >
              <FileJson size="1.1em" aria-hidden="true" /> Take, with throws
            </button>
          )}
          <button
            type="button"
            class="button"
            onClick={() =>
              void attempt("Animation", async () => {
                const { glbOf } = await import("../keep/glb.js");
                save(await glbOf(studio.players.value[0]!, studio.meshes.value), `${stem}.glb`, "model/gltf-binary");
              })
            }
          >
            <Package size="1.1em" aria-hidden="true" /> Animated .glb
          </button>
        </div>
        <p class="hint">
          {inputs === 0
            ? "For this page, the command line and your program: docs/scene.md."
            : "The scene file holds the start; the take holds the throws too, and opens here."}
          {brought ? " Meshes that you brought are in them as their hulls; the .glb has the meshes themselves." : ""}
        </p>
      </Section>
      <Section title="A link">
        <div class="row wrap">
          <CopyButton label="Copy link" text={() => linkTo(take, location.href)} />
          <a
            class="button"
            href={packed > limits.link ? undefined : linkTo(take, location.href)}
            target="_blank"
            rel="noopener"
            data-link="take"
          >
            <Link2 size="1.1em" aria-hidden="true" /> Open it
          </a>
        </div>
        <p class="hint">
          {packed > limits.link
            ? "This scene is too large for a link: keep its file."
            : `The link itself holds the whole scene: ${packed} characters.`}
        </p>
      </Section>
      <Section title="Pictures and film">
        <div class="row wrap">
          <label class="field inline">
            Size
            <select value={size} onChange={(event) => setSize(event.currentTarget.value)}>
              {Object.entries(sizes).map(([name, [w, h]]) => (
                <option key={name} value={name}>
                  {name}, {w} × {h}
                </option>
              ))}
            </select>
          </label>
          <label class="field inline">
            Rate
            <select value={rate} onChange={(event) => setRate(event.currentTarget.value)}>
              {["12", "24", "30", "60"].map((each) => (
                <option key={each} value={each}>
                  {each}/s
                </option>
              ))}
            </select>
          </label>
        </div>
        {progress === null ? (
          <div class="row wrap">
            <button
              type="button"
              class="button"
              onClick={() =>
                void attempt("Strobe", async () => {
                  const { stillOf } = await import("../keep/film.js");
                  save(
                    await stillOf(studio.director, width, height, studio.time.value, "strobe"),
                    `${stem}-strobe.png`,
                    "image/png",
                  );
                })
              }
            >
              <Image size="1.1em" aria-hidden="true" /> Strobe PNG
            </button>
            <button type="button" class="button" onClick={() => void film(false)}>
              <Clapperboard size="1.1em" aria-hidden="true" /> Film
            </button>
            <button type="button" class="button" onClick={() => void film(true)}>
              <Clapperboard size="1.1em" aria-hidden="true" /> PNGs in a zip
            </button>
          </div>
        ) : (
          <div class="row">
            <progress max="1" value={progress} aria-label="Film" />
            <button type="button" class="button" onClick={() => cancel.current?.abort()}>
              <Square size="1em" aria-hidden="true" /> Stop
            </button>
          </div>
        )}
        <p class="hint">
          Frame by frame at exact times, however slow this machine is; with the ghosts that are switched on.
        </p>
      </Section>
      <Section
        title="Style as code"
        aside={
          <Segmented
            label="Language"
            value={language}
            onChange={setLanguage}
            options={[
              { value: "ts", text: "TypeScript" },
              { value: "cpp", text: "C++" },
              { value: "json", text: "JSON" },
            ]}
          />
        }
      >
        <pre class="code" tabIndex={0} aria-label="Style as code">
          <code>{code}</code>
        </pre>
        <CopyButton label="Copy code" text={() => code} />
      </Section>
    </>
  );
}
