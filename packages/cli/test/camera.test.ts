import { describe, expect, it } from 'vitest';
import { cameraFromJson, chooseCamera, lookAt } from '../src/camera';
import { CliError } from '../src/index';
import { temporaryFolder, triangleScene } from './fakes';

const close = (a: readonly number[], b: readonly number[]) =>
  a.forEach((v, i) => expect(v, `[${i}]`).toBeCloseTo(b[i] as number, 12));

describe('lookAt', () => {
  it('looks along −Z of its node', () => {
    close(lookAt([0, 0, 5], [0, 0, 0], [0, 1, 0]), [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1]);
    // From +X: right is −Z, back is +X.
    close(lookAt([5, 0, 0], [0, 0, 0], [0, 1, 0]), [0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 5, 0, 0, 1]);
  });
  it('finds a right axis even when looking straight down', () => {
    const m = lookAt([0, 3, 0], [0, 0, 0], [0, 1, 0]);
    close(m.slice(8, 11), [0, 1, 0]);
    expect(Math.hypot(...m.slice(0, 3))).toBeCloseTo(1, 12);
  });
});

describe('cameraFromJson', () => {
  it('takes degrees and metres', () => {
    const camera = cameraFromJson('{"position":[0,0,5],"target":[0,0,1],"fov":90,"lens_radius":0.01}');
    expect(camera).toMatchObject({
      type: 'perspective',
      name: 'camera',
      yfov: Math.PI / 2,
      lens_radius: 0.01,
      focus_distance: 4,
    });
  });
  it.each([
    ['{"position":[0,0,5]', 'not valid JSON'],
    ['[1]', 'must be an object'],
    ['{}', '"position" is missing'],
    ['{"position":[0,"a",5]}', '"position" must be three numbers'],
    ['{"position":[0,0,0],"target":[0,0,0]}', 'the same point'],
    ['{"position":[0,0,1],"fov":180}', '"fov" must be a number'],
    ['{"position":[0,0,1],"fow":35}', 'unknown field "fow"'],
    ['{"position":[0,0,1],"projection":"fisheye"}', 'must be one of perspective, orthographic, panorama'],
    ['{"position":[0,0,1],"projection":"orthographic"}', 'needs "height"'],
    ['{"position":[0,0,1],"projection":"panorama","fov":35}', 'has no "fov"'],
    ['{"position":[0,0,1],"height":2}', 'has no "height"'],
  ])('%s', (text, message) => {
    expect(() => cameraFromJson(text)).toThrow(CliError);
    expect(() => cameraFromJson(text)).toThrow(message);
  });
});

it('knows parallel projection, panoramas and apertures', () => {
  expect(cameraFromJson('{"position":[0,0,5],"projection":"orthographic","height":3}', 2)).toMatchObject({
    type: 'orthographic',
    xmag: 3,
    ymag: 1.5,
  });
  expect(cameraFromJson('{"position":[0,0,5],"projection":"panorama","name":"p"}')).toEqual({
    type: 'panorama',
    name: 'p',
    transform: lookAt([0, 0, 5], [0, 0, 0], [0, 1, 0]),
  });
  expect(cameraFromJson('{"position":[0,0,5],"lens_radius":0.1,"lens_blades":6,"lens_rotation":180}')).toMatchObject({
    lens_blades: 6,
    lens_rotation: Math.PI,
  });
});

describe('chooseCamera', () => {
  const scene = triangleScene();
  it('by name, by number, by JSON, by file; the first by default', async () => {
    const cwd = temporaryFolder({ 'view.json': '{"position":[1,2,3],"name":"view"}' });
    expect(await chooseCamera(scene, undefined, 1, cwd)).toBe(scene.cameras[0]);
    expect(await chooseCamera(scene, 'front', 1, cwd)).toBe(scene.cameras[0]);
    expect(await chooseCamera(scene, '0', 1, cwd)).toBe(scene.cameras[0]);
    expect((await chooseCamera(scene, '{"position":[1,2,3]}', 1, cwd)).type).toBe('perspective');
    expect((await chooseCamera(scene, 'view.json', 1, cwd)).name).toBe('view');
  });
  it('names the cameras there are when there is no such one', async () => {
    await expect(chooseCamera(scene, 'back', 1, '.')).rejects.toThrow('no camera "back"; it has 0 "front"');
    await expect(chooseCamera({ ...scene, cameras: [] }, '1', 1, '.')).rejects.toThrow('it has none');
    await expect(chooseCamera(scene, 'gone.json', 1, temporaryFolder())).rejects.toMatchObject({ code: 'cli/input' });
  });
  it('frames a scene that has none', async () => {
    const camera = await chooseCamera({ ...scene, cameras: [] }, undefined, 1.5, '.');
    expect(camera.type).toBe('perspective');
    // In front, to the right and above of a triangle at the origin.
    const [x, y, z] = [camera.transform[12], camera.transform[13], camera.transform[14]] as [number, number, number];
    expect(Math.min(x, y, z)).toBeGreaterThan(0.1);
  });
});
