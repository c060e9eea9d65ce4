// The golden scenes of native programs, in steps as the command line does: for Node, a page and a worker alike.

/** Lines "scene fps hash"; gives those that differ, as texts. */
export async function runGoldens({ Elastoon, Scene }, hashes, readScene) {
  await Elastoon.init();
  const differing = [];
  let met = 0;
  for (const line of hashes.split("\n")) {
    if (line === "" || line.startsWith("#")) continue;
    const [name, fps, hash] = line.split(" ");
    const scene = Scene.parse(await readScene(name), name);
    const world = scene.stage();
    for (let step = 1; world.time < scene.duration; ++step) {
      const next = Math.min(step / Number(fps), scene.duration);
      world.step(Math.max(0, next - world.time));
      if (next >= scene.duration) break;
    }
    if (world.stateHash() === hash) ++met;
    else differing.push(`${line} DIFFERS: ${world.stateHash()}`);
    world.dispose();
    scene.dispose();
  }
  return { met, differing };
}
