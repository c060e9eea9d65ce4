// Every view at three sizes and in both themes: nothing is cut off, axe finds no serious fault; pictures to look at.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { assert, check, panel, pause } from "./harness.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
/** Those that the studio promises, and one between, which is looked at in one theme. */
const sizes = [
  [360, 740],
  [1280, 800],
  [2560, 1440],
  [940, 560],
];
const views = ["Scenes", "Tune", "Motion", "Things", "Keep"];

async function seriousFaults(page) {
  // The page lets no foreign scripts in: this one comes through the debugger.
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
  return violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(
      ({ id, nodes }) =>
        `${id}: ${nodes
          .slice(0, 3)
          .map(({ html, failureSummary }) => `${html.slice(0, 160)} ${failureSummary}`)
          .join(" | ")}`,
    );
}

/** Controls that stick out of the picture, unless what holds them scrolls. */
const cutOff = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll("button, select, input, a, output, h1, h2")]
      .filter((element) => {
        const box = element.getBoundingClientRect();
        if (box.width === 0 || element.closest(".panel-body, dialog, .visually-hidden") !== null) return false;
        const room = element.closest(".transport, .rail, .top")?.getBoundingClientRect() ?? {
          left: 0,
          top: 0,
          right: innerWidth,
          bottom: innerHeight,
        };
        return (
          box.left < room.left - 1 ||
          box.right > room.right + 1 ||
          box.top < room.top - 1 ||
          box.bottom > room.bottom + 1
        );
      })
      .map((element) => element.outerHTML.slice(0, 120)),
  );

const wide = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll(".panel-body, html")]
      .filter((element) => element.scrollWidth > element.clientWidth + 1)
      .map((element) => element.className || element.tagName),
  );

export async function lookAtViews(visit, pictures) {
  for (const theme of ["light", "dark"]) {
    for (const [width, height] of sizes) {
      if (theme === "dark" && (width === 940 || (width === 2560 && !process.env.ELASTOON_ALL_VIEWS))) continue;
      // Large pictures take long to draw by software: the quality stays low there.
      const page = await visit(`?quality=${width > 2000 ? 6 : 4}`, { width, height, colorScheme: theme });
      await pause(page);
      await page.getByRole("slider", { name: "Time" }).fill("1.05");
      const name = (view) => `${pictures}/${view}-${width}x${height}-${theme}.png`;
      await check(`${width} x ${height}, ${theme}`, async () => {
        await page.evaluate(() => (studio.panel.value = null));
        await page.screenshot({ path: name("start") });
        assert.deepEqual(await cutOff(page), []);
        for (const view of views) {
          await panel(page, view);
          await page.waitForTimeout(view === "Scenes" && theme === "light" ? 2500 : 350);
          await page.screenshot({ path: name(view.toLowerCase()) });
          assert.deepEqual(await cutOff(page), [], view);
          assert.deepEqual(await wide(page), [], view);
          if (width < 900 || width === 1280) assert.deepEqual(await seriousFaults(page), [], view);
        }
        await panel(page, "Tune");
        await page.getByRole("button", { name: "Compare A/B" }).click();
        await page.waitForTimeout(300);
        await page.screenshot({ path: name("compare") });
        assert.deepEqual(await cutOff(page), []);
        await page.getByRole("button", { name: "End the comparison" }).click();
        await page.getByRole("button", { name: "Help" }).click();
        await page.waitForTimeout(200);
        await page.screenshot({ path: name("help") });
        if (width === 1280) assert.deepEqual(await seriousFaults(page), [], "help");
      });
      await page.context().close();
    }
  }
}
