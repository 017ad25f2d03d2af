import type { LatLongEnvironment } from '@glanz/scene';

/**
 * Six square images of `size`² texels, linear RGB, first row at the top, in the order +X, −X, +Y, −Y, +Z, −Z of their
 * names.
 */
export interface Cube {
  readonly size: number;
  readonly faces: readonly [Float32Array, Float32Array, Float32Array, Float32Array, Float32Array, Float32Array];
}

/**
 * Face and place on it, 0..1 from its upper left corner, of a direction of the world. Cubes are looked up as OpenGL
 * does (4.6 core profile, table 8.19), in a left-handed frame: three turns x over for that.
 */
export function cubePlace(x: number, y: number, z: number): readonly [face: number, s: number, t: number] {
  const [rx, ry, rz] = [-x, y, z];
  const [ax, ay, az] = [Math.abs(rx), Math.abs(ry), Math.abs(rz)];
  const [face, sc, tc, ma] =
    ax >= ay && ax >= az
      ? rx > 0
        ? [0, -rz, -ry, ax]
        : [1, rz, -ry, ax]
      : ay >= az
        ? ry > 0
          ? [2, rx, rz, ay]
          : [3, rx, -rz, ay]
        : rz > 0
          ? [4, rx, -ry, az]
          : [5, -rx, -ry, az];
  return [face as number, ((sc as number) / (ma as number) + 1) / 2, ((tc as number) / (ma as number) + 1) / 2];
}

/** Samples along each side of a texel: edges of lights keep their energy. */
const SAMPLES = 4;

/**
 * A cube as a latitude-longitude image of about as many texels around the horizon; each is the mean of 16 samples.
 */
export function readCube({ size, faces }: Cube): LatLongEnvironment {
  const [width, height] = [4 * size, 2 * size];
  const data = new Float32Array(width * height * 3);
  for (let j = 0; j < height; j++)
    for (let i = 0; i < width; i++) {
      const at = 3 * (j * width + i);
      for (let n = 0; n < SAMPLES * SAMPLES; n++) {
        const phi = ((i + ((n % SAMPLES) + 0.5) / SAMPLES) / width - 0.5) * 2 * Math.PI;
        const theta = ((j + (Math.floor(n / SAMPLES) + 0.5) / SAMPLES) / height) * Math.PI;
        const [face, s, t] = cubePlace(
          Math.sin(theta) * Math.cos(phi),
          Math.cos(theta),
          Math.sin(theta) * Math.sin(phi),
        );
        const texel = 3 * (Math.min(size - 1, Math.floor(t * size)) * size + Math.min(size - 1, Math.floor(s * size)));
        for (let k = 0; k < 3; k++)
          data[at + k] = (data[at + k] as number) + ((faces[face] as Float32Array)[texel + k] as number) / SAMPLES ** 2;
      }
    }
  return { type: 'latlong', width, height, data };
}
