// Tune: presets, and the parameters of the table as sliders that act at once; a second style to compare with.
import {
  styleDescriptions,
  styleNames,
  styleParameters,
  type StyleParameterInfo,
  type StyleParameters,
} from "elastoon";
import { Columns2, Replace, X } from "lucide-preact";
import { useEffect, useState } from "preact/hooks";
import { bodiesOf, defaultStyle, overrides } from "../core/edit.js";
import { readTake } from "../core/take.js";
import { type Thumb, thumbOf } from "../core/thumb.js";
import type { Studio } from "../studio.js";
import { NumberSlider, Section, Segmented } from "./parts.js";
import { ThumbPicture } from "./thumb.js";

/** What sliders show of ranges whose ends nobody wants to see. */
const usual: Partial<Record<keyof StyleParameters, readonly [number, number]>> = {
  restitution: [0, 1.2],
  max_stretch: [1, 5],
  min_squash: [0.05, 1],
  stretch_rate: [0, 1],
  squash_rate: [0.1, 10],
  reversal_rate: [60, 3600],
  rest_speed: [0, 3],
  friction: [0, 2],
};
/** Sliders that go by ratios. */
const byRatio: ReadonlySet<string> = new Set(["squash_rate", "reversal_rate"]);

const thumbs = new Map<string, Thumb>();
function presetThumb(style: string): Thumb {
  const known = thumbs.get(style);
  if (known !== undefined) return known;
  const take = readTake(
    JSON.stringify({
      elastoon: 1,
      duration: 1.7,
      shapes: { ball: { type: "sphere", radius: 0.5 } },
      bodies: [{ shape: "ball", style, position: [-3, 2.3, 0], velocity: [3, 1.6, 0], color: "#e4572e" }],
      obstacles: [{ type: "plane", normal: [0, 1, 0], offset: 0 }],
      camera: { eye: [-0.4, 1.9, 12], target: [-0.4, 1.45, 0], fov: 17.5 },
    }),
  );
  const made = thumbOf(take, { width: 96, height: 52, seconds: 1.7, every: 1 / 11 });
  thumbs.set(style, made);
  return made;
}

function Preset({ name, current, onPick }: { name: string; current: boolean; onPick: () => void }) {
  const [thumb, setThumb] = useState<Thumb | null>(thumbs.get(name) ?? null);
  useEffect(() => {
    if (thumb !== null) return undefined;
    const later = setTimeout(
      () => setThumb(presetThumb(name)),
      30 + 25 * (styleNames as readonly string[]).indexOf(name),
    );
    return () => clearTimeout(later);
  }, []);
  const description = styleDescriptions[name as keyof typeof styleDescriptions];
  return (
    <button type="button" class="preset" aria-pressed={current} title={description} onClick={onPick}>
      <ThumbPicture thumb={thumb} width={96} height={52} />
      <span>{name}</span>
    </button>
  );
}

function Parameter({ studio, row, style }: { studio: Studio; row: StyleParameterInfo; style: StyleParameters }) {
  const value = style[row.name];
  const preset = defaultStyle()[row.name];
  const label = row.name.replace(/_/g, " ");
  const set = (next: number | string) => studio.setParameter(row.name, next);
  if (row.choices.length > 0) {
    return (
      <div class="slider-row">
        <div class="slider-head">
          <span class="label" title={row.meaning}>
            {label}
          </span>
        </div>
        <Segmented
          label={label}
          value={String(value)}
          options={row.choices.map((choice) => ({ value: choice, text: choice }))}
          onChange={(choice) => {
            set(choice);
            studio.settle();
          }}
        />
        <p class="hint">{row.meaning}</p>
      </div>
    );
  }
  const [low, high] = usual[row.name] ?? [row.minimum, row.maximum];
  const shown = typeof value === "number" ? value : 0.63;
  const ratio = byRatio.has(row.name);
  const toShare = (v: number) => (ratio ? Math.log(v / low) / Math.log(high / low) : (v - low) / (high - low));
  const fromShare = (share: number) => {
    const raw = ratio ? low * (high / low) ** share : low + share * (high - low);
    return Number(raw.toPrecision(3));
  };
  return (
    <NumberSlider
      label={label}
      symbol={row.symbol}
      unit={row.unit}
      hint={row.meaning}
      value={shown}
      minimum={row.minimum}
      maximum={row.maximum}
      toShare={(v) => Math.min(Math.max(toShare(v), 0), 1)}
      fromShare={fromShare}
      onInput={set}
      onSettle={() => studio.settle()}
      disabled={value === "auto"}
      onReset={
        value === preset
          ? null
          : () => {
              set(preset);
              studio.settle();
            }
      }
      extra={
        row.may_be_derived ? (
          <label class="auto">
            <input
              type="checkbox"
              checked={value === "auto"}
              onChange={(event) => {
                set(event.currentTarget.checked ? "auto" : 0.5);
                studio.settle();
              }}
            />{" "}
            auto
          </label>
        ) : null
      }
    />
  );
}

