// Motion: stretch and speed over time, the impact's curve, and the spacing chart of the selected body. All of it alive.
import type { ImpactEvent } from "elastoon";
import { useMemo } from "preact/hooks";
import type { Player } from "../core/player.js";
import { frameTimes, kFramesPerSecond, spacingTicks, spanAround } from "../core/spacing.js";
import type { Studio } from "../studio.js";
import { Chart, type Line, useWidth } from "./charts.js";
import { Section, shortened } from "./parts.js";
import { Ways } from "./transport.js";

interface Motion {
  readonly times: number[];
  readonly stretch: number[];
  readonly speed: number[];
  readonly impacts: readonly ImpactEvent[];
}

function motionOf(player: Player | undefined, name: string | null, end: number): Motion | null {
  const played = player?.bodyNamed(name) ?? player?.bodies[0];
  if (player === undefined || played === undefined) return null;
  const known = Math.min(end, player.recordedTime);
  const impacts = player
    .events()
    .filter(
      (event): event is ImpactEvent =>
        event.type === "impact" && event.body.index === played.body.index && event.time <= known,
    );
  const times = Array.from({ length: 301 }, (_, i) => (known * i) / 300);
  // Impacts are short: their corners are sampled too.
  for (const { time, timeIn, timeOut } of impacts.slice(0, 60)) {
    for (let i = 0; i <= 8; ++i) times.push(time + (timeIn * i) / 8, time + timeIn + (timeOut * i) / 8);
  }
  const sorted = times.filter((time) => time <= known).sort((a, b) => a - b);
  const { poses, velocities } = player.motionOf(played.body, sorted);
  return {
    times: sorted,
    stretch: poses.map((pose) => pose.stretch),
    speed: velocities.map(({ x, y, z }) => Math.hypot(x, y, z)),
    impacts,
  };
}

/** The last impact that has begun, or the first one to come. */
function impactAt(motion: Motion, time: number): ImpactEvent | undefined {
  return motion.impacts.filter((impact) => impact.time <= time + 1e-9).at(-1) ?? motion.impacts[0];
}

function ImpactChart({ studio, motion, name }: { studio: Studio; motion: Motion; name: string }) {
  const time = studio.time.value;
  const player = studio.players.value[0];
  const impact = impactAt(motion, time);
  const curve = useMemo(() => {
    const played = player?.bodyNamed(name);
    if (impact === undefined || player === undefined || played === undefined) return null;
    const span = impact.timeIn + impact.timeOut;
    const local = Array.from({ length: 121 }, (_, i) => (span * (i * 1.36 - 0.18 * 120)) / 120);
    const poses = player.motionOf(
      played.body,
      local.map((each) => Math.max(impact.time + each, 0)),
    ).poses;
    return { local, stretch: poses.map((pose) => pose.stretch), span };
  }, [impact, player, name]);
  if (impact === undefined || curve === null) return <p class="empty">No impact yet. Throw the body at something.</p>;
  const { stretchIn, stretchMid, stretchOut, timeIn, timeOut } = impact;
  const here = time - impact.time;
  const within = here >= -0.18 * curve.span && here <= 1.18 * curve.span;
  const low = Math.min(stretchMid, ...curve.stretch);
  const high = Math.max(stretchIn, stretchOut, ...curve.stretch);
  const pad = Math.max(0.12 * (high - low), 0.02);
  const at = (x: number) => curve.stretch[curve.local.findIndex((each) => each >= x)] ?? 1;
  return (
    <>
      <Chart
        label={`Stretch through the impact at ${impact.time.toFixed(2)} seconds`}
        unit=""
        height={190}
        xUnit="s"
        lines={[{ x: curve.local, y: curve.stretch, tone: "a" }]}
        range={[low - pad, high + pad]}
        from={-0.18 * curve.span}
        to={1.18 * curve.span}
        marks={[
          { x: 0, text: "touch" },
          { x: timeIn, text: "t_in" },
          { x: timeIn + timeOut, text: "t_out" },
        ]}
        levels={[
          { y: stretchIn, text: "s_in", side: "left" },
          { y: stretchMid, text: "s_mid", side: "left" },
          { y: stretchOut, text: "s_out", side: "right" },
        ]}
        {...(within && { dot: { x: here, y: at(here) } })}
        onPick={(x) => studio.scrub(impact.time + x)}
      />
      <dl class="numbers">
        {(
          [
            ["s_in", stretchIn, ""],
            ["s_mid", stretchMid, ""],
            ["s_out", stretchOut, ""],
            ["t_in", timeIn * 1000, "ms"],
            ["t_out", timeOut * 1000, "ms"],
            ["speed", impact.speed, "m/s"],
          ] as const
        ).map(([label, value, unit]) => (
          <div key={label}>
            <dt>{label}</dt>
            <dd>
              {shortened(value)}
              <span class="unit">{unit}</span>
            </dd>
          </div>
        ))}
      </dl>
    </>
  );
}

