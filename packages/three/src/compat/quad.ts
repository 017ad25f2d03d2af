import {
  BufferAttribute,
  BufferGeometry,
  Mesh,
  MeshBasicMaterial,
  OrthographicCamera,
  type Camera,
  type Object3D,
  type Texture,
} from 'three';

/** The part of three's renderers that is used: `WebGLRenderer` and `WebGPURenderer` have it. */
export interface CompatRenderer {
  autoClear: boolean;
  readonly domElement: HTMLCanvasElement | OffscreenCanvas;
  render(scene: Object3D, camera: Camera): unknown;
  getDrawingBufferSize(target: { x: number; y: number }): { x: number; y: number };
}

/**
 * Draws a texture over the whole target, through the renderer's tone mapping and colour space. `material` is a
 * `MeshBasicMaterial`, whose `map` and `opacity` are set for each draw; another material can take its place.
 */
export class FullScreenQuad {
  readonly #camera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
  readonly #mesh: Mesh<BufferGeometry, MeshBasicMaterial>;

  constructor() {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(Float32Array.of(-1, 3, 0, -1, -1, 0, 3, -1, 0), 3));
    geometry.setAttribute('uv', new BufferAttribute(Float32Array.of(0, 2, 0, 0, 2, 0), 2));
    const material = new MeshBasicMaterial({ transparent: true, depthTest: false, depthWrite: false, fog: false });
    this.#mesh = new Mesh(geometry, material);
    this.#mesh.frustumCulled = false;
  }

  get material(): MeshBasicMaterial {
    return this.#mesh.material;
  }

  set material(material: MeshBasicMaterial) {
    this.#mesh.material = material;
  }

  /** Sets what is drawn. */
  set(map: Texture, opacity: number): this {
    const { material } = this;
    // A shader without a texture is another program.
    if (!material.map) material.needsUpdate = true;
    material.map = map;
    material.opacity = opacity;
    return this;
  }

  /** Draws it to the renderer's present target. */
  render(renderer: Pick<CompatRenderer, 'render'>): void {
    renderer.render(this.#mesh, this.#camera);
  }

  dispose(): void {
    this.#mesh.geometry.dispose();
    this.#mesh.material.dispose();
  }
}
