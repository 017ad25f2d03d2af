#!/usr/bin/env node
// Every task of the repository: `node tools/run.mjs <task> [arguments]`, which the npm scripts call.
// Depends on nothing but Node ≥ 20 and npm: it installs what is missing, builds what is stale, then runs the task.
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { ensureBuilt } from './pipeline/build.mjs';
import { formatArguments } from './pipeline/format.mjs';
import { ensureInstalled } from './pipeline/install.mjs';
import { TaskError, bin, main, root, stream } from './pipeline/process.mjs';

const node = (script, args = [], options = {}) => stream(process.execPath, [script, ...args], options);

/** Where the user typed the command: npm changes to the repository's root, and remembers. */
const userFolder = () => (process.env.npm_lifecycle_event && process.env.INIT_CWD) || process.cwd();

/** @type {Record<string, { help: string, build?: true | string[], run: (args: string[]) => Promise<number> }>} */
const tasks = {
  install: { help: 'install dependencies if they are missing or stale', run: async () => 0 },
  build: {
    help: 'build the packages whose sources changed (--force: all)',
    run: async (args) => {
      const { built, fresh } = await ensureBuilt({ force: args.includes('--force') });
      process.stderr.write(`${built.length} built, ${fresh.length} up to date\n`);
      return 0;
    },
  },
  demo: {
    help: 'path-trace the push-button into out/demo.png',
    build: ['cli'],
    run: (args) => node(join(root, 'tools/demo.mjs'), args),
  },
  start: { help: 'serve the playground', run: (args) => startPlayground(args) },
  glanz: {
    help: 'the glanz command: npm run glanz -- render model.glb -o out.png',
    build: ['cli'],
    run: (args) => node(join(root, 'packages/cli/dist/glanz.js'), args, { cwd: userFolder() }),
  },
  bench: {
    help: 'run a benchmark: npm run bench -- <name> --json FILE',
    run: (args) => node(join(root, 'tools/bench/src/main.mjs'), args, { cwd: userFolder() }),
  },
  'bench:pack': {
    help: 'bundle every benchmark for bare GPU machines into .gpu-bench/',
    run: (args) => node(join(root, 'tools/bench/src/pack.mjs'), args),
  },
  'contact-sheet': {
    help: 'render a folder of models into one page: npm run contact-sheet -- FOLDER',
    run: (args) => node(join(root, 'tools/contact-sheet/src/main.mjs'), args),
  },
  gallery: {
    help: 'render the images of the gallery into out/gallery (--only ID, --scale F, --samples N, --list)',
    run: (args) => node(join(root, 'tools/gallery/src/main.mjs'), args),
  },
  'gallery:pack': {
    help: 'bundle the gallery for bare GPU machines into .gallery-bench/',
    run: (args) => node(join(root, 'tools/gallery/src/pack.mjs'), args),
  },
  reference: {
    help: 'estimate the references of the glass scenes by brute force: npm run reference -- NAME',
    run: (args) => node(join(root, 'tools/reference/src/main.mjs'), args, { cwd: userFolder() }),
  },
  newcomer: {
    help: "a newcomer's first minutes, timed: packed packages, a fresh project, the README's quick start, pixels",
    build: true,
    run: (args) => node(join(root, 'tools/newcomer/src/main.mjs'), args),
  },
  docs: {
    help: 'serve the documentation',
    run: (args) =>
      node(bin('vitepress', 'bin/vitepress.js', join(root, 'apps/docs')), ['dev', join(root, 'apps/docs'), ...args], {
        cwd: join(root, 'apps/docs'),
      }),
  },
  'docs:build': {
    help: 'build the documentation into apps/docs/.vitepress/dist',
    run: (args) =>
      node(bin('vitepress', 'bin/vitepress.js', join(root, 'apps/docs')), ['build', join(root, 'apps/docs'), ...args], {
        cwd: join(root, 'apps/docs'),
      }),
  },
  typecheck: {
    help: 'check the types of everything',
    run: (args) => node(bin('typescript-native', 'bin/tsc'), ['--noEmit', '-p', 'tsconfig.json', ...args]),
  },
  format: {
    help: 'format the sources, lines up to 120 columns (--check: only say which are not)',
    run: (args) => node(bin('oxfmt', 'bin/oxfmt'), formatArguments(args.includes('--check'))),
  },
  lint: {
    help: 'oxlint, warnings are errors',
    run: (args) => node(bin('oxlint', 'bin/oxlint'), ['--deny-warnings', ...args]),
  },
  unit: {
    help: 'unit and GPU tests: npm run unit -- --project bvh',
    run: (args) => node(bin('vitest', 'vitest.mjs'), ['run', ...args]),
  },
  test: {
    help: 'everything that must pass (--only a,b or --skip a,b: stages; --list)',
    run: (args) => node(join(root, 'tools/test.mjs'), args),
  },
  release: {
    help: 'with --dry-run: the same as release:dry',
    run: async (args) => {
      if (!args.includes('--dry-run'))
        throw new TaskError(
          'A release is two commits of a maintainer: "npx changeset version", and after its review "npx changeset publish". See what would go out with --dry-run.',
        );
      await ensureBuilt({});
      return node(
        join(root, 'tools/release-dry.mjs'),
        args.filter((arg) => arg !== '--dry-run'),
      );
    },
  },
  'release:dry': {
    help: 'pack all packages as a release would, check them, and print the next versions',
    build: true,
    run: (args) => node(join(root, 'tools/release-dry.mjs'), args),
  },
};

function startPlayground(args) {
  const playground = join(root, 'apps/playground');
  if (!existsSync(join(playground, 'index.html')))
    throw new TaskError('apps/playground has no index.html: this checkout is incomplete.');
  return node(bin('vite', 'bin/vite.js', playground), [...args], { cwd: playground });
}

await main(async () => {
  const [name, ...args] = process.argv.slice(2);
  const task = name === undefined ? undefined : tasks[name];
  if (!task) {
    const width = Math.max(...Object.keys(tasks).map((key) => key.length));
    process.stderr.write(
      `${name === undefined ? '' : `glanz: there is no task "${name}". `}Tasks of node tools/run.mjs:\n${Object.entries(
        tasks,
      )
        .map(([key, { help }]) => `  ${key.padEnd(width)}  ${help}\n`)
        .join('')}`,
    );
    return name === undefined ? 0 : 1;
  }
  await ensureInstalled({ force: name === 'install' && args.includes('--force') });
  if (task.build) await ensureBuilt(task.build === true ? {} : { only: task.build });
  return task.run(args);
});
