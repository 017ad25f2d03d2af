// three ships no types; this is the little that the peer's adapter uses.
declare module 'three/webgpu' {
  interface Vector3 {
    x: number;
    y: number;
    z: number;
  }
  export class Object3D {
    readonly position: Vector3;
    readonly quaternion: object;
    readonly scale: Vector3;
    readonly matrix: {
      fromArray(values: readonly number[]): void;
      decompose(position: Vector3, quaternion: object, scale: Vector3): void;
    };
    add(child: Object3D): this;
    traverse(
      visit: (object: {
        readonly isMesh?: boolean;
        readonly isInstancedMesh?: boolean;
        readonly count?: number;
        readonly geometry: {
          readonly index?: { readonly count: number };
          readonly attributes: { readonly position: { readonly count: number } };
        };
      }) => void,
    ): void;
  }
  export class Texture {
    mapping: number;
    colorSpace: string;
    minFilter: number;
    magFilter: number;
    wrapS: number;
    wrapT: number;
    generateMipmaps: boolean;
    needsUpdate: boolean;
  }
  export class Color {
    constructor(r: number, g: number, b: number);
  }
  export class DataTexture extends Texture {
    constructor(data: Float32Array | Uint8Array, width: number, height: number, format: number, type?: number);
  }
  export class Scene extends Object3D {
    environment: Texture | null;
    environmentIntensity: number;
    readonly environmentRotation: Vector3;
    background: Texture | Color | null;
    backgroundIntensity: number;
    readonly backgroundRotation: Vector3;
  }
  export class WebGPURenderer {
    constructor(options: { canvas: object; context: object; device: GPUDevice; antialias: boolean });
    readonly backend: { get(texture: Texture): { texture: GPUTexture } };
    setSize(width: number, height: number, updateStyle: boolean): void;
    init(): Promise<void>;
  }
  export const EquirectangularReflectionMapping: number;
  export const FloatType: number;
  export const LinearFilter: number;
  export const NearestFilter: number;
  export const LinearSRGBColorSpace: string;
  export const RepeatWrapping: number;
  export const RGBAFormat: number;
}
declare module 'three/examples/jsm/loaders/GLTFLoader.js' {
  import type { Scene, Texture } from 'three/webgpu';
  interface GltfParser {
    readonly json: {
      readonly textures?: readonly { readonly source: number; readonly sampler?: number }[];
      readonly samplers?: readonly { readonly magFilter?: number; readonly wrapS?: number; readonly wrapT?: number }[];
    };
    readonly associations: Map<Texture, object>;
  }
  export interface GltfPlugin {
    readonly name: string;
    loadTexture(index: number): Promise<Texture>;
  }
  export class GLTFLoader {
    register(plugin: (parser: GltfParser) => GltfPlugin): this;
    setDRACOLoader(loader: object): this;
    setMeshoptDecoder(decoder: unknown): this;
    parseAsync(data: ArrayBuffer, path: string): Promise<{ readonly scene: Scene }>;
  }
}
declare module 'three-gpu-pathtracer/src/objects/PhysicalCamera.js' {
  import type { Object3D } from 'three/webgpu';
  export class PhysicalCamera extends Object3D {
    constructor(fov: number, aspect: number, near: number, far: number);
    bokehSize: number;
    focusDistance: number;
  }
}
declare module 'three-gpu-pathtracer/webgpu' {
  import type { Object3D, Scene, Texture, WebGPURenderer } from 'three/webgpu';
  export class WebGPUPathTracer {
    constructor(renderer: WebGPURenderer);
    readonly _pathTracer: { seed: number };
    readonly target: Texture;
    maxBounces: number;
    filterGlossyFactor: number;
    clampDirect: number;
    clampIndirect: number;
    synchronizeRenderSize: boolean;
    renderDelay: number;
    dynamicLowRes: boolean;
    minSamples: number;
    stableNoise: boolean;
    frameBudget: number;
    setSize(width: number, height: number): void;
    setScene(scene: Scene, camera: Object3D): void;
    reset(): void;
    renderSample(): void;
    updateCamera(): void;
    getSampleCountsAsync(): Promise<{ readonly min: number; readonly avg: number }>;
    dispose(): void;
  }
}
declare module 'three/examples/jsm/libs/meshopt_decoder.module.js' {
  export const MeshoptDecoder: unknown;
}
