// EXT_lights_image_based: a cube map. Its prefiltered levels and its spherical harmonics are for rasterizers; here the
// sharpest level becomes a lat-long environment.
import type { LatLongEnvironment } from '@glanz/scene';
import type { DecodedImage } from './decoded-image';
import type { GltfImageLight } from './json';

/** Max edge of a face in pixels; larger levels are skipped if smaller ones exist. */
export const MAX_FACE_SIZE = 1024;

const srgbToLinear = (c: number) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);

/** Milliseconds between yields to the event loop. */
const SLICE_MS = 8;

/** The six images of the sharpest level within {@link MAX_FACE_SIZE}. */
export function facesOf({ specularImages, specularImageSize = 0 }: GltfImageLight): readonly number[] {
  const level = Math.min(
    Math.max(0, Math.ceil(Math.log2(specularImageSize / MAX_FACE_SIZE))),
    specularImages.length - 1,
  );
  return specularImages[level] as readonly number[];
}

/**
 * Radiance of the texels of a face: RGBD (colour divided by alpha) for a PNG with an alpha channel, else plain colours.
 */
function decodeFace({ data }: DecodedImage): Float32Array {
  const curve = Float32Array.from({ length: 256 }, (_, code) => srgbToLinear(code / 255));
  const texels = new Float32Array((data.length / 4) * 3);
  for (let i = 0, o = 0; i < data.length; i += 4, o += 3) {
    const divisor = Math.max(data[i + 3] as number, 1) / 255;
    for (let k = 0; k < 3; k++) texels[o + k] = (curve[data[i + k] as number] as number) / divisor;
  }
  return texels;
}

/**
 * Computes the environment from a light's six faces (+X, −X, +Y, −Y, +Z, −Z, each upright as seen from inside, in
 * glTF's right-handed space). Yields to the event loop every few milliseconds.
 */
export async function environmentOf(
  { rotation = [0, 0, 0, 1], intensity = 1 }: GltfImageLight,
  faces: readonly DecodedImage[],
  signal: AbortSignal | undefined,
): Promise<LatLongEnvironment> {
  const size = Math.max(...faces.map(({ width }) => width));
  const [width, height] = [4 * size, 2 * size];
  const data = new Float32Array(3 * width * height);
  const pixels = faces.map(decodeFace);
  const [qx, qy, qz, qw] = rotation as readonly [number, number, number, number];
  let until = performance.now() + SLICE_MS;
  const direction = new Float64Array(3);
  for (let y = 0, o = 0; y < height; y++) {
    if (performance.now() > until) {
      await new Promise((resolve) => setTimeout(resolve));
      signal?.throwIfAborted();
      until = performance.now() + SLICE_MS;
    }
    const polar = (Math.PI * (y + 0.5)) / height;
    for (let x = 0; x < width; x++, o += 3) {
      const azimuth = 2 * Math.PI * ((x + 0.5) / width - 0.5);
      // The light is rotated by q: look the cube up in the direction rotated by the inverse.
      rotateInverse(
        direction,
        Math.sin(polar) * Math.cos(azimuth),
        Math.cos(polar),
        Math.sin(polar) * Math.sin(azimuth),
        qx,
        qy,
        qz,
        qw,
      );
      lookUp(data, o, direction, faces, pixels);
    }
  }
  return { type: 'latlong', width, height, data, intensity };
}

/** Rotates a vector by the inverse of a unit quaternion. */
function rotateInverse(
  out: Float64Array,
  x: number,
  y: number,
  z: number,
  qx: number,
  qy: number,
  qz: number,
  qw: number,
): void {
  const tx = 2 * (y * qz - z * qy),
    ty = 2 * (z * qx - x * qz),
    tz = 2 * (x * qy - y * qx);
  out[0] = x + qw * tx + (ty * qz - tz * qy);
  out[1] = y + qw * ty + (tz * qx - tx * qz);
  out[2] = z + qw * tz + (tx * qy - ty * qx);
}

/** Bilinear lookup within the face that the direction hits. */
function lookUp(
  out: Float32Array,
  at: number,
  d: Float64Array,
  faces: readonly DecodedImage[],
  pixels: readonly Float32Array[],
): void {
  const x = d[0] as number,
    y = d[1] as number,
    z = d[2] as number;
  const [ax, ay, az] = [Math.abs(x), Math.abs(y), Math.abs(z)];
  // Right and down of each face, as one looks at it with +Y up (for ±Y: with the top of the image towards −Z and +Z).
  let face: number, u: number, v: number;
  if (ax >= ay && ax >= az) [face, u, v] = x > 0 ? [0, z / ax, -y / ax] : [1, -z / ax, -y / ax];
  else if (ay >= az) [face, u, v] = y > 0 ? [2, -x / ay, z / ay] : [3, -x / ay, -z / ay];
  else [face, u, v] = z > 0 ? [4, -x / az, -y / az] : [5, x / az, -y / az];
  const { width, height } = faces[face] as DecodedImage;
  const texels = pixels[face] as Float32Array;
  const fx = Math.min(Math.max(((u + 1) / 2) * width - 0.5, 0), width - 1),
    fy = Math.min(Math.max(((v + 1) / 2) * height - 0.5, 0), height - 1);
  const x0 = Math.floor(fx),
    y0 = Math.floor(fy),
    x1 = Math.min(x0 + 1, width - 1),
    y1 = Math.min(y0 + 1, height - 1);
  for (let k = 0; k < 3; k++) {
    const texel = (i: number, j: number) => texels[3 * (j * width + i) + k] as number;
    const top = texel(x0, y0) * (1 - fx + x0) + texel(x1, y0) * (fx - x0),
      bottom = texel(x0, y1) * (1 - fx + x0) + texel(x1, y1) * (fx - x0);
    out[at + k] = top * (1 - fy + y0) + bottom * (fy - y0);
  }
}
