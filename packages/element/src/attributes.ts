/** How the text of an attribute becomes the value of a property, and back. */
export type AttributeKind = 'text' | 'flag' | 'number';

/**
 * The attributes of the element. Attributes that model-viewer has too have the same meaning. The property of each is
 * its name in camel case, and reflects. `custom-elements.json`, which editors read, is generated from these comments;
 * `@option` stands for the values and the default of an option of the renderer, whose range is that of the attribute.
 */
export const ATTRIBUTES = {
  /** Address of the model: glTF, GLB, OBJ, STL or USD. */
  src: 'text',
  /** Alternative text: a description of the model for screen readers. */
  alt: 'text',
  /** Address of an image that is shown until the model is rendered. */
  poster: 'text',
  /**
   * With `reveal="auto"`: samples per pixel at which the image replaces the poster. It also does so when the image is
   * finished and when the user moves the camera.
   * @defaultValue 64
   */
  'poster-samples': 'number',
  /**
   * When the model is loaded: near the window (`auto`, `lazy`), or at once.
   * @values auto, lazy, eager
   * @defaultValue auto
   */
  loading: 'text',
  /**
   * When the poster disappears: once the image has enough samples (see `poster-samples`), or at `dismissPoster()`.
   * @values auto, manual
   * @defaultValue auto
   */
  reveal: 'text',
  /** Pointers and keys move the camera. */
  'camera-controls': 'flag',
  /** With `camera-controls`: the camera does not pan. */
  'disable-pan': 'flag',
  /** With `camera-controls`: a double tap does not move the target. */
  'disable-tap': 'flag',
  /** With `camera-controls`: the camera does not zoom. */
  'disable-zoom': 'flag',
  /**
   * With `camera-controls`: factor of the orbit angle per movement of the pointer or key press.
   * @defaultValue 1
   */
  'orbit-sensitivity': 'number',
  /**
   * With `camera-controls`: the same for panning.
   * @defaultValue 1
   */
  'pan-sensitivity': 'number',
  /**
   * With `camera-controls`: the same for zooming.
   * @defaultValue 1
   */
  'zoom-sensitivity': 'number',
  /**
   * With `camera-controls`: whether an icon of a hand shows that the model can be orbited, once, after a time without
   * input. Not shown to users who prefer reduced motion.
   * @values auto, none
   * @defaultValue none
   */
  'interaction-prompt': 'text',
  /**
   * Milliseconds after the load, without any input, before the prompt is shown.
   * @defaultValue 3000
   */
  'interaction-prompt-threshold': 'number',
  /**
   * Style of the prompt: a moving hand, or a still one.
   * @values wiggle, basic
   * @defaultValue wiggle
   */
  'interaction-prompt-style': 'text',
  /**
   * CSS `touch-action` of the canvas while `camera-controls` is set.
   * @defaultValue pan-y
   */
  'touch-action': 'text',
  /**
   * Where the camera is: `theta phi radius`, in deg or rad, and m, cm, mm or %.
   * @defaultValue 0deg 75deg 105%
   */
  'camera-orbit': 'text',
  /**
   * The point that the camera looks at: `x y z`, or `auto`, the centre of the model.
   * @defaultValue auto
   */
  'camera-target': 'text',
  /**
   * Vertical field of view, in deg or rad.
   * @defaultValue 30deg
   */
  'field-of-view': 'text',
  /**
   * Lower limits of `camera-orbit`.
   * @defaultValue auto
   */
  'min-camera-orbit': 'text',
  /**
   * Upper limits of `camera-orbit`.
   * @defaultValue auto
   */
  'max-camera-orbit': 'text',
  /**
   * Time constant of camera movements, in milliseconds: after this time 63 % of a movement is done.
   * @defaultValue 60
   */
  'interpolation-decay': 'number',
  /** The camera orbits continuously while there is no input. */
  'auto-rotate': 'flag',
  /**
   * Milliseconds after an interaction before the camera orbits again.
   * @defaultValue 3000
   */
  'auto-rotate-delay': 'number',
  /**
   * Speed of `auto-rotate`, in deg or rad.
   * @defaultValue 5.625deg
   */
  'rotation-per-second': 'text',
  /**
   * Light: address of a .hdr or .exr, or of a .jpg, .png or .webp (radiance up to 1), `neutral` (a studio), or `auto`:
   * the model's own, or else the studio.
   * @defaultValue auto
   */
  'environment-image': 'text',
  /**
   * Factor of the environment's light.
   * @defaultValue 1
   */
  'environment-intensity': 'number',
  /**
   * Rotation of the environment about the vertical axis, in deg or rad.
   * @defaultValue 0
   */
  'environment-rotation': 'text',
  /**
   * Address of an environment that lights the model and is visible behind it. Without it the background is transparent.
   */
  'skybox-image': 'text',
  /**
   * Exposure in EV (stops): 1 doubles the image's brightness, -1 halves it.
   * @defaultValue 0
   */
  'exposure-ev': 'number',
  /**
   * Factor of the image's brightness, as in model-viewer; ignored where `exposure-ev` is given.
   * @deprecated Use `exposure-ev`, the factor's base-2 logarithm. Supported until the next minor version.
   */
  exposure: 'number',
  /**
   * View transform from radiance to the screen.
   * @values neutral, aces, agx, reinhard, linear
   * @defaultValue neutral
   */
  'tone-mapping': 'text',
  /** Name of the animation that poses the model, and that plays; without it the first one plays. */
  'animation-name': 'text',
  /** The animation plays when the model is loaded, unless the user prefers reduced motion. */
  autoplay: 'flag',
  /**
   * Rotation of the model: `roll pitch yaw`, about +Z, then +X, then +Y, in deg or rad.
   * @defaultValue 0deg 0deg 0deg
   */
  orientation: 'text',
  /**
   * Scale of the model along x, y and z, not 0; or one number for all three.
   * @defaultValue 1 1 1
   */
  scale: 'text',
  /**
   * Strength of the shadow on the ground beneath the model, 0 to 1. Its softness follows from the lights; see
   * `shadow-softness`.
   * @defaultValue 0
   */
  'shadow-intensity': 'number',
  /**
   * Strength of the model's reflection in the ground, 0 to 1; where `shadow-intensity` is not given, that is 1.
   * @defaultValue 0
   */
  'ground-reflection': 'number',
  /** Requests for models and environments send credentials to other origins too. */
  'with-credentials': 'flag',
  /** Name of the model's material variant. Without it, the default materials. */
  'variant-name': 'text',
  /**
   * Samples per pixel at which the image is finished.
   * @option samples
   */
  samples: 'number',
  /**
   * Relative noise at which the image is finished, if reached before `samples`.
   * @option noise
   */
  noise: 'number',
  /**
   * Maximum number of edges of a path from the camera to a light.
   * @option maxDepth
   */
  'max-depth': 'number',
  /** Film pixels per CSS pixel. Without it, the device pixel ratio of the screen. */
  'pixel-ratio': 'number',
  /**
   * Culls single-sided faces that are seen from behind: for camera rays only, or for all rays.
   * @option backFaceCulling
   */
  'back-face-culling': 'text',
  /**
   * Softens the shadow on the ground beneath the model, 0 to 1: 0 leaves it unchanged, 1 spreads shadow rays by up to
   * 30 degrees. A biased option.
   * @option shadowSoftness
   */
  'shadow-softness': 'number',
  /**
   * Address of an ES module that replaces the package's decoder of Draco. Its default export is the module of
   * `draco3dgltf`, or a function that returns it or a promise of it.
   */
  'draco-decoder': 'text',
  /**
   * Address of an ES module that replaces the package's transcoder of KTX2. Its default export is the module of the
   * Basis Universal transcoder, or a function that returns it or a promise of it.
   */
  'ktx2-transcoder': 'text',
  /**
   * Address of an ES module whose default export is what `denoising()` of `@glanz/viewer/denoise` returns: with it,
   * images are denoised while they have few samples.
   */
  denoise: 'text',
  /**
   * Image while the view moves: the film's samples as they are (`raw`), filtered over time (`filtered`), or the latter
   * unless the adapter is software (`auto`).
   * @values auto, raw, filtered
   * @defaultValue auto
   */
  preview: 'text',
} as const satisfies Readonly<Record<string, AttributeKind>>;

/** Name of an attribute of the element. */
export type AttributeName = keyof typeof ATTRIBUTES;

type Camel<Name extends string> = Name extends `${infer Head}-${infer Tail}`
  ? `${Head}${Capitalize<Camel<Tail>>}`
  : Name;
type Value<Kind extends AttributeKind> = Kind extends 'flag'
  ? boolean
  : Kind extends 'number'
    ? number | null
    : string | null;

/** The properties that reflect the attributes; `null` where an attribute is missing. */
export type ReflectedProperties = {
  -readonly [Name in AttributeName as Camel<Name>]: Value<(typeof ATTRIBUTES)[Name]>;
};

/** The name of an attribute's property. */
export const camel = (name: string) => name.replace(/-([a-z])/g, (_, letter: string) => letter.toUpperCase());
