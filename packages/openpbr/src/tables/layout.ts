import { TABLE_LAYOUT } from './grid';

/**
 * Where the blocks of the dielectric table begin along its depth, in slices; shared by the WGSL text and its CPU twin.
 */
const outerTotal = TABLE_LAYOUT.outer;
const inner = outerTotal + TABLE_LAYOUT.outerTotal;
const innerTotal = inner + TABLE_LAYOUT.inner;

const stretched = innerTotal + TABLE_LAYOUT.innerTotal;

/** The dielectric table's blocks: first slice and number of slices. Names as in scripts/tables.mjs. */
export const TABLE_BLOCKS = {
  /**
   * Share of the energy that is reflected by all scattering, over the Fresnel reflectance at the softened cosine; seen
   * from the thinner medium.
   */
  outer: [0, TABLE_LAYOUT.outer],
  /** Energy that single scattering loses; seen from the thinner medium, over the cubic root of ε. */
  outerTotal: [outerTotal, TABLE_LAYOUT.outerTotal],
  /** The reflected part of single scattering; seen from the denser medium. */
  inner: [inner, TABLE_LAYOUT.inner],
  /** Energy that single scattering loses; seen from the denser medium. */
  innerTotal: [innerTotal, TABLE_LAYOUT.innerTotal],
  /**
   * What stretched mirrors keep by single scattering, less what round ones of the same masking do; over the roughness.
   * Rows: slopes along the view, for each of the anisotropies; the last column holds by how much of the round one's the
   * mean loss is less.
   */
  stretched: [stretched, TABLE_LAYOUT.stretched],
} as const;

/** Depth of the dielectric table in slices. */
export const TABLE_DEPTH = stretched + TABLE_LAYOUT.stretched;

/**
 * Angle samples of the dielectric table; one more column holds the mean over all directions. In the blocks of totals
 * the roughness lies along the rows instead, and the angles down the columns, with the mean in the last row.
 */
export const TABLE_ANGLES = TABLE_LAYOUT.angles;
export const TABLE_ROUGHNESSES = TABLE_LAYOUT.roughnesses;
export const TABLE_CONDUCTOR = TABLE_LAYOUT.conductor;
/** Cosines and roughnesses of the fuzz: blocks below the conductor's, as wide as that. */
export const SHEEN_COLUMNS = TABLE_LAYOUT.conductor + 1;
export const SHEEN_ROWS = TABLE_LAYOUT.sheen;

/** The two-dimensional table's blocks: first row and number of rows. */
export const TABLE_BLOCKS_2D = {
  /** What perfect mirrors lose by single scattering. */
  conductor: [0, TABLE_LAYOUT.conductor],
  /** Energy that fuzz reflects. */
  sheenAlbedo: [TABLE_LAYOUT.conductor, SHEEN_ROWS],
  /** The two numbers of its linearly transformed cosine. */
  sheenStretch: [TABLE_LAYOUT.conductor + SHEEN_ROWS, SHEEN_ROWS],
  sheenShear: [TABLE_LAYOUT.conductor + 2 * SHEEN_ROWS, SHEEN_ROWS],
} as const;

/** Height of the two-dimensional table in rows. */
export const TABLE_HEIGHT_2D = TABLE_LAYOUT.conductor + 3 * SHEEN_ROWS;

/**
 * Anisotropies 1/n, 2/n, … 1, and slopes along the view, of the block of stretched mirrors; one over the slope is
 * linear.
 */
export const STRETCHED_FLATS = 6;
export const STRETCHED_VIEWS = TABLE_LAYOUT.roughnesses / STRETCHED_FLATS;

/** The tables' first roughness, which is that of the smallest slope. */
export const TABLE_MIN_ROUGHNESS = 0.01;

/** Nearer to index 1 than this ε the tables are too coarse for what is seen from inside: it is summed over facets. */
export const INSIDE_NEAR = 0.04;

/**
 * Gauss and Legendre's nodes and weights, halved to 0 to 1: for the mean share of an interface that is summed over
 * facets, on either side of the critical angle.
 */
export const INNER_SUM_NODES = [
  [0.01985507175123188, 0.05061426814518813],
  [0.10166676129318664, 0.11119051722668724],
  [0.2372337950418355, 0.15685332293894366],
  [0.4082826787521751, 0.181341891689181],
  [0.5917173212478249, 0.181341891689181],
  [0.7627662049581645, 0.15685332293894366],
  [0.8983332387068134, 0.11119051722668724],
  [0.9801449282487681, 0.05061426814518813],
] as const;

/**
 * Facets that a stretched dielectric's energies from outside are summed over: of those that mirror upwards, and of all,
 * around the cap at each height.
 */
export const STRETCHED_MIRRORS = 32;
export const STRETCHED_AROUND = 10;

/**
 * Heights of the cap and weights of what passes there: Gauss and Legendre's over the root of the rest, since what
 * passes vanishes at the rim.
 */
export const STRETCHED_HEIGHTS = [
  [0.13404290741652147, 0.3237026417246205],
  [0.5511127007083099, 0.4369310725907613],
  [0.8910937442931661, 0.2152140822717851],
  [0.9951792190105739, 0.024152203412833254],
] as const;
