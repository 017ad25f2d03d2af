import { execFileSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import sharp from 'sharp';
import { describe, expect, it } from 'vitest';
import { runCli } from '../src/index';
import { fakeIo, temporaryFolder } from './fakes';

/** A square of 1 × 1 m that moves from x = −2 m to 2 m in a second. */
function movingSquare(): string {
  const positions = Float32Array.of(-0.5, -0.5, 0, 0.5, -0.5, 0, 0.5, 0.5, 0, -0.5, 0.5, 0);
  const keys = Float32Array.of(0, 1, -2, 0, 0, 2, 0, 0);
  const indices = Uint16Array.of(0, 1, 2, 0, 2, 3);
  const bytes = Buffer.concat([positions, keys, indices].map(({ buffer }) => Buffer.from(buffer)));
  return JSON.stringify({
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    animations: [
      {
        name: 'across',
        channels: [{ sampler: 0, target: { node: 0, path: 'translation' } }],
        samplers: [{ input: 2, output: 3 }],
      },
    ],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 4, type: 'VEC3', min: [-0.5, -0.5, 0], max: [0.5, 0.5, 0] },
      { bufferView: 2, componentType: 5123, count: 6, type: 'SCALAR' },
      { bufferView: 1, componentType: 5126, count: 2, type: 'SCALAR', min: [0], max: [1] },
      { bufferView: 1, byteOffset: 8, componentType: 5126, count: 2, type: 'VEC3' },
    ],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: 48 },
      { buffer: 0, byteOffset: 48, byteLength: 32 },
      { buffer: 0, byteOffset: 80, byteLength: 12 },
    ],
    buffers: [{ byteLength: 92, uri: `data:application/octet-stream;base64,${bytes.toString('base64')}` }],
  });
}

// 8 pixels are a metre; the square's middle is in the middle of the image at half of the animation.
const camera = '{"position":[0,0,4],"projection":"orthographic","height":2}';
const common = ['--animation', 'across', '--camera', camera, '--size', '48x16', '--max-depth', '2'];

/** Coverage of the columns of an image along a row, 0 to 1. */
async function coverage(file: string, row = 8): Promise<number[]> {
  const { data, info } = await sharp(file).ensureAlpha().raw().toBuffer({ resolveWithObject: true });
  return Array.from({ length: info.width }, (_, x) => data[4 * (row * info.width + x) + 3]! / 255);
}

async function glanz(argv: readonly string[], cwd: string) {
  const io = fakeIo(cwd);
  const code = await runCli(['video', 'square.gltf', ...common, ...argv, '--gpu', 'software', '--json'], io);
  return { code, out: io.out.join(''), err: io.err.join('') };
}

const middle = (columns: readonly number[]) =>
  columns.reduce((sum, value, x) => sum + value * (x + 0.5), 0) / columns.reduce((sum, value) => sum + value, 0);

describe('frames of an animation', () => {
  it('show it at their times, and blurred by as much as it moves while the shutter is open', async () => {
    const cwd = temporaryFolder({ 'square.gltf': movingSquare() });
    const argv = ['--fps', '4', '--background', 'transparent', '--filter', 'box', '--samples', '64'];
    const still = await glanz([...argv, '-o', 'still/{frame}.png'], cwd);
    expect(still.code, still.err).toBe(0);
    const shutter = await glanz([...argv, '--shutter', '0.5', '-o', 'blur/{frame}.png'], cwd);
    expect(shutter.code, shutter.err).toBe(0);
    expect(JSON.parse(shutter.out)).toMatchObject({ total: 4, seconds: 1 });
    for (const frame of [1, 2]) {
      // A metre in a frame: 8 pixels, from column 8 on.
      const [sharpened, blurred] = [
        await coverage(join(cwd, `still/000${frame}.png`)),
        await coverage(join(cwd, `blur/000${frame}.png`)),
      ];
      expect(sharpened).toEqual(Array.from({ length: 48 }, (_, x) => Number(x >= 4 + 8 * frame && x < 12 + 8 * frame)));
      // Open for half of the frame: 4 pixels of motion. The ramp's values are exact but for the pixels' jitter in the
      // strata of time in which the edge crosses them, 18 of 64, with a variance of 1/4: five standard deviations.
      const tolerance = (5 * Math.sqrt(18 / 4)) / 64 + 1 / 255;
      blurred.forEach((value, x) => {
        const [enter, leave] = [x + 0.5 - (4 + 8 * frame), x + 0.5 - (12 + 8 * frame)];
        const ramp = (at: number) => Math.min(1, Math.max(0, at / 4));
        expect(Math.abs(value - (ramp(enter) - ramp(leave))), `frame ${frame}, column ${x}`).toBeLessThan(tolerance);
      });
      expect(Math.abs(middle(blurred) - (8 + 8 * frame + 2))).toBeLessThan(0.3);
    }
  });

  const ffmpeg = process.env['GLANZ_TEST_FFMPEG'] ?? 'ffmpeg';
  let installed = true;
  try {
    execFileSync(ffmpeg, ['-version'], { stdio: 'ignore' });
  } catch {
    installed = false;
  }
  it.runIf(installed).each(['film.mp4', 'film.webm'])('ffmpeg encodes them as %s', async (film) => {
    const cwd = temporaryFolder({ 'square.gltf': movingSquare() });
    const argv = ['--fps', '8', '--samples', '16', '--frames', 'frames', '--crf', '4', '--ffmpeg', ffmpeg, '-o', film];
    const { code, out, err } = await glanz(argv, cwd);
    expect(code, err).toBe(0);
    const { frames } = JSON.parse(out) as { frames: string[] };
    expect(frames.length).toBe(8);
    execFileSync(ffmpeg, ['-v', 'error', '-i', join(cwd, film), join(cwd, 'decoded-%d.png')]);
    for (const [index, frame] of frames.entries()) {
      const [made, decoded] = await Promise.all(
        [frame, `decoded-${index + 1}.png`].map((file) => sharp(join(cwd, file)).removeAlpha().raw().toBuffer()),
      );
      const error = made!.reduce((sum, value, i) => sum + (value - decoded![i]!) ** 2, 0) / made!.length;
      // Colours have half the resolution, and the square's edges are sharp.
      expect(10 * Math.log10(255 ** 2 / error)).toBeGreaterThan(30);
    }
    expect(existsSync(join(cwd, 'decoded-9.png'))).toBe(false);
  });
});
