import { expect, test } from 'vitest';
import { RENDER_OPTIONS } from '@glanz/renderer/options';
import { LIMITS } from '../src/state/limits';
import { decodeLink, difference, encodeLink, linkContent } from '../src/state/link';
import { textForReceiver, textForSender } from '../src/state/link-texts';
import { initialState, type State } from '../src/state/state';

const edited: State = {
  ...initialState('studio'),
  exposure: 0.7,
  denoise: false,
  rotation: -35,
  orbit: { target: [0.01, -0.02, 0.123456], distance: 0.4, yaw: 0.3, pitch: -0.2, zoom: 1 },
  materials: { 3: { base_color: [0.1, 0.2, 0.3], specular_roughness: 0.25 }, 11: { base_metalness: 1 } },
  hidden: [2, 5],
  boxes: [{ azimuth: 0.3, elevation: 0.5, width: 0.7, height: 0.4, radiance: [3, 2, 1] }],
  background: 'color',
  lens: { projection: 'perspective', fov: 20, stop: 2.8, blades: 7, focus: 0.31 },
};

test('a state comes back from its link, to six digits', async () => {
  const link = await encodeLink({ model: 'push-button', state: difference(edited) });
  expect(link).toMatch(/^v1\.[\w-]+$/);
  expect(await decodeLink(`#${link}`)).toEqual({ model: 'push-button', state: difference(edited) });
});

test('an untouched state is a short link, a worked-on one still fits into a message', async () => {
  expect((await encodeLink({ model: 'push-button', state: difference(initialState('studio')) })).length).toBeLessThan(
    90,
  );
  expect((await encodeLink({ model: 'push-button', state: difference(edited) })).length).toBeLessThan(520);
});

test('images are not in the link, nor is what is as at the beginning', () => {
  const image = { name: 'p', width: 1, height: 1, data: new Uint8Array(4) };
  expect(
    Object.keys(
      difference({
        ...initialState('none'),
        samples: 9,
        slots: { '0/base_color': { image, color_space: 'srgb', binding: { channels: 'rgb' } } },
      }),
    ),
  ).toEqual(['samples', 'environment']);
});

test('a link names the files that it cannot hold, when it is made and when it is opened', async () => {
  const image = { name: 'p', width: 1, height: 1, data: new Uint8Array(4) };
  const slot = { image, color_space: 'srgb', binding: { channels: 'rgb' } } as const;
  const whole = linkContent('push-button', edited, 'old.hdr');
  expect(whole).toEqual({ model: 'push-button', state: difference(edited) });
  expect([textForSender(whole, false), textForReceiver(whole, false)]).toEqual(['', '']);
  const content = linkContent(
    'chair.glb',
    { ...initialState('file'), slots: { '0/base_color': slot, '1/base_color': null } },
    'sky.exr',
  );
  const opened = await decodeLink(await encodeLink(content));
  expect(opened).toEqual({ ...content, files: { environment: 'sky.exr', images: 2 } });
  for (const text of [textForSender(content, true), textForReceiver(opened!, true)])
    expect(text).toContain('the model "chair.glb", the environment "sky.exr" and 2 changed textures on materials');
  // Links that were made before name no file.
  expect(
    textForReceiver((await decodeLink(await encodeLink({ model: 'a', state: { environment: 'file' } })))!, false),
  ).toContain('created with the environment, which it does not contain. Drop that file');
  // What an address says is read with care.
  const spoiled = await decodeLink(
    await encodeLink({ model: 'a', state: {}, files: { environment: 'x'.repeat(1000), images: -1 } }),
  );
  expect(spoiled?.files).toEqual({ environment: 'x'.repeat(200) });
});

test('what is no link, of another version, or spoiled anywhere gives nothing, and never throws', async () => {
  const link = await encodeLink({ model: 'a', state: difference(edited) });
  for (const bad of ['', '#', 'v1.', 'v1.####', link.replace('v1.', 'v2.'), link.slice(0, -12)])
    expect(await decodeLink(bad), bad).toBeUndefined();
  for (let i = 3; i < link.length; i += 5) {
    const spoiled = `${link.slice(0, i)}${link[i] === 'A' ? 'B' : 'A'}${link.slice(i + 1)}`;
    const content = await decodeLink(spoiled);
    if (content) expect(typeof content.model).toBe('string');
  }
});

