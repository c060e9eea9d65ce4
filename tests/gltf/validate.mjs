// Judges a .glb file of `elastoon simulate` from outside: the Khronos validator must find nothing, and three.js must
// show every body where the pose table says: node validate.mjs FILE.glb POSES.csv
import { readFileSync } from 'node:fs';
import { AnimationMixer, LoopOnce, Matrix4, Quaternion, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import validator from 'gltf-validator';

const kTolerance = 1e-5; // of the body's size, and of its distance from the origin

function fail(message) {
    console.error(`validate: ${message}`);
    process.exit(1);
}

/** Errors and warnings of the Khronos validator, and its hints, as lines. */
async function judge(bytes) {
    const report = await validator.validateBytes(bytes, { maxIssues: 100 });
    const kinds = ['error', 'warning', 'information', 'hint'];
    const lines = report.issues.messages.map((m) => `${kinds[m.severity]} ${m.code} ${m.pointer}: ${m.message}`);
    return { grave: report.issues.numErrors + report.issues.numWarnings, lines, info: report.info };
}

/** Rows of a CSV text as arrays of cells (RFC 4180). */
function parseCsv(text) {
    const rows = [[]];
    const cell = /(?:"((?:[^"]|"")*)"|([^",\r\n]*))(,|\r?\n|$)/gy;
    while (cell.lastIndex < text.length) {
        const match = cell.exec(text);
        if (!match) {
            fail(`the pose table cannot be read at character ${cell.lastIndex}`);
        }
        rows.at(-1).push(match[1] === undefined ? match[2] : match[1].replaceAll('""', '"'));
        if (match[3] !== ',') {
            rows.push([]);
        }
    }
    return rows.filter((row) => row.length > 1);
}

/** The poses by frame: [{ time, bodies: Map(name -> Matrix4) }]. */
function readPoses(file) {
    const [header, ...rows] = parseCsv(readFileSync(file, 'utf8'));
    const column = Object.fromEntries(header.map((name, index) => [name, index]));
    const frames = [];
    for (const row of rows) {
        const number = (name) => Number(row[column[name]]);
        if (frames.at(-1)?.time !== number('time')) {
            frames.push({ time: number('time'), bodies: new Map() });
        }
        const across = 1 / Math.sqrt(number('stretch'));
        const matrix = new Matrix4().compose(
            new Vector3(number('px'), number('py'), number('pz')),
            new Quaternion(number('qx'), number('qy'), number('qz'), number('qw')),
            new Vector3(number('stretch'), across, across));
        frames.at(-1).bodies.set(row[column.body], matrix);
    }
    return frames;
}

function loadGltf(bytes) {
    const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
    return new Promise((resolve, reject) => new GLTFLoader().parse(buffer, '', resolve, reject));
}

/** Body nodes by the names in the file: three.js takes spaces and dots out of `name`. */
function nodesByName(scene) {
    const nodes = new Map();
    scene.traverse((node) => {
        if (node.parent === scene) {
            nodes.set(node.userData.name ?? node.name, node);
        }
    });
    return nodes;
}

/** Largest difference of two matrices, over what kTolerance is relative to. */
function mismatch(found, wanted) {
    const position = Math.hypot(wanted.elements[12], wanted.elements[13], wanted.elements[14]);
    return found.elements.reduce((worst, value, i) => {
        const scale = i >= 12 && i <= 14 ? Math.max(1, position) : 1;
        return Math.max(worst, Math.abs(value - wanted.elements[i]) / scale);
    }, 0);
}

/** Strictly rising times, unit quaternions, and no step between quaternions the long way round. */
function checkTracks(clip) {
    for (const track of clip.tracks) {
        for (let i = 1; i < track.times.length; ++i) {
            if (!(track.times[i] > track.times[i - 1])) {
                fail(`${track.name}: the time of key ${i} does not rise`);
            }
            if (track.name.endsWith('.quaternion')) {
                const a = track.values.subarray(4 * i - 4, 4 * i);
                const b = track.values.subarray(4 * i, 4 * i + 4);
                if (a.reduce((sum, value, j) => sum + value * b[j], 0) < 0) {
                    fail(`${track.name}: the quaternion of key ${i} goes the long way round`);
                }
            }
        }
    }
}

/** Plays the animation to each frame of the table and compares. */
function comparePoses(gltf, frames) {
    const [clip] = gltf.animations;
    if (!clip) {
        fail('the file has no animation');
    }
    checkTracks(clip);
    const mixer = new AnimationMixer(gltf.scene);
    const action = mixer.clipAction(clip);
    action.setLoop(LoopOnce, 1);
    action.clampWhenFinished = true;
    action.play();
    const nodes = nodesByName(gltf.scene);
    const keys = new Set(clip.tracks.flatMap((track) => [...track.times]));
    let worst = 0;
    for (const { time, bodies } of frames) {
        const key = Math.fround(time);
        if (!keys.has(key)) {
            fail(`no key at ${time} s`);
        }
        action.reset().play();
        mixer.setTime(key);
        gltf.scene.updateMatrixWorld(true);
        for (const [name, wanted] of bodies) {
            const node = nodes.get(name) ?? fail(`no node is named "${name}"`);
            const difference = mismatch(node.matrixWorld, wanted);
            worst = Math.max(worst, difference);
            if (!(difference <= kTolerance)) {
                fail(`"${name}" at ${time} s is off by ${difference}:\nfound  ${node.matrixWorld.elements.join(' ')}\n`
                    + `wanted ${wanted.elements.join(' ')}`);
            }
        }
    }
    return { worst, keys: keys.size };
}

const [file, poses] = process.argv.slice(2);
if (!file) {
    console.error('use: node validate.mjs FILE.glb [POSES.csv]');
    process.exit(2);
}
const bytes = new Uint8Array(readFileSync(file));
const verdict = await judge(bytes);
verdict.lines.forEach((line) => console.log(line));
if (verdict.grave > 0) {
    fail(`${file}: the Khronos validator finds ${verdict.grave} errors and warnings`);
}
console.log(`validator: no errors, no warnings; ${verdict.info.drawCallCount} draw calls, `
    + `${verdict.info.totalTriangleCount} triangles`);
const gltf = await loadGltf(bytes);
if (poses) {
    const frames = readPoses(poses);
    const rows = frames.reduce((sum, frame) => sum + frame.bodies.size, 0);
    if (rows === 0) {
        console.log('three.js: read; the pose table has no rows');
    } else {
        const { worst, keys } = comparePoses(gltf, frames);
        console.log(`three.js: ${rows} poses in ${frames.length} frames agree, ${keys} key times, worst difference `
            + worst.toExponential(2));
    }
}
