// The studio in Chromium: plays, scrubs, throws, tunes, keeps, opens, refuses. Usage: node main.mjs [CHROMIUM]
// [FOLDER FOR PICTURES]
import { readFileSync, mkdirSync } from "node:fs";
import validator from "gltf-validator";
import { assert, check, count, download, give, hashAt, open, panel, pause, told } from "./harness.mjs";
import { hangingScene, hostileNames } from "./hostile.mjs";
import { lookAtViews } from "./views.mjs";
import { linkTo } from "./links.mjs";

const [chromium_path = "/usr/bin/chromium", pictures = "build/pictures"] = process.argv.slice(2);
mkdirSync(pictures, { recursive: true });
const { visit, close, complaints, address } = await open(chromium_path);
const goldens = readFileSync(new URL("../../../../tests/golden/hashes.txt", import.meta.url), "utf8");
const golden = (scene) => new RegExp(`^${scene} 60 (\\w{16})$`, "m").exec(goldens)[1];
const bytesOf = async (file) => readFileSync(await file.path());

try {
  let page = await visit();
  await check("it moves at once, and invites to throw", async () => {
    const first = await page.evaluate(() => studio.time.value);
    await page.waitForFunction((time) => studio.time.value > time, first);
    await page.getByText("Pull the ball back, and let go").waitFor();
  });
  await check("pause, step and keys", async () => {
    await page.keyboard.press("Space");
    await page.waitForFunction(() => !studio.playing.value);
    const before = await page.evaluate(() => studio.step);
    await page.getByRole("button", { name: "One step", exact: true }).click();
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press(".");
    assert.equal(await page.evaluate(() => studio.step), before + 2);
    await page.keyboard.press(",");
    assert.equal(await page.evaluate(() => studio.step), before + 1);
    // A button that was clicked does not keep Space for itself.
    const [throws, edits] = ["Throw", "Edit"].map((name) => page.getByRole("button", { name, exact: true }));
    await edits.click();
    await page.keyboard.press("Space");
    await page.waitForFunction(() => studio.playing.value);
    await page.keyboard.press("Space");
    await page.waitForFunction(() => !studio.playing.value);
    await throws.click();
  });
  await check("a scrubbed-to state is the played one", async () => {
    const played = await hashAt(page, 150);
    await hashAt(page, 20);
    await hashAt(page, 299);
    assert.equal(await hashAt(page, 150), played);
    assert.notEqual(await hashAt(page, 151), played);
  });

  let thrown = "";
  await check("a ball is thrown with the mouse", async () => {
    await page.getByRole("slider", { name: "Time" }).fill("0");
    const place = await page.evaluate(() => studio.placeOf("ball"));
    await page.mouse.move(place.x, place.y);
    await page.mouse.down();
    await page.mouse.move(place.x - 30, place.y + 20);
    await page.mouse.move(place.x - 70, place.y + 45, { steps: 3 });
    await page.getByText(/m\/s$/).first().waitFor();
    await page.mouse.up();
    await page.waitForFunction(() => studio.take.value.inputs.length === 1 && studio.playing.value);
    await pause(page);
    const velocity = await page.evaluate(() => studio.take.value.inputs[0].velocity);
    assert.ok(velocity[0] > 1 && velocity[1] > 1 && Math.abs(velocity[2]) < 1e-9, `${velocity}`);
    thrown = await hashAt(page, 100);
  });
  await check("undo and redo of the throw", async () => {
    await page.getByRole("button", { name: "Undo" }).click();
    assert.notEqual(await hashAt(page, 100), thrown);
    await page.getByRole("button", { name: "Redo" }).click();
    assert.equal(await hashAt(page, 100), thrown);
  });
  await check("a slider acts at once, in mid-bounce, and is undone as one", async () => {
    await panel(page, "Tune");
    const slider = page.locator('input[type="range"][id="slider-min-squash"]');
    await slider.evaluate((input) => {
      for (const value of ["0.1", "0.2", "0.15"]) {
        input.value = value;
        input.dispatchEvent(new Event("input", { bubbles: true }));
      }
      input.dispatchEvent(new Event("change", { bubbles: true }));
    });
    const style = await page.evaluate(() => studio.take.value.scene.styles.bouncy);
    assert.ok(style.min_squash < 0.25, JSON.stringify(style));
    assert.notEqual(await hashAt(page, 100), thrown);
    await page.getByRole("button", { name: "Undo" }).click();
    assert.equal(await hashAt(page, 100), thrown);
  });
  await check("presets, and two styles side by side on the same throw", async () => {
    await page.getByRole("button", { name: "Compare A/B" }).click();
    await page.getByRole("button", { name: "water-balloon" }).click();
    await page.locator(".pane-names").waitFor();
    const [a, b] = await page.evaluate(() => studio.players.value.map((player) => player.hashAt(100)));
    assert.equal(a, thrown);
    assert.notEqual(b, thrown);
    const box = await page.locator(".picture canvas").boundingBox();
    await page.getByRole("slider", { name: "Time" }).fill("1.5");
    const place = await page.evaluate(() => {
      const { x, y, z } = studio.players.value[1].motionOf(studio.players.value[1].bodies[0].body, [1.5]).poses[0].position;
      return studio.director.placeOf(x, y, z);
    });
    await page.mouse.move(place.x + box.width / 2, place.y);
    await page.mouse.down();
    await page.mouse.move(place.x + box.width / 2 - 40, place.y + 30, { steps: 3 });
    await page.getByText(/m\/s$/).first().waitFor();
    await page.keyboard.press("Escape");
    await page.mouse.up();
    assert.equal(await page.evaluate(() => studio.take.value.inputs.length), 1);
    await page.getByRole("button", { name: "Keep B" }).click();
    assert.equal(await hashAt(page, 100), b);
    await page.getByRole("button", { name: "Undo" }).click();
    assert.equal(await hashAt(page, 100), thrown);
  });
  await check("charts go along", async () => {
    await panel(page, "Motion");
    await page.locator(".chart .line").first().waitFor();
    assert.equal(await page.locator(".numbers dt").count(), 6);
    const time = await page.evaluate(() => studio.time.value);
    await page
      .locator(".chart .pickable")
      .first()
      .click({ position: { x: 200, y: 60 } });
    assert.notEqual(await page.evaluate(() => studio.time.value), time);
  });
  await check("things are added, thrown by numbers, and deleted", async () => {
    await panel(page, "Things");
    await page.getByRole("button", { name: "Capsule" }).click();
    await page.getByRole("button", { name: "Ramp" }).click();
    const scene = await page.evaluate(() => ({
      count: studio.players.value[0].bodies.length,
      obstacles: studio.take.value.scene.obstacles.length,
    }));
    assert.deepEqual(scene, { count: 2, obstacles: 6 });
    await page.getByRole("button", { name: "Delete" }).click();
    await page
      .locator(".things")
      .getByRole("button", { name: /capsule/ })
      .click();
    await page.getByRole("button", { name: "Throw now" }).click();
    await pause(page);
    await page.getByRole("button", { name: "Delete" }).click();
    assert.deepEqual(
      await page.evaluate(() => [studio.players.value[0].bodies.length, studio.take.value.scene.obstacles.length]),
      [1, 5],
    );
  });

  await check("a take is kept as a file and opened again: the same hash", async () => {
    await panel(page, "Keep");
    const hash = await hashAt(page, 120);
    const file = await download(page, () => page.getByRole("button", { name: "Take, with throws" }).click());
    assert.match(file.suggestedFilename(), /^throw-the-ball\.take\.json$/);
    const text = await bytesOf(file);
    await panel(page, "Scenes");
    await page.getByRole("button", { name: /^Stairs/ }).click();
    await give(page, ["mine.take.json", text]);
    await told(page, "Opened mine.take.json");
    assert.equal(await hashAt(page, 120), hash);
  });
  await check("a link holds the whole take, and opens in another page", async () => {
    const hash = await hashAt(page, 130);
    await panel(page, "Keep");
    const href = await page.locator("[data-link]").getAttribute("href");
    const other = await visit(href.slice(address.length));
    await told(other, "Opened the link");
    await pause(other);
    assert.equal(await hashAt(other, 130), hash);
    await other.context().close();
  });
  await check("scene files: the hashes of the native program, and back", async () => {
    const text = readFileSync(new URL("../../../../scenes/stairs.json", import.meta.url));
    await panel(page, "Scenes");
    await give(page, ["stairs.json", text]);
    await told(page, "Opened stairs.json");
    await pause(page);
    const steps = await page.evaluate(() => studio.duration.value * 60);
    assert.equal(await hashAt(page, steps), golden("stairs.json"));
    await panel(page, "Keep");
    const file = await download(page, () => page.getByRole("button", { name: "Scene file" }).click());
    assert.deepEqual(JSON.parse(await bytesOf(file)), JSON.parse(text));
  });
  await check("an animated .glb that the judge takes, and that comes in as a mesh", async () => {
    const file = await download(page, () => page.getByRole("button", { name: "Animated .glb" }).click());
    const bytes = new Uint8Array(await bytesOf(file));
    const report = await validator.validateBytes(bytes);
    assert.equal(report.issues.numErrors, 0, JSON.stringify(report.issues.messages.slice(0, 3)));
    assert.equal(report.info.animationCount, 1);
    await panel(page, "Scenes");
    await give(page, ["stairs.glb", bytes]);
    await told(page, /its hull of \d+ points collides/);
    assert.equal(await page.evaluate(() => studio.meshes.value.size), 1);
  });
  await check("an .obj comes in, flies and is drawn", async () => {
    const tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1.5 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    await give(page, ["peak.obj", tetrahedron]);
    await told(page, /peak: its hull of 4 points/);
    assert.ok(await page.evaluate(() => studio.players.value[0].bodies.some(({ name }) => name === "peak")));
  });
  await check("pictures and films", async () => {
    await give(page, [
      "short.json",
      JSON.stringify({
        elastoon: 1,
        name: "Short",
        duration: 0.5,
        shapes: { b: { type: "sphere", radius: 0.5 } },
        bodies: [{ shape: "b", position: [0, 1, 0] }],
        obstacles: [{ type: "plane", normal: [0, 1, 0] }],
      }),
    ]);
    await told(page, "Opened short.json");
    await panel(page, "Keep");
    await page.getByLabel("Size").selectOption("small");
    await page.getByLabel("Rate").selectOption("12");
    const still = await bytesOf(await download(page, () => page.getByRole("button", { name: "Strobe PNG" }).click()));
    assert.deepEqual([still.readUInt32BE(16), still.readUInt32BE(20)], [640, 360]);
    const film = await download(page, () => page.getByRole("button", { name: "Film" }).click());
    assert.match(film.suggestedFilename(), /^short\.(webm|mp4)$/);
    assert.ok((await bytesOf(film)).length > 2000);
    const zip = await bytesOf(await download(page, () => page.getByRole("button", { name: "PNGs in a zip" }).click()));
    assert.equal(zip.readUInt32LE(0), 0x04034b50);
    assert.equal(zip.subarray(-22).readUInt16LE(10), 6);
  });

  await check("bad files are refused with their place, and nothing is lost", async () => {
    const before = await page.evaluate(() => studio.take.value);
    await panel(page, "Scenes");
    for (const [name, content, words] of [
      ["broken.json", '{"elastoon": 1,', /broken.json is not JSON/],
      [
        "typo.json",
        '{"elastoon":1,"shapes":{"ball":{"type":"sphere","radius":1}},"bodies":[{"shape":"bal"}]}',
        /bodies\/0\/shape.*"ball"/,
      ],
      [
        "inside.json",
        JSON.stringify({ ...before.scene, bodies: [{ shape: "b", position: [0, 0, 0] }] }),
        /inside the obstacle/,
      ],
      ["notes.txt", "hello", /opens scenes and takes/],
      ["torn.glb", "glTF\u0002\u0000", /torn.glb/],
      ["flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", /flat.obj.*four points/],
      ["hang.json", hangingScene(), /takes too long/],
    ]) {
      await give(page, [name, content]);
      await told(page, words);
      assert.deepEqual(await page.evaluate(() => studio.take.value), before, name);
    }
  });
  await check("a message can be sent away", async () => {
    await give(page, ["notes.txt", "hello"]);
    await page.getByRole("button", { name: "Dismiss" }).click();
    await page.locator(".toast").waitFor({ state: "detached" });
  });
  await check("a stranger's names are text, and links are data", async () => {
    const other = await visit(linkTo(hostileNames()));
    await told(other, "Opened the link");
    for (const name of ["Things", "Tune", "Keep"]) await panel(other, name);
    assert.equal(await other.evaluate(() => globalThis.harmed), undefined);
    assert.equal(await other.locator("img, iframe").count(), 0);
    await other.goto(`${address}#take=%3Cscript%3E`);
    await told(other, /link is damaged/);
    await other.goto(address + linkTo("0".repeat(4_500_000), true));
    await told(other, /larger than/);
    await other.context().close();
  });
  await check("without WebGL 2 it says so", async () => {
    const other = await visit("", {
      expectFailure: true,
      before: () => {
        HTMLCanvasElement.prototype.getContext = () => null;
      },
    });
    await other.getByRole("heading", { name: "This browser cannot draw the studio" }).waitFor();
    await other.context().close();
  });
  await check("a lost picture is told, and comes back", async () => {
    await page.evaluate(() => {
      const gl = document.querySelector(".picture canvas").getContext("webgl2");
      globalThis.loser = gl.getExtension("WEBGL_lose_context");
      globalThis.loser.loseContext();
    });
    await page.getByText("graphics card has taken its picture away").waitFor();
    await page.evaluate(() => globalThis.loser.restoreContext());
    await page.getByText("graphics card has taken its picture away").waitFor({ state: "detached" });
  });
  await check("who wants little motion begins with a still picture", async () => {
    const other = await visit("", { reducedMotion: "reduce" });
    assert.equal(await other.evaluate(() => studio.playing.value), false);
    await other.context().close();
  });
  await check("the last scene can be opened again", async () => {
    const { bodies } = await page.evaluate(() => studio.take.value.scene);
    await page.waitForFunction(() => localStorage.getItem("elastoon-studio-last") !== null);
    await page.waitForTimeout(1600);
    await page.reload();
    await page.waitForSelector(".play");
    await panel(page, "Scenes");
    await page.getByRole("button", { name: "Last scene" }).click();
    await told(page, "Opened the last scene");
    assert.deepEqual(await page.evaluate(() => studio.take.value.scene.bodies), bodies);
  });
  await check("it works without a network once it was loaded", async () => {
    const other = await visit();
    await other.evaluate(() => navigator.serviceWorker.ready);
    await other.waitForFunction(
      async () =>
        (await caches.keys()).some((name) => name.startsWith("elastoon-studio-")) &&
        navigator.serviceWorker.controller !== null,
      null,
      { timeout: 20000 },
    );
    await other.context().setOffline(true);
    await other.reload();
    await other.waitForSelector(".play");
    await other.waitForFunction(() => studio.time.value > 0);
    await other.context().close();
  });
  await page.context().close();
  await lookAtViews(visit, pictures);
  await check("nothing was said on the console", async () => {
    const real = complaints.filter((text) => !/CONTEXT_LOST|Context Lost|ERR_INTERNET_DISCONNECTED/.test(text));
    assert.deepEqual(real, []);
  });
  console.log(`studio: ${count()} checks in Chromium passed`);
} catch (error) {
  console.error(error.stack, complaints.slice(0, 5));
  process.exitCode = 1;
} finally {
  await close();
}
process.exit();
