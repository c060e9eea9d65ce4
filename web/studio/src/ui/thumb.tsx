// A thumbnail as SVG; an empty box of the same size until it is made.
import type { Thumb } from "../core/thumb.js";

export function ThumbPicture({ thumb, width, height }: { thumb: Thumb | null; width: number; height: number }) {
  return (
    <svg class="thumb" viewBox={`0 0 ${width} ${height}`} aria-hidden="true" preserveAspectRatio="xMidYMid slice">
      {thumb === null ? null : (
        <>
          {thumb.floor === null ? null : (
            <rect x="0" y={thumb.floor} width={width} height={height} class="thumb-floor" />
          )}
          {thumb.outlines.map((outline, i) => (
            <path
              key={i}
              d={outline.d}
              opacity={outline.opacity}
              {...(outline.color === "" ? { class: "thumb-solid" } : { fill: outline.color, class: "thumb-body" })}
            />
          ))}
        </>
      )}
    </svg>
  );
}