const feel: readonly (keyof StyleParameters)[] = [
  "restitution",
  "max_stretch",
  "min_squash",
  "stretch_rate",
  "squash_rate",
];

export function TunePanel({ studio }: { studio: Studio }) {
  const [all, setAll] = useState(false);
  const bodies = bodiesOf(studio.take.value);
  const played = studio.players.value[0]?.bodies ?? [];
  const index = studio.bodyIndex.value;
  const name = bodies[index]?.style;
  const shared = name === undefined ? 1 : bodies.filter((body) => body.style === name).length;
  const style = studio.shownStyle();
  const comparing = studio.other.value !== null;
  const editing_b = comparing && studio.editing.value === "b";
  if (bodies.length === 0) {
    return (
      <p class="empty">There is no body in this scene. Add one under “Things”, and come back to give it a style.</p>
    );
  }
  return (
    <>
      <div class="target">
        <label class="field">
          Body
          <select
            value={String(index)}
            onChange={(event) => studio.selectBody(played[Number(event.currentTarget.value)]?.name ?? null)}
          >
            {played.slice(0, 300).map((each, i) => (
              <option key={each.name} value={String(i)}>
                {each.name}
              </option>
            ))}
          </select>
        </label>
        {comparing ? (
          <div class="row">
            <Segmented
              label="Style to edit"
              value={studio.editing.value}
              onChange={(value) => (studio.editing.value = value)}
              options={[
                { value: "a", text: "A" },
                { value: "b", text: "B" },
              ]}
            />
            <button type="button" class="button" onClick={() => studio.keepOther()}>
              <Replace size="1.1em" aria-hidden="true" /> Keep B
            </button>
            <button type="button" class="button" aria-label="End the comparison" onClick={() => studio.setOther(null)}>
              <X size="1.1em" aria-hidden="true" />
            </button>
          </div>
        ) : (
          <button
            type="button"
            class="button"
            onClick={() => studio.setOther({ ...style })}
            title="The same throw with a second style, side by side"
          >
            <Columns2 size="1.1em" aria-hidden="true" /> Compare A/B
          </button>
        )}
      </div>
      <p class="note">
        {editing_b ? (
          "Style B: sliders and presets change the second picture."
        ) : (
          <>
            Style <b>{name ?? "default"}</b>
            {shared > 1 ? `, shared by ${shared} bodies` : ""}.
          </>
        )}
        {!editing_b && overrides(studio.take.value, name) ? (
          <button type="button" class="link" onClick={() => studio.resetStyle(name!)}>
            Back to the library’s {name}
          </button>
        ) : null}
      </p>
      <Section
        title="Presets"
        aside={
          <label class="auto">
            <input type="checkbox" checked={all} onChange={(event) => setAll(event.currentTarget.checked)} /> all bodies
          </label>
        }
      >
        <div class="presets">
          {styleNames.map((preset) => (
            <Preset
              key={preset}
              name={preset}
              current={!editing_b && name === preset}
              onPick={() => studio.applyPreset(preset, all)}
            />
          ))}
        </div>
      </Section>
      <Section title="Squash and stretch">
        {styleParameters
          .filter((row) => feel.includes(row.name))
          .map((row) => (
            <Parameter key={row.name} studio={studio} row={row} style={style} />
          ))}
      </Section>
      <Section title="Contacts and turns">
        {styleParameters
          .filter((row) => !feel.includes(row.name))
          .map((row) => (
            <Parameter key={row.name} studio={studio} row={row} style={style} />
          ))}
      </Section>
    </>
  );
}
