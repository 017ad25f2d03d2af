import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import type { PerspectiveCamera } from '@glanz/scene';
import { EquirectCamera, PhysicalCamera } from '../src/compat/index';
import { fromThree, type ThreeCamera } from '../src/index';

const seenBy = async (camera: THREE.Camera) => {
  const scene = new THREE.Scene().add(new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial()));
  const { cameras, warnings } = await fromThree(scene, camera as unknown as ThreeCamera);
  return { camera: cameras[0], warnings };
};

describe('cameras', () => {
  it('with a lens have its radius in metres, from millimetres of film', async () => {
    // 35 mm of film, 50 mm away: the full height is seen under 2 atan(35 / 100).
    const made = new PhysicalCamera((2 * Math.atan(0.35) * 180) / Math.PI, 1);
    made.fStop = 2.5;
    made.focusDistance = 4;
    made.apertureBlades = 5;
    made.apertureRotation = 0.3;
    expect(made.bokehSize).toBeCloseTo(20, 6);
    const { camera, warnings } = await seenBy(made);
    // 20 mm wide.
    expect((camera as PerspectiveCamera).lens_radius).toBeCloseTo(0.01, 9);
    expect(camera).toMatchObject({ focus_distance: 4, lens_blades: 5, lens_rotation: 0.3 });
    expect(warnings).toEqual([]);
    made.anamorphicRatio = 2;
    made.bokehSize = 40;
    const wider = await seenBy(made.clone());
    expect((wider.camera as PerspectiveCamera).lens_radius).toBeCloseTo(0.02, 9);
    expect(wider.warnings.map(({ code }) => code)).toEqual(['three/camera']);
  });

  it('without one are pinholes', async () => {
    const { camera } = await seenBy(new THREE.PerspectiveCamera(40, 1));
    expect(camera).not.toHaveProperty('lens_radius');
  });

  it('that see everything are panoramas', async () => {
    expect(await seenBy(new EquirectCamera())).toMatchObject({ camera: { type: 'panorama' }, warnings: [] });
  });
});
