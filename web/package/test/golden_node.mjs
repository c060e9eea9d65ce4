// Golden hashes in Node. Usage: node test/golden_node.mjs
import { readFileSync } from "node:fs";
import * as elastoon from "elastoon";
import { runGoldens } from "./golden.mjs";

const root = new URL("../../../", import.meta.url);
const read = (path) => readFileSync(new URL(path, root), "utf8");
const { met, differing } = await runGoldens(elastoon, read("tests/golden/hashes.txt"), (name) => read(`scenes/${name}`));
differing.forEach((line) => console.error(line));
console.log(`Node ${process.versions.node}: ${met} golden hashes are met`);
process.exit(differing.length === 0 && met > 0 ? 0 : 1);
