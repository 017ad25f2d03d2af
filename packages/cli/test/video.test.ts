import { chmodSync, existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { ScenePoser } from '@glanz/gltf/animation';
import type { Camera } from '@glanz/scene';
import sharp from 'sharp';
import { describe, expect, it } from 'vitest';
import { parseVideo } from '../src/commands/video';
import { fakeIo, run, temporaryFolder, triangleScene } from './fakes';

/** A program that answers as ffmpeg does, and writes down what it was given. */
function fakeFfmpeg(cwd: string, { encoders = 'libx264 libvpx-vp9', fails = '' } = {}): string {
  const path = join(cwd, 'ffmpeg');
  writeFileSync(
    path,
    `#!${process.execPath}
const { writeFileSync } = require('node:fs');
const args = process.argv.slice(2);
if (args.includes('-encoders')) console.log(${JSON.stringify(encoders)});
else if (${JSON.stringify(fails)}) { console.error(${JSON.stringify(fails)}); process.exit(3); }
else {
  const parts = [];
  process.stdin.on('data', (part) => parts.push(part)).on('end', () => {
    writeFileSync(${JSON.stringify(join(cwd, 'args.json'))}, JSON.stringify(args));
    writeFileSync(${JSON.stringify(join(cwd, 'stdin.bin'))}, Buffer.concat(parts));
    writeFileSync(args.at(-1), 'a film');
  });
}
`,
  );
  chmodSync(path, 0o755);
  return path;
}

/** The PNG files in a stream of them. */
function pngsOf(bytes: Buffer): Buffer[] {
  const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  const starts: number[] = [];
  for (let at = bytes.indexOf(signature); at >= 0; at = bytes.indexOf(signature, at + 1)) starts.push(at);
  return starts.map((start, i) => bytes.subarray(start, starts[i + 1]));
}

const small = ['--size', '4x2', '--samples', '4', '--json'];
/** Degrees that a camera has gone around the y axis. */
const azimuth = ({ transform: m }: Camera) => (Math.atan2(m[8]!, m[10]!) * 180) / Math.PI;

describe('glanz video', () => {
  it('renders the frames of a turntable and gives them to ffmpeg, in their order', async () => {
    const cwd = temporaryFolder({ 'm.glb': '' });
    const ffmpeg = fakeFfmpeg(cwd);
    const angles: number[] = [];
    const argv = ['video', 'm.glb', '--seconds', '1', '--fps', '8', '--degrees', '180', '--ffmpeg', ffmpeg, ...small];
    const { code, out, err, created } = await run(argv, cwd, { onCamera: (camera) => angles.push(azimuth(camera)) });
    expect(code, err).toBe(0);
    expect(JSON.parse(out)).toMatchObject({
      ok: true,
      file: 'm.mp4',
      bytes: 6,
      codec: 'h264',
      width: 4,
      height: 2,
      fps: 8,
      seconds: 1,
      total: 8,
      skipped: 0,
    });
    // One tracer; its first camera is that of the first frame. Each frame sets its camera, and poses it when it begins.
    expect(created.length).toBe(1);
    const frames = [...new Set(angles.map((angle) => Math.round(10 * angle) / 10))];
    expect(frames).toEqual([0, 22.5, 45, 67.5, 90, 112.5, 135, 157.5]);
    const pngs = await Promise.all(pngsOf(readFileSync(join(cwd, 'stdin.bin'))).map((png) => sharp(png).metadata()));
    expect(pngs.map(({ width, height }) => [width, height])).toEqual(Array.from({ length: 8 }, () => [4, 2]));
    const args = JSON.parse(readFileSync(join(cwd, 'args.json'), 'utf8')) as string[];
    const after = (name: string) => args.slice(args.indexOf(name)).find((_, i) => i === 1);
    expect([after('-framerate'), args.filter((_, i) => args[i - 1] === '-c:v'), after('-pix_fmt')]).toEqual([
      '8',
      ['png', 'libx264'],
      'yuv420p',
    ]);
    expect([after('-i'), args.at(-3), args.at(-2)]).toEqual(['pipe:0', '-f', 'mp4']);
    // The frames have gone, with their folder and journal.
    expect(readdirSync(cwd).sort()).toEqual(['args.json', 'ffmpeg', 'm.glb', 'm.mp4', 'stdin.bin']);
  });

  it('poses the camera and the animation at times of the shutter, and adds up their samples', async () => {
    const cwd = temporaryFolder({ 'm.glb': '' });
    const posed: [unknown, number][] = [];
    const cameras: [number, number][] = [];
    const poser = {
      animations: [{ name: 'walk', duration: 0.5 }],
      pose: (name: unknown, time: number) => {
        posed.push([name, time]);
        return { transforms: [{ instance: 0, transform: [time] }], visibility: [], lights: [], meshes: [] };
      },
    } as unknown as ScenePoser;
    const argv = ['video', 'm.glb', '-o', 'f/{frame}.png', '--animation', 'walk', '--fps', '4', '--degrees', '40'];
    const { code, err, edits, out } = await run([...argv, '--shutter', '0.5', '--shutter-times', '2', ...small], cwd, {
      scene: { ...triangleScene(), animations: [{ name: 'walk', duration: 0.5 }] },
      openAnimations: async () => poser,
      onCamera: (camera, samples) => cameras.push([azimuth(camera), samples]),
    });
    expect(code, err).toBe(0);
    expect(JSON.parse(out)).toMatchObject({ seconds: 0.5, frames: ['f/0000.png', 'f/0001.png'], total: 2 });
    expect(posed.length).toBe(4);
    // Two frames of a quarter of a second, whose shutters are open for half of it, in two strata.
    for (const [index, [name, time]] of posed.entries()) {
      const from = Math.floor(index / 2) / 4 + (index % 2) / 16;
      expect(name).toBe('walk');
      expect(time).toBeGreaterThanOrEqual(from);
      expect(time).toBeLessThan(from + 1 / 16);
    }
    expect(edits.filter(([what]) => what === 'instance 0').map(([, to]) => to)).toEqual(
      posed.map(([, time]) => [time]),
    );
    // The camera turns by 80 degrees a second, at the same times; the second pose finds the samples of the first.
    const turned = cameras.filter(([angle]) => posed.some(([, time]) => Math.abs(angle - 80 * time) < 1e-3));
    expect(turned.map(([, samples]) => samples)).toEqual([0, 2, 0, 2]);
  });

  it('goes on with --resume: finished frames are kept when ffmpeg fails', async () => {
    const cwd = temporaryFolder({ 'm.glb': '' });
    const ffmpeg = fakeFfmpeg(cwd, { fails: 'no space left' });
    const argv = ['video', 'm.glb', '-o', 'a/film.webm', '--seconds', '3', '--fps', '1', '--ffmpeg', ffmpeg, ...small];
    const cwdFiles = () => readdirSync(join(cwd, 'a/film.frames')).filter((name) => name.endsWith('.png'));
    const first = await run(argv, cwd);
    expect([first.code, existsSync(join(cwd, 'a'))]).toEqual([4, false]);
    mkdirSync(join(cwd, 'a'));
    const failed = await run(argv, cwd);
    expect(failed.code).toBe(1);
    expect(JSON.parse(failed.out)).toMatchObject({ ok: false, error: { code: 'cli/ffmpeg' } });
    expect(failed.err).toContain('no space left');
    expect(cwdFiles()).toEqual(['0000.png', '0001.png', '0002.png']);
    expect(readdirSync(join(cwd, 'a'))).toEqual(['film.frames']);
    fakeFfmpeg(cwd);
    const again = await run([...argv, '--resume'], cwd);
    expect(again.code, again.err).toBe(0);
    expect(JSON.parse(again.out)).toMatchObject({ ok: true, total: 3, skipped: 3, codec: 'vp9' });
    expect(again.created.length).toBe(0);
    expect(readdirSync(join(cwd, 'a'))).toEqual(['film.webm']);
    expect(pngsOf(readFileSync(join(cwd, 'stdin.bin'))).length).toBe(3);
    // Another shutter is another film.
    const kept = ['--frames', 'kept', '--resume'];
    await run([...argv, ...kept], cwd);
    const other = await run([...argv, ...kept, '--shutter', '0.5'], cwd);
    expect(JSON.parse(other.out)).toMatchObject({
      skipped: 0,
      frames: ['kept/0000.png', 'kept/0001.png', 'kept/0002.png'],
    });
  });

  it('says what to install before anything is rendered', async () => {
    const cwd = temporaryFolder({ 'm.glb': '' });
    const argv = ['video', 'm.glb', ...small, '--ffmpeg'];
    const missing = await run([...argv, join(cwd, 'nowhere')], cwd);
    expect([missing.code, missing.created.length]).toEqual([1, 0]);
    expect(missing.err).toMatch(/needs? ffmpeg.*ENOENT.*apt install ffmpeg.*--ffmpeg.*\{frame\}\.png.*\[cli\/ffmpeg\]/);
    const poor = await run([...argv, fakeFfmpeg(cwd, { encoders: 'libvpx-vp9' })], cwd);
    expect(poor.err).toMatch(/no encoder libx264.*--codec/);
    expect(poor.created.length).toBe(0);
  });

  it('leaves no film behind when it is interrupted, and the frames that are done', async () => {
    const cwd = temporaryFolder({ 'm.glb': '' });
    const io = fakeIo(cwd);
    let samples = 0;
    const argv = ['video', 'm.glb', '--seconds', '3', '--fps', '1', '--ffmpeg', fakeFfmpeg(cwd), ...small];
    const { code, out } = await run(argv, cwd, { onSample: () => void (++samples === 6 && io.interrupt()) }, io);
    expect(code).toBe(130);
    expect(JSON.parse(out)).toMatchObject({ ok: false, interrupted: 'SIGINT' });
    expect(readdirSync(cwd).sort()).toEqual(['ffmpeg', 'm.frames', 'm.glb']);
    expect(readdirSync(join(cwd, 'm.frames')).sort()).toEqual(['.glanz-journal.jsonl', '0000.png']);
  });

  it.each([
    [['m.glb', '--turntable', '8'], /--degrees/],
    [['m.glb', '--noise', '0.1'], /same samples/],
    [['m.glb', '-o', 'a.png'], /frames\/\{frame\}\.png/],
    [['m.glb', '--size', '5x4'], /even/],
    [['m.glb', '--camera', '0', '--degrees', '30'], /one of the two/],
    [['m.glb', '--camera', '0', '--elevation', '30'], /--degrees/],
    [['m.glb', '-o', 'a.webm', '--codec', 'h264'], /vp9, av1/],
    [['m.glb', '--codec', 'theora'], /h264, h265/],
    [['m.glb', '--crf', '99'], /from 0 to 51/],
    [['m.glb', '-o', 'f/{frame}.png', '--crf', '9'], /--codec and --crf/],
    [['m.glb', '-o', 'f/{frame}.png', '--frames', 'g'], /--output says/],
    [['m.glb', '--shutter', '2'], /from 0 to 1/],
    [['m.glb', '--variant', 'all'], /one variant/],
    [['m.glb', '--shuter', '1'], /--shutter/],
    [[], /No model/],
  ] as const)('refuses %j', (argv, message) => {
    expect(() => parseVideo(argv)).toThrow(
      expect.objectContaining({ code: 'cli/usage', message: expect.stringMatching(message) }),
    );
  });

  it('an animation that the model does not have is refused', async () => {
    const cwd = temporaryFolder({ 'm.glb': '' });
    const argv = ['video', 'm.glb', '-o', '{frame}.png', '--animation', 'run', ...small];
    const { code, err } = await run(argv, cwd, {
      scene: { ...triangleScene(), animations: [{ name: 'walk', duration: 1 }] },
    });
    expect([code, err]).toEqual([2, expect.stringContaining('it has "walk"')]);
  });
});
