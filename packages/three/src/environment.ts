import type { Environment, Image, LatLongEnvironment, Scene } from '@glanz/scene';
import { readCube, type Cube } from './cube';
import type { Ambience } from './lights';
import type { Textures } from './textures';
import type { Loose, ThreeObject, ThreeTexture } from './types';

/** Mappings of three: equirectangular images, cubes, and cubes that its renderer has blurred on the GPU. */
const [EQUIRECTANGULAR, CUBE, PREFILTERED] = [[303, 304], [301, 302], 306];

/** The environment of a THREE.Scene, with its ambient light; `undefined` where there is neither. */
export async function readEnvironment(
  root: ThreeObject,
  ambience: Ambience,
  scene: Scene,
  textures: Textures,
): Promise<Environment | undefined> {
  const { environment, background } = root as unknown as {
    readonly environment?: ThreeTexture | null;
    readonly background?: unknown;
  };
  const loose = root as unknown as Loose;
  const intensity = (loose['environmentIntensity'] as number | undefined) ?? 1;
  const turn = (loose['environmentRotation'] as
    | { readonly x: number; readonly y: number; readonly z: number }
    | undefined) ?? { x: 0, y: 0, z: 0 };
  const visible = background === environment && environment !== undefined && environment !== null;
  const image = environment ? await readImage(environment, scene, textures) : undefined;
  const warn = (message: string) => {
    const code = 'three/environment';
    if (!scene.warnings.some((known) => known.message === `${message}.`))
      scene.warnings.push({ code, message: `${message}.` });
  };
  if (Math.abs(turn.x) + Math.abs(turn.z) > 1e-6)
    warn('The environment is rotated about another axis than +Y; only its rotation about +Y is supported');
  const number = (name: string) => (loose[name] as number | undefined) ?? (name === 'backgroundBlurriness' ? 0 : 1);
  const backgroundTurn = (loose['backgroundRotation'] as { readonly y: number } | undefined)?.y ?? 0;
  if (
    visible &&
    (number('backgroundBlurriness') > 0 || number('backgroundIntensity') !== intensity || backgroundTurn !== turn.y)
  )
    warn('The background is shown as the environment is: its own blurriness, intensity and rotation are not supported');
  if (!image) return ambience.dark ? undefined : ambient(ambience, visible);
  if (!ambience.dark && intensity > 0) {
    for (let j = 0; j < image.height; j++) {
      const side = j < image.height / 2 ? ambience.above : ambience.below;
      for (let i = 0; i < image.width; i++)
        for (const k of [0, 1, 2] as const)
          image.data[3 * (j * image.width + i) + k] =
            (image.data[3 * (j * image.width + i) + k] as number) + side[k] / intensity;
    }
  }
  return { ...image, intensity, rotation: turn.y, visible };
}

function ambient({ above, below }: Ambience, visible: boolean): Environment {
  if (above.every((value, k) => value === below[k])) return { type: 'constant', radiance: [...above], visible };
  // Rows enough that the seam at the horizon, which is bilinear, is narrow.
  const [width, height] = [4, 64];
  const data = new Float32Array(width * height * 3);
  for (let j = 0; j < height; j++)
    for (let i = 0; i < width; i++) data.set(j < height / 2 ? above : below, 3 * (j * width + i));
  return { type: 'latlong', width, height, data, visible };
}

/** The environment that a texture shows; `undefined`, with a warning, where its image cannot be had. */
async function readImage(
  texture: ThreeTexture,
  scene: Scene,
  textures: Textures,
): Promise<LatLongEnvironment | undefined> {
  const warn = (message: string): undefined => {
    scene.warnings.push({
      code: 'three/environment',
      message: `${message}; or set an environment of the scene yourself.`,
    });
  };
  if (texture.mapping === PREFILTERED)
    return warn(
      'The environment was prefiltered on the GPU (PMREMGenerator), where it cannot be read: assign the equirectangular or cube texture that it was made from to scene.environment before the conversion',
    );
  if (CUBE.includes(texture.mapping)) {
    const faces = await Promise.all(facesOf(texture).map((face) => textures.pixelsOf(face, texture)));
    const [first] = faces;
    if (
      faces.length === 6 &&
      first &&
      faces.every((face) => face && face.width === first.width && face.height === first.width)
    )
      return readCube({
        size: first.width,
        faces: faces.map((face) => radianceOf(face as Pixels, texture)) as unknown as Cube['faces'],
      });
    return warn(
      'The cube of the environment has not six square faces of one size whose pixels can be read (not loaded yet, compressed, or on the GPU only)',
    );
  }
  const image = EQUIRECTANGULAR.includes(texture.mapping)
    ? await textures.pixelsOf(texture.source?.data ?? texture.image, texture)
    : undefined;
  if (!image)
    return warn(
      'The environment is neither an equirectangular image nor a cube whose pixels can be read (not loaded yet, compressed, or with another mapping): give it the mapping EquirectangularReflectionMapping',
    );
  const { width, height } = image;
  const rgb = radianceOf(image, texture);
  // Raw numbers run upwards in three, unless `flipY` is set; images of the browser have their first row
  // at the top then.
  if (texture.flipY) return { type: 'latlong', width, height, data: rgb };
  const data = new Float32Array(rgb.length);
  for (let j = 0; j < height; j++)
    data.set(rgb.subarray(3 * (height - 1 - j) * width, 3 * (height - j) * width), 3 * j * width);
  return { type: 'latlong', width, height, data };
}

type Pixels = Pick<Image, 'width' | 'height' | 'data'>;

/** The six images of a cube: elements, raw numbers, or textures with either. */
function facesOf(texture: ThreeTexture): unknown[] {
  const list = (texture.source?.data ?? texture.image) as unknown;
  return Array.isArray(list)
    ? list.map((face: { readonly isDataTexture?: unknown; readonly image?: unknown }) =>
        face?.isDataTexture === true ? face.image : face,
      )
    : [];
}

/** Linear RGB of an image, rows as they are in memory. */
function radianceOf({ width, height, data }: Pixels, texture: ThreeTexture): Float32Array<ArrayBuffer> {
  const out = new Float32Array(width * height * 3);
  const bytes = !(data instanceof Float32Array);
  const decode =
    texture.colorSpace === 'srgb'
      ? (v: number) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
      : (v: number) => v;
  for (let i = 0; i < width * height; i++)
    for (let k = 0; k < 3; k++) {
      const value = bytes ? decode((data[4 * i + k] as number) / 255) : (data[4 * i + k] as number);
      out[3 * i + k] = value > 0 ? Math.min(value, 3.4e38) : 0;
    }
  return out;
}
