// The page in Chromium: started, played by keys to losing and by the bot to winning level one, paused, resumed,
// muted; by
// touch and gamepad; offline; without faults of access; with the hashes of native programs.
// Usage: node test/browser.mjs CHROMIUM PICTURES
import { mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { serve } from "./serve.mjs";

const [executablePath = "/usr/bin/chromium", pictures = "build/game"] = process.argv.slice(2);
mkdirSync(pictures, { recursive: true });
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const root = new URL("../../../", import.meta.url);
const server = await serve(fileURLToPath(new URL("../dist", import.meta.url)));
const browser = await chromium.launch({ executablePath,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--autoplay-policy=no-user-gesture-required"] });

let checks = 0;
function expect(what, holds) {
  if (!holds) throw new Error(`not so: ${what}`);
  checks += 1;
}
const faults = [];

async function open(options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, bypassCSP: true, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(20000);
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(error.message));
  await page.goto(server.url);
  await page.waitForFunction(() => window.squashout !== undefined);
  return { context, page };
}
const app = (page, act, ...args) => page.evaluate(`((app, ...args) => (${act})(app, ...args))(window.squashout.app, ${
  args.map((arg) => JSON.stringify(arg)).join(", ") || "undefined"})`);
const state = (page) => app(page, (a) => ({ ...a.snapshot, mode: a.mode }));

async function noFaultsOfAccess(page, where) {
  await page.waitForTimeout(350); // colours that fade in
  await page.evaluate(axe);
  const found = await page.evaluate(async () => (await window.axe.run()).violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" ").slice(0, 300)}`));
  expect(`${where}: no serious fault of access, found ${found.join("; ")}`, found.length === 0);
}

async function titleAndDialogs() {
  const { context, page } = await open();
  expect("the title is open", await page.isVisible("#title"));
  expect("the bot plays behind it", (await state(page)).mode === "attract");
  await noFaultsOfAccess(page, "title");
  await page.screenshot({ path: `${pictures}/title-1280x800.png` });
  for (const name of ["help", "options", "scores"]) {
    await page.click(`#title [data-open=${name}]`);
    await noFaultsOfAccess(page, name);
    await page.keyboard.press("Escape");
    expect(`Escape leads back from ${name}`, await page.isVisible("#title"));
  }
  await context.close();
}

async function keysToLosing() {
  const { context, page } = await open();
  await page.keyboard.press("Enter"); // on Play
  await page.waitForFunction(() => window.squashout.app.mode === "playing");
  expect("the bar shows three lives", (await page.getAttribute("#lives", "aria-label")) === "3 lives");
  await page.keyboard.down("ArrowLeft");
  await app(page, (a) => a.pass(0.6));
  const left = await state(page);
  expect("the left key moves the paddle to the left wall", Math.abs(left.paddleX + 5.5 - left.paddleHalfWidth) < 0.01);
  await page.keyboard.up("ArrowLeft");
  await page.keyboard.down("ArrowRight");
  await app(page, (a) => a.pass(0.25));
  expect("the right key moves it back", (await state(page)).paddleX > left.paddleX + 1);
  await page.keyboard.press("Space");
  await app(page, (a) => a.pass(0.1));
  expect("the space key lets the ball go", (await state(page)).stage === "playing");

  await page.keyboard.press("p");
  expect("P pauses", await page.isVisible("#paused"));
  const paused = await state(page);
  await page.waitForTimeout(400);
  expect("nothing moves in a pause", (await state(page)).steps === paused.steps);
  await noFaultsOfAccess(page, "paused");
  await page.keyboard.press("Escape");
  await page.waitForFunction((steps) => window.squashout.app.snapshot.steps > steps, paused.steps);

  await page.keyboard.press("m");
  expect("M mutes", (await page.getAttribute("#mute", "aria-pressed")) === "false");
  await page.click("#mute");
  expect("and the button brings the sound back", (await page.getAttribute("#mute", "aria-pressed")) === "true");
  await page.keyboard.press("m");

  for (let i = 0; i < 60 && (await state(page)).mode === "playing"; ++i) {
    await page.keyboard.press("Space");
    await app(page, (a) => a.pass(4));
  }
  expect("the game is lost by keys", (await state(page)).stage === "lost" && (await page.isVisible("#over")));
  await noFaultsOfAccess(page, "over");
  const { score } = await state(page);
  if (score > 0) {
    await page.fill("#name", "Ada <b>");
    await page.keyboard.press("Enter");
    expect("the score is kept", (await page.textContent("#table .new")).includes(String(score)));
    expect("a name is text", (await page.textContent("#table .new")).includes("Ada <b>"));
    await page.click("#scores [data-do=back]");
  }
  await page.click("#over [data-do=again]");
  expect("and another begins", (await state(page)).lives === 3);
  await page.reload();
  await page.waitForFunction(() => window.squashout !== undefined);
  expect("options are kept", (await app(page, (a) => a.options.sound)) === false);
  await context.close();
}

