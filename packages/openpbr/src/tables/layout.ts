import { OPENPBR_ANISOTROPIC_FLATS } from './constants.wesl';
import {
  OPENPBR_TABLE_ANGLES,
  OPENPBR_TABLE_CONDUCTOR,
  OPENPBR_TABLE_INNER,
  OPENPBR_TABLE_INNER_TOTAL,
  OPENPBR_TABLE_OUTER,
  OPENPBR_TABLE_OUTER_TOTAL,
  OPENPBR_TABLE_ROUGHNESSES,
  OPENPBR_TABLE_SHEEN,
  OPENPBR_TABLE_ANISOTROPIC,
} from './grid.wesl';

/** Where the blocks of the dielectric table begin along its depth, in slices. */
const outerTotal = OPENPBR_TABLE_OUTER;
const inner = outerTotal + OPENPBR_TABLE_OUTER_TOTAL;
const innerTotal = inner + OPENPBR_TABLE_INNER;

const anisotropic = innerTotal + OPENPBR_TABLE_INNER_TOTAL;

/** The dielectric table's blocks: first slice and number of slices. Names as in scripts/tables.mjs. */
export const TABLE_BLOCKS = {
  /**
   * Share of the energy that is reflected by all scattering, over the Fresnel reflectance at the softened cosine; seen
   * from the thinner medium.
   */
  outer: [0, OPENPBR_TABLE_OUTER],
  /** Energy that single scattering loses; seen from the thinner medium, over the cubic root of ε. */
  outerTotal: [outerTotal, OPENPBR_TABLE_OUTER_TOTAL],
  /**
   * The reflected part of single scattering; seen from the denser medium. The last column holds what goes through in
   * the mean, by all scattering, over η^(2 - roughness).
   */
  inner: [inner, OPENPBR_TABLE_INNER],
  /** Energy that single scattering loses; seen from the denser medium. */
  innerTotal: [innerTotal, OPENPBR_TABLE_INNER_TOTAL],
  /**
   * What anisotropic mirrors keep by single scattering, less what round ones of the same masking do; over the
   * roughness. Rows: slopes along the view, for each of the anisotropies; the last column holds by how much of the
   * round one's the mean loss is less.
   */
  anisotropic: [anisotropic, OPENPBR_TABLE_ANISOTROPIC],
} as const;

/** Depth of the dielectric table in slices. */
export const TABLE_DEPTH = anisotropic + OPENPBR_TABLE_ANISOTROPIC;

/**
 * Angle samples of the dielectric table; one more column holds the mean over all directions. In the blocks of totals
 * the roughness lies along the rows instead, and the angles down the columns, with the mean in the last row.
 */
export const TABLE_ANGLES = OPENPBR_TABLE_ANGLES;
export const TABLE_ROUGHNESSES = OPENPBR_TABLE_ROUGHNESSES;
export const TABLE_CONDUCTOR = OPENPBR_TABLE_CONDUCTOR;
/** Cosines and roughnesses of the fuzz: blocks below the conductor's, as wide as that. */
export const SHEEN_COLUMNS = OPENPBR_TABLE_CONDUCTOR + 1;
export const SHEEN_ROWS = OPENPBR_TABLE_SHEEN;

/** The two-dimensional table's blocks: first row and number of rows. */
export const TABLE_BLOCKS_2D = {
  /** What perfect mirrors lose by single scattering. */
  conductor: [0, OPENPBR_TABLE_CONDUCTOR],
  /** Energy that fuzz reflects. */
  sheenAlbedo: [OPENPBR_TABLE_CONDUCTOR, SHEEN_ROWS],
  /** The two numbers of its linearly transformed cosine. */
  sheenStretch: [OPENPBR_TABLE_CONDUCTOR + SHEEN_ROWS, SHEEN_ROWS],
  sheenShear: [OPENPBR_TABLE_CONDUCTOR + 2 * SHEEN_ROWS, SHEEN_ROWS],
} as const;

/** Height of the two-dimensional table in rows. */
export const TABLE_HEIGHT_2D = OPENPBR_TABLE_CONDUCTOR + 3 * SHEEN_ROWS;

/** Slopes along the view, of the block of anisotropic mirrors; one over the slope is linear. */
export const ANISOTROPIC_VIEWS = OPENPBR_TABLE_ROUGHNESSES / OPENPBR_ANISOTROPIC_FLATS;
