// Made by scripts/tables.mjs; do not edit.

/** How many angles, roughnesses and slices of indices the tables hold. */
export const TABLE_LAYOUT = {
  angles: 17,
  roughnesses: 24,
  outer: 20,
  outerTotal: 18,
  inner: 12,
  innerTotal: 20,
  stretched: 12,
  conductor: 40,
  sheen: 24,
} as const;
