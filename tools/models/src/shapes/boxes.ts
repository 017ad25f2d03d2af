import { extrude } from './extrude';
import { FINE } from './lathe';
import type { MeshBuilder } from './mesh-builder';
import { closedOutline, rectangle } from './outline';
import type { Tessellation } from './tessellation';

/** Options for {@link roundedBox}. Millimetres. */
export interface RoundedBoxOptions {
  /** Centre of the base. */
  readonly at?: readonly [number, number, number];
  readonly size: readonly [width: number, depth: number, height: number];
  /** Rounds the four upright edges; larger than `edge`. */
  readonly corner: number;
  /** Rounds the edges at the top and the bottom. */
  readonly edge: number;
  readonly tessellation?: Tessellation;
}

/** A box that stands on z = at[2], all edges rounded. */
export function roundedBox(
  builder: MeshBuilder,
  { at = [0, 0, 0], size, corner, edge, tessellation = FINE }: RoundedBoxOptions,
): void {
  extrude(builder, closedOutline(rectangle(at[0], at[1], size[0], size[1], corner), tessellation), [], {
    bottom: at[2],
    top: at[2] + size[2],
    bottomRadius: edge,
    topRadius: edge,
    tessellation,
  });
}

/** A flat rectangle in the plane z = 0 that faces +z, centred. */
export function panel(builder: MeshBuilder, width: number, height: number): void {
  const [w, h] = [width / 2, height / 2];
  const corner = (x: number, y: number) => builder.vertex(x, y, 0, 0, 0, 1);
  builder.quad(corner(-w, -h), corner(w, -h), corner(w, h), corner(-w, h));
}
