// npm test — everything that must pass, in the order that finds mistakes soonest. Called through tools/run.mjs, which
// has installed the dependencies by now.
//
// npm test -- --list              the stages
// npm test -- --only types,unit   some of them
// npm test -- --skip e2e          all but some
// npm test -- --full              at full size what is a sample otherwise: every page in every width and theme
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { parseArgs } from 'node:util';
import { ensureBuilt } from './pipeline/build.mjs';
import { formatArguments } from './pipeline/format.mjs';
import { TaskError, bin, main, root, stream } from './pipeline/process.mjs';
import { columns, playwrightFailures, vitestFailures } from './pipeline/report.mjs';

const reports = join(root, '.cache', 'reports');
const node = (script, args, options) => stream(process.execPath, [script, ...args], options);

/** A stage that is one program: it passes if the program ends well. */
async function program(script, args) {
  const code = await node(script, args);
  return {
    passed: code === 0 ? 1 : 0,
    failed: code === 0 ? 0 : 1,
    lines: code === 0 ? [] : [`ended with code ${code}`],
  };
}

/** A stage that is a check of ours. */
const check = (file, name) => async () => (await import(file))[name]();

function readReport(file) {
  return existsSync(file) ? JSON.parse(readFileSync(file, 'utf8')) : undefined;
}

/** Seconds by test file, slowest first. @type {Map<string, [file: string, seconds: number][]>} */
const times = new Map();

/** Notes the time of each file of a stage. @returns {string[]} The slowest files, as lines of a table. */
function noteTimes(stage, entries, unit = 'seconds') {
  const byFile = new Map();
  for (const [file, ms] of entries) byFile.set(file, (byFile.get(file) ?? 0) + ms / 1000);
  const files = [...byFile]
    .map(([file, time]) => [relative(root, file).replaceAll('\\', '/'), Number(time.toFixed(1))])
    .sort((a, b) => b[1] - a[1]);
  times.set(stage, files);
  writeFileSync(join(reports, 'times.json'), `${JSON.stringify(Object.fromEntries(times), undefined, 1)}\n`);
  return columns([['slowest files', unit], ...files.slice(0, 12).map(([file, time]) => [file, String(time)])], [1]);
}

/** File and time of each test of Playwright's report. */
function playwrightTimes({ config, suites }) {
  const entries = [];
  const visit = (suite) => {
    for (const { file, tests } of suite.specs ?? [])
      for (const { results } of tests)
        entries.push([join(config.rootDir, file), results.reduce((sum, { duration }) => sum + duration, 0)]);
    for (const child of suite.suites ?? []) visit(child);
  };
  for (const suite of suites) visit(suite);
  return entries;
}

async function unit() {
  const file = join(reports, 'vitest.json');
  const cpu = join(reports, 'unit-times.jsonl');
  const code = await node(
    bin('vitest', 'vitest.mjs'),
    ['run', '--reporter=default', '--reporter=json', `--outputFile.json=${file}`],
    { env: { GLANZ_TEST_TIMES: cpu } },
  );
  const report = readReport(file);
  const { numPassedTests: passed = 0, numFailedTests = 0, numPendingTests: skipped = 0 } = report ?? {};
  // Errors outside of tests, and files that do not load, fail the run without failing a test.
  const failed = Math.max(numFailedTests, code === 0 ? 0 : 1, passed === 0 ? 1 : 0);
  const table = noteTimes(
    'unit',
    (existsSync(cpu) ? readFileSync(cpu, 'utf8').trim().split('\n') : [])
      .map((line) => JSON.parse(line))
      .map((entry) => [entry.file, entry.cpu * 1000]),
    'CPU seconds',
  );
  return {
    passed,
    failed,
    skipped,
    table,
    lines: [
      ...(report ? vitestFailures(report, root) : ['vitest left no report']),
      ...(report && failed > numFailedTests ? ['a test file or a hook failed outside of its tests: see above'] : []),
    ],
  };
}

