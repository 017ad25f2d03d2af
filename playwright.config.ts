import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { defineConfig } from '@playwright/test';
import { FAST_COMPILATION, launchOptions } from './tools/browser/src/launch';

const launch = await launchOptions(fileURLToPath(new URL('.cache/browser', import.meta.url)));
// Programs are compiled as they are for users in `npm test -- --full`.
if (process.env['GLANZ_FULL'] === undefined) launch.args = [...launch.args!, ...FAST_COMPILATION];

export default defineConfig({
  // Those with the longest files first: what comes last runs alone.
  projects: ['apps/docs', 'apps/playground', 'packages/viewer', 'packages/element', 'packages/react', 'packages/three']
    .filter((folder) => existsSync(new URL(`${folder}/test`, import.meta.url)))
    .map((folder) => ({
      name: folder.slice(folder.indexOf('/') + 1),
      testDir: `${folder}/test`,
      testMatch: '**/*.spec.ts',
    }))
    // Wants packed packages and the registry: npm run newcomer brings them.
    .concat(
      process.env['GLANZ_NEWCOMER']
        ? [{ name: 'newcomer', testDir: 'tools/newcomer/src', testMatch: '**/*.spec.ts' }]
        : [],
    ),
  outputDir: '.cache/playwright',
  globalSetup: fileURLToPath(new URL('tools/browser/src/run.ts', import.meta.url)),
  // The software GPU renders on all cores, but compiles each program on one, and pages are built, loaded and waited for
  // in between: three at a time keep two cores busy.
  workers: 3,
  timeout: 120_000,
  // Now and then a browser does not start. `npm test` lets a repeated test pass only then: see playwrightFailures().
  retries: 1,
  expect: { timeout: 60_000 },
  forbidOnly: true,
  reporter: 'list',
  use: {
    viewport: { width: 1280, height: 800 },
    launchOptions: launch,
  },
});
