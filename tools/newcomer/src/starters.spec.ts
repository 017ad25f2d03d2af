// npm create glanz, each template: from the command to pixels.
import { expect, test } from '@playwright/test';
import { Project } from './project';
import { requested, sees } from './sees';

test.setTimeout(600_000);
test.use({ viewport: { width: 480, height: 320 } });

let project: Project;
test.afterEach(() => project?.stop());

/** Template, and where its image is. */
const STARTERS = [
  ['vanilla', 'glanz-viewer'],
  ['react', 'glanz-viewer'],
  ['next', 'glanz-viewer'],
  ['three', '#traced.ready'],
  ['configurator', 'canvas'],
] as const;

for (const [template, selector] of STARTERS)
  test(`npm create glanz -- --template ${template}`, async ({ page: browser }) => {
    requested(`create-${template}`);
    project = new Project(`starter-${template}`);
    await project.create(template);
    await project.install();
    await project.timed('npm run build', () => project.run('npm', ['run', 'build']));
    const address = template === 'next' ? await project.serveNext() : await project.serve('preview');
    const { seconds, complaints } = await sees(browser, address, selector);
    const parts = Object.entries(project.timings).map(([what, ms]) => `${what} ${(ms / 1000).toFixed(1)} s`);
    console.log(`${template}: ${parts.join(', ')}, first pixels ${seconds.toFixed(1)} s`);
    // For the eye: later samples too.
    await browser.waitForTimeout(4000);
    await browser.screenshot({ path: `.cache/newcomer/starter-${template}.png` });
    expect(complaints).toEqual([]);
  });
