import type { KernelFamily } from '@glanz/denoise';

/**
 * Ways to share a layer among threads, side by side: threads along x and y, rows of four pixels and output channels a
 * thread; then what is different from the default.
 */
export const VARIANTS: readonly KernelFamily[] = [
  { threadsX: 8, threadsY: 8, rows: 2, outputs: 8, maxGroups: 4 },
  { threadsX: 8, threadsY: 8, rows: 2, outputs: 8, maxGroups: 2 },
  { threadsX: 8, threadsY: 8, rows: 2, outputs: 8, maxGroups: 1 },
  { threadsX: 16, threadsY: 4, rows: 2, outputs: 8, maxGroups: 4 },
  { threadsX: 16, threadsY: 4, rows: 2, outputs: 8, maxGroups: 2 },
  { threadsX: 8, threadsY: 4, rows: 2, outputs: 8 },
  { threadsX: 8, threadsY: 4, rows: 2, outputs: 8, maxGroups: 2 },
  { threadsX: 8, threadsY: 4, rows: 4, outputs: 4 },
  { threadsX: 8, threadsY: 4, rows: 4, outputs: 4, maxGroups: 4 },
  { threadsX: 16, threadsY: 4, rows: 4, outputs: 4, maxGroups: 4 },
  { threadsX: 8, threadsY: 8, rows: 2, outputs: 4 },
  { threadsX: 16, threadsY: 4, rows: 2, outputs: 4 },
  { threadsX: 4, threadsY: 4, rows: 2, outputs: 8 },
  { threadsX: 4, threadsY: 8, rows: 2, outputs: 8 },
  { threadsX: 4, threadsY: 8, rows: 2, outputs: 4 },
  { threadsX: 2, threadsY: 4, rows: 2, outputs: 4 },
  { threadsX: 4, threadsY: 8, rows: 1, outputs: 4 },
  { threadsX: 4, threadsY: 8, rows: 1, outputs: 8 },
  { threadsX: 2, threadsY: 8, rows: 1, outputs: 4, maxGroups: 4 },
  { threadsX: 8, threadsY: 4, rows: 4, outputs: 8 },
  { threadsX: 8, threadsY: 8, rows: 2, outputs: 8, weights: 'storage' },
];

/** A family as text. */
export const familyName = ({ threadsX, threadsY, rows, outputs, weights, maxGroups }: KernelFamily): string =>
  `${threadsX}x${threadsY} threads of 4x${rows}x${outputs}${maxGroups === undefined ? '' : `, at most ${maxGroups} groups`}${weights === 'storage' ? ', weights unstaged' : ''}`;