async function e2e() {
  if (!existsSync(join(root, 'playwright.config.ts')))
    return { passed: 0, failed: 1, lines: ['there is no playwright.config.ts'] };
  const file = join(reports, 'playwright.json');
  const code = await node(bin('@playwright/test', 'cli.js'), ['test', '--reporter=list,json'], {
    env: { PLAYWRIGHT_JSON_OUTPUT_NAME: file },
  });
  const report = readReport(file);
  const { expected = 0, unexpected = 0, flaky = 0, skipped = 0 } = report?.stats ?? {};
  const { failed: lines, repeated } = report
    ? playwrightFailures(report)
    : { failed: ['playwright left no report'], repeated: [] };
  const passed = expected + repeated.length;
  const failed = Math.max(unexpected + flaky - repeated.length, code === 0 && passed > 0 ? 0 : 1);
  if (failed > 0 && lines.length === 0) lines.push(`playwright ended with code ${code}, ${passed} tests passed`);
  const table = report ? noteTimes('e2e', playwrightTimes(report)) : [];
  if (repeated.length > 0) table.push('repeated, because there was no browser', ...repeated);
  return { passed, failed, skipped, table, lines };
}

async function build() {
  const table = [];
  const { built, fresh } = await ensureBuilt({ log: (line) => table.push(line) });
  table.push(`${built.length} built, ${fresh.length} up to date`);
  return { passed: built.length + fresh.length, failed: 0, table };
}

/**
 * Stages run one after another, those with `beside` beside the others, and all are reported in this order. `beside`
 * names the stage after which one begins, because it reads what that one leaves, or writes what it reads. It prints
 * nothing itself, and keeps cores busy that the others leave idle.
 *
 * @type {{ name: string, title: string, beside?: string, run: () => Promise<import('./pipeline/report.mjs').CheckResult> }[]}
 */
const STAGES = [
  { name: 'imports', title: 'who imports whom', run: check('./check-imports.mjs', 'checkImports') },
  { name: 'exports', title: 'export maps and builds agree', run: check('./check-exports.mjs', 'checkExports') },
  {
    name: 'manifests',
    title: 'what all manifests share, LICENSE and CHANGELOG',
    run: check('./check-manifests.mjs', 'checkManifests'),
  },
  {
    name: 'lint',
    title: 'oxlint, warnings are errors',
    run: () => program(bin('oxlint', 'bin/oxlint'), ['--deny-warnings']),
  },
  {
    name: 'format',
    title: 'oxfmt, lines up to 120 columns',
    run: () => program(bin('oxfmt', 'bin/oxfmt'), formatArguments(true)),
  },
  { name: 'words', title: "the field's words", run: check('./check-words.mjs', 'checkWords') },
  { name: 'wesl', title: 'shader sources: lengths and conditions', run: check('./check-wesl.mjs', 'checkWesl') },
  {
    name: 'types',
    title: 'TypeScript 7, the whole repository',
    run: () => program(bin('typescript-native', 'bin/tsc'), ['--noEmit', '-p', 'tsconfig.json']),
  },
  { name: 'docs', title: 'a doc comment on every exported symbol', run: check('./check-docs.mjs', 'checkDocs') },
  { name: 'unit', title: 'unit and GPU tests, from sources', run: unit },
  // After the linter, which follows imports into builds.
  { name: 'build', title: 'every package', beside: 'lint', run: build },
  {
    name: 'published',
    title: 'publint, attw, declarations at consumers',
    beside: 'build',
    run: check('./check-published.mjs', 'checkPublished'),
  },
  { name: 'sizes', title: 'budgets', beside: 'published', run: check('./check-sizes.mjs', 'checkSizes') },
  {
    name: 'treeshake',
    title: 'one symbol brings only itself',
    beside: 'sizes',
    run: check('./check-treeshake.mjs', 'checkTreeShaking'),
  },
  {
    name: 'entries',
    title: 'importing does nothing, in bare Node',
    beside: 'treeshake',
    run: check('./check-entries.mjs', 'checkEntries'),
  },
  { name: 'e2e', title: 'playground and documentation in Chromium', run: e2e },
];

