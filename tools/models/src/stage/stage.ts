import { createScene, frameCamera, type Material, type PerspectiveCamera, type Scene } from '@glanz/scene';
import { cross, subtract } from 'gl-matrix/esm/vec3.js';
import { panel } from '../shapes/boxes';
import { MeshBuilder } from '../shapes/mesh-builder';
import { surface } from '../shapes/surface';
import { emitter, matte } from './materials';
import { multiply, translation, UPRIGHT, type Matrix } from './transform';

export type Point = readonly [number, number, number];
type Colour = readonly [number, number, number];

/** Options for {@link Stage.softbox}. Millimetres, world axes (+y up). */
export interface SoftboxOptions {
  readonly name: string;
  readonly at: Point;
  /** The point that it faces. */
  readonly to?: Point;
  readonly width: number;
  readonly height: number;
  /** Radiance at its centre. */
  readonly radiance: number;
  readonly color?: Colour;
  /**
   * Frames of falling radiance that its edge consists of, as light falls off in a real softbox; default 0, all the
   * same. Seen in reflections as a gradient.
   */
  readonly gradient?: number;
}

/** Options for {@link Stage.camera}. Millimetres. */
export interface StageCameraOptions {
  /** Where the camera stands and looks. Or `direction`: then it frames the subject. */
  readonly eye?: Point;
  readonly target?: Point;
  /** From the subject towards the camera, any length. */
  readonly direction?: Point;
  /** Fraction of the image's half width and height left free around the subject; default 0.16. */
  readonly margin?: number;
  /** Moves the subject up in the image, as a fraction of its height; default 0. */
  readonly lift?: number;
  /** Names of the parts to frame start with this; default: everything but the backdrop and the lights. */
  readonly around?: string;
  /** Focal length for a full frame (36 mm wide) at the aspect 1.6; default 70. */
  readonly focalLength?: number;
  /** Radius of the lens, for depth of field; default 0. Not part of glTF. */
  readonly lensRadius?: number;
  /** The point in focus; default: the target. */
  readonly focus?: Point;
}

/** Width over height that the cameras are made for. */
const ASPECT = 1.6;

/** Axes of a frame at `eye` whose z points away from `target`. */
function frame(eye: Point, target: Point): number[] {
  const back = subtract([0, 0, 0], eye, target);
  const distance = Math.hypot(...back);
  const z = back.map((value) => value / distance) as unknown as [number, number, number];
  const flat = Math.hypot(z[0], z[2]);
  const x = flat > 1e-6 ? ([z[2] / flat, 0, -z[0] / flat] as const) : ([1, 0, 0] as const);
  const y = cross([0, 0, 0], z, x);
  return [...x, 0, ...y, 0, ...z, 0, eye[0] / 1000, eye[1] / 1000, eye[2] / 1000, 1];
}

/**
 * Puts a scene together like a photographer's set: parts, softboxes, a sweep behind, cameras. Shapes are built in
 * millimetres with z up; the set has y up.
 */
export class Stage {
  readonly scene: Scene;
  #variantCount = 0;

  constructor(name: string) {
    this.scene = createScene(name);
  }

  /** Index of a material; those of one name are one. */
  material(material: Material): number {
    const found = this.scene.materials.findIndex(({ name }) => name === material.name);
    return found >= 0 ? found : this.scene.materials.push(structuredClone(material)) - 1;
  }

  /**
   * Adds a part, built with z up and placed by a matrix.
   *
   * @param place Matrices, the outermost first; by default the part stands upright at the origin.
   */
  add(name: string, material: Material, shape: (builder: MeshBuilder) => void, ...place: readonly Matrix[]): number {
    const builder = new MeshBuilder();
    shape(builder);
    const mesh = this.scene.meshes.push(builder.build(name)) - 1;
    return this.place(name, material, mesh, ...place);
  }

  /** Adds another instance of a mesh. */
  place(name: string, material: Material, mesh: number, ...place: readonly Matrix[]): number {
    this.scene.instances.push({
      name,
      mesh,
      material: this.material(material),
      transform: [...place, UPRIGHT].reduce(multiply),
    });
    return mesh;
  }

  /** Lowers or raises the parts from the instance `first` on until the lowest of their vertices lies at y, millimetres. */
  rest(first = 0, y = 0): void {
    const instances = this.scene.instances.slice(first);
    let lowest = Infinity;
    for (const { mesh, transform: m } of instances) {
      const { positions: p } = this.scene.meshes[mesh]!;
      for (let i = 0; i < p.length; i += 3)
        lowest = Math.min(lowest, m[1]! * p[i]! + m[5]! * p[i + 1]! + m[9]! * p[i + 2]! + m[13]!);
    }
    for (const instance of instances)
      instance.transform = multiply(at(0, y - lowest * 1000, 0), [...(instance.transform as number[])]);
  }

  /** Gives the material of one name another one in each variant, by the variant's name. */
  variants(material: Material, variants: Readonly<Record<string, Material>>): void {
    const index = this.material(material);
    this.scene.variants ??= [];
    for (const [name, other] of Object.entries(variants)) {
      if (!this.scene.variants.includes(name)) this.scene.variants.push(name);
      const variant = this.scene.variants.indexOf(name);
      const replacement = this.material(other);
      for (const instance of this.scene.instances)
        if (instance.material === index) instance.variants = { ...instance.variants, [variant]: replacement };
    }
    this.#variantCount = this.scene.variants.length;
  }

