// Patterns on bodies, worked out in the body's own frame, so that they stretch, squash and turn with it.
import { Color, MeshStandardMaterial, type WebGLProgramParametersWithUniforms } from "three";

export const patternNames = ["checker", "two-tone", "stripes", "gores", "plain"] as const;
export type PatternName = (typeof patternNames)[number];

/** 1 where the second colour shows. `p` is the point of the body, each axis from -1 to 1; x is the principal axis.
 *  Edges are as soft as a pixel. */
const glsl = /* glsl */ `
varying vec3 vBodyPoint;
uniform vec3 uSecond;
uniform int uPattern;
float edge(float wave) {
  float width = max(fwidth(wave), 1e-4) * 0.75;
  return smoothstep(-width, width, wave);
}
float patternShare(vec3 p) {
  float turn = atan(p.z, p.y);
  if (uPattern == 0) {
    float rows = sin(p.x * 6.2831853), columns = sin(turn * 4.0);
    // At the poles the columns run together: a cap of one colour.
    return abs(p.x) > 0.93 ? 0.0 : mix(edge(rows), 1.0 - edge(rows), edge(columns));
  }
  if (uPattern == 1) return max(edge(-p.x - 0.11), 0.0);
  if (uPattern == 2) return edge(sin(p.x * 9.424778 + 1.5707963));
  if (uPattern == 3) return abs(p.x) > 0.9 ? 1.0 : edge(sin(turn * 3.0));
  return 0.0;
}
float patternBelt(vec3 p) {
  return uPattern == 1 ? edge(0.11 - abs(p.x)) : 0.0;
}
`;

/** A material whose pattern is in its vertices' own frame. `half_extents` are those of the shape. */
export function patterned(
  pattern: PatternName,
  half_extents: readonly [number, number, number],
  cream: number,
  options: { opacity?: number } = {},
): MeshStandardMaterial {
  const opacity = options.opacity ?? 1;
  const material = new MeshStandardMaterial({ roughness: 0.5, metalness: 0, transparent: opacity < 1, opacity });
  const uniforms = {
    uSecond: { value: new Color(cream) },
    uPattern: { value: patternNames.indexOf(pattern) },
    uHalf: { value: [...half_extents] },
  };
  material.userData["uniforms"] = uniforms;
  material.onBeforeCompile = (shader: WebGLProgramParametersWithUniforms) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = `varying vec3 vBodyPoint;\nuniform vec3 uHalf;\n${shader.vertexShader}`.replace(
      "#include <begin_vertex>",
      "#include <begin_vertex>\n  vBodyPoint = position / uHalf;",
    );
    shader.fragmentShader = `${glsl}\n${shader.fragmentShader}`.replace(
      "#include <color_fragment>",
      `#include <color_fragment>
  vec3 second_color = mix(uSecond, diffuseColor.rgb, 0.12);
  vec3 belt_color = diffuseColor.rgb * 0.35;
  diffuseColor.rgb = mix(diffuseColor.rgb, second_color, patternShare(vBodyPoint));
  diffuseColor.rgb = mix(diffuseColor.rgb, belt_color, patternBelt(vBodyPoint));`,
    );
  };
  material.customProgramCacheKey = () => "elastoon-pattern";
  return material;
}
