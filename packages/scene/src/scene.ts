import type { Camera } from './camera';
import type { Environment } from './environment';
import type { Image, Texture } from './texture';
import type { Light } from './light';
import type { Material } from './material';
import type { Mesh } from './mesh';

/** A fault that a loader could work around. Shown to the user; never fatal. */
export interface SceneWarning {
  /** Stable, machine-readable: `<package>/<what>`. */
  readonly code: string;
  /** One line for people. */
  readonly message: string;
  /** JSON pointer or readable path into the source file. */
  readonly path?: string;
}

/** One placement of a mesh in the world with a material on it. */
export interface Instance {
  /** Name of the part; not necessarily unique. */
  name: string;
  /** Index into {@link Scene.meshes}. */
  mesh: number;
  /** Index into {@link Scene.materials}. */
  material: number;
  /**
   * Object to world, 16 numbers, column-major (column vectors, translation in 12..14). Any affine matrix; may mirror or
   * shear.
   */
  transform: ArrayLike<number>;
  /** Default true. An invisible instance casts no shadow either. */
  visible?: boolean;
  /**
   * Shadow catcher, default false: represents a surface in the photograph behind the scene, such as a table. The camera
   * sees only the shadows and the light that the other instances cast on it.
   */
  catcher?: boolean;
  /**
   * Material index by the index of a variant in {@link Scene.variants}; other variants use `material`. See
   * `withVariant`.
   */
  variants?: Readonly<Record<number, number>>;
}

/**
 * An animation of the file the scene came from. A scene holds one moment of it; `openAnimations` of
 * `@glanz/gltf/animation` gives others.
 */
export interface SceneAnimation {
  readonly name: string;
  /** Seconds. */
  readonly duration: number;
}

/**
 * A whole scene as plain data: no GPU, no classes, structured-cloneable. Everything refers to everything else by index.
 * Right-handed, +Y up, metres; colours are linear with Rec.709/sRGB primaries.
 */
export interface Scene {
  name?: string;
  meshes: Mesh[];
  materials: Material[];
  images: Image[];
  textures: Texture[];
  instances: Instance[];
  lights: Light[];
  cameras: Camera[];
  /** Default: none, which is black. */
  environment?: Environment;
  /** Names of the material variants that `withVariant` applies. */
  variants?: string[];
  /** Animations that the loader can pose the scene by. */
  animations?: SceneAnimation[];
  /**
   * Of a scene with animations, or of one loaded with the option `partNodes`, for each of {@link instances} the node and
   * the primitive of its mesh in the file: what `openAnimations` of `@glanz/gltf/animation` needs to pose it.
   */
  animatedParts?: (readonly [node: number, primitive: number])[];
  /** Metadata of the file (authors, generator, licence, XMP packets), unchanged. */
  metadata?: Readonly<Record<string, unknown>>;
  /** Faults that the loader worked around. */
  warnings: SceneWarning[];
}

/** An empty scene to fill. */
export function createScene(name?: string): Scene {
  return {
    ...(name === undefined ? {} : { name }),
    meshes: [],
    materials: [],
    images: [],
    textures: [],
    instances: [],
    lights: [],
    cameras: [],
    warnings: [],
  };
}
