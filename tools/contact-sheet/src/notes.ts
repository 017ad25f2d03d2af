/**
 * Where the image of a model differs from that of other renderers, and why. A change of the image changes the note.
 */
export const NOTES: Readonly<Record<string, string>> = {
  SunglassesKhronos: 'The lenses shine from violet to blue: a thin film over a nearly black body.',
  IridescentDishWithOlives:
    'Noisy at 16 samples: the olives are seen and lit through two walls of glass, each with a film.',
  TextureSettingsTest:
    'The row "single-sided" shows its cross: surfaces are there from both sides. Rasterisers leave out the back of such a surface, and the tick behind it shows; a path tracer that did so would let light through walls.',
  NegativeScaleTest:
    'The column "back" shows its crosses for the same reason as TextureSettingsTest: nothing is culled. That mirrored parts are wound and lit rightly shows in the balls below, which are alike.',
  'hotel-room':
    'A closed room seen from outside, as all models are framed; walls that rasterisers cull hide what is in it. It has no lights, so it is dark within: its own image was lit in the viewer.',
  'CornellBox-babylon':
    'Framed like all models, from the front right and above; the box has a camera of its own that looks straight in.',
  'CornellBox-bevy': 'Noisy at 16 samples: the box is lit by a small light through one opening.',
  MixedLightingExample:
    "Overexposed: its sun has 2,049 lux, as glTF asks for, and images here are taken without a camera's exposure. With `--exposure -10` it is right.",
  'geometry-camera-light': 'Overexposed, as MixedLightingExample: its lights are in candela and lux.',
  LightsPunctualLamp: 'The bulbs are points, which are invisible; the shades glow by what passes through them.',
  'blenderio-15_transmission':
    'White metal, as it says: the materials leave metallicFactor at its default, 1, and metals transmit nothing.',
  'openpbr-shader-ball': 'Black and rough, as its only material says: it is a shape for other materials.',
  'openpbr-shader-ball-neutral': 'White, as its only material says: it is a shape for other materials.',
  SimpleMorph: 'At rest; `--time` poses it.',
  SimpleSkin: 'At rest; `--time` bends it.',
  AnimatedTriangle: 'At rest; `--time` turns it.',
  InterpolationTest: 'At rest; `--animation` and `--time` move one of the boxes.',
  MorphStressTest: 'At rest; `--animation` and `--time` grow the bars.',
  RecursiveSkeletons: '84 skins share meshes and lie in one another; many copies coincide at rest.',
  MeshPrimitiveModes:
    'Strips, fans and lists are there. Points and lines have no area, so nothing can be seen of them; four warnings say so.',
  PrimitiveModeNormalsTest:
    'The columns of points and lines are empty, as warnings say; those of triangles are there, with normals of their own and without (flat).',
  'blenderio-22_vertex_color':
    'Five triangles of vertex colours are there; the points and lines beside them are not, as warnings say.',
  Cameras:
    'Framed like all models; it has a perspective and an orthographic camera of its own (`--camera 0`, `--camera 1`).',
  TransmissionTest:
    'Rays go straight through thin walls, with a tint, and do not blur what lies behind by an image of the screen, as rasterisers do.',
  AttenuationTest:
    'Light goes through closed volumes: the blue on the wall is their shadow. Rasterisers have none there.',
  'blenderio-16_volume': 'As AttenuationTest.',
  'dispersion-test': 'Noisy at 16 samples: what is seen through prisms is a caustic of many small bright squares.',
  EmissiveStrengthTest: 'The glowing cubes light the walls around them, which rasterisers leave dark.',
  'glass-table': 'Its plate has no KHR_materials_volume, so glTF has it thin: nothing behind it is displaced.',
  AlphaBlendModeTest: 'Blended parts cast lighter shadows, in proportion to their opacity.',
  'blenderio-01_vertex_count_32bit':
    'A blue box. Its triangles are wound inwards and its normals point outwards; the normals count, as a warning says. Rasterisers cull its outside.',
  'webp-babylon': 'Black and rough, as its images are.',
  UnlitTest: 'Unlit colours are emitted, so that they come out as they are in any environment.',
  SpecularTest: 'Dark, as its base colour is black: only the highlights differ.',
  teapot: 'Open below its lid and through its spout, as the original patches are.',
};
