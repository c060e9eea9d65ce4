// The page: top bar, picture, time, panels, messages.
import {
  Activity,
  CircleHelp,
  Download,
  Gauge,
  Hand,
  LayoutGrid,
  Moon,
  MousePointer2,
  Redo2,
  Shapes,
  SlidersHorizontal,
  Sun,
  Undo2,
  Volume2,
  VolumeX,
  X,
} from "lucide-preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { type Capability, patternNames } from "stage";
import { openFiles } from "../keep/open.js";
import { useHands } from "../view/hands.js";
import type { Panel, Studio } from "../studio.js";
import { Help } from "./help.js";
import { KeepPanel } from "./keep.js";
import { listen } from "./keys.js";
import { MotionPanel } from "./motion.js";
import { type Icon, IconButton } from "./parts.js";
import { ScenesPanel } from "./scenes.js";
import { ThingsPanel } from "./things.js";
import { Transport } from "./transport.js";
import { TunePanel } from "./tune.js";

const panels: readonly { id: Panel; text: string; icon: Icon }[] = [
  { id: "scenes", text: "Scenes", icon: LayoutGrid },
  { id: "tune", text: "Tune", icon: SlidersHorizontal },
  { id: "motion", text: "Motion", icon: Activity },
  { id: "things", text: "Things", icon: Shapes },
  { id: "keep", text: "Keep", icon: Download },
];

function TopBar({ studio }: { studio: Studio }) {
  const dark = studio.theme.value === "dark";
  const edit = studio.tool.value === "edit";
  return (
    <header class="top">
      <h1>
        <svg viewBox="0 0 64 64" aria-hidden="true">
          <path d="M8 53h48" />
          <ellipse cx="32" cy="42.500" rx="19" ry="9" />
          <ellipse class="ghost" cx="32" cy="20" rx="9" ry="14" />
        </svg>
        <span>
          Elastoon <em>studio</em>
        </span>
      </h1>
      <p class="scene-name" title={studio.take.value.scene.name ?? ""}>
        {studio.take.value.scene.name ?? "Untitled scene"}
      </p>
      <div class="segmented tools" role="group" aria-label="Tool">
        <button type="button" aria-pressed={!edit} title="Throw (T)" onClick={() => studio.setTool("throw")}>
          <Hand size="1.1em" aria-hidden="true" />
          <span>Throw</span>
        </button>
        <button type="button" aria-pressed={edit} title="Edit (E)" onClick={() => studio.setTool("edit")}>
          <MousePointer2 size="1.1em" aria-hidden="true" />
          <span>Edit</span>
        </button>
      </div>
      <div class="top-buttons">
        <IconButton
          icon={Undo2}
          label="Undo"
          shortcut="Ctrl Z"
          disabled={!studio.canUndo.value}
          onClick={() => studio.undo()}
        />
        <IconButton
          icon={Redo2}
          label="Redo"
          shortcut="Ctrl Shift Z"
          disabled={!studio.canRedo.value}
          onClick={() => studio.redo()}
        />
        <span class="gap wide-only" />
        <label class="field inline wide-only">
          <select
            value={studio.pattern.value}
            aria-label="Pattern on bodies"
            onChange={(event) => studio.setPattern(event.currentTarget.value as typeof studio.pattern.value)}
          >
            {patternNames.map((name) => (
              <option key={name} value={name}>
                {name}
              </option>
            ))}
          </select>
        </label>
        <IconButton
          icon={Gauge}
          label="Figures"
          shortcut="F"
          pressed={studio.showFigures.value}
          class="wide-only"
          onClick={() => (studio.showFigures.value = !studio.showFigures.value)}
        />
        <IconButton
          icon={studio.sound.value ? Volume2 : VolumeX}
          label="Sound"
          pressed={studio.sound.value}
          onClick={() => void studio.setSound(!studio.sound.value)}
        />
        <IconButton
          icon={dark ? Sun : Moon}
          label={dark ? "Light theme" : "Dark theme"}
          onClick={() => studio.setTheme(dark ? "light" : "dark")}
        />
        <IconButton icon={CircleHelp} label="Help" shortcut="?" onClick={() => (studio.help.value = true)} />
      </div>
    </header>
  );
}

