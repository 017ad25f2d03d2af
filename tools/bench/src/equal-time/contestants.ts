import { createThreeGpuPathtracer } from '../peers/three-gpu-pathtracer';
import type { ContestantMaker } from './contestant';
import { createGlanz } from './glanz';

/** Who takes part, by the name in tables. */
export const CONTESTANTS = {
  glanz: createGlanz,
  /** Its options that trade truth for smoothness are off. */
  'three-gpu-pathtracer': (device, task) => createThreeGpuPathtracer(device, task, { defaults: false }),
  /** As its users get it. */
  'three-gpu-pathtracer (defaults)': (device, task) => createThreeGpuPathtracer(device, task, { defaults: true }),
} as const satisfies Record<string, ContestantMaker>;

export type ContestantName = keyof typeof CONTESTANTS;
