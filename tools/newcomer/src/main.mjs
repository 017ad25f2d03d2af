// npm run newcomer — see README.md. Packs, then starts Playwright.
import { bin, main, root, stream } from '../../pipeline/process.mjs';
import { packAll } from '../../pipeline/packed.mjs';

await main(async () => {
  const from = performance.now();
  const packages = await packAll();
  process.stdout.write(`packed ${packages.length} packages in ${((performance.now() - from) / 1000).toFixed(1)} s\n`);
  const env = {
    GLANZ_NEWCOMER: JSON.stringify(Object.fromEntries(packages.map(({ name, tarball }) => [name, tarball]))),
  };
  return stream(
    process.execPath,
    [bin('@playwright/test', 'cli.js'), 'test', '--project=newcomer', ...process.argv.slice(2)],
    { env, cwd: root },
  );
});
