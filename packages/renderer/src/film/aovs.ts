import type { AovName } from '../options';

/** Samples of a film that its AOVs average: they converge sooner than light. */
export const AOV_SAMPLES = 64;

/** Buffers of the film that hold AOVs, each with its bytes per pixel. */
export const AOV_BUFFERS = { aov_albedo: 16, aov_normal: 16, aov_position: 16, aov_ids: 16, aov_motion: 8 } as const;

export type AovBuffer = keyof typeof AOV_BUFFERS;

/** Where an AOV lies: its buffer, and its place in it, in 32-bit numbers. */
export interface AovPlace {
  readonly buffer: AovBuffer;
  readonly format: 'float32' | 'uint32';
  readonly stride: number;
  readonly offset: number;
  readonly channels: number;
}

const place = (
  buffer: AovBuffer,
  offset: number,
  channels: number,
  format: AovPlace['format'] = 'float32',
): AovPlace => ({ buffer, format, stride: 4, offset, channels });

/** The place of each AOV: numbers share the vec4f of the vector that they go with. */
export const AOV_PLACES: Readonly<Record<AovName, AovPlace>> = {
  albedo: place('aov_albedo', 0, 3),
  coverage: place('aov_albedo', 3, 1),
  normal: place('aov_normal', 0, 3),
  depth: place('aov_normal', 3, 1),
  position: place('aov_position', 0, 3),
  virtualDepth: place('aov_position', 3, 1),
  objectId: place('aov_ids', 0, 1, 'uint32'),
  materialId: place('aov_ids', 1, 1, 'uint32'),
  roughness: place('aov_ids', 3, 1),
  motion: { buffer: 'aov_motion', format: 'float32', stride: 2, offset: 0, channels: 2 },
};

/** The kernels' flags for AOVs that are requested. Albedo and coverage are always with the others. */
export function aovFlags(aovs: readonly AovName[]): Readonly<Record<string, boolean>> {
  const needs = (buffer: AovBuffer) => aovs.some((name) => AOV_PLACES[name].buffer === buffer);
  return {
    AOVS: aovs.length > 0,
    AOV_NORMAL: needs('aov_normal'),
    AOV_POSITION: needs('aov_position'),
    // Which sample is nearest is kept with the ids.
    AOV_IDS: needs('aov_ids') || needs('aov_motion'),
    AOV_MOTION: needs('aov_motion'),
  };
}

/** The film's buffers for kernels with these flags. */
export const aovBuffers = (flags: Readonly<Record<string, boolean>>): AovBuffer[] => [
  ...(flags.AOVS ? (['aov_albedo'] as const) : []),
  ...(flags.AOV_NORMAL ? (['aov_normal'] as const) : []),
  ...(flags.AOV_POSITION ? (['aov_position'] as const) : []),
  ...(flags.AOV_IDS ? (['aov_ids'] as const) : []),
  ...(flags.AOV_MOTION ? (['aov_motion'] as const) : []),
];
