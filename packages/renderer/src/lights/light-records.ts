import type { DiskLight, Light, ProfileLight, RectangleLight, SphereLight } from '@glanz/scene';
import {
  LIGHT_DIRECTIONAL,
  LIGHT_DISK,
  LIGHT_HIDDEN,
  LIGHT_POINT,
  LIGHT_PROFILE,
  LIGHT_RECTANGLE,
  LIGHT_SPHERE,
  LIGHT_SPOT,
  lightStruct,
  NONE,
} from '../storage/layout';
import { cross, type Vector } from '../vector';
import type { ProfileGrid } from './light-profile';
import type { TreeLights } from './light-bounds';

/** Luminance of a colour, linear Rec. 709. */
export const luminance = (c: ArrayLike<number>): number =>
  0.2126 * (c[0] as number) + 0.7152 * (c[1] as number) + 0.0722 * (c[2] as number);

/** Where a field of a light record lies, in words. */
export const wordOf = (field: Parameters<typeof lightStruct.offsetOf>[0]): number => lightStruct.offsetOf(field) / 4;

const unit = (v: Vector): Vector => {
  const length = Math.hypot(...v);
  return [v[0] / length, v[1] / length, v[2] / length];
};
const scaled = (v: Vector, factor: number): Vector => [v[0] * factor, v[1] * factor, v[2] * factor];

/** Whether a ray can meet the light. */
export const hasSize = (light: Light): light is RectangleLight | DiskLight | SphereLight =>
  light.type === 'rectangle' || light.type === 'disk' || light.type === 'sphere';

/** Unit vectors along a flat light's width and height, so that width × height is its direction. */
function axesOf(light: RectangleLight | DiskLight | ProfileLight): [Vector, Vector] {
  const n = unit(light.direction);
  const tangent = light.type === 'disk' ? undefined : light.tangent;
  // Straight up or down, level is any direction.
  const along = tangent ?? (Math.abs(n[1]) > 0.999999 ? ([1, 0, 0] as const) : cross([0, 1, 0], n));
  const height = unit(cross(n, along));
  return [cross(height, n), height];
}

/**
 * Writes one of the scene's lights with what the tree needs to know, and returns its power.
 * @param profile For a light with one: it on the grid, and the record that it will begin at.
 */
export function writeLight(
  records: ArrayBuffer,
  tree: TreeLights,
  index: number,
  light: Light,
  sceneRadius: number,
  group: number,
  profile?: { readonly grid: ProfileGrid; readonly first: number },
): number {
  const color = light.color.map((c) => c * light.intensity);
  const ids = [NONE, NONE, NONE, NONE];
  const bright = luminance(color);
  const note = (middle: Vector, extent: Vector, axis: Vector, spread: number, reach: number, energy: number) => {
    for (let k = 0; k < 3; k++) {
      tree.bounds[6 * index + k] = (middle[k] as number) - (extent[k] as number);
      tree.bounds[6 * index + 3 + k] = (middle[k] as number) + (extent[k] as number);
      tree.axes[3 * index + k] = axis[k] as number;
    }
    tree.spreads[index] = spread;
    tree.reaches[index] = reach;
    tree.energies[index] = energy;
  };
  const hidden = hasSize(light) && light.visible === false ? LIGHT_HIDDEN : 0;
  switch (light.type) {
    case 'directional': {
      const direction = unit(light.direction);
      lightStruct.write(records, index, { kind: LIGHT_DIRECTIONAL | group, b: direction, color, ids });
      note([0, 0, 0], [0, 0, 0], direction, 0, 0, bright);
      return bright * Math.PI * sceneRadius * sceneRadius;
    }
    case 'point':
      lightStruct.write(records, index, { kind: LIGHT_POINT | group, a: light.position, color, ids });
      note(light.position, [0, 0, 0], [0, 1, 0], Math.PI, Math.PI / 2, bright);
      return bright * 4 * Math.PI;
    case 'spot': {
      const outer = Math.cos(light.outer_cone_angle);
      const scale = 1 / Math.max(1e-3, Math.cos(light.inner_cone_angle) - outer);
      const direction = unit(light.direction);
      lightStruct.write(records, index, {
        kind: LIGHT_SPOT | group,
        a: light.position,
        b: direction,
        c: [scale, -outer * scale, 0],
        color,
        ids,
      });
      // Where the cone's edge is sharp, it is blurred over the 1e-3 above.
      note(
        light.position,
        [0, 0, 0],
        direction,
        Math.min(light.inner_cone_angle, light.outer_cone_angle),
        Math.max(light.outer_cone_angle - light.inner_cone_angle, 0.05),
        bright,
      );
      return bright * 2 * Math.PI * (1 - outer);
    }
    case 'profile': {
      const { grid, first } = profile as NonNullable<typeof profile>;
      const direction = unit(light.direction);
      lightStruct.write(records, index, {
        kind: LIGHT_PROFILE | group,
        a: light.position,
        b: direction,
        c: axesOf(light)[0],
        color,
        ids: [first, grid.around, 0, 0],
      });
      note(light.position, [0, 0, 0], direction, grid.reach, 0.05, bright * grid.largest);
      return bright * grid.power;
    }
    case 'rectangle': {
      const [x, y] = axesOf(light);
      const [across, up] = [scaled(x, light.width), scaled(y, light.height)];
      const corner = [0, 1, 2].map(
        (k) => (light.position[k] as number) - 0.5 * ((across[k] as number) + (up[k] as number)),
      );
      lightStruct.write(records, index, {
        kind: LIGHT_RECTANGLE | hidden | group,
        a: corner,
        b: across,
        c: up,
        color,
        ids,
      });
      const area = light.width * light.height;
      note(
        light.position,
        [0, 1, 2].map((k) => 0.5 * (Math.abs(across[k] as number) + Math.abs(up[k] as number))) as unknown as Vector,
        unit(light.direction),
        0,
        Math.PI / 2,
        bright * area,
      );
      return bright * Math.PI * area;
    }
    case 'disk': {
      const [x, y] = axesOf(light);
      const n = unit(light.direction);
      lightStruct.write(records, index, {
        kind: LIGHT_DISK | hidden | group,
        a: light.position,
        b: scaled(x, light.radius),
        c: scaled(y, light.radius),
        color,
        ids,
      });
      const area = Math.PI * light.radius * light.radius;
      note(
        light.position,
        n.map((c) => light.radius * Math.sqrt(Math.max(0, 1 - c * c))) as unknown as Vector,
        n,
        0,
        Math.PI / 2,
        bright * area,
      );
      return bright * Math.PI * area;
    }
    case 'sphere': {
      lightStruct.write(records, index, {
        kind: LIGHT_SPHERE | hidden | group,
        a: light.position,
        b: [light.radius, 0, 0],
        color,
        ids,
      });
      note(
        light.position,
        [light.radius, light.radius, light.radius],
        [0, 1, 0],
        Math.PI,
        Math.PI / 2,
        bright * Math.PI * light.radius * light.radius,
      );
      return bright * 4 * Math.PI * Math.PI * light.radius * light.radius;
    }
  }
}
