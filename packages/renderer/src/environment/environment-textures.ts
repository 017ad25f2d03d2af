import type { EnvironmentData } from './environment';
import type { SceneResources } from '../storage/scene-resources';

/** Pixels are written so many bytes at a time. */
const SLICE_BYTES = 1 << 20;

/**
 * The images of an environment by the names that kernels bind them under, or those that `before` has not; black where
 * there are none.
 */
function images({ pixels, table }: EnvironmentData, before?: EnvironmentData) {
  const none = { width: 1, height: 1, data: new Float32Array(4) };
  const all = [
    ['environment', pixels ?? none, before?.pixels ?? none],
    ['environment_table', table ?? none, before?.table ?? none],
  ] as const;
  return before ? all.filter(([, image, former]) => image !== former) : all;
}

/** Makes the textures of an environment, still empty: those whose image `before` does not have. */
export function makeEnvironmentTextures(
  resources: SceneResources,
  environment: EnvironmentData,
  before?: EnvironmentData,
): void {
  for (const [name, { width, height, data }] of images(environment, before))
    resources.makeTexture(name, { size: [width, height], format: 'rgba32float' }, data.byteLength);
}

/** Fills the textures that {@link makeEnvironmentTextures} made, some rows at a time; gives the bytes of each slice. */
export function* fillEnvironmentTextures(
  queue: GPUQueue,
  resources: SceneResources,
  environment: EnvironmentData,
  before?: EnvironmentData,
): Generator<number> {
  for (const [name, { width, height, data }] of images(environment, before)) {
    const texture = resources.texture(name) as GPUTexture;
    const rows = Math.max(1, Math.floor(SLICE_BYTES / (16 * width)));
    for (let y = 0; y < height; y += rows) {
      const some = Math.min(rows, height - y);
      const part = data.subarray(4 * width * y, 4 * width * (y + some));
      queue.writeTexture({ texture, origin: [0, y] }, part, { bytesPerRow: width * 16, rowsPerImage: some }, [
        width,
        some,
      ]);
      yield 16 * width * some;
    }
  }
}
