import { GLTFLoader, type GltfPlugin } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { PhysicalCamera } from 'three-gpu-pathtracer/src/objects/PhysicalCamera.js';
import { WebGPUPathTracer } from 'three-gpu-pathtracer/webgpu';
import {
  Color,
  DataTexture,
  EquirectangularReflectionMapping,
  FloatType,
  LinearFilter,
  LinearSRGBColorSpace,
  NearestFilter,
  RepeatWrapping,
  RGBAFormat,
  Scene,
  WebGPURenderer,
  type Texture,
} from 'three/webgpu';
import type { Environment, PerspectiveCamera } from '@glanz/scene';
import type { Contestant, Task } from '../equal-time/contestant';
import { decodePixels, glbImages } from '../equal-time/load';

/** How {@link createThreeGpuPathtracer} is set. */
export interface PeerOptions {
  /** False: what trades truth for smoothness is off (clamps, blurred gloss). True: as its users get it. */
  readonly defaults: boolean;
}

/** The peer, whose camera can move. */
export interface ThreeGpuPathtracer extends Contestant {
  /** Looks from elsewhere, which begins an image again; the field of view stays. */
  setCamera(camera: PerspectiveCamera): void;
  /** Samples of the pixel that has fewest. */
  minSamples(): Promise<number>;
}

/** Why the peer takes no part on an adapter, where that is known beforehand. */
export const withoutPeer = (adapter: string): string | undefined =>
  /swiftshader/i.test(adapter) ? 'SwiftShader is too slow for it (it wants a GPU, or Mesa 25 or later)' : undefined;

/** Rounds between two waits, so that the queue does not grow without bound. */
const ROUNDS_PER_WAIT = 32;

/** What three asks of a browser, as little as that is. */
function shimBrowser(): void {
  const scope = globalThis as Record<string, unknown>;
  scope['self'] ??= globalThis;
  scope['requestAnimationFrame'] ??= () => 0;
  scope['cancelAnimationFrame'] ??= () => undefined;
  const navigator = (scope['navigator'] ??= {}) as {
    gpu?: { getPreferredCanvasFormat?: () => string };
    userAgent?: string;
  };
  if (navigator.gpu?.getPreferredCanvasFormat) return;
  Object.defineProperty(navigator, 'gpu', {
    value: { getPreferredCanvasFormat: () => 'bgra8unorm' },
    configurable: true,
  });
  navigator.userAgent ??= 'node';
}

/** A canvas that nobody sees: one texture to present into. */
function createCanvas(device: GPUDevice, width: number, height: number) {
  const texture = device.createTexture({
    size: [width, height],
    format: 'bgra8unorm',
    usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC,
  });
  const nothing = () => undefined;
  return {
    texture,
    canvas: {
      width,
      height,
      style: {},
      addEventListener: nothing,
      removeEventListener: nothing,
      setAttribute: nothing,
    },
    context: { configure: nothing, unconfigure: nothing, getCurrentTexture: () => texture },
  };
}

function environmentTexture(environment: Environment): { texture: DataTexture; intensity: number; rotation: number } {
  const [width, height] = environment.type === 'latlong' ? [environment.width, environment.height] : [4, 2];
  const data = new Float32Array(4 * width * height).fill(1);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      // Its rows go upwards.
      const from = 3 * ((height - 1 - y) * width + x);
      for (let c = 0; c < 3; c++)
        data[4 * (y * width + x) + c] =
          environment.type === 'latlong' ? environment.data[from + c]! : environment.radiance[c]!;
    }
  }
  const texture = new DataTexture(data, width, height, RGBAFormat, FloatType);
  texture.mapping = EquirectangularReflectionMapping;
  texture.colorSpace = LinearSRGBColorSpace;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.wrapS = RepeatWrapping;
  texture.generateMipmaps = false;
  texture.needsUpdate = true;
  return environment.type === 'latlong'
    ? { texture, intensity: environment.intensity ?? 1, rotation: environment.rotation ?? 0 }
    : { texture, intensity: 1, rotation: 0 };
}

/** Gives the loader decoded textures, which it would ask the browser for. */
function decodedTextures({
  glb,
  textures,
}: Task): (parser: Parameters<Parameters<GLTFLoader['register']>[0]>[0]) => GltfPlugin {
  const images = glbImages(glb);
  return (parser) => ({
    name: 'decoded-textures',
    async loadTexture(index) {
      const { source, sampler } = parser.json.textures![index]!;
      const { width, height, data } = await decodePixels(images[source]!, textures);
      const texture: Texture = new DataTexture(data, width, height, RGBAFormat);
      const settings = sampler === undefined ? {} : (parser.json.samplers?.[sampler] ?? {});
      texture.magFilter = texture.minFilter = settings.magFilter === 9728 ? NearestFilter : LinearFilter;
      texture.wrapS = wrap(settings.wrapS);
      texture.wrapT = wrap(settings.wrapT);
      texture.needsUpdate = true;
      parser.associations.set(texture, { textures: index });
      return texture;
    },
  });
}

