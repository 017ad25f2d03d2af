import type { Scene } from '@glanz/scene';
import { randomSequence } from './shapes/noise';
import { sphere } from './shapes/surface';
import { plastic } from './stage/materials';
import { at, Stage } from './stage/stage';
import { scaling } from './stage/transform';

/** Soap bubbles: thin walls of water, each with a film of another thickness, between coloured softboxes. */
export function createBubbles(): Scene {
  const stage = new Stage('Soap bubbles');
  const random = randomSequence(11);
  const films = [0.24, 0.31, 0.38, 0.46, 0.55, 0.66].map((thickness) => ({
    name: `film ${Math.round(thickness * 1000)} nm`,
    parameters: {
      base_color: [1, 1, 1] as const,
      base_metalness: 0,
      specular_roughness: 0,
      specular_ior: 1.33,
      transmission_weight: 1,
      transmission_color: [1, 1, 1] as const,
      geometry_thin_walled: true,
      thin_film_weight: 1,
      thin_film_thickness: thickness,
      thin_film_ior: 1.5,
    },
  }));
  // Bubbles that do not touch: tried in order of size.
  const placed: { x: number; y: number; z: number; r: number }[] = [{ x: -6, y: 98, z: 0, r: 62 }];
  for (let i = 0; placed.length < 13 && i < 4000; i++) {
    const r = 52 * (1 - i / 4600) ** 2 + 7;
    const candidate = { x: (random() - 0.5) * 380, y: 30 + random() * 170, z: (random() - 0.65) * 220, r };
    if (placed.every((p) => Math.hypot(p.x - candidate.x, p.y - candidate.y, p.z - candidate.z) > p.r + r + 3))
      placed.push(candidate);
  }
  let mesh: number | undefined;
  for (const [i, { x, y, z, r }] of placed.entries()) {
    const film = films[(i * 5 + 2) % films.length]!;
    const name = `Bubble ${i + 1}`;
    if (mesh === undefined) mesh = stage.add(name, film, (b) => sphere(b, [0, 0, 0], 1, 160), at(x, y, z), scaling(r));
    else stage.place(name, film, mesh, at(x, y, z), scaling(r));
  }
  stage.sweep(plastic('floor', [0.01, 0.012, 0.02], 0.3), {
    front: 900,
    back: 420,
    radius: 300,
    height: 1100,
    width: 3000,
  });
  stage.softbox({
    name: 'Left',
    at: [-420, 260, 260],
    to: [0, 100, 0],
    width: 260,
    height: 420,
    radiance: 14,
    gradient: 8,
  });
  stage.softbox({
    name: 'Right',
    at: [440, 200, 160],
    to: [0, 100, 0],
    width: 130,
    height: 420,
    radiance: 13,
    gradient: 6,
    color: [0.8, 0.9, 1],
  });
  stage.softbox({
    name: 'Above',
    at: [0, 480, -60],
    to: [0, 100, 0],
    width: 520,
    height: 200,
    radiance: 10,
    gradient: 6,
  });
  stage.softbox({
    name: 'Below',
    at: [0, 14, -330],
    to: [0, 150, 0],
    width: 500,
    height: 24,
    radiance: 7,
    color: [1, 0.6, 0.8],
  });
  stage.camera('Front', {
    eye: [40, 120, 760],
    target: [0, 104, 0],
    focalLength: 72,
    lensRadius: 4.5,
    focus: [-6, 98, 50],
  });
  return stage.scene;
}
