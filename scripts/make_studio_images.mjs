// Makes the pictures and the film of docs/studio.md, from the page itself. Usage: make_studio_images.mjs, after
// build_page.sh studio.
import { execFileSync } from "node:child_process";
import { mkdirSync, rmSync } from "node:fs";
import { join, resolve } from "node:path";
import { open, panel, pause } from "../web/studio/test/browser/harness.mjs";

const root = resolve(import.meta.dirname, "..");
const images = join(root, "docs/images");
const work = join(root, "build/studio-film");
rmSync(work, { recursive: true, force: true });
mkdirSync(work, { recursive: true });
const rate = 12;
const { visit, close } = await open("/usr/bin/chromium");

async function pictures() {
  const page = await visit("?quality=1", { width: 1280, height: 800, colorScheme: "light" });
  const shot = async (name) => {
    await page.waitForTimeout(2500);
    const file = join(work, `${name}.png`);
    await page.screenshot({ path: file });
    execFileSync("ffmpeg", [
      "-loglevel",
      "error",
      "-y",
      "-i",
      file,
      "-vf",
      "scale=1120:-1:flags=lanczos",
      "-c:v",
      "libwebp",
      "-quality",
      "82",
      join(images, `${name}.webp`),
    ]);
  };
  await pause(page);
  await page.evaluate(() => studio.scrub(0.4));
  await panel(page, "Motion");
  const place = await page.evaluate(() => studio.placeOf("ball"));
  await page.mouse.move(place.x, place.y);
  await page.mouse.down();
  await page.mouse.move(place.x - 90, place.y + 70, { steps: 4 });
  await shot("studio-throw");
  await page.keyboard.press("Escape");
  await page.mouse.up();
  await page.evaluate(() => studio.setTheme("dark"));
  await panel(page, "Tune");
  await page.evaluate(() => {
    studio.setOther({ ...studio.shownStyle(), min_squash: 0.25, squash_rate: 0.55, max_stretch: 2.6 });
    studio.setOverlay("strobe");
    studio.scrub(1.3);
  });
  await shot("studio-compare");
  await page.context().close();
}

/** Frames of the page with a pointer drawn into it. */
async function film() {
  const page = await visit("?quality=2", { width: 1120, height: 700, colorScheme: "light" });
  await pause(page);
  await page.evaluate(() => {
    studio.panel.value = "motion";
    const pointer = document.createElement("div");
    pointer.id = "pointer";
    pointer.style.cssText =
      "position:fixed;z-index:99;width:22px;height:22px;margin:-11px;border-radius:50%;background:rgb(20 20 20 / 45%);" +
      "border:2px solid white;pointer-events:none;left:-50px;top:0";
    document.body.append(pointer);
  });
  await page.waitForTimeout(1500);
  let frame = 0;
  const shoot = async (repeats = 1) => {
    // The next frame has drawn what was set.
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    const file = join(work, `frame-${String(frame).padStart(4, "0")}.png`);
    await page.screenshot({ path: file });
    frame += 1;
    for (let i = 1; i < repeats; ++i) {
      execFileSync("cp", [file, join(work, `frame-${String(frame++).padStart(4, "0")}.png`)]);
    }
  };
  const point = async (x, y) => {
    await page.mouse.move(x, y);
    await page.evaluate(
      ([left, top]) => Object.assign(document.getElementById("pointer").style, { left: `${left}px`, top: `${top}px` }),
      [x, y],
    );
  };
  const run = async (from, to, step = 1 / rate) => {
    for (let t = from; Math.abs(t - to) > Math.abs(step) * 0.6; t += step) {
      await page.evaluate((time) => studio.scrub(time), t);
      await shoot();
    }
  };
  await run(0, 1.2);
  await page.evaluate(() => studio.scrub(0.5));
  const ball = await page.evaluate(() => studio.placeOf("ball"));
  await point(ball.x, ball.y);
  await page.mouse.down();
  for (let i = 1; i <= 9; ++i) {
    await point(ball.x - 6.5 * i, ball.y + 5 * i);
    await shoot();
  }
  await shoot(4);
  await page.mouse.up();
  await pause(page);
  await page.evaluate(() => Object.assign(document.getElementById("pointer").style, { left: "-50px" }));
  await run(0.5, 2.6);
  await run(2.6, 1.2, -2 / rate);
  await page.evaluate(() =>
    studio.setOther({ ...studio.shownStyle(), min_squash: 0.25, squash_rate: 0.55, max_stretch: 2.6 }),
  );
  await page.waitForTimeout(400);
  await run(0.7, 3);
  await page.context().close();
  execFileSync("ffmpeg", [
    "-loglevel",
    "error",
    "-y",
    "-framerate",
    String(rate),
    "-i",
    join(work, "frame-%04d.png"),
    "-vf",
    "scale=780:-1:flags=lanczos",
    "-c:v",
    "libwebp",
    "-quality",
    "52",
    "-compression_level",
    "6",
    "-loop",
    "0",
    join(images, "studio.webp"),
  ]);
  console.log(`${frame} frames`);
}

try {
  await pictures();
  await film();
} finally {
  await close();
}
process.exit();