/** glTF's wrap modes as three's: clamp, mirror, repeat. */
const wrap = (mode: number | undefined) => (mode === 33071 ? 1001 : mode === 33648 ? 1002 : 1000);

/**
 * three-gpu-pathtracer 0.0.26 with its WebGPU wavefront tracer, in Node. It is driven through its own `renderSample()`,
 * with all pixels' paths in flight at once (its best batching), and without its low-resolution preview.
 */
export async function createThreeGpuPathtracer(
  device: GPUDevice,
  task: Task,
  { defaults }: PeerOptions,
): Promise<ThreeGpuPathtracer> {
  shimBrowser();
  const { width, height, camera, environment } = task;
  const { canvas, context, texture: target } = createCanvas(device, width, height);
  const renderer = new WebGPURenderer({ canvas, context, device, antialias: false });
  renderer.setSize(width, height, false);
  await renderer.init();

  const { scene: model } = await new GLTFLoader()
    .register(decodedTextures(task))
    .parseAsync(task.glb.slice().buffer, '');
  const scene = new Scene();
  scene.add(model);
  if (environment) {
    const { texture, intensity, rotation } = environmentTexture(environment);
    scene.environment = texture;
    scene.environmentIntensity = intensity;
    scene.environmentRotation.y = rotation;
    if (environment.visible ?? true) {
      scene.background = texture;
      scene.backgroundIntensity = intensity;
      scene.backgroundRotation.y = rotation;
    }
  }
  scene.background ??= new Color(0, 0, 0);

  const view = new PhysicalCamera((camera.yfov * 180) / Math.PI, width / height, 0.001, 1000);
  const place = ({ transform }: PerspectiveCamera) => {
    view.matrix.fromArray(Array.from(transform));
    view.matrix.decompose(view.position, view.quaternion, view.scale);
  };
  place(camera);
  // Millimetres, as on a lens's barrel.
  view.bokehSize = Math.max(2000 * (camera.lens_radius ?? 0), 1e-9);
  view.focusDistance = camera.focus_distance ?? 1;

  const tracer = new WebGPUPathTracer(renderer);
  tracer.maxBounces = task.maxDepth;
  if (!defaults) {
    tracer.filterGlossyFactor = 0;
    tracer.clampDirect = 0;
    tracer.clampIndirect = 0;
  }
  tracer.synchronizeRenderSize = false;
  tracer.renderDelay = 0;
  tracer.dynamicLowRes = false;
  tracer.minSamples = 0;
  tracer.stableNoise = false;
  tracer.frameBudget = width * height;
  tracer.setSize(width, height);
  tracer.setScene(scene, view);

  const advance = async (rounds: number) => {
    for (let i = 1; i <= rounds; i++) {
      tracer.renderSample();
      if (i % ROUNDS_PER_WAIT === 0 || i === rounds) await device.queue.onSubmittedWorkDone();
    }
  };
  return {
    unit: 'rounds',
    async restart(seed) {
      tracer.reset();
      // Its seeds count up by one with each sample: runs must not overlap.
      tracer._pathTracer.seed = seed << 20;
      await device.queue.onSubmittedWorkDone();
    },
    advance,
    samples: async () => (await tracer.getSampleCountsAsync()).avg,
    minSamples: async () => (await tracer.getSampleCountsAsync()).min,
    setCamera(to) {
      place(to);
      tracer.updateCamera();
    },
    async read() {
      const { texture } = renderer.backend.get(tracer.target);
      const row = Math.ceil((width * 16) / 256) * 256;
      const buffer = device.createBuffer({
        size: row * height,
        usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST,
      });
      const encoder = device.createCommandEncoder();
      encoder.copyTextureToBuffer({ texture }, { buffer, bytesPerRow: row }, [width, height]);
      device.queue.submit([encoder.finish()]);
      await buffer.mapAsync(GPUMapMode.READ);
      const data = new Float32Array(buffer.getMappedRange());
      const image = new Float32Array(3 * width * height);
      for (let y = 0; y < height; y++)
        for (let x = 0; x < width; x++)
          for (let c = 0; c < 3; c++) image[3 * (y * width + x) + c] = data[(y * row) / 4 + 4 * x + c]!;
      buffer.destroy();
      return image;
    },
    destroy() {
      tracer.dispose();
      target.destroy();
    },
  };
}
