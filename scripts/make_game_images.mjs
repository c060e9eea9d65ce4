// Makes docs/images/squashout.png from the game's page, which must be built (scripts/build_page.sh game): three levels, played
// by the bot. Usage: node scripts/make_game_images.mjs
import { execFileSync } from "node:child_process";
import { fileURLToPath } from "node:url";
import { chromium } from "../web/game/node_modules/playwright-core/index.mjs";
import { serve } from "../web/game/test/serve.mjs";

const at = (path) => fileURLToPath(new URL(`../${path}`, import.meta.url));
const server = await serve(at("web/game/dist"));
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
const page = await browser.newPage({ viewport: { width: 520, height: 800 } });
await page.goto(server.url);
await page.waitForFunction(() => window.squashout !== undefined);
const files = [];
for (const [level, seconds] of [[3, 14], [6, 9], [7, 6]]) {
  await page.evaluate(([level, seconds]) => {
    const { app } = window.squashout;
    const { stage } = app.field;
    stage.watch = () => false; // a slow renderer's quality is not to be seen
    stage.setLevel(1);
    app.start(level, 5);
    app.bot = true;
    app.frame = ((frame) => (now) => window.held ? undefined : frame(now))(app.frame.bind(app));
    window.held = true;
    const still = () => {};
    app.screens.banner = still;
    app.pass(seconds);
    for (let i = 1; i <= 14; ++i) { // so that the ball has its trail
      window.held = false;
      app.last = 0;
      app.frame(1000 / 60);
      window.held = true;
    }
    app.last = 0;
  }, [level, seconds]);
  files.push(at(`build/game/level-${level + 1}.png`));
  await page.screenshot({ path: files.at(-1) });
}
await browser.close();
server.close();
const filter = "[0][1][2]hstack=inputs=3,scale=1170:-2,split[a][b];" +
  "[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=bayer:bayer_scale=4";
execFileSync("ffmpeg", ["-v", "error", "-y", ...files.flatMap((file) => ["-i", file]), "-filter_complex", filter,
  at("docs/images/squashout.png")]);
