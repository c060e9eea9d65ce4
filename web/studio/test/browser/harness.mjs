// Serves the built page, opens it in Chromium, and keeps an eye on everything that it says on its console.
import assert from "node:assert/strict";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { preview } from "vite";

const root = fileURLToPath(new URL("../..", import.meta.url));

export async function open(chromium_path) {
  const server = await preview({ root, logLevel: "error", preview: { port: 0, host: "127.0.0.1" } });
  const browser = await chromium.launch({
    executablePath: chromium_path,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  const complaints = [];
  const address = server.resolvedUrls.local[0];

  /** A page of its own; `suffix` goes after the address. */
  async function visit(suffix = "", options = {}) {
    const { width = 1280, height = 800, before, expectFailure = false, ...rest } = options;
    const context = await browser.newContext({ viewport: { width, height }, acceptDownloads: true, ...rest });
    const page = await context.newPage();
    page.on("pageerror", (error) => complaints.push(`page error: ${error.message}`));
    page.on("console", (message) => {
      if (message.type() === "error") complaints.push(`console: ${message.text()}`);
    });
    page.on("dialog", (dialog) => {
      complaints.push(`dialog: ${dialog.message()}`);
      void dialog.dismiss();
    });
    if (before !== undefined) await page.addInitScript(before);
    await page.goto(address + suffix);
    if (!expectFailure) {
      await page.waitForSelector(".play", { timeout: 60000 });
      await page.waitForFunction(() => document.querySelector(".toast.busy") === null);
    }
    return page;
  }
  const close = async () => {
    await browser.close();
    await server.close();
  };
  return { visit, close, complaints, address, browser };
}

/** Chooses a panel unless it is open. */
export async function panel(page, name) {
  const button = page.getByRole("navigation", { name: "Panels" }).getByRole("button", { name });
  if ((await button.getAttribute("aria-pressed")) !== "true") await button.click();
  await page.getByRole("heading", { name, exact: true }).waitFor();
}

export const pause = async (page) => {
  if (await page.evaluate(() => studio.playing.value)) await page.locator(".play").click();
  await page.waitForFunction(() => !studio.playing.value);
};

/** Goes to a step by the time line's own slider, and gives the hash that the figures show there. */
export async function hashAt(page, step) {
  await page.getByRole("slider", { name: "Time" }).fill(String(Math.round((step / 60) * 240) / 240));
  await page.waitForFunction((wanted) => studio.step === wanted && !studio.playing.value, step);
  if (!(await page.evaluate(() => studio.showFigures.value))) {
    await page.evaluate(() => document.activeElement?.blur());
    await page.keyboard.press("f");
  }
  await page.locator(".figures").getByRole("button", { name: "hash" }).click();
  return page.locator(".figures code").textContent();
}

/** A text of the page's messages that matches; then they are gone. */
export async function told(page, words) {
  const pattern = typeof words === "string" ? words.replace(/[.*+?^${}()|[\]\\]/g, "\\$&") : words.source;
  const found = await page.waitForFunction(
    (source) => [...document.querySelectorAll(".toast:not(.busy)")].map((toast) => toast.innerText)
      .find((text) => new RegExp(source).test(text)),
    pattern, { timeout: 40000, polling: 50 });
  await page.evaluate(() => studio.toasts.value.forEach(({ id }) => studio.dismiss(id)));
  return found.jsonValue();
}

export async function download(page, act) {
  const coming = page.waitForEvent("download", { timeout: 180000 });
  await act();
  return coming;
}

/** Drops files on the page, or gives them to the file chooser. */
export const give = (page, ...files) =>
  page
    .locator('input[type="file"]')
    .setInputFiles(
      files.map(([name, content]) => ({ name, mimeType: "application/octet-stream", buffer: Buffer.from(content) })),
    );

let passed = 0;
export async function check(name, work) {
  const began = Date.now();
  try {
    await work();
  } catch (error) {
    error.message = `${name}: ${error.message}`;
    throw error;
  }
  passed += 1;
  if (process.env.ELASTOON_VERBOSE) console.log(`  ${name} (${((Date.now() - began) / 1000).toFixed(1)} s)`);
}
export const count = () => passed;
export { assert };