test('fields of another kind than the state has are left out', async () => {
  const state = {
    samples: 'many',
    exposure: null,
    rotation: 12,
    hidden: [1, 'x'],
    constant: [1, 2],
    materials: [],
    unheard: 5,
    orbit: null,
  } as unknown as Partial<State>;
  const link = await encodeLink({ model: 'a', state });
  expect((await decodeLink(link))?.state).toEqual({ rotation: 12, orbit: null });
});

test('numbers are brought into the ranges of the page, and what is deep inside is of its own kind', async () => {
  const read = async (state: object) =>
    (await decodeLink(await encodeLink({ model: 'a', state: state as Partial<State> })))?.state;
  for (const [maxDepth, expected] of [
    [0, 1],
    [1.5, 2],
    [1e9, 64],
    [-3, 1],
  ] as const)
    expect(await read({ maxDepth })).toEqual({ maxDepth: expected });
  // The name of the field in links that were made before it changed.
  expect(await read({ depth: 5 })).toEqual({ maxDepth: 5 });
  expect(
    await read({
      samples: 1e9,
      noise: -1,
      exposure: 1e30,
      intensity: -5,
      rotation: 1e30,
      backgroundBlur: 0,
      constant: [-1, 2, 1e30],
      camera: -7.2,
      time: -1,
      clip: 0.4,
    }),
  ).toEqual({
    samples: 65536,
    noise: 0,
    exposure: 8,
    intensity: 0,
    rotation: 3600,
    backgroundBlur: 2,
    constant: [0, 2, 1e4],
    camera: -1,
    time: 0,
    clip: 0,
  });
  for (const wrong of [
    5,
    'far',
    [],
    {},
    { target: [1, 2], distance: 1, yaw: 0, pitch: 0 },
    { target: [1, 2, null], distance: 1, yaw: 0, pitch: 0 },
    { target: [0, 0, 0], distance: '1', yaw: 0, pitch: 0 },
  ]) {
    expect(await read({ orbit: wrong }), JSON.stringify(wrong)).toEqual({});
  }
  expect(await read({ orbit: { target: [1e30, 0, 0], distance: -1, yaw: 1e30, pitch: 9, zoom: 0 } })).toEqual({
    orbit: { target: [1e9, 0, 0], distance: 1e-9, yaw: 1000, pitch: Math.PI / 2, zoom: 0.001 },
  });
  expect(await read({ lens: { projection: 'fisheye', fov: 400, stop: -1, blades: 2.6, focus: 'near' } })).toEqual({
    lens: { projection: 'perspective', fov: 170, stop: 0, blades: 3, focus: null },
  });
  expect(await read({ boxes: [{ azimuth: 0, elevation: 0, width: 9, height: 0, radiance: -1 }] })).toEqual({
    boxes: [{ azimuth: 0, elevation: 0, width: Math.PI - 0.01, height: 0.01, radiance: 0 }],
  });
  for (const boxes of [7, ['x'], [{}], [null], Array.from({ length: 65 }, () => edited.boxes?.[0])])
    expect(await read({ boxes })).toEqual({});
  expect(
    await read({
      groups: { a: { intensity: 1e9, color: 'red' }, b: 3 },
      materials: { 0: { base_metalness: 1 }, 1: 5, 2: null },
      hidden: [1.5],
      variant: 4,
      studio: 'barn',
      toneMap: 'film',
      scale: 3,
      floor: 1,
      environment: null,
    }),
  ).toEqual({
    groups: { a: { intensity: 1000, color: [1, 1, 1] } },
    materials: { 0: { base_metalness: 1 } },
  });
});

test('a few letters that unpack to megabytes are no link', async () => {
  const link = await encodeLink({ model: 'a'.repeat(20_000_000), state: {} });
  expect(link.length).toBeLessThan(50_000);
  expect(await decodeLink(link)).toBeUndefined();
});

test("the page's limits of render options lie within the options' ranges", () => {
  for (const name of Object.keys(LIMITS) as (keyof typeof LIMITS)[]) {
    const [low, high] = RENDER_OPTIONS[name].range;
    expect(LIMITS[name][0], name).toBeGreaterThanOrEqual(low);
    expect(LIMITS[name][1], name).toBeLessThanOrEqual(high);
  }
});
