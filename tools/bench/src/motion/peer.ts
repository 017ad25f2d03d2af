import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { watchedDevice } from '../equal-time/device';
import { BenchError } from '../error';
import { createThreeGpuPathtracer } from '../peers/three-gpu-pathtracer';
import { orbitCamera } from './movements';
import { MOTION_SCENES } from './scenes';

/** Frames of an orbit that three-gpu-pathtracer is to render, in a process of its own. */
export interface PeerPlan {
  readonly scene: string;
  readonly width: number;
  readonly height: number;
  readonly maxDepth: number;
  /** Samples that each pixel of a frame has at least. */
  readonly samples: number;
  /** The last frame. */
  readonly last: number;
  /** Frames whose images are written to the folder. */
  readonly kept: readonly number[];
  readonly folder: string;
  /** Part of the adapter's name. */
  readonly gpu?: string;
}

/** What became of a {@link PeerPlan}. */
export interface PeerFrames {
  readonly milliseconds: readonly number[];
  /** Rounds of a frame, which carry every path one bounce further. */
  readonly rounds: number;
  /** Samples a pixel of the last frame: the mean, and those of the pixel with fewest. */
  readonly samples: number;
  readonly minSamples: number;
}

/** Rounds after which a renderer that gets no further is given up, for each sample and edge of a path. */
const PATIENCE = 8;

/** File of a frame: linear RGBA, stride 4, top row first, as floats. */
export const frameFile = (folder: string, frame: number): string => join(folder, `${frame}.rgba`);

/**
 * Renders an orbit as planned, from nothing at each frame, with the settings that users get but at full size at once:
 * by default it shows a tenth of the width and height until it has rested for half a second.
 *
 * @throws {BenchError} `bench/failed` where it gets no samples, `bench/gpu-error`.
 */
export async function peerFrames(plan: PeerPlan, log: (line: string) => void): Promise<PeerFrames> {
  const { width, height, maxDepth } = plan;
  const what = `${plan.scene}, three-gpu-pathtracer`;
  const motionScene = MOTION_SCENES[plan.scene]!;
  const product = await motionScene.load(width / height);
  const { camera, scene } = product;
  if (camera.type !== 'perspective') throw new BenchError('bench/failed', `${what}: its camera has no perspective.`);
  const { device, check } = await watchedDevice(plan.gpu, what);
  const task = { ...(await motionScene.file(product)), camera, width, height, maxDepth, multipleScattering: true };
  const { environment } = scene;
  const peer = await createThreeGpuPathtracer(device, environment ? { ...task, environment } : task, {
    defaults: true,
  });
  await peer.restart(1);
  // A frame has as many rounds as the first one needs, so that nothing is read back while frames are timed.
  let rounds = 0;
  while ((await peer.minSamples()) < plan.samples) {
    if (rounds++ >= PATIENCE * plan.samples * (maxDepth + 8))
      throw new BenchError('bench/failed', `${what}: pixels without a sample after ${rounds} rounds.`);
    await peer.advance(1);
  }
  check();
  log(`${what}: ${rounds} rounds a frame`);
  const milliseconds: number[] = [];
  for (let frame = 0; frame <= plan.last; frame++) {
    const started = performance.now();
    peer.setCamera(orbitCamera(product, frame) as typeof camera);
    await peer.advance(rounds);
    milliseconds.push(performance.now() - started);
    if (!plan.kept.includes(frame)) continue;
    const rgb = await peer.read();
    const rgba = Float32Array.from({ length: (4 * rgb.length) / 3 }, (_, i) =>
      i % 4 === 3 ? 1 : rgb[3 * (i >> 2) + (i % 4)]!,
    );
    writeFileSync(frameFile(plan.folder, frame), rgba);
  }
  const [samples, minSamples] = [await peer.samples(), await peer.minSamples()];
  check();
  peer.destroy();
  device.destroy();
  return { milliseconds, rounds, samples, minSamples };
}
