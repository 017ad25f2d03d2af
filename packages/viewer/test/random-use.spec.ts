import { fileURLToPath } from 'node:url';
import { injectFaults, servePage, watch, type Served } from '@glanz/browser';
import { expect, test } from '@playwright/test';
import { done, heard, model, open } from './open';

let served: Served;
test.beforeAll(async () => void (served = await servePage(fileURLToPath(new URL('page', import.meta.url)))));
test.afterAll(() => served.close());
test.use({ viewport: { width: 640, height: 480 } });

/** Of the random sequences; one of them where the full tests are not asked for. */
const seeds = process.env['GLANZ_FULL'] === undefined ? [4] : [...Array(40).keys()];

for (const seed of seeds)
  test(`whatever is done to it at whatever moment, the viewer comes to the same image: seed ${seed}`, async ({
    page,
  }) => {
    const complaints = watch(page, served.origin);
    await injectFaults(page);
    await open(page, served.origin, { preview: seed % 2 ? 'filtered' : 'auto' });
    const film = () => page.evaluate(async () => Array.from(await window.viewer.tracer!.read('beauty')).join());
    const before = await film();
    const { steps, codes } = await page.evaluate(
      async ([first, bytes]) => {
        const { viewer, gpuFaults: faults } = window;
        const canvas = document.querySelector('canvas')!;
        let state = (first as number) * 7919 + 1;
        const random = () => {
          state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
          return state / 2 ** 32;
        };
        const flip = () => random() < 0.5;
        const ends: Promise<unknown>[] = [];
        const codes: (string | number)[] = [];
        const later = (work: Promise<unknown>) =>
          void ends.push(
            work.catch(({ name, code }: { name: string; code?: string }) =>
              codes.push(name === 'AbortError' ? name : (code ?? name)),
            ),
          );
        let lost = 0;
        const actions: Record<string, () => unknown> = {
          pause: () => (viewer.paused = flip()),
          samples: () => (viewer.samples = 1 + Math.floor(40 * random())),
          noise: () => (viewer.noise = flip() ? 0.1 : undefined),
          depth: () => (viewer.maxDepth = 1 + Math.floor(4 * random())),
          orbit: () => viewer.setOrbit({ theta: random() - 0.5 }, { immediate: flip() }),
          size: () => (canvas.style.width = `${100 + Math.floor(300 * random())}px`),
          ratio: () => (viewer.pixelRatio = flip() ? 0.1 : 0.25),
          hide: () => faults.hide(flip()),
          colour: () => later(viewer.setMaterial('left', { base_color: [random(), 0, 0] })),
          variant: () => later(viewer.setVariant(flip() ? 'night' : undefined)),
          part: () => later(viewer.setVisibility('left', flip())),
          environment: () => later(viewer.setEnvironment({ type: 'constant', radiance: [random(), 1, 1] })),
          background: () => (viewer.background = flip() ? 'transparent' : 'environment'),
          ground: () => (viewer.ground = flip() ? { shadow: 0.5 } : undefined),
          preview: () => (viewer.previewMode = flip() ? 'raw' : 'filtered'),
          blob: () => later(viewer.toBlob({ width: 16, samples: 2 })),
          load: () => later(viewer.load(window.file(bytes as string, 'model.glb'))),
          lose: () => void (lost++ < 2 && window.loseGpu()),
          redraw: () => viewer.redraw(),
        };
        const names = Object.keys(actions);
        const steps: string[] = [];
        for (let i = 0; i < 40; i++) {
          const name = names[Math.floor(random() * names.length)]!;
          const wait = flip() ? 0 : Math.floor(250 * random());
          steps.push(`${name} ${wait}`);
          actions[name]!();
          if (wait > 0) await new Promise((resolve) => setTimeout(resolve, wait));
        }
        faults.hide(false);
        viewer.paused = false;
        await Promise.all(ends);
        canvas.style.width = '';
        Object.assign(viewer, {
          samples: 6,
          noise: undefined,
          maxDepth: 3,
          pixelRatio: 0.25,
          background: 'environment',
          ground: undefined,
        });
        await viewer.load(window.file(bytes as string, 'model.glb'));
        await viewer.setEnvironment({ type: 'constant', radiance: [1, 1, 1] });
        await viewer.setVariant(undefined);
        viewer.home({ immediate: true });
        return { steps, codes };
      },
      [seed, model.toString('base64')] as const,
    );
    await done(page);
    expect(await film(), steps.join(', ')).toBe(before);
    // What was asked for while there was no device, or was replaced by something later.
    const known = ['AbortError', 'renderer/device-lost', 'viewer/device-lost', 'viewer/no-scene'];
    expect(codes.filter((code) => !known.includes(String(code)))).toEqual([]);
    expect(await heard(page, 'error')).toEqual([]);
    expect(complaints).toEqual([]);
  });
