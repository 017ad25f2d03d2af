import * as THREE from 'three';
import { afterEach, describe, expect, it, vi } from 'vitest';
import { GradientEquirectTexture, WebGLPathTracer, WebGPUPathTracer } from '../src/compat/index';

afterEach(() => void vi.restoreAllMocks());

/** What the classes use of three's renderers. */
function fakeRenderer() {
  return {
    autoClear: true,
    domElement: {} as HTMLCanvasElement,
    render: vi.fn<(scene: THREE.Object3D, camera: THREE.Camera) => void>(),
    getDrawingBufferSize: (target: { x: number; y: number }) => Object.assign(target, { x: 32, y: 24 }),
  };
}

function build() {
  const scene = new THREE.Scene().add(new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial()));
  return { scene, camera: new THREE.PerspectiveCamera(40, 1) };
}

describe("three-gpu-pathtracer's classes", () => {
  it('have its defaults', () => {
    const { tiles, textureSize, ...pathTracer } = new WebGLPathTracer(fakeRenderer());
    expect([tiles.toArray(), textureSize.toArray()]).toEqual([
      [3, 3],
      [1024, 1024],
    ]);
    expect(pathTracer).toMatchObject({
      renderDelay: 100,
      minSamples: 5,
      fadeDuration: 500,
      enablePathTracing: true,
      pausePathTracing: false,
      dynamicLowRes: false,
      lowResScale: 0.25,
      renderScale: 1,
      synchronizeRenderSize: true,
      rasterizeScene: true,
      renderToCanvas: true,
      multipleImportanceSampling: true,
      stableNoise: false,
    });
    const { bounces, transmissiveBounces, filterGlossyFactor, samples, isCompiling } = new WebGLPathTracer(
      fakeRenderer(),
    );
    expect({ bounces, transmissiveBounces, filterGlossyFactor, samples, isCompiling }).toEqual({
      bounces: 10,
      transmissiveBounces: 10,
      filterGlossyFactor: 0,
      samples: 0,
      isCompiling: false,
    });
    expect(new WebGPUPathTracer(fakeRenderer()).maxBounces).toBe(15);
  });

  it('rasterise where nothing can be path-traced, and say why once', async () => {
    const log = vi.spyOn(console, 'error').mockImplementation(() => undefined);
    const renderer = fakeRenderer();
    const pathTracer = new WebGLPathTracer(renderer);
    const { scene, camera } = build();
    pathTracer.setScene(scene, camera);
    expect(pathTracer.isCompiling).toBe(true);
    pathTracer.renderSample();
    expect(renderer.render.mock.calls).toEqual([[scene, camera]]);
    // Node has no WebGPU of its own.
    await expect(pathTracer.setSceneAsync(scene, camera)).rejects.toMatchObject({ code: 'renderer/no-webgpu' });
    expect(pathTracer.error).toMatchObject({ code: 'renderer/no-webgpu' });
    expect(pathTracer.isCompiling).toBe(false);
    pathTracer.setScene(scene, camera);
    pathTracer.updateMaterials();
    pathTracer.renderSample();
    expect(renderer.render).toHaveBeenCalledTimes(2);
    await expect(pathTracer.setSceneAsync(scene, camera)).rejects.toThrow(/WebGPU/);
    expect(log).toHaveBeenCalledTimes(1);
    await expect(pathTracer.setSceneAsync(new THREE.Scene(), camera)).rejects.toMatchObject({
      code: 'three/no-triangles',
    });
    pathTracer.dispose();
    pathTracer.renderSample();
    expect(renderer.render).toHaveBeenCalledTimes(2);
  });

  it('refuse settings out of range', () => {
    const pathTracer = new WebGLPathTracer(fakeRenderer());
    expect(() => (pathTracer.bounces = 0)).toThrow(expect.objectContaining({ code: 'three/option' }));
    expect(() => (pathTracer.transmissiveBounces = Number.NaN)).toThrow(/transmissiveBounces/);
    expect(() => (pathTracer.filterGlossyFactor = -1)).toThrow(/filterGlossyFactor/);
    expect(pathTracer.bounces).toBe(10);
  });

  it('make gradients that are as bright above and below as their colours', () => {
    const texture = new GradientEquirectTexture(16);
    texture.topColor.setRGB(1, 0.5, 0.25);
    texture.bottomColor.setRGB(0, 0, 0);
    texture.exponent = 1;
    texture.update();
    const { data, width, height } = texture.image;
    expect([width, height]).toEqual([16, 16]);
    const red = (row: number) => (data as Float32Array)[4 * row * width]!;
    for (let row = 0; row < height; row++) {
      // Rows go upwards; linear in the height on the sphere.
      const y = Math.sin(((row + 0.5) / height - 0.5) * Math.PI);
      expect(red(row)).toBeCloseTo((y + 1) / 2, 5);
    }
    expect((data as Float32Array)[4 * 15 * width + 1]! / red(15)).toBeCloseTo(0.5, 5);
  });
});
