import { finish } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { prepareEnvironment } from '../../src/environment/environment';
import { PANE_BINS, PANE_COLUMNS, PANE_ROWS } from '../../src/guiding/pane_constants.wesl';
import { paneTableSteps } from '../../src/guiding/pane-table';
import { panesOf } from '../../src/materials/panes';
import { addQuad, addSphere, createScene } from '../scenes';

const pane = {
  name: 'pane',
  parameters: { transmission_weight: 1, specular_roughness: 0.05, geometry_thin_walled: true },
};

/** Dim, with one bright texel. */
function environment(x: number, y: number, rotation = 0) {
  const data = new Float32Array(3 * 64 * 32).fill(0.1);
  data.fill(1000, 3 * (64 * y + x), 3 * (64 * y + x) + 3);
  return prepareEnvironment({ type: 'latlong', width: 64, height: 32, data, rotation });
}

/** The probability of each bin. */
function chances(scene = createScene(), light = environment(0, 0)): number[] {
  const { table } = finish(paneTableSteps(scene, panesOf(scene), light));
  return Array.from({ length: PANE_BINS }, (_, bin) => table[2 + bin]! - (bin > 0 ? table[1 + bin]! : 0));
}

/** The middle of a bin. */
function middleOf(bin: number): readonly [number, number, number] {
  const x = (2 * (Math.floor(bin / PANE_COLUMNS) + 0.5)) / PANE_ROWS - 1;
  const around = (((bin % PANE_COLUMNS) + 0.5) / PANE_COLUMNS - 0.5) * 2 * Math.PI;
  return [x, Math.sqrt(1 - x * x) * Math.cos(around), Math.sqrt(1 - x * x) * Math.sin(around)];
}

describe('paneTableSteps', () => {
  it('chooses directions in which a plane mirrors a bright light', () => {
    const scene = createScene();
    addQuad(scene, 1, 0, pane);
    for (const rotation of [0, 1.2]) {
      const [x, y] = [10, 8];
      const theta = ((y + 0.5) / 32) * Math.PI;
      const phi = ((x + 0.5) / 64 - 0.5) * 2 * Math.PI - rotation;
      // Of the light, with the plane's axis turned round.
      const mirrored = [Math.sin(theta) * Math.cos(phi), Math.cos(theta), -Math.sin(theta) * Math.sin(phi)];
      const found = chances(scene, environment(x, y, rotation));
      expect(found.reduce((a, b) => a + b)).toBeCloseTo(0.2, 6);
      // A texel is 0.1 wide, as are those around it, which count as bright; slopes of 0.02 turn directions by 0.04.
      found.forEach((chance, bin) => {
        const cosine = middleOf(bin).reduce((sum, value, k) => sum + value * mirrored[k]!, 0);
        if (chance > 0.001) expect(Math.acos(cosine)).toBeLessThan(0.15 * Math.SQRT2 + 0.04);
      });
    }
  });

  it('blurs the reflections of panes with normal maps', () => {
    const scene = createScene();
    const textures = { geometry_normal: { texture: 0, channels: 'rgb' } } as const;
    const counts = [pane, { ...pane, textures }].map((material) => {
      scene.instances = [];
      addQuad(scene, 1, 0, material);
      return chances(scene, environment(10, 8)).filter((chance) => chance > 0).length;
    });
    expect(counts[1]).toBeGreaterThan(1.4 * counts[0]!);
  });

  it('leaves curved panes, dark environments and scenes without panes alone', () => {
    const curved = createScene();
    addSphere(curved, 1, [0, 0, 0], pane);
    expect(Math.max(...chances(curved))).toBe(0);
    expect(Math.max(...chances(createScene()))).toBe(0);
    const flat = createScene();
    addQuad(flat, 1, 0, pane);
    expect(Math.max(...chances(flat, prepareEnvironment({ type: 'constant', radiance: [1, 1, 1] })))).toBe(0);
  });
});

describe('panesOf', () => {
  it('finds thin walls that scatter a little', () => {
    const with_ = (parameters: object) => {
      const scene = createScene();
      addQuad(scene, 1, 0, { name: 'pane', parameters: { ...pane.parameters, ...parameters } });
      return panesOf(scene).length;
    };
    expect(with_({})).toBe(1);
    // Light samples pass smooth walls.
    expect(with_({ specular_roughness: 0 })).toBe(0);
    expect(with_({ specular_roughness: 0.3 })).toBe(0);
    expect(with_({ geometry_thin_walled: false })).toBe(0);
    expect(with_({ transmission_weight: 0 })).toBe(0);
  });
});
