// Things: what is in the scene, what can be added, and the numbers of what is selected.
import { Box, Circle, Cone, Cylinder, Pill, Square, Trash2, TriangleRight, Wallpaper } from "lucide-preact";
import { useState } from "preact/hooks";
import { bodiesOf, palette } from "../core/edit.js";
import type { SceneShape, Triple } from "../core/take.js";
import type { Studio } from "../studio.js";
import { type Icon, Section, Segmented, shortened } from "./parts.js";

const bodies: readonly { text: string; icon: Icon; shape: SceneShape }[] = [
  { text: "Ball", icon: Circle, shape: { type: "sphere", radius: 0.5 } },
  { text: "Box", icon: Box, shape: { type: "box", size: [1, 0.8, 0.8] } },
  { text: "Cylinder", icon: Cylinder, shape: { type: "cylinder", radius: 0.35, length: 1 } },
  { text: "Cone", icon: Cone, shape: { type: "cone", radius: 0.45, length: 1 } },
  { text: "Capsule", icon: Pill, shape: { type: "capsule", radius: 0.3, length: 1.1 } },
];

function Triples(props: { label: string; unit: string; value: Triple; onChange: (value: Triple) => void }) {
  return (
    <fieldset class="triple">
      <legend>
        {props.label} <span class="unit">{props.unit}</span>
      </legend>
      {(["x", "y", "z"] as const).map((axis, i) => (
        <input
          key={axis}
          type="text"
          inputMode="decimal"
          aria-label={`${props.label} ${axis}, ${props.unit}`}
          value={shortened(props.value[i]!)}
          onChange={(event) => {
            const number = Number(event.currentTarget.value);
            if (!Number.isFinite(number) || Math.abs(number) > 1e5) return;
            props.onChange(props.value.map((old, j) => (i === j ? number : old)) as unknown as Triple);
          }}
        />
      ))}
    </fieldset>
  );
}

function BodyDetails({ studio, name }: { studio: Studio; name: string }) {
  const [velocity, setVelocity] = useState<Triple>([4, 6, 0]);
  void studio.known.value;
  const player = studio.players.value[0];
  const played = player?.bodyNamed(name);
  if (player === undefined || played === undefined) return null;
  const { position } = player.motionOf(played.body, [studio.time.value]).poses[0]!;
  const place: Triple = [position.x, position.y, position.z];
  return (
    <Section title={name}>
      <Triples
        label="Position"
        unit="m"
        value={place}
        onChange={(to) => {
          studio.moveBody(name, to);
          studio.settle();
        }}
      />
      <Triples label="Throw" unit="m/s" value={velocity} onChange={setVelocity} />
      <button type="button" class="button primary" onClick={() => studio.throwNow(name, place, velocity)}>
        Throw now
      </button>
      <Colors studio={studio} />
    </Section>
  );
}

function ObstacleDetails({ studio, index }: { studio: Studio; index: number }) {
  const obstacle = studio.take.value.scene.obstacles?.[index];
  if (obstacle === undefined) return null;
  const title = obstacle.name ?? (obstacle.type === "plane" ? "plane" : "solid");
  return (
    <Section title={title}>
      {obstacle.shape === undefined ? (
        <>
          <Triples
            label="Normal"
            unit=""
            value={obstacle.normal ?? [0, 1, 0]}
            onChange={(normal) => studio.changeObstacle(index, { normal })}
          />
          <label class="field">
            Offset, m
            <input
              type="text"
              inputMode="decimal"
              value={shortened(obstacle.offset ?? 0)}
              onChange={(event) => {
                const offset = Number(event.currentTarget.value);
                if (Number.isFinite(offset)) studio.changeObstacle(index, { offset });
              }}
            />
          </label>
        </>
      ) : (
        <Triples
          label="Position"
          unit="m"
          value={obstacle.position ?? [0, 0, 0]}
          onChange={(position) => studio.changeObstacle(index, { position })}
        />
      )}
      <Segmented
        label="Gizmo"
        value={studio.gizmoMode.value}
        onChange={(mode) => (studio.gizmoMode.value = mode)}
        options={[
          { value: "translate", text: "Move" },
          { value: "rotate", text: "Turn" },
        ]}
      />
      <Colors studio={studio} />
    </Section>
  );
}

function Colors({ studio }: { studio: Studio }) {
  return (
    <div class="colors" role="group" aria-label="Colour">
      {palette.map((color) => (
        <button
          key={color}
          type="button"
          class="swatch"
          style={{ background: color }}
          aria-label={`Colour ${color}`}
          onClick={() => {
            studio.setColor(color);
            studio.settle();
          }}
        />
      ))}
      <input
        type="color"
        aria-label="Another colour"
        onInput={(event) => studio.setColor(event.currentTarget.value)}
        onChange={() => studio.settle()}
      />
    </div>
  );
}

