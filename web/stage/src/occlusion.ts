// Contact shadows: each body darkens what it comes near to, as the ellipsoid that it is at that moment.
import { type MeshStandardMaterial, Vector4, type WebGLProgramParametersWithUniforms } from "three";

/** Most bodies that darken at once. */
export const kMostOccluders = 32;

/** For a body whose unit sphere goes to the world by x = M X + p: the three rows of M's inverse, with -(row . p) as
 *  fourth. */
export interface Occluders {
  readonly rows: Vector4[];
  count: number;
}

export function makeOccluders(): Occluders {
  return { rows: Array.from({ length: 3 * kMostOccluders }, () => new Vector4()), count: 0 };
}

/** Adds a body: 12 numbers of its matrix from `at` on, and its half extents. M's columns are at right angles. */
export function addOccluder(to: Occluders, matrices: ArrayLike<number>, at: number, half: readonly number[]): void {
  if (to.count >= kMostOccluders) return;
  for (let axis = 0; axis < 3; ++axis) {
    const [x, y, z] = [0, 1, 2].map((i) => matrices[at + 3 * axis + i] ?? 0) as [number, number, number];
    const square = x * x + y * y + z * z;
    if (square === 0) return;
    const scale = 1 / (square * (half[axis] ?? 1));
    const along = x * (matrices[at + 9] ?? 0) + y * (matrices[at + 10] ?? 0) + z * (matrices[at + 11] ?? 0);
    to.rows[3 * to.count + axis]?.set(x * scale, y * scale, z * scale, -along * scale);
  }
  to.count += 1;
}

const glsl = /* glsl */ `
uniform vec4 uOccluders[${3 * kMostOccluders}];
uniform int uOccluderCount;
varying vec3 vStagePoint;
varying vec3 vStageNormal;
// Share of the light from all sides that comes past the bodies: the closed form for spheres, in each body's own frame.
float lightPastBodies() {
  float light = 1.0;
  vec3 n = normalize(vStageNormal);
  for (int i = 0; i < ${kMostOccluders}; ++i) {
    if (i >= uOccluderCount) break;
    vec4 a = uOccluders[3 * i], b = uOccluders[3 * i + 1], c = uOccluders[3 * i + 2];
    vec4 p = vec4(vStagePoint, 1.0);
    vec3 d = vec3(dot(a, p), dot(b, p), dot(c, p));
    float square = dot(d, d);
    if (square > 40.0) continue;
    vec3 m = normalize(vec3(dot(a.xyz, n) / dot(a.xyz, a.xyz), dot(b.xyz, n) / dot(b.xyz, b.xyz),
                            dot(c.xyz, n) / dot(c.xyz, c.xyz)));
    float near = max(square, 1.0);
    light *= 1.0 - 0.9 * clamp(dot(m, -d) * inversesqrt(square) / near, 0.0, 1.0);
  }
  return light;
}
`;

/** Lets the material be darkened. `extra` is more GLSL for after the colour is known. */
export function darkened(
  material: MeshStandardMaterial,
  occluders: Occluders,
  extra: { declare?: string; color?: string; uniforms?: Record<string, { value: unknown }>; key?: string } = {},
): void {
  const uniforms = { uOccluders: { value: occluders.rows }, uOccluderCount: { value: 0 }, ...extra.uniforms };
  material.userData["uniforms"] = uniforms;
  material.onBeforeRender = () => {
    uniforms.uOccluderCount.value = occluders.count;
  };
  material.onBeforeCompile = (shader: WebGLProgramParametersWithUniforms) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = `varying vec3 vStagePoint;\nvarying vec3 vStageNormal;\n${shader.vertexShader}`.replace(
      "#include <project_vertex>",
      `#include <project_vertex>
  vStagePoint = (modelMatrix * vec4(transformed, 1.0)).xyz;
  vStageNormal = mat3(modelMatrix) * objectNormal;`,
    );
    shader.fragmentShader = `${glsl}${extra.declare ?? ""}\n${shader.fragmentShader}`
      .replace("#include <color_fragment>", `#include <color_fragment>\n${extra.color ?? ""}`)
      .replace(
        "#include <aomap_fragment>",
        `#include <aomap_fragment>
  float past = lightPastBodies();
  reflectedLight.indirectDiffuse *= past;
  reflectedLight.directDiffuse *= mix(1.0, past, 0.45);`,
      );
  };
  material.customProgramCacheKey = () => `elastoon-occlusion-${extra.key ?? ""}`;
}
