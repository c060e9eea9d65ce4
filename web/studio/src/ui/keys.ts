// Keyboard: one table for what keys do and for the sheet that tells of them.
import type { Studio } from "../studio.js";

export interface KeyBinding {
  /** As `KeyboardEvent.key`; with "Ctrl+" where that is held (or the command key). */
  readonly keys: readonly string[];
  readonly shown: string;
  readonly text: string;
  readonly act: (studio: Studio) => void;
}

const overlays = ["none", "onion", "strobe"] as const;

export const bindings: readonly KeyBinding[] = [
  { keys: [" "], shown: "Space", text: "Play or pause", act: (studio) => studio.setPlaying(!studio.playing.value) },
  { keys: [",", "ArrowLeft"], shown: ", or ←", text: "One step back", act: (studio) => studio.stepBy(-1) },
  { keys: [".", "ArrowRight"], shown: ". or →", text: "One step", act: (studio) => studio.stepBy(1) },
  { keys: ["Home"], shown: "Home", text: "Back to the start", act: (studio) => studio.scrub(0) },
  { keys: ["End"], shown: "End", text: "To the end", act: (studio) => studio.scrub(studio.duration.value) },
  { keys: ["l"], shown: "L", text: "Loop", act: (studio) => studio.setLoop(!studio.loop.value) },
  {
    keys: ["s"],
    shown: "S",
    text: "Slow motion",
    act: (studio) => studio.setSpeed(studio.speed.value === 1 ? 0.25 : 1),
  },
  {
    keys: ["o"],
    shown: "O",
    text: "Onion skin, strobe, none",
    act: (studio) => studio.setOverlay(overlays[(overlays.indexOf(studio.overlay.value) + 1) % 3]!),
  },
  { keys: ["t"], shown: "T", text: "Throw tool", act: (studio) => studio.setTool("throw") },
  { keys: ["e"], shown: "E", text: "Edit tool: select, move, turn", act: (studio) => studio.setTool("edit") },
  {
    keys: ["g"],
    shown: "G",
    text: "Gizmo: move or turn",
    act: (studio) => (studio.gizmoMode.value = studio.gizmoMode.value === "translate" ? "rotate" : "translate"),
  },
  {
    keys: ["Delete", "Backspace"],
    shown: "Delete",
    text: "Delete what is selected",
    act: (studio) => studio.removeSelected(),
  },
  { keys: ["Ctrl+z"], shown: "Ctrl Z", text: "Undo", act: (studio) => studio.undo() },
  { keys: ["Ctrl+Z", "Ctrl+y"], shown: "Ctrl Shift Z", text: "Redo", act: (studio) => studio.redo() },
  { keys: ["c"], shown: "C", text: "Camera back to where it was", act: (studio) => studio.director.goHome() },
  {
    keys: ["f"],
    shown: "F",
    text: "Figures: speed, counts, hash",
    act: (studio) => (studio.showFigures.value = !studio.showFigures.value),
  },
  { keys: ["?"], shown: "?", text: "This sheet", act: (studio) => (studio.help.value = !studio.help.value) },
];

/** Keys that a focused control needs for itself. `pointed`: it has the focus because it was clicked. */
function belongsToControl(event: KeyboardEvent, pointed: boolean): boolean {
  const target = event.target as HTMLElement | null;
  if (target === null) return false;
  const { tagName } = target;
  if (tagName === "TEXTAREA" || tagName === "SELECT" || target.isContentEditable) return true;
  if (tagName === "INPUT") {
    const range = (target as HTMLInputElement).type === "range";
    return !range || /^(Arrow|Home|End|Page)/.test(event.key);
  }
  // What was clicked keeps the focus, but nobody sees it: Space is for playing then.
  const wants = tagName === "BUTTON" || tagName === "A" || tagName === "SUMMARY";
  return wants && (event.key === " " || event.key === "Enter") && !pointed;
}

export function listen(studio: Studio): () => void {
  let pointed = false;
  const point = () => (pointed = true);
  const handle = (event: KeyboardEvent) => {
    if (event.key === "Tab") pointed = false;
    if (
      event.altKey ||
      event.defaultPrevented ||
      belongsToControl(event, pointed) ||
      document.querySelector("dialog[open]") !== null
    )
      return;
    const key =
      event.ctrlKey || event.metaKey
        ? `Ctrl+${event.shiftKey ? event.key.toUpperCase() : event.key}`
        : event.key.length === 1
          ? event.key.toLowerCase()
          : event.key;
    const binding = bindings.find((each) => each.keys.includes(key));
    if (binding === undefined) return;
    event.preventDefault();
    if (event.key === " ") (document.activeElement as HTMLElement | null)?.blur();
    binding.act(studio);
  };
  addEventListener("keydown", handle);
  addEventListener("pointerdown", point, { capture: true });
  return () => {
    removeEventListener("keydown", handle);
    removeEventListener("pointerdown", point, { capture: true });
  };
}