export function ThingsPanel({ studio }: { studio: Studio }) {
  const played = studio.players.value[0]?.bodies ?? [];
  void studio.known.value;
  const selection = studio.selection.value;
  const { x, y, z } = studio.director.controls.target;
  const near: Triple = [Number(x.toFixed(1)), Number(Math.max(y - 1, 0.5).toFixed(1)), Number(z.toFixed(1))];
  const obstacles: readonly { text: string; icon: Icon; add: () => void }[] = [
    {
      text: "Block",
      icon: Square,
      add: () => studio.addObstacle({ name: fresh("block"), position: near }, { type: "box", size: [2, 1, 2] }),
    },
    {
      text: "Ramp",
      icon: TriangleRight,
      add: () =>
        studio.addObstacle(
          { name: fresh("ramp"), position: near, rotation: [0, 0, 0.2164, 0.9763] },
          { type: "box", size: [3.5, 0.4, 2.5] },
        ),
    },
    {
      text: "Peg",
      icon: Circle,
      add: () => studio.addObstacle({ name: fresh("peg"), position: near }, { type: "sphere", radius: 0.5 }),
    },
    {
      text: "Floor",
      icon: Wallpaper,
      add: () => studio.addObstacle({ name: fresh("floor"), type: "plane", normal: [0, 1, 0], offset: 0 }),
    },
  ];
  const listed = studio.take.value.scene.obstacles ?? [];
  const fresh = (stem: string) => {
    const names = new Set(listed.map((each) => each.name));
    let name = stem;
    for (let i = 2; names.has(name); ++i) name = `${stem} ${i}`;
    return name;
  };
  const inputs = studio.take.value.inputs;
  return (
    <>
      <Section title="Add a body">
        <div class="adders">
          {bodies.map(({ text, icon: Picture, shape }) => (
            <button
              key={text}
              type="button"
              class="adder"
              onClick={() => studio.addBody({ shape, name: text.toLowerCase() })}
            >
              <Picture size="1.3em" aria-hidden="true" />
              <span>{text}</span>
            </button>
          ))}
        </div>
      </Section>
      <Section title="Add an obstacle">
        <div class="adders">
          {obstacles.map(({ text, icon: Picture, add }) => (
            <button key={text} type="button" class="adder" onClick={add}>
              <Picture size="1.3em" aria-hidden="true" />
              <span>{text}</span>
            </button>
          ))}
        </div>
      </Section>
      <Section
        title="In this scene"
        aside={
          selection === null ? null : (
            <button type="button" class="button" onClick={() => studio.removeSelected()}>
              <Trash2 size="1.1em" aria-hidden="true" /> Delete
            </button>
          )
        }
      >
        <ul class="things">
          {played.slice(0, 100).map((each) => (
            <li key={`b ${each.name}`}>
              <button
                type="button"
                aria-pressed={selection?.kind === "body" && selection.name === each.name}
                onClick={() => {
                  studio.selectBody(each.name);
                  studio.setTool("edit");
                }}
              >
                <span class="dot" style={{ background: `#${each.color.toString(16).padStart(6, "0")}` }} />
                {each.name}
                <small>{bodiesOf(studio.take.value)[played.indexOf(each)]?.style ?? ""}</small>
              </button>
            </li>
          ))}
          {played.length > 100 ? <li class="note">and {played.length - 100} bodies more</li> : null}
          {listed.slice(0, 100).map((each, i) => (
            <li key={`o ${i}`}>
              <button
                type="button"
                aria-pressed={selection?.kind === "obstacle" && selection.index === i}
                onClick={() => {
                  studio.setTool("edit");
                  studio.selectObstacle(i);
                }}
              >
                <span class="dot square" style={{ background: each.color ?? "var(--muted)" }} />
                {each.name ?? `obstacle ${i}`}
                <small>{each.shape === undefined ? "plane" : "solid"}</small>
              </button>
            </li>
          ))}
        </ul>
      </Section>
      {selection?.kind === "body" ? <BodyDetails key={selection.name} studio={studio} name={selection.name} /> : null}
      {selection?.kind === "obstacle" ? (
        <ObstacleDetails key={selection.index} studio={studio} index={selection.index} />
      ) : null}
      <Section title="Throws in this take">
        <p class="note">
          {inputs.length === 0
            ? "None yet. Pull a body back on the picture and let go."
            : `${inputs.filter((input) => input.kind === "throw").length} throws, ${
                inputs.filter((input) => input.kind === "arrival").length
              } bodies that come in later.`}
        </p>
        <div class="row">
          <button type="button" class="button" disabled={inputs.length === 0} onClick={() => studio.clearThrows()}>
            Forget throws
          </button>
          <button
            type="button"
            class="button"
            disabled={studio.step === 0}
            onClick={() => studio.startHere()}
            title="Makes this moment the start of the scene"
          >
            Start from here
          </button>
        </div>
      </Section>
    </>
  );
}