function SpacingChart({ studio, motion, name }: { studio: Studio; motion: Motion; name: string }) {
  const [ref, width] = useWidth();
  const player = studio.players.value[0];
  const time = studio.time.value;
  const known = Math.min(studio.duration.value, player?.recordedTime ?? 0);
  const [from, to] = spanAround(
    motion.impacts.map((impact) => impact.time),
    time,
    known,
  );
  const chart = useMemo(() => {
    const played = player?.bodyNamed(name);
    if (player === undefined || played === undefined || to <= from) return null;
    const times = frameTimes(from, Math.min(to, from + 4));
    return { times, ticks: spacingTicks(player.motionOf(played.body, times).poses.map((pose) => pose.position)) };
  }, [player, name, from, to]);
  if (chart === null) return null;
  const px = (share: number) => 12 + share * (width - 24);
  const now = Math.round((time - from) * kFramesPerSecond);
  return (
    <div ref={ref} class="chart">
      <svg
        width={width}
        height="74"
        role="img"
        class="spacing"
        aria-label={`Spacing: ${chart.ticks.length} frames from ${from.toFixed(2)} to ${to.toFixed(2)} seconds`}
      >
        <line class="axis" x1={px(0)} x2={px(1)} y1="38" y2="38" />
        {chart.ticks.map(({ frame, share }, i) => {
          const extreme = i === 0 || i === chart.ticks.length - 1;
          return (
            <g key={i} class={frame === now ? "now" : ""}>
              <line class="axis" x1={px(share)} x2={px(share)} y1={extreme ? 16 : 26} y2={extreme ? 60 : 50} />
              {extreme || frame === now ? (
                <text
                  class="tick"
                  x={px(share)}
                  y={frame === now && !extreme ? 14 : 72}
                  text-anchor={i === 0 ? "start" : extreme ? "end" : "middle"}
                >
                  {frame + 1}
                </text>
              ) : null}
            </g>
          );
        })}
      </svg>
    </div>
  );
}

export function MotionPanel({ studio }: { studio: Studio }) {
  const known = studio.known.value;
  const [first, second] = studio.players.value;
  const name = studio.selectedBody.value ?? first?.bodies[0]?.name ?? null;
  const end = studio.duration.value;
  const motion = useMemo(() => motionOf(first, name, end), [first, name, end, known]);
  const other = useMemo(() => motionOf(second, name, end), [second, name, end, known]);
  if (motion === null || name === null) return <p class="empty">Select a body to see how it moves.</p>;
  const marks = motion.impacts.slice(0, 80).map((impact) => ({ x: impact.time }));
  const lines = (of: (motion: Motion) => number[]): Line[] => [
    ...(other === null ? [] : [{ x: other.times, y: of(other), tone: "b" as const }]),
    { x: motion.times, y: of(motion), tone: "a" },
  ];
  const top = (list: readonly number[], least: number) => list.reduce((most, value) => Math.max(most, value), least);
  const highest = top([...motion.stretch, ...(other?.stretch ?? [])], 1.2) * 1.05;
  const fastest = top([...motion.speed, ...(other?.speed ?? [])], 1) * 1.05;
  return (
    <>
      <div class="row narrow-only">
        <Ways studio={studio} />
        <button
          type="button"
          class="button"
          aria-pressed={studio.loop.value}
          onClick={() => studio.setLoop(!studio.loop.value)}
        >
          {studio.loop.value ? "Loops" : "Plays once"}
        </button>
      </div>
      <p class="note">
        Of <b>{name}</b>. Click a chart to go to that moment.
        {other === null ? null : (
          <span class="legend">
            <i class="tone-a" /> A <i class="tone-b" /> B
          </span>
        )}
      </p>
      <Section title="Stretch s">
        <Chart
          label="Stretch over time"
          unit=""
          height={120}
          lines={lines((each) => each.stretch)}
          range={[0, highest]}
          from={0}
          to={end}
          marks={marks}
          cursor={studio.time.value}
          xUnit="s"
          onPick={(x) => studio.scrub(x)}
        />
      </Section>
      <Section title="Speed, m/s">
        <Chart
          label="Speed over time"
          unit="m/s"
          height={110}
          lines={lines((each) => each.speed)}
          range={[0, fastest]}
          from={0}
          to={end}
          marks={marks}
          cursor={studio.time.value}
          xUnit="s"
          onPick={(x) => studio.scrub(x)}
        />
      </Section>
      <Section title="The impact’s curve">
        <ImpactChart studio={studio} motion={motion} name={name} />
      </Section>
      <Section
        title="Spacing, 24 frames a second"
        aside={
          <label class="auto">
            <input
              type="checkbox"
              checked={studio.spacing.value}
              onChange={(event) => studio.setSpacing(event.currentTarget.checked)}
            />{" "}
            on the picture
          </label>
        }
      >
        <SpacingChart studio={studio} motion={motion} name={name} />
        <p class="hint">Each tick is a frame between two contacts: close together is slow, far apart is fast.</p>
      </Section>
    </>
  );
}
