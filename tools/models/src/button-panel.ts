import type { Material, Mesh, Scene } from '@glanz/scene';
import { createPushButtonKit, PUSH_BUTTON_KIT } from './push-button/kit';
import { roundedBox } from './shapes/boxes';
import { lathe } from './shapes/lathe';
import { ALUMINIUM, BRASS, CHROME, coated, COPPER, matte, metal, plastic } from './stage/materials';
import { at, Stage } from './stage/stage';
import { multiply, rotation, type Matrix } from './stage/transform';

type Colour = readonly [number, number, number];

const lit = (name: string, base: Colour, glow: Colour, luminance: number, roughness = 0.08): Material => ({
  name,
  parameters: {
    base_color: base,
    base_metalness: 0,
    specular_roughness: roughness,
    emission_color: glow,
    emission_luminance: luminance,
  },
});

/** Buttons of the panel: parts of the kit and their finishes. */
const BUTTONS: readonly {
  readonly lens: string;
  readonly legend: string;
  readonly bezel: string;
  readonly finish: Material;
  readonly color: Material;
  readonly halo: Material;
}[] = [
  {
    lens: 'flush',
    legend: 'power',
    bezel: 'round',
    finish: metal('chrome', CHROME, 0.08),
    color: lit('lens green', [0.012, 0.33, 0.08], [0.03, 1, 0.2], 0.25),
    halo: lit('halo green', [0.3, 0.5, 0.35], [0.2, 1, 0.4], 3.4, 0.2),
  },
  {
    lens: 'domed',
    legend: 'run',
    bezel: 'slim',
    finish: metal('brass', BRASS, 0.14),
    color: lit('lens white', [0.72, 0.72, 0.7], [1, 0.9, 0.75], 0.2),
    halo: lit('halo white', [0.6, 0.6, 0.6], [1, 0.82, 0.6], 2.6, 0.2),
  },
  {
    lens: 'flush',
    legend: 'plus',
    bezel: 'square',
    finish: metal('aluminium blasted', ALUMINIUM, 0.42),
    color: lit('lens blue', [0.012, 0.08, 0.45], [0.08, 0.3, 1], 0.3),
    halo: lit('halo blue', [0.3, 0.35, 0.5], [0.15, 0.45, 1], 3.4, 0.2),
  },
  {
    lens: 'raised',
    legend: 'arrow',
    bezel: 'round',
    finish: metal('copper', COPPER, 0.12),
    color: lit('lens amber', [0.6, 0.22, 0.01], [1, 0.42, 0.02], 0.3),
    halo: lit('halo amber', [0.5, 0.4, 0.3], [1, 0.5, 0.1], 3, 0.2),
  },
  {
    lens: 'flush',
    legend: 'stop',
    bezel: 'round',
    finish: coated(metal('anodised black', [0.04, 0.04, 0.045], 0.3), 0.1, 0.5),
    color: lit('lens violet', [0.16, 0.02, 0.36], [0.5, 0.12, 1], 0.3),
    halo: lit('halo violet', [0.4, 0.3, 0.5], [0.55, 0.2, 1], 3.4, 0.2),
  },
  {
    lens: 'mushroom',
    legend: 'halt',
    bezel: 'slim',
    finish: metal('steel', [0.56, 0.56, 0.57], 0.2),
    color: coated(plastic('mushroom red', [0.55, 0.012, 0.012], 0.35), 0.05),
    halo: lit('halo red', [0.5, 0.3, 0.3], [1, 0.12, 0.05], 3.4, 0.2),
  },
];

