import { GALLERY_MODELS } from '@glanz/models/gallery';
import type { PerspectiveCamera, Scene } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { cameraJson, commandOf } from '../src/command';
import { GALLERY } from '../src/manifest';

const scenes = new Map<string, Scene>();
const sceneOf = (model: string): Scene => {
  const scene = scenes.get(model) ?? GALLERY_MODELS[model]!();
  scenes.set(model, scene);
  return scene;
};

describe('manifest of the gallery', () => {
  it('has at least 24 images, each with an id, a title and an alternative text of its own', () => {
    expect(GALLERY.length).toBeGreaterThanOrEqual(24);
    for (const key of ['id', 'title', 'alt'] as const)
      expect(new Set(GALLERY.map((image) => image[key])).size, key).toBe(GALLERY.length);
    for (const { id, alt } of GALLERY) {
      expect(id).toMatch(/^[a-z]+(-[a-z]+)*$/);
      expect(alt.length, id).toBeGreaterThan(30);
    }
  });

  it.each(GALLERY.map((image) => [image.id, image] as const))(
    '%s names a model, a camera and a variant that exist',
    (_, image) => {
      expect(Object.keys(GALLERY_MODELS)).toContain(image.model);
      const scene = sceneOf(image.model);
      expect(scene.cameras.map(({ name }) => name)).toContain(image.camera);
      if (image.variant !== undefined) expect(scene.variants).toContain(image.variant);
      const catchers = (image.options?.['catcher'] ?? []) as readonly string[];
      for (const part of catchers) expect(scene.instances.map(({ name }) => name)).toContain(part);
      for (const line of commandOf(image).split('\n')) expect(line.length).toBeLessThanOrEqual(80);
    },
  );

  it('shows every model', () => {
    expect([...new Set(GALLERY.map(({ model }) => model))].sort()).toEqual(Object.keys(GALLERY_MODELS).sort());
  });
});

describe('commandOf', () => {
  it('has the samples that an image was rendered with, which a run may set', () => {
    const watch = GALLERY.find(({ id }) => id === 'watch-blue')!;
    expect(commandOf(watch)).toContain(' --samples 256 ');
    expect(commandOf(watch, 64)).toBe(commandOf(watch).replace('--samples 256', '--samples 64'));
  });
});

describe('cameraJson', () => {
  it('gives position, target and lens of a camera that looks along -z of its frame', () => {
    const camera: PerspectiveCamera = {
      type: 'perspective',
      name: 'Side',
      // Looks along -x.
      transform: [0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 3, 0.5, 0.25, 1],
      yfov: Math.PI / 6,
      lens_radius: 0.002,
      focus_distance: 2,
    };
    expect(JSON.parse(cameraJson(camera))).toEqual({
      name: 'Side',
      position: [3, 0.5, 0.25],
      target: [1, 0.5, 0.25],
      fov: 30,
      lens_radius: 0.002,
      focus_distance: 2,
    });
  });
});