async function botToWinning() {
  const { context, page } = await open({ viewport: { width: 1280, height: 800 } });
  await app(page, (a) => {
    a.start(0, 4);
    a.bot = true;
  });
  for (let i = 0; i < 80 && (await state(page)).level === 0; ++i) await app(page, (a) => a.pass(3));
  const won = await state(page);
  expect(`the bot wins level one, has ${won.blocksLeft} blocks left`, won.level === 1 && won.mode === "playing");
  expect("the bar tells the level", (await page.textContent("#level")).startsWith("2"));
  await app(page, (a) => a.pass(6));
  await page.waitForTimeout(300);
  await page.screenshot({ path: `${pictures}/play-1280x800.png` });
  const recording = await app(page, (a) => a.recording);
  const same = await page.evaluate((text) => window.squashout.engine.replay(text).hash, recording);
  expect("the page's own recording plays again", same === JSON.parse(recording).hash);
  await context.close();
}

async function touch() {
  const { context, page } = await open({ viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true });
  await page.screenshot({ path: `${pictures}/title-360x740.png` });
  await page.tap("#title [data-do=play]");
  await page.waitForFunction(() => window.squashout.app.mode === "playing");
  const client = await context.newCDPSession(page);
  const send = (type, x) => client.send("Input.dispatchTouchEvent", { type, touchPoints: x === undefined ? [] : [{ x,
    y: 650 }] });
  await send("touchStart", 180);
  await send("touchMove", 230);
  await app(page, (a) => a.pass(0.5));
  const { paddleX, stage } = await state(page);
  expect(`a finger drags the paddle, to ${paddleX}`, paddleX > 1 && stage === "ready");
  await send("touchEnd");
  await app(page, (a) => a.pass(0.1));
  expect("and lets the ball go", (await state(page)).stage === "playing");
  const small = await page.evaluate(() => [...document.querySelectorAll("#hud button")]
    .map((button) => button.getBoundingClientRect()).filter(({ width, height }) => width < 44 || height < 44).length);
  expect("buttons are large enough for a finger", small === 0);
  expect("nothing sticks out", await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await page.screenshot({ path: `${pictures}/play-360x740.png` });
  await context.close();
}

async function gamepad() {
  const { context, page } = await open();
  await page.evaluate(() => {
    const buttons = Array.from({ length: 17 }, () => ({ pressed: false }));
    window.pad = { connected: true, axes: [0, 0], buttons };
    navigator.getGamepads = () => [window.pad];
    window.squashout.app.start(0, 1);
    window.pad.axes[0] = 0.8;
    window.squashout.app.pass(0.4);
  });
  expect("the stick moves the paddle", (await state(page)).paddleX > 1);
  await page.evaluate(() => {
    window.pad.buttons[0].pressed = true;
    window.squashout.app.pass(0.1);
  });
  expect("its first button lets the ball go", (await state(page)).stage === "playing");
  await page.evaluate(() => {
    window.pad.buttons[9].pressed = true;
    window.squashout.app.pass(0.1);
  });
  expect("its start button pauses", await page.isVisible("#paused"));
  await context.close();
}

async function calmAndOffline() {
  const { context, page } = await open({ reducedMotion: "reduce" });
  expect("reduced motion is respected", await app(page, (a) => a.options.reducedMotion));
  const before = await state(page);
  await page.waitForTimeout(400);
  expect("the title's game stands still then", (await state(page)).steps === before.steps);
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.waitForFunction(async () => (await caches.keys()).length > 0 &&
    navigator.serviceWorker.controller !== null);
  await context.setOffline(true);
  await page.reload();
  await page.waitForFunction(() => window.squashout !== undefined);
  expect("it works without a network", await page.isVisible("#title"));
  await context.close();
}

async function goldens() {
  const { context, page } = await open();
  for (const name of ["flat", "gravity"]) {
    const play = readFileSync(new URL(`tests/golden/game-${name}.json`, root), "utf8");
    const hash = await page.evaluate((text) => window.squashout.engine.replay(text).hash, play);
    expect(`game-${name} has its hash in Chromium`, hash === JSON.parse(play).hash);
  }
  const wrong = await page.evaluate(() => {
    try {
      window.squashout.engine.replay("{");
      return "";
    } catch (error) {
      return error.message;
    }
  });
  expect("what is no play is refused with a message", wrong.includes("play"));
  await context.close();
}

let failed = false;
for (const test of [titleAndDialogs, keysToLosing, botToWinning, touch, gamepad, calmAndOffline, goldens]) {
  try {
    await test();
  } catch (error) {
    failed = true;
    console.error(`${test.name}: ${error.message}`);
  }
}
await browser.close();
server.close();
for (const fault of faults) console.error(`console: ${fault}`);
console.log(`game: ${checks} checks of the page in Chromium`);
process.exit(failed || faults.length > 0 ? 1 : 0);
