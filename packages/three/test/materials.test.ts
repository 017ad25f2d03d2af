import type { Material } from '@glanz/scene';
import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { fromThree } from '../src/index';

const convert = async (
  material: THREE.Material,
): Promise<{ readonly made: Material; readonly warnings: readonly string[] }> => {
  const scene = await fromThree(new THREE.Mesh(new THREE.BoxGeometry(), material));
  return { made: scene.materials[0] as Material, warnings: scene.warnings.map(({ message }) => message) };
};

const map = () => new THREE.DataTexture(new Uint8Array([10, 20, 30, 255]), 1, 1);

describe('materials', () => {
  it('standard ones: colour, roughness, metalness, emission', async () => {
    const { made, warnings } = await convert(
      new THREE.MeshStandardMaterial({
        name: 'paint',
        color: new THREE.Color(0.2, 0.4, 0.6),
        roughness: 0.3,
        metalness: 0.7,
        emissive: new THREE.Color(0.5, 0.25, 0),
        emissiveIntensity: 4,
        side: THREE.DoubleSide,
      }),
    );
    expect(made).toMatchObject({
      name: 'paint',
      double_sided: true,
      parameters: { base_color: [0.2, 0.4, 0.6], specular_roughness: 0.3, base_metalness: 0.7 },
    });
    const { emission_color = [1, 1, 1], emission_luminance = 0 } = made.parameters;
    emission_color.forEach((value, k) => expect(value * emission_luminance).toBeCloseTo([2, 1, 0][k]!, 10));
    expect(warnings).toEqual([]);
  });

  it('physical ones: coat, transmission, volume, sheen, film, anisotropy', async () => {
    const { made, warnings } = await convert(
      new THREE.MeshPhysicalMaterial({
        clearcoat: 0.8,
        clearcoatRoughness: 0.2,
        ior: 1.33,
        transmission: 1,
        thickness: 0.5,
        attenuationDistance: 2,
        attenuationColor: new THREE.Color(0.5, 0.9, 1),
        iridescence: 0.6,
        iridescenceIOR: 1.8,
        iridescenceThicknessRange: [100, 500],
      }),
    );
    expect(made.parameters).toMatchObject({
      coat_weight: 0.8,
      coat_roughness: 0.2,
      specular_ior: 1.33,
      transmission_weight: 1,
      thin_film_weight: 0.6,
      thin_film_ior: 1.8,
    });
    // Nanometres there, micrometres here.
    expect(made.parameters.thin_film_thickness).toBeCloseTo(0.5, 10);
    expect(made.parameters.transmission_depth).toBe(2);
    expect(made.parameters.geometry_thin_walled ?? false).toBe(false);
    expect(warnings).toEqual([]);
    const thin = await convert(new THREE.MeshPhysicalMaterial({ transmission: 1 }));
    expect(thin.made.parameters.geometry_thin_walled).toBe(true);
    const cloth = await convert(
      new THREE.MeshPhysicalMaterial({ sheen: 0.5, sheenColor: new THREE.Color(1, 0, 0), sheenRoughness: 0.4 }),
    );
    expect(cloth.made.parameters.fuzz_weight).toBeGreaterThan(0);
    expect(
      (await convert(new THREE.MeshPhysicalMaterial({ anisotropy: 0.7, roughness: 0.4 }))).made.parameters
        .specular_roughness_anisotropy,
    ).toBeGreaterThan(0);
  });

  it('basic ones shine as they are, without light', async () => {
    const { made } = await convert(new THREE.MeshBasicMaterial({ color: new THREE.Color(0.25, 0.5, 1) }));
    expect(made.parameters).toMatchObject({ base_weight: 0, specular_weight: 0 });
    const { emission_color = [1, 1, 1], emission_luminance = 0 } = made.parameters;
    emission_color.forEach((value, k) => expect(value * emission_luminance).toBeCloseTo([0.25, 0.5, 1][k]!, 10));
  });

  it('other ones as standard ones, with a word', async () => {
    const { made, warnings } = await convert(
      new THREE.MeshPhongMaterial({ color: new THREE.Color(0.5, 0.5, 0.5), shininess: 30 }),
    );
    expect(made.parameters).toMatchObject({ base_color: [0.5, 0.5, 0.5], specular_roughness: 0.25 });
    expect(warnings).toEqual([expect.stringContaining('MeshPhongMaterial')]);
  });

  it('opacity counts where three blends or cuts', async () => {
    expect(
      (await convert(new THREE.MeshStandardMaterial({ opacity: 0.4 }))).made.parameters.geometry_opacity ?? 1,
    ).toBe(1);
    expect(
      (await convert(new THREE.MeshStandardMaterial({ opacity: 0.4, transparent: true }))).made.parameters
        .geometry_opacity,
    ).toBe(0.4);
    const cut = (await convert(new THREE.MeshStandardMaterial({ alphaTest: 0.6, map: map() }))).made;
    expect(cut.opacity_threshold).toBe(0.6);
    expect(cut.textures?.geometry_opacity).toMatchObject({ channels: 'a' });
    expect(
      (await convert(new THREE.MeshStandardMaterial({ transparent: true, alphaMap: map() }))).made.textures
        ?.geometry_opacity,
    ).toMatchObject({ channels: 'g' });
  });

  it('textures drive what they drive in three, also roughness and metalness by two images', async () => {
    const [color, rough, metal, normal, emission] = Array.from({ length: 5 }, map) as [
      THREE.DataTexture,
      THREE.DataTexture,
      THREE.DataTexture,
      THREE.DataTexture,
      THREE.DataTexture,
    ];
    const { made, warnings } = await convert(
      new THREE.MeshStandardMaterial({
        map: color,
        roughnessMap: rough,
        metalnessMap: metal,
        metalness: 1,
        normalMap: normal,
        normalScale: new THREE.Vector2(0.5, -0.5),
        emissive: 0xffffff,
        emissiveMap: emission,
      }),
    );
    expect(made.textures).toMatchObject({
      base_color: { texture: 0 + made.textures!.base_color!.texture, channels: 'rgb' },
      specular_roughness: { channels: 'g' },
      base_metalness: { channels: 'b' },
      geometry_normal: { channels: 'rgb', scale: 0.5 },
      emission_color: { channels: 'rgb' },
    });
    expect(made.textures!.specular_roughness!.texture).not.toBe(made.textures!.base_metalness!.texture);
    expect(warnings).toEqual([]);
    const only = await convert(new THREE.MeshStandardMaterial({ metalness: 1, metalnessMap: metal }));
    expect(Object.keys(only.made.textures!)).toEqual(['base_metalness']);
  });

  it('what has no counterpart is reported', async () => {
    const { warnings } = await convert(
      new THREE.MeshStandardMaterial({ bumpMap: map(), displacementMap: map(), lightMap: map() }),
    );
    for (const slot of ['bumpMap', 'displacementMap', 'lightMap'])
      expect(warnings.some((message) => message.includes(slot))).toBe(true);
  });
});
