import type { RenderOptionName } from '@glanz/renderer/options';

/**
 * Limits of this page for render options, within their ranges: an address comes from anywhere, and must not keep a GPU
 * busy for hours.
 */
export const LIMITS = { samples: [1, 65_536], noise: [0, 1], maxDepth: [1, 64] } as const satisfies Partial<
  Record<RenderOptionName, readonly [number, number]>
>;