  /** Number of variants so far. */
  get variantCount(): number {
    return this.#variantCount;
  }

  /** A rectangular light that faces a point; its back is black. */
  softbox({
    name,
    at,
    to = [0, 0, 0],
    width,
    height,
    radiance,
    color = [1, 1, 1],
    gradient = 0,
  }: SoftboxOptions): void {
    const transform = frame(at, to);
    // The front is +z of the frame, which points away from the target: turned about y.
    for (const column of [0, 8]) for (let k = 0; k < 3; k++) transform[column + k]! *= -1;
    const push = (label: string, level: number, shape: (builder: MeshBuilder) => void) => {
      const builder = new MeshBuilder();
      shape(builder);
      this.scene.instances.push({
        name: label,
        mesh: this.scene.meshes.push(builder.build(label)) - 1,
        material: this.material(emitter(label, radiance * level, color)),
        transform,
      });
    };
    if (gradient === 0) {
      push(name, 1, (b) => panel(b, width, height));
      return;
    }
    // The frames have one width, that of a share of the shorter side.
    const border = (0.3 * Math.min(width, height)) / gradient;
    for (let i = 0; i < gradient; i++) {
      const [w, h] = [width / 2 - i * border, height / 2 - i * border];
      const level = 0.12 + 0.88 * Math.sin(((i + 0.5) / gradient) * (Math.PI / 2)) ** 1.5;
      push(`${name} edge ${i + 1}`, level, (b) => {
        const ring = (x: number, y: number) => [
          b.vertex(-x, -y, 0, 0, 0, 1),
          b.vertex(x, -y, 0, 0, 0, 1),
          b.vertex(x, y, 0, 0, 0, 1),
          b.vertex(-x, y, 0, 0, 0, 1),
        ];
        const [outer, inner] = [ring(w, h), ring(w - border, h - border)];
        for (let k = 0; k < 4; k++) {
          const l = (k + 1) % 4;
          b.quad(outer[k]!, outer[l]!, inner[l]!, inner[k]!);
        }
      });
    }
    push(name, 1, (b) => panel(b, width - 2 * gradient * border, height - 2 * gradient * border));
  }

  /** A floor that rises into a wall behind the subject without an edge. Millimetres. */
  sweep(
    material: Material = matte('backdrop', [0.8, 0.8, 0.8]),
    {
      width = 4000,
      front = 1500,
      back = 900,
      radius = 500,
      height = 2000,
      y = 0,
    }: { width?: number; front?: number; back?: number; radius?: number; height?: number; y?: number } = {},
  ): void {
    const straight = front + back - radius;
    const bend = (radius * Math.PI) / 2;
    const total = straight + bend + (height - radius);
    this.add('Backdrop', material, (b) =>
      surface(
        b,
        (u, v) => {
          const s = v * total;
          const x = (u - 0.5) * width;
          if (s < straight) return [x, s - front, y];
          const angle = Math.min((s - straight) / radius, Math.PI / 2);
          const up = Math.max(s - straight - bend, 0);
          return [x, back - radius + radius * Math.sin(angle), y + radius * (1 - Math.cos(angle)) + up];
        },
        { nu: 1, nv: 160 },
      ),
    );
  }

  /** The parts that make up the subject, framed by a camera that looks against a direction. Millimetres. */
  #framed(
    { direction = [0, 0, 1], margin = 0.16, lift = 0, around }: StageCameraOptions,
    yfov: number,
  ): [Point, Point] {
    const isLight = (material: number) => (this.scene.materials[material]!.parameters.emission_luminance ?? 0) > 0;
    const instances = this.scene.instances.filter(({ name, material }) =>
      around === undefined ? name !== 'Backdrop' && !isLight(material) : name.startsWith(around),
    );
    const { transform, focus_distance = 1 } = frameCamera(
      { ...this.scene, instances },
      { aspect: ASPECT, yfov, direction, margin },
    );
    const eye = [12, 13, 14].map((k) => transform[k]! * 1000);
    const raise = 2 * lift * Math.tan(yfov / 2) * focus_distance * 1000;
    const lower = (p: readonly number[]) => p.map((x, k) => x - raise * transform[4 + k]!) as unknown as Point;
    return [lower(eye), lower(eye.map((x, k) => x - transform[8 + k]! * focus_distance * 1000))];
  }

  /** A camera by name. */
  camera(name: string, options: StageCameraOptions): void {
    const { focalLength = 70, lensRadius } = options;
    const yfov = 2 * Math.atan(36 / ASPECT / 2 / focalLength);
    const [eye, target] = options.eye && options.target ? [options.eye, options.target] : this.#framed(options, yfov);
    const focus = options.focus ?? target;
    const camera: PerspectiveCamera = {
      type: 'perspective',
      name,
      transform: frame(eye, target),
      yfov,
      aspect: ASPECT,
    };
    if (lensRadius !== undefined) {
      camera.lens_radius = lensRadius / 1000;
      const [direction, to] = [subtract([0, 0, 0], target, eye), subtract([0, 0, 0], focus, eye)];
      const length = Math.hypot(...direction);
      camera.focus_distance = direction.reduce((sum, value, k) => sum + (value / length) * to[k]!, 0) / 1000;
    }
    this.scene.cameras.push(camera);
  }
}

/** A matrix that moves a part, millimetres, with y up. */
export const at = (x: number, y: number, z: number): Matrix => translation(x / 1000, y / 1000, z / 1000);