function chosenStages() {
  let values;
  try {
    ({ values } = parseArgs({
      options: {
        only: { type: 'string' },
        skip: { type: 'string' },
        list: { type: 'boolean' },
        full: { type: 'boolean' },
      },
    }));
  } catch (error) {
    throw new TaskError(`${error.message} Options: --only a,b, --skip a,b, --full, --list.`);
  }
  const names = (text) => text.split(',').map((name) => name.trim());
  for (const name of [...(values.only ? names(values.only) : []), ...(values.skip ? names(values.skip) : [])]) {
    if (!STAGES.some((stage) => stage.name === name))
      throw new TaskError(`there is no stage "${name}"; stages: ${STAGES.map((stage) => stage.name).join(', ')}.`);
  }
  if (values.list) return undefined;
  if (values.full) process.env['GLANZ_FULL'] = '1';
  return STAGES.filter(
    ({ name }) =>
      (values.only ? names(values.only).includes(name) : true) && !(values.skip && names(values.skip).includes(name)),
  );
}

/** The stage after which one begins: where that is not chosen, the one before it; undefined for none. */
function chosenBefore({ beside }, chosen) {
  if (beside === undefined || chosen.some(({ name }) => name === beside)) return beside;
  return chosenBefore(
    STAGES.find(({ name }) => name === beside),
    chosen,
  );
}

const seconds = (ms) => `${(ms / 1000).toFixed(1)} s`;

await main(async () => {
  const stages = chosenStages();
  if (!stages)
    return void process.stdout.write(`${columns(STAGES.map(({ name, title }) => [name, title])).join('\n')}\n`);
  rmSync(reports, { recursive: true, force: true });
  mkdirSync(reports, { recursive: true });
  const start = performance.now();
  /** Runs a stage; what it throws is its failure. */
  const attempt = async ({ run }) => {
    const from = performance.now();
    const end = (result) => ({ result, ms: performance.now() - from });
    try {
      return end(await run());
    } catch (error) {
      const line = error instanceof TaskError ? error.message : (error?.stack ?? String(error));
      return end({ passed: 0, failed: 1, lines: [line] });
    }
  };
  /** Ends of the stages that run beside the others. @type {Map<string, ReturnType<typeof attempt>>} */
  const begun = new Map();
  /** Those of the others that have ended. @type {Map<string, { promise: Promise<void>, resolve: () => void }>} */
  const ended = new Map(
    stages.map(({ name }) => {
      let resolve = () => undefined;
      const promise = new Promise((done) => (resolve = done));
      return [name, { promise, resolve }];
    }),
  );
  for (const stage of stages.filter(({ beside }) => beside !== undefined))
    begun.set(
      stage.name,
      (async () => {
        const before = chosenBefore(stage, stages);
        await (begun.get(before) ?? ended.get(before)?.promise);
        const end = await attempt(stage);
        if (end.result.failed > 0) process.stdout.write(`\n── ${stage.name} has failed, as is reported in its turn\n`);
        return end;
      })(),
    );
  const rows = [];
  /** Failures again at the end, where a log that was cut still has them. @type {string[]} */
  const failures = [];
  let passed = 0;
  let failed = 0;
  for (const stage of stages) {
    const { name, title } = stage;
    process.stdout.write(`\n── ${name}: ${title}\n`);
    const { result, ms } = await (begun.get(name) ?? attempt(stage));
    ended.get(name)?.resolve();
    for (const line of [...(result.table ?? []), ...(result.lines ?? [])]) process.stdout.write(`${line}\n`);
    passed += result.passed;
    failed += result.failed;
    if (result.failed > 0) failures.push(...(result.lines ?? []).slice(0, 20).map((line) => `${name}: ${line}`));
    rows.push([name, String(result.passed), String(result.failed), String(result.skipped ?? 0), seconds(ms)]);
  }
  rows.push([
    'all',
    String(passed),
    String(failed),
    String(rows.reduce((sum, row) => sum + Number(row[3]), 0)),
    seconds(performance.now() - start),
  ]);
  process.stdout.write(
    `\n${columns([['stage', 'passed', 'failed', 'skipped', 'time'], ...rows], [1, 2, 3, 4]).join('\n')}\n\n`,
  );
  if (failures.length > 0) process.stdout.write(`what failed\n${failures.join('\n')}\n\n`);
  process.stdout.write(`checks: ${passed} passed, ${failed} failed\n`);
  return failed > 0 ? 1 : 0;
});
