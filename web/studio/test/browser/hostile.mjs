// Scenes of strangers who mean no good.

/** Over a million impacts in a step. */
export function hangingScene() {
  const plane = (normal, offset) => ({ type: "plane", normal, offset });
  return JSON.stringify({
    elastoon: 1,
    duration: 6,
    shapes: { b: { type: "sphere", radius: 0.1 } },
    styles: { s: { restitution: 1, squash_rate: 1000, max_stretch: 1.01, min_squash: 0.99, friction: 0 } },
    bodies: Array.from({ length: 300 }, (_, i) => ({
      shape: "b",
      style: "s",
      position: [0, 0.5 + i * 0.001, 0],
      velocity: [1e5, 3e5, 0],
    })),
    obstacles: [plane([0, 1, 0], -1), plane([0, -1, 0], -2), plane([1, 0, 0], -1), plane([-1, 0, 0], -1)],
  });
}

export function hostileNames() {
  const name = '"><img src=x onerror="globalThis.harmed=1"><script>globalThis.harmed=1</script>';
  const scene = {
    elastoon: 1,
    name,
    duration: 2,
    shapes: { [name]: { type: "sphere", radius: 0.5 } },
    styles: { [name]: { restitution: 0.5 } },
    bodies: [
      { name, shape: name, style: name, position: [0, 3, 0] },
      { name: "__proto__", shape: name, position: [2, 3, 0] },
    ],
    obstacles: [{ name: "constructor", type: "plane", normal: [0, 1, 0] }],
  };
  return { take: 1, scene, inputs: [{ kind: "throw", step: 5, body: name, position: [0, 3, 0], velocity: [1, 1, 0] }] };
}