function Figures({ studio }: { studio: Studio }) {
  const figures = studio.figures.value;
  if (!studio.showFigures.value) return null;
  return (
    <dl class="figures" aria-label="Figures">
      <div>
        <dt>frames</dt>
        <dd>{figures === null ? "–" : `${figures.fps.toFixed(0)}/s`}</dd>
      </div>
      <div>
        <dt>simulation</dt>
        <dd>{figures === null ? "–" : `${figures.simulation.toFixed(2)} ms`}</dd>
      </div>
      <div>
        <dt>frame</dt>
        <dd>{figures === null ? "–" : `${figures.frame.toFixed(1)} ms`}</dd>
      </div>
      <div>
        <dt>bodies</dt>
        <dd>{figures?.bodies ?? studio.players.value[0]?.bodies.length ?? 0}</dd>
      </div>
      <div>
        <dt>draw calls</dt>
        <dd>{figures?.calls ?? "–"}</dd>
      </div>
      <div>
        <dt>quality</dt>
        <dd>{figures === null ? "–" : `${6 - figures.quality} of 6`}</dd>
      </div>
      <div class="hash">
        <dt>state</dt>
        <dd>
          {studio.hash.value === "" ? (
            <button type="button" class="link" disabled={studio.playing.value} onClick={() => studio.stateHash()}>
              hash
            </button>
          ) : (
            <code>{studio.hash.value}</code>
          )}
        </dd>
      </div>
    </dl>
  );
}

function PanelArea({ studio }: { studio: Studio }) {
  const open = studio.panel.value;
  const title = panels.find(({ id }) => id === open)?.text ?? "";
  return (
    <aside class={open === null ? "side closed" : "side"} aria-label="Panels">
      <nav class="rail" aria-label="Panels">
        {panels.map(({ id, text, icon: Picture }) => (
          <button
            key={id}
            type="button"
            aria-pressed={open === id}
            aria-controls="panel"
            onClick={() => (studio.panel.value = open === id ? null : id)}
          >
            <Picture size="1.3em" aria-hidden="true" />
            <span>{text}</span>
          </button>
        ))}
      </nav>
      <div id="panel" class="panel" hidden={open === null} tabIndex={-1}>
        <header class="panel-head">
          <h2>{title}</h2>
          <IconButton icon={X} label="Close the panel" onClick={() => (studio.panel.value = null)} />
        </header>
        <div class="panel-body" key={open ?? ""}>
          {open === "scenes" ? <ScenesPanel studio={studio} /> : null}
          {open === "tune" ? <TunePanel studio={studio} /> : null}
          {open === "motion" ? <MotionPanel studio={studio} /> : null}
          {open === "things" ? <ThingsPanel studio={studio} /> : null}
          {open === "keep" ? <KeepPanel studio={studio} /> : null}
        </div>
      </div>
    </aside>
  );
}

function Messages({ studio }: { studio: Studio }) {
  return (
    <div class="toasts">
      <div aria-live="polite" role="status">
        {studio.busy.value === "" ? null : (
          <p class="toast busy">
            <span class="spinner" aria-hidden="true" />
            {studio.busy.value} …
          </p>
        )}
      </div>
      {studio.toasts.value.map((toast) => (
        <p key={toast.id} class={`toast ${toast.kind}`} role={toast.kind === "error" ? "alert" : "status"}>
          <span>{toast.text}</span>
          <IconButton icon={X} label="Dismiss" onClick={() => studio.dismiss(toast.id)} />
        </p>
      ))}
    </div>
  );
}

