// SPDX-License-Identifier: MIT
//
// Does `lodestar check` find a problem in exactly the scenes in which Khronos' glTF validator finds an
// error (severity 0)? The differences allowed are the rows of a table in docs/gltf-acceptance.md: one
// that is not listed there fails, and so does a row that is no difference any more.
//
//   node validator.mjs LODESTAR DOCUMENT MODULE-FOLDER SCENE-FOLDER...
//
// Exit status 0: as documented; 1: not; 77: what it needs is missing, with a line "skipped: why".
import { spawnSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, dirname, join, relative, resolve } from 'node:path';

const [lodestar, page, modules, ...folders] = process.argv.slice(2).map((p) => resolve(p));

function skip(why) {
    console.log(`skipped: ${why}`);
    process.exit(77);
}

function scenesBelow(folder) {
    return readdirSync(folder, { recursive: true })
        .filter((name) => /\.(gltf|glb)$/.test(name))
        .sort()
        .map((name) => join(folder, name));
}

/// Rows "| `path/of/scene.gltf` | accepts or refuses | accepts or refuses | reason |" of the page.
function documented() {
    const rows = new Map();
    for (const line of readFileSync(page, 'utf8').split('\n')) {
        const row = line.match(/^\| `([^`]+\.(?:gltf|glb))` \| (\w+) \| (\w+) \| (.+) \|$/);
        if (row) {
            rows.set(row[1], { lodestar: row[2], validator: row[3], reason: row[4] });
        }
    }
    return rows;
}

/// The first few of what was found, for a line.
const few = (list) => list.slice(0, 3).join('; ') + (list.length > 3 ? `; and ${list.length - 3} more` : '');

/// Whether `check` is content. What it finds and mends is a problem too, though the file loads.
function ours(file) {
    const run = spawnSync(lodestar, ['check', file], { maxBuffer: 1 << 28, timeout: 60000 });
    if (run.status !== 0 && run.status !== 3) {
        throw new Error(`lodestar check ${file}: status ${run.status}, signal ${run.signal}`);
    }
    const problems = JSON.parse(run.stdout.toString()).problems;
    if (run.status === 3 && problems.length === 0) {
        throw new Error(`lodestar check ${file}: refused without a problem`);
    }
    return { accepts: problems.length === 0, says: few(problems.map((p) => `${p.message} ${p.pointer}`)) };
}

async function theirs(validator, file) {
    // A file that is no glTF at all is rejected by a failing promise instead of by a report.
    try {
        const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
            uri: basename(file),
            maxIssues: 0,
            externalResourceFunction: async (uri) =>
                new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri)))),
        });
        const errors = report.issues.messages.filter((message) => message.severity === 0);
        return { accepts: report.issues.numErrors === 0, says: few(errors.map((m) => `${m.code} ${m.pointer ?? ''}`)) };
    } catch (failure) {
        return { accepts: false, says: String(failure).split('\n')[0] };
    }
}

for (const folder of folders) {
    if (!existsSync(folder)) {
        skip(`needs the shared assets, which this machine lacks`);
    }
}
if (!existsSync(join(modules, 'gltf-validator'))) {
    skip(`needs Khronos' gltf-validator: tests/run.sh --long installs it where there is npm`);
}
const validator = createRequire(join(modules, 'x.js'))('gltf-validator');
const expected = documented();
const word = (verdict) => (verdict.accepts ? 'accepts' : 'refuses');
let agreed = 0;
let compared = 0;
const faults = [];
for (const folder of folders) {
    for (const file of scenesBelow(folder)) {
        const name = join(basename(folder), relative(folder, file));
        const mine = ours(file);
        const khronos = await theirs(validator, file);
        const row = expected.get(name);
        expected.delete(name);
        ++compared;
        agreed += mine.accepts === khronos.accepts ? 1 : 0;
        const asDocumented = row
            ? row.lodestar === word(mine) && row.validator === word(khronos) && row.lodestar !== row.validator
            : mine.accepts === khronos.accepts;
        if (!asDocumented) {
            faults.push(`${name}: lodestar ${word(mine)} (${mine.says}), the validator ${word(khronos)} (${khronos.says})` +
                (row ? `; the page says ${row.lodestar}, ${row.validator}` : '; not in the page'));
        }
    }
}
faults.push(...[...expected.keys()].map((name) => `${name}: in the page, but there is no such file`));
console.log(`gltf-validator ${validator.version()}: ${agreed} of ${compared} scenes agree, ${compared - agreed} differ`);
faults.forEach((fault) => console.log(`FAILED ${fault}`));
process.exit(faults.length > 0 || compared < 80 ? 1 : 0);
