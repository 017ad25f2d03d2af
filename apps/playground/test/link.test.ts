import { expect, test } from 'vitest';
import { decodeLink, difference, encodeLink } from '../src/state/link';
import { initialState, type State } from '../src/state/state';

const edited: State = {
  ...initialState('studio'),
  exposure: 0.7,
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
  expect((await encodeLink({ model: 'push-button', state: difference(initialState('studio')) })).length).toBeLessThan(90);
  expect((await encodeLink({ model: 'push-button', state: difference(edited) })).length).toBeLessThan(520);
});

test('pictures are not in the link, nor is what is as at the beginning', () => {
  const image = { name: 'p', width: 1, height: 1, data: new Uint8Array(4) };
  expect(Object.keys(difference({ ...initialState('none'), samples: 9, slots: { '0/base_color': { image, color_space: 'srgb', binding: { channels: 'rgb' } } } }))).toEqual(['samples', 'environment']);
});

test('what is no link, of another version, or spoiled anywhere gives nothing, and never throws', async () => {
  const link = await encodeLink({ model: 'a', state: difference(edited) });
  for (const bad of ['', '#', 'v1.', 'v1.####', link.replace('v1.', 'v2.'), link.slice(0, -12)]) expect(await decodeLink(bad), bad).toBeUndefined();
  for (let i = 3; i < link.length; i += 5) {
    const spoiled = `${link.slice(0, i)}${link[i] === 'A' ? 'B' : 'A'}${link.slice(i + 1)}`;
    const content = await decodeLink(spoiled);
    if (content) expect(typeof content.model).toBe('string');
  }
});

test('fields of another kind than the state has are left out', async () => {
  const state = { samples: 'many', exposure: null, rotation: 12, hidden: [1, 'x'], constant: [1, 2], materials: [], unheard: 5, orbit: null } as unknown as Partial<State>;
  const link = await encodeLink({ model: 'a', state });
  expect((await decodeLink(link))?.state).toEqual({ rotation: 12, orbit: null });
});
