/**
 * Where the image of a model differs from those of other renderers, and why. Update a note when its image changes.
 */
export const NOTES: Readonly<Record<string, string>> = {
  SunglassesKhronos: 'The lenses reflect violet to blue: a thin film over a nearly black base.',
  IridescentDishWithOlives:
    'Noisy at 16 samples: the olives are seen and lit through two walls of glass, each with a thin film.',
  TextureSettingsTest:
    'The row "single-sided" shows its cross, because surfaces are visible from both sides. Rasterisers cull the back of such a surface, so that the tick behind it is visible. `backFaceCulling: \'all\'` does the same here.',
  NegativeScaleTest:
    'The column "back" shows its crosses for the same reason as TextureSettingsTest: nothing is culled unless `backFaceCulling` asks for it. The two rows of spheres below look alike, which shows that mirrored parts have the right winding and shading.',
  'hotel-room':
    'A closed room, framed from outside as all models are. Rasterisers cull the walls, which hide the interior here. The model has no lights, so its interior is dark; images of it elsewhere are lit by the viewer.',
  'CornellBox-babylon':
    'Framed like all models, from the front right and above. The camera of the file looks straight into the box.',
  'CornellBox-bevy': 'Noisy at 16 samples: the only light is small and reaches the box through one opening.',
  MixedLightingExample:
    'Overexposed: its sun has an illuminance of 2,049 lux, and no exposure is applied here. `--exposure -10` corrects it.',
  'geometry-camera-light': 'Overexposed like MixedLightingExample: its lights are in candela and lux.',
  LightsPunctualLamp:
    'The bulbs are point lights, which are invisible. The shades glow because they transmit the light.',
  'blenderio-15_transmission':
    'White metal, as the file says: metallicFactor has its default, 1, and metals transmit no light.',
  'openpbr-shader-ball': 'Black and rough, as its only material says. The model is meant for other materials.',
  'openpbr-shader-ball-neutral': 'White, as its only material says. The model is meant for other materials.',
  SimpleMorph: 'In its rest pose; `--time` applies the morph targets.',
  SimpleSkin: 'In its rest pose; `--time` bends it.',
  AnimatedTriangle: 'In its rest pose; `--time` rotates it.',
  InterpolationTest: 'In its rest pose; `--animation` and `--time` move one of the boxes.',
  MorphStressTest: 'In its rest pose; `--animation` and `--time` raise the bars.',
  RecursiveSkeletons: '84 skins share meshes, in nested hierarchies. In the rest pose many of the copies coincide.',
  MeshPrimitiveModes:
    'Triangle lists, strips and fans are rendered. Points and lines have no area and are not rendered, as four warnings say.',
  PrimitiveModeNormalsTest:
    'The columns of points and lines are empty, as warnings say. Those of triangles are rendered, with the normals of the file or with flat normals.',
  'blenderio-22_vertex_color':
    'Five triangles with vertex colours are rendered. The points and lines beside them are not, as warnings say.',
  Cameras:
    'Framed like all models. The file has a perspective and an orthographic camera (`--camera 0`, `--camera 1`).',
  TransmissionTest:
    'Rays pass straight through the thin walls and are tinted. Rasterisers blur a copy of the screen instead.',
  AttenuationTest:
    'Light passes through closed volumes, and the blue on the wall is their shadow. Rasterisers show no such shadow.',
  'blenderio-16_volume': 'As AttenuationTest.',
  'dispersion-test': 'Noisy at 16 samples: the prisms form a caustic of many small bright squares.',
  EmissiveStrengthTest: 'The emissive cubes light the walls around them. In rasterisers the walls stay dark.',
  'glass-table':
    'The table top has no KHR_materials_volume, so it is thin-walled: it does not refract what is behind it.',
  AlphaBlendModeTest: 'Blended parts cast lighter shadows, in proportion to their opacity.',
  'blenderio-01_vertex_count_32bit':
    'A blue box. Its triangles are wound inwards and its normals point outwards. The normals decide, as a warning says; rasterisers cull the outside of the box.',
  'webp-babylon': 'Black and rough, as its textures are.',
  UnlitTest: 'Unlit colours are emitted, so that they look the same in every environment.',
  SpecularTest: 'Dark, because its base colour is black: only the highlights differ.',
  teapot: 'Open below its lid and through its spout, as the original patches are.',
};