function Picture({ studio, capability }: { studio: Studio; capability: Capability }) {
  const box = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const [ready, setReady] = useState(false);
  const [upright, setUpright] = useState(false);
  useEffect(() => {
    const element = canvas.current!;
    void studio.start(element, capability).then(() => {
      useHands(studio);
      setReady(true);
      if (innerWidth >= 1000) studio.panel.value = "tune";
    });
    const watcher = new ResizeObserver(([entry]) => {
      const size = entry?.contentRect;
      if (size === undefined || size.width === 0) return;
      studio.director.resize(size.width, size.height);
      setUpright(size.height > size.width);
    });
    watcher.observe(box.current!);
    const forget = listen(studio);
    return () => {
      watcher.disconnect();
      forget();
    };
  }, []);
  const comparing = studio.other.value !== null;
  const aiming = studio.aiming.value;
  return (
    <div ref={box} class="picture">
      <canvas
        ref={canvas}
        aria-label="The scene. Bodies can be thrown with the mouse or a finger; with the keyboard, under Things."
        role="img"
      />
      {ready ? (
        <>
          <Figures studio={studio} />
          {comparing ? (
            <div class={upright ? "pane-names upright" : "pane-names"} aria-hidden="true">
              <span>A</span>
              <span>B</span>
            </div>
          ) : null}
          {!studio.thrown.value &&
          studio.tool.value === "throw" &&
          studio.sceneId.value === "welcome" &&
          aiming === null ? (
            <p class="invitation">
              <Hand size="1.2em" aria-hidden="true" /> Pull the ball back, and let go
            </p>
          ) : null}
          {aiming === null ? null : <p class="invitation aim">{aiming.speed.toFixed(1)} m/s</p>}
          {(studio.players.value[0]?.bodies.length ?? 0) === 0 && studio.duration.value > 0 ? (
            <p class="invitation">Nothing moves here yet. Add a body under “Things”.</p>
          ) : null}
        </>
      ) : (
        <p class="invitation">Working out the scene …</p>
      )}
      {studio.contextLost.value ? (
        <div class="cover" role="alert">
          <p>The graphics card has taken its picture away. It usually comes back by itself.</p>
          <button type="button" class="button primary" onClick={() => location.reload()}>
            Load the page again
          </button>
        </div>
      ) : null}
    </div>
  );
}

export function App({ studio, capability }: { studio: Studio; capability: Capability }) {
  const [dropping, setDropping] = useState(false);
  const theme = studio.theme.value;
  useEffect(() => {
    document.documentElement.dataset["theme"] = theme;
  }, [theme]);
  useEffect(() => {
    let depth = 0;
    const files = (event: DragEvent) => event.dataTransfer?.types.includes("Files") === true;
    const enter = (event: DragEvent) => {
      if (files(event)) setDropping(++depth > 0);
    };
    const leave = (event: DragEvent) => {
      if (files(event)) setDropping(--depth > 0);
    };
    const over = (event: DragEvent) => event.preventDefault();
    const drop = (event: DragEvent) => {
      event.preventDefault();
      depth = 0;
      setDropping(false);
      void openFiles(studio, event.dataTransfer?.files ?? []);
    };
    addEventListener("dragenter", enter);
    addEventListener("dragleave", leave);
    addEventListener("dragover", over);
    addEventListener("drop", drop);
  }, []);
  return (
    <div class={studio.panel.value === null ? "app" : "app with-panel"}>
      <TopBar studio={studio} />
      <main class="stage-area">
        <Picture studio={studio} capability={capability} />
        {studio.players.value.length === 0 ? null : <Transport studio={studio} />}
      </main>
      {studio.players.value.length === 0 ? null : <PanelArea studio={studio} />}
      <Messages studio={studio} />
      <Help studio={studio} />
      {dropping ? (
        <div class="cover drop" aria-hidden="true">
          <p>Drop a scene, a take or a mesh</p>
        </div>
      ) : null}
    </div>
  );
}
