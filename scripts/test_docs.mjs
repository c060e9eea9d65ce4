// Runs what the documents say: every sh block, every cpp and c block (compiled and run), every js block (in Node), every json block
// (checked as a scene); every html block is a page for scripts/test_npm.sh; every relative link and every path in backticks must exist. Usage: node scripts/test_docs.mjs [FILE.md...]
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";

const root = resolve(dirname(new URL(import.meta.url).pathname), "..");
process.chdir(root);
const build = join(root, "build/docs");
mkdirSync(build, { recursive: true });
const files = process.argv.slice(2).length
  ? process.argv.slice(2)
  : execFileSync("git", ["ls-files", "*.md"], { encoding: "utf8" }).trim().split("\n");

let failures = 0;
let passed = 0;
function attempt(what, work) {
  try {
    work();
    passed += 1;
  } catch (error) {
    failures += 1;
    console.log(`FAILED ${what}\n${error.stdout ?? ""}${error.stderr ?? error.message}`);
  }
}
const run = (program, args) => execFileSync(program, args, { encoding: "utf8", stdio: "pipe", timeout: 600000 });

function runShell(text) {
  // The test command is what is running right now; the packed npm package is installed by scripts/test_npm.sh.
  const lines = text.split("\n").filter((line) => !/^\s*(\.\/test\b|npm install elastoon\b)/.test(line));
  run("bash", ["-euc", lines.join("\n")]);
}

function runCpp(text, index, file) {
  const name = join(build, `${file.replace(/\W/g, "_")}_${index}`);
  writeFileSync(`${name}.cpp`, text);
  const libraries = ["build/release/libelastoon.a"];
  run("g++", ["-std=c++20", "-Wall", "-Wextra", "-Werror", "-Iinclude", `${name}.cpp`, ...libraries, "-o", name]);
  run(name, []);
}

function runC(text, index, file) {
  const name = join(build, `${file.replace(/\W/g, "_")}_${index}`);
  writeFileSync(`${name}.c`, text);
  const warnings = ["-std=c11", "-pedantic", "-Wall", "-Wextra", "-Werror"];
  run("gcc", [...warnings, "-Iinclude", `${name}.c`, "build/release/libelastoon.a", "-lstdc++", "-lm", "-o", name]);
  run(name, []);
}

// Inside the package, which may be imported by its name there.
function runJs(text, index, file) {
  const folder = join(root, "web/package/build/docs");
  const name = join(folder, `${file.replace(/\W/g, "_")}_${index}.mjs`);
  mkdirSync(folder, { recursive: true });
  writeFileSync(name, text);
  run("node", [name]);
}

function runJson(text, index, file) {
  const name = join(build, `${file.replace(/\W/g, "_")}_${index}.json`);
  writeFileSync(name, text);
  run("build/release/elastoon", ["check", name]);
}

function checkLinks(text, file) {
  const prose = text.replace(/```[\s\S]*?```/g, "");
  for (const [, target] of prose.matchAll(/\]\(([^)#\s]+)(?:#[^)]*)?\)/g)) {
    if (!/^[a-z]+:/.test(target)) {
      attempt(`${file}: link ${target}`, () => {
        if (!existsSync(join(dirname(file), target))) throw new Error("no such file");
      });
    }
  }
  for (const [, path] of prose.matchAll(/`((?:src|include|apps|tests|scenes|scripts|docs)\/[\w./-]*)`/g)) {
    attempt(`${file}: path ${path}`, () => {
      if (!existsSync(path)) throw new Error("no such file");
    });
  }
}

for (const file of files) {
  const text = readFileSync(file, "utf8");
  checkLinks(text, file);
  let index = 0;
  for (const [, language, body] of text.matchAll(/```(\w+)\n([\s\S]*?)```/g)) {
    index += 1;
    const what = `${file}: ${language} block ${index}`;
    if (language === "sh") attempt(what, () => runShell(body));
    else if (language === "cpp") attempt(what, () => runCpp(body, index, file));
    else if (language === "c") attempt(what, () => runC(body, index, file));
    else if (language === "js") attempt(what, () => runJs(body, index, file));
    else if (language === "json") attempt(what, () => runJson(body, index, file));
  }
}
console.log(`docs: ${passed} passed, ${failures} failed`);
process.exit(failures === 0 ? 0 : 1);
