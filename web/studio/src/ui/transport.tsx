// Play, pause, steps, speed, and the time line with the impacts on it.
import { ChevronLeft, ChevronRight, Pause, Play, Repeat, SkipBack } from "lucide-preact";
import { useMemo } from "preact/hooks";
import { kStepsPerSecond } from "../core/take.js";
import type { Overlay } from "../view/director.js";
import type { Studio } from "../studio.js";
import { IconButton } from "./parts.js";

const speeds = ["0.1", "0.25", "0.5", "1", "2"] as const;

function Marks({ studio }: { studio: Studio }) {
  const known = studio.known.value;
  const [player] = studio.players.value;
  const end = studio.duration.value;
  const name = studio.selectedBody.value;
  const { mine, others, share } = useMemo(() => {
    const own: number[] = [];
    const rest: number[] = [];
    const index = player?.bodyNamed(name)?.body.index;
    for (const event of player?.events() ?? []) {
      if (event.type !== "impact" || event.time > end) continue;
      (event.body.index === index ? own : rest).push((1000 * event.time) / end);
    }
    return { mine: own, others: rest.slice(0, 3000), share: Math.min((player?.recordedTime ?? 0) / end, 1) };
  }, [player, known, end, name]);
  const path = (places: readonly number[], top: number) =>
    places.map((x) => `M${x.toFixed(1)} ${top}V${40 - top}`).join("");
  return (
    <svg class="marks" viewBox="0 0 1000 40" preserveAspectRatio="none" aria-hidden="true">
      <rect class="track" x="0" y="17" width="1000" height="6" rx="3" />
      <rect class="known" x="0" y="17" width={1000 * share} height="6" rx="3" />
      <path class="other" d={path(others, 12)} vector-effect="non-scaling-stroke" />
      <path class="mine" d={path(mine, 7)} vector-effect="non-scaling-stroke" />
    </svg>
  );
}

/** Speed and ghosts: beside the time line, or in a panel where that is narrow. */
export function Ways({ studio }: { studio: Studio }) {
  return (
    <>
      <select
        value={String(studio.speed.value)}
        aria-label="Speed"
        onChange={(event) => studio.setSpeed(Number(event.currentTarget.value))}
      >
        {speeds.map((speed) => (
          <option key={speed} value={speed}>
            {speed} ×
          </option>
        ))}
      </select>
      <select
        value={studio.overlay.value}
        aria-label="Ghosts"
        onChange={(event) => studio.setOverlay(event.currentTarget.value as Overlay)}
      >
        <option value="none">No ghosts</option>
        <option value="onion">Onion skin</option>
        <option value="strobe">Strobe</option>
      </select>
    </>
  );
}

export function Transport({ studio }: { studio: Studio }) {
  const time = studio.time.value;
  const end = studio.duration.value;
  const playing = studio.playing.value;
  const frame = Math.round(time * 24);
  return (
    <section class="transport" aria-label="Time">
      <div class="transport-row">
        <IconButton icon={SkipBack} label="Back to the start" shortcut="Home" onClick={() => studio.scrub(0)} />
        <IconButton
          icon={ChevronLeft}
          label="One step back"
          shortcut=","
          onClick={() => studio.stepBy(-1)}
          class="wide-only"
        />
        <button
          type="button"
          class="play"
          aria-label={playing ? "Pause" : "Play"}
          title={`${playing ? "Pause" : "Play"} (Space)`}
          onClick={() => studio.setPlaying(!playing)}
        >
          {playing ? <Pause size="1.3em" aria-hidden="true" /> : <Play size="1.3em" aria-hidden="true" />}
        </button>
        <IconButton icon={ChevronRight} label="One step" shortcut="." onClick={() => studio.stepBy(1)} />
        <div class="timeline">
          <Marks studio={studio} />
          <input
            type="range"
            min="0"
            max={end}
            step={1 / kStepsPerSecond / 4}
            value={time}
            aria-label="Time"
            aria-valuetext={`${time.toFixed(2)} of ${end} seconds`}
            onInput={(event) => studio.scrub(Number(event.currentTarget.value))}
          />
        </div>
        <output class="clock" aria-label="Time and frame">
          <b>{time.toFixed(2)}</b> s <span>f {frame}</span>
        </output>
        <div class="row wide-only">
          <Ways studio={studio} />
        </div>
        <IconButton
          icon={Repeat}
          label="Loop"
          shortcut="L"
          pressed={studio.loop.value}
          class="wide-only"
          onClick={() => studio.setLoop(!studio.loop.value)}
        />
      </div>
    </section>
  );
}
