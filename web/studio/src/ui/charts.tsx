// Charts as SVG: lines over time with marks and a cursor, in the theme's colours.
import { useEffect, useRef, useState } from "preact/hooks";
import { ticks, tickText } from "../core/scale.js";

export interface Line {
  readonly x: readonly number[];
  readonly y: readonly number[];
  /** Of the theme: a class of its own. */
  readonly tone: "a" | "b" | "c";
}

export interface Mark {
  readonly x: number;
  readonly text?: string;
}

export interface Level {
  readonly y: number;
  readonly text: string;
  readonly side: "left" | "right";
}

interface ChartProps {
  readonly label: string;
  readonly unit: string;
  readonly lines: readonly Line[];
  readonly range: readonly [number, number];
  readonly from: number;
  readonly to: number;
  readonly height: number;
  readonly marks?: readonly Mark[];
  readonly levels?: readonly Level[];
  readonly cursor?: number;
  readonly dot?: { x: number; y: number };
  readonly xUnit?: string;
  readonly onPick?: (x: number) => void;
}

const margin = { left: 34, right: 14, top: 10, bottom: 22 };

export function useWidth(): [preact.RefObject<HTMLDivElement>, number] {
  const ref = useRef<HTMLDivElement>(null);
  const [width, setWidth] = useState(300);
  useEffect(() => {
    if (ref.current === null) return undefined;
    const watcher = new ResizeObserver(([entry]) => setWidth(Math.max(entry?.contentRect.width ?? 300, 120)));
    watcher.observe(ref.current);
    return () => watcher.disconnect();
  }, []);
  return [ref, width];
}

export function Chart(props: ChartProps) {
  const [ref, width] = useWidth();
  const {
    range: [low, high],
    from,
    to,
    height,
  } = props;
  const inner = { width: width - margin.left - margin.right, height: height - margin.top - margin.bottom };
  const px = (x: number) => margin.left + ((x - from) / Math.max(to - from, 1e-9)) * inner.width;
  const py = (y: number) => margin.top + (1 - (y - low) / Math.max(high - low, 1e-9)) * inner.height;
  const pick = (event: MouseEvent) => {
    const box = (event.currentTarget as Element).getBoundingClientRect();
    const x = from + ((event.clientX - box.left - margin.left) / inner.width) * (to - from);
    props.onPick?.(Math.min(Math.max(x, from), to));
  };
  return (
    <div ref={ref} class="chart">
      <svg
        width={width}
        height={height}
        role="img"
        aria-label={props.label}
        onClick={pick}
        class={props.onPick === undefined ? "" : "pickable"}
      >
        {ticks(low, high, height > 130 ? 5 : 3).map((y) => (
          <g key={y}>
            <line class="grid" x1={margin.left} x2={width - margin.right} y1={py(y)} y2={py(y)} />
            <text class="tick" x={margin.left - 6} y={py(y) + 3.5} text-anchor="end">
              {tickText(y)}
            </text>
          </g>
        ))}
        {ticks(from, to, Math.max(Math.floor(inner.width / 60), 2)).map((x, i, all) => (
          <text key={x} class="tick" x={Math.min(px(x), width - 12)} y={height - 7} text-anchor="middle">
            {tickText(x)}
            {i === all.length - 1 ? ` ${props.xUnit ?? ""}` : ""}
          </text>
        ))}
        {props.marks?.map((mark, i) => (
          <g key={`${mark.x} ${i}`}>
            <line class="mark" x1={px(mark.x)} x2={px(mark.x)} y1={margin.top} y2={height - margin.bottom} />
            {mark.text === undefined ? null : (
              <text class="mark-text" x={px(mark.x) + 4} y={height - margin.bottom - 5}>
                {mark.text}
              </text>
            )}
          </g>
        ))}
        {props.levels?.map((level) => (
          <g key={level.text}>
            <line class="level" x1={margin.left} x2={width - margin.right} y1={py(level.y)} y2={py(level.y)} />
            <text
              class="mark-text"
              x={level.side === "left" ? margin.left + 2 : width - margin.right - 2}
              y={py(level.y) - 4}
              text-anchor={level.side === "left" ? "start" : "end"}
            >
              {level.text}
            </text>
          </g>
        ))}
        {props.lines.map((line, i) => (
          <path
            key={i}
            class={`line tone-${line.tone}`}
            d={line.x
              .map((x, j) => `${j === 0 ? "M" : "L"}${px(x).toFixed(1)} ${py(line.y[j] ?? 0).toFixed(1)}`)
              .join("")}
          />
        ))}
        {props.cursor === undefined ? null : (
          <line
            class="cursor"
            x1={px(props.cursor)}
            x2={px(props.cursor)}
            y1={margin.top}
            y2={height - margin.bottom}
          />
        )}
        {props.dot === undefined ? null : <circle class="dot" cx={px(props.dot.x)} cy={py(props.dot.y)} r="4.5" />}
      </svg>
    </div>
  );
}
