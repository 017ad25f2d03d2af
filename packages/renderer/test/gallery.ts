import type { Instance, Mesh, Scene } from '@glanz/scene';
import { addQuad, addSphere, createScene, lambert } from './scenes';

/** Texture coordinates, tangents and colours for a sphere: numbers that differ at each vertex. */
export function withAttributes(mesh: Mesh): Mesh {
  const normals = mesh.normals as Float32Array;
  const count = normals.length / 3;
  const uv = new Float32Array(2 * count);
  const tangents = new Float32Array(4 * count);
  const colors = new Float32Array(4 * count);
  for (let i = 0; i < count; i++) {
    const [x, y, z] = [0, 1, 2].map((k) => normals[3 * i + k]!) as [number, number, number];
    uv.set([2 * Math.atan2(z, x), 3 * y], 2 * i);
    const length = Math.hypot(x, z) || 1;
    tangents.set([-z / length, 0, x / length, i % 2 ? 1 : -1], 4 * i);
    colors.set([0.5 + 0.5 * x, 0.5 + 0.5 * y, 0.5 + 0.5 * z, 0.6 + 0.4 * Math.abs(y)], 4 * i);
  }
  return { ...mesh, uvs: [uv, uv.map((value) => 1 - value)], tangents, colors };
}

function addTexture(scene: Scene, name: string, texel: (x: number, y: number) => readonly number[]): number {
  const data = Array.from({ length: 64 }, (_, i) => texel(i % 8, i >> 3)).flat();
  const image = scene.images.push({ name, width: 8, height: 8, data: new Float32Array(data) }) - 1;
  return scene.textures.push({ image, color_space: 'linear' }) - 1;
}

export const place = (x: number, y: number, z: number, scale = 1, mirrored = false) => [
  mirrored ? -scale : scale,
  0,
  0,
  0,
  0,
  scale,
  0,
  0,
  0,
  0,
  scale,
  0,
  x,
  y,
  z,
  1,
];

/**
 * All that shaders read of shapes: a floor; a ball with normals, two sets of texture coordinates, tangents and colours
 * that let light pass, three times, once mirrored; glass; a cut-out before them; a light of triangles; a hidden ball.
 */
export function gallery(segments = 40): Scene {
  const scene = createScene();
  addQuad(scene, 0.9, -0.4, { ...lambert(0.6, 0.5, 0.4), name: 'floor' });
  const normal = addTexture(scene, 'bumps', (x, y) => [0.5 + 0.2 * Math.sin(x), 0.5 + 0.2 * Math.cos(y), 0.9, 1]);
  const stripes = addTexture(scene, 'stripes', (x, y) => [x / 8, y / 8, 0.5, (x + y) % 2]);
  addSphere(
    scene,
    0.3,
    [0, 0, 0],
    {
      name: 'paint',
      parameters: { specular_roughness: 0.4, specular_roughness_anisotropy: 0.7 },
      textures: {
        base_color: { texture: stripes, channels: 'rgb' },
        specular_roughness: { texture: stripes, channels: 'g', uv: 1 },
        geometry_normal: { texture: normal, channels: 'rgb' },
      },
    },
    segments,
  );
  scene.meshes[1] = withAttributes(scene.meshes[1] as Mesh);
  const ball = scene.instances[1] as Instance;
  Object.assign(ball, { name: 'ball', transform: place(-0.35, 0.3, 0) });
  scene.instances.push(
    { ...ball, name: 'mirrored', transform: place(0.35, 0.3, 0.1, 1, true) },
    { ...ball, name: 'small', transform: place(0, -0.5, 0.3, 0.5) },
  );
  addSphere(
    scene,
    0.2,
    [0.4, -0.4, 0.3],
    {
      name: 'glass',
      parameters: { transmission_weight: 1, transmission_color: [0.8, 0.9, 1], transmission_depth: 0.2 },
    },
    segments / 2,
  );
  addSphere(
    scene,
    0.1,
    [0, 0.7, 0.4],
    { name: 'light', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 20 } },
    12,
  );
  addSphere(scene, 0.2, [-0.5, -0.5, 0.2], { ...lambert(0.9), name: 'late' }, segments);
  Object.assign(scene.instances.at(-1) as object, { name: 'late', visible: false });
  // The last of all: what is read of it lies in the last rows.
  const cutOut = addQuad(scene, 0.6, 0.6, {
    name: 'cut-out',
    parameters: { base_color: [0.2, 0.4, 0.2] },
    opacity_threshold: 0.5,
    textures: { geometry_opacity: { texture: stripes, channels: 'a' } },
  });
  Object.assign(scene.instances.at(-1) as object, { name: 'cut-out', material: cutOut });
  scene.environment = { type: 'constant', radiance: [0.3, 0.4, 0.5] };
  return scene;
}

/** What a shader can bind of a buffer, and textures of as few texels: rows of 64, layers of 16 KiB. */
export const SMALL = { maxStorageBufferBindingSize: 40 << 10, maxTextureDimension2D: 64 };
type Limits = Partial<
  Record<keyof typeof SMALL | 'maxTextureArrayLayers' | 'maxSampledTexturesPerShaderStage', number>
>;

/** The device with lower limits, and the arrays and buffers of a scene that are made on it. */
export function limited(device: GPUDevice, limits: Limits = SMALL) {
  const live = new Map<GPUBuffer | GPUTexture, string>();
  const tracked = <T extends GPUBuffer | GPUTexture>(label: string, resource: T): T => {
    live.set(resource, label);
    const destroy = resource.destroy.bind(resource);
    return Object.assign(resource, {
      destroy: () => {
        live.delete(resource);
        destroy();
      },
    });
  };
  const all = new Proxy(device.limits, {
    get: (target, name) => (limits as Record<string | symbol, number>)[name] ?? (Reflect.get(target, name) as number),
  });
  const proxy = new Proxy(device, {
    get(target, name) {
      if (name === 'limits') return all;
      if (name === 'createBuffer')
        return (of: GPUBufferDescriptor) => tracked(`buffer ${of.label ?? ''}`, target.createBuffer(of));
      if (name === 'createTexture')
        return (of: GPUTextureDescriptor) => tracked(`texture ${of.label ?? ''}`, target.createTexture(of));
      const value = Reflect.get(target, name) as unknown;
      return typeof value === 'function' ? (value as () => unknown).bind(target) : value;
    },
  });
  const shapes = () =>
    [...live.values()]
      .filter((label) => /glanz (nodes|triangles|attributes)$/.test(label))
      .map((label) => label.replace('glanz ', ''))
      .sort();
  return { device: proxy, live, shapes };
}