/** The push-button family: six buttons of the kit in finishes of their own, on a blasted panel. */
export function createButtonPanel(): Scene {
  const stage = new Stage('Push-button panel');
  const kit = createPushButtonKit({ level: 'medium' });
  const lean: Matrix = rotation('x', -52);
  const meshes = new Map<string, number>();
  const part = (name: string): { mesh: Mesh; transform: Matrix } => {
    const instance = kit.instances.find((one) => one.name === name)!;
    return { mesh: kit.meshes[instance.mesh]!, transform: Array.from(instance.transform) };
  };
  const put = (label: string, name: string, material: Material, place: Matrix, replaced?: Matrix) => {
    const { mesh, transform } = part(name);
    let index = meshes.get(name);
    if (index === undefined) meshes.set(name, (index = stage.scene.meshes.push(mesh) - 1));
    stage.scene.instances.push({
      name: label,
      mesh: index,
      material: stage.material(material),
      transform: [lean, place, replaced ?? transform].reduce(multiply),
    });
  };
  // Built with z up, as the front of the buttons; the panel then leans back.
  stage.add(
    'Panel',
    metal('panel', [0.3, 0.305, 0.315], 0.42),
    (b) => roundedBox(b, { at: [0, 0, -5], size: [176, 122, 5], corner: 9, edge: 1.2 }),
    lean,
    rotation('x', 90),
  );
  const screw = metal('screw', [0.6, 0.6, 0.6], 0.22);
  for (const [i, [x, y]] of (
    [
      [-79, -52],
      [79, -52],
      [79, 52],
      [-79, 52],
    ] as const
  ).entries())
    stage.add(
      `Screw ${i + 1}`,
      screw,
      (b) =>
        lathe(
          b,
          [
            [0, -1],
            [3.6, -1],
            [3.6, 0.8, 0.4],
            [3, 1.6, 0.5],
            [1.5, 1.6, 0.1],
            [1.3, 0.4],
            [0, 0.4],
          ],
          40,
        ),
      lean,
      at(x, y, 0),
      rotation('x', 90),
    );
  const seal = plastic('rubber', [0.018, 0.018, 0.019], 0.6);
  const white = lit('legend', [0.8, 0.8, 0.8], [1, 1, 1], 1.6, 0.3);
  for (const [i, { lens, legend, bezel, finish, color, halo }] of BUTTONS.entries()) {
    const place = at(((i % 3) - 1) * 52, (i < 3 ? 1 : -1) * 25.5, 0);
    const name = (what: string) => `Button ${i + 1} ${what}`;
    put(name('seal'), 'Seal', seal, place);
    put(name('bezel'), `Bezel ${bezel}`, finish, place);
    put(name('light ring'), 'Light ring', halo, place);
    put(name('lens'), `Lens ${lens}`, color, place);
    const face = PUSH_BUTTON_KIT.lenses[lens]! * 1000;
    put(name('legend'), `Legend ${legend}`, white, place, at(0, 0, face - 0.1));
  }
  stage.rest();
  stage.sweep(matte('backdrop', [0.13, 0.14, 0.155]), { front: 600, back: 320, radius: 240, height: 800, width: 1900 });
  stage.softbox({
    name: 'Over',
    at: [110, 460, 170],
    to: [0, 40, 0],
    width: 460,
    height: 280,
    radiance: 2.4,
    gradient: 8,
  });
  stage.softbox({
    name: 'Key',
    at: [-240, 320, 60],
    to: [0, 40, 0],
    width: 260,
    height: 200,
    radiance: 6,
    gradient: 8,
  });
  stage.softbox({
    name: 'Right',
    at: [330, 190, 60],
    to: [0, 40, 0],
    width: 70,
    height: 300,
    radiance: 4,
    gradient: 6,
  });
  stage.softbox({
    name: 'Behind',
    at: [30, 330, -260],
    to: [0, 40, 0],
    width: 420,
    height: 110,
    radiance: 4,
    gradient: 6,
  });
  stage.camera('Panel', {
    direction: [-0.28, 0.62, 1],
    around: 'Panel',
    margin: 0.08,
    focalLength: 85,
    lensRadius: 1.6,
    focus: [0, 36, 12],
  });
  stage.camera('Close', {
    direction: [-0.5, 0.8, 1],
    around: 'Button 1',
    margin: 0,
    focalLength: 95,
    lensRadius: 1.1,
  });
  return stage.scene;
}
