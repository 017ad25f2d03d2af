/** An image of the gallery: what is rendered, and how. */
export interface GalleryImage {
  /** Name of the image's file. */
  readonly id: string;
  readonly title: string;
  /** What the image shows, for those who cannot see it. */
  readonly alt: string;
  /** Name of the model; see `GALLERY_MODELS` of `@glanz/models/gallery`. */
  readonly model: string;
  /** Name of one of the model's cameras. */
  readonly camera: string;
  /** Name of one of the model's variants; default: the model's own look. */
  readonly variant?: string;
  /** Options of `glanz render` beside those of {@link DEFAULTS}. */
  readonly options?: Readonly<Record<string, string | number | boolean | readonly string[]>>;
}

/** Size of the images, pixels. */
export const SIZE = { width: 1600, height: 1000 } as const;

/** Options of `glanz render` for all images that do not say otherwise. */
export const DEFAULTS = {
  env: 'none',
  samples: 256,
  'max-depth': 12,
  denoise: 'balanced',
} as const;

/** Models of more than 3 MiB: the site does not carry them. */
export const LARGE_MODELS: readonly string[] = ['amplifier', 'camera-lens', 'speedform', 'tea-set', 'watch', 'weave'];

const GLASS = { 'max-depth': 24, samples: 512 } as const;
const INSIDE = { samples: 384, 'max-volume-depth': 128 } as const;

/** The images of the gallery in their order on the page. */
export const GALLERY: readonly GalleryImage[] = [
  {
    id: 'watch-blue',
    title: 'Watch',
    alt: 'A steel wristwatch with a blue sunray dial and a stitched brown leather strap',
    model: 'watch',
    camera: 'Front',
  },
  {
    id: 'perfume-amber',
    title: 'Perfume',
    alt: 'A perfume bottle of thick glass with amber liquid, a gold cap and a paper label',
    model: 'perfume',
    camera: 'Front',
    options: GLASS,
  },
  {
    id: 'armchair-emerald',
    title: 'Velvet armchair',
    alt: 'A tub chair in emerald velvet, stitched into upright channels, on brass legs',
    model: 'armchair',
    camera: 'Three quarters',
  },
  {
    id: 'speedform-red',
    title: 'Car paint',
    alt: 'A streamlined body in red metallic paint under a clear coat, with long softboxes reflected along its flank',
    model: 'speedform',
    camera: 'Three quarters',
  },
  {
    id: 'ring-diamond',
    title: 'Ring',
    alt: 'A gold ring with a brilliant-cut diamond that splits light into colours, on a dark polished table',
    model: 'ring',
    camera: 'Front',
    options: GLASS,
  },
  {
    id: 'lamps',
    title: 'Room of lights',
    alt: 'A dark room with a polished floor in which globes of opal glass hang at many heights',
    model: 'lamps',
    camera: 'Room',
    options: { samples: 160, 'max-depth': 10, exposure: 0.5 },
  },
  {
    id: 'tumbler-whisky',
    title: 'Whisky on ice',
    alt: 'A heavy tumbler of whisky with ice cubes, on a cork coaster',
    model: 'tumbler',
    camera: 'Front',
    options: GLASS,
  },
  {
    id: 'knot-jade',
    title: 'Jade',
    alt: 'A trefoil knot carved in jade, lit from behind so that light passes through its thin parts',
    model: 'knot',
    camera: 'Front',
    options: INSIDE,
  },
  {
    id: 'amplifier',
    title: 'Amplifier',
    alt: 'A hi-fi amplifier with a brushed aluminium front, turned knobs and two lit meters',
    model: 'amplifier',
    camera: 'Front',
  },
  {
    id: 'candles',
    title: 'Candles',
    alt: 'Three burning candles whose wax glows around the flames, in brass dishes',
    model: 'candles',
    camera: 'Front',
    options: { ...INSIDE, samples: 1024 },
  },
  {
    id: 'tea-set-celadon',
    title: 'Tea set',
    alt: 'A teapot in celadon glaze with a bamboo handle, bowls of tea and a cobalt vase',
    model: 'tea-set',
    camera: 'Front',
    options: { samples: 160 },
  },
  {
    id: 'button-panel',
    title: 'Push-buttons',
    alt: 'Six illuminated push-buttons with bezels of chrome, brass, aluminium, copper, black and steel on a metal panel',
    model: 'button-panel',
    camera: 'Panel',
    options: { samples: 160 },
  },
  {
    id: 'bubbles',
    title: 'Soap bubbles',
    alt: 'Soap bubbles of many sizes before a dark backdrop, coloured by interference in their films',
    model: 'bubbles',
    camera: 'Front',
    options: GLASS,
  },
  {
    id: 'chess-clear',
    title: 'Chess',
    alt: 'A chess game of clear glass pieces against black ones on a wooden board',
    model: 'chess',
    camera: 'Low',
    options: GLASS,
  },
  {
    id: 'weave',
    title: 'Twill',
    alt: 'Woven cloth from near, with every yarn of an indigo and ochre twill',
    model: 'weave',
    camera: 'Near',
  },
  {
    id: 'mail-steel',
    title: 'Mail',
    alt: 'Mail of steel rings with a band of brass, draped over a ball',
    model: 'mail',
    camera: 'Near',
  },
  {
    id: 'camera-lens',
    title: 'Lens, cut out',
    alt: 'A photographic lens with violet and green coatings, cut out on a transparent background with its shadow',
    model: 'camera-lens',
    camera: 'Front',
    options: { ...GLASS, samples: 160, transparent: true, catcher: ['Backdrop'] },
  },
  {
    id: 'knot-titanium',
    title: 'Anodised titanium',
    alt: 'A trefoil knot of titanium, coloured by a thin oxide film',
    model: 'knot',
    camera: 'Front',
    variant: 'titanium',
    options: { samples: 160 },
  },
  {
    id: 'watch-dial',
    title: 'Salmon dial',
    alt: 'The salmon dial of a watch from near, with polished indices and a steel bezel',
    model: 'watch',
    camera: 'Dial',
    variant: 'salmon',
  },
  {
    id: 'perfume-rose',
    title: 'Rose',
    alt: 'The perfume bottle with rose liquid and a rose gold cap',
    model: 'perfume',
    camera: 'Detail',
    variant: 'rose',
    options: GLASS,
  },
  {
    id: 'armchair-blush',
    title: 'Blush velvet',
    alt: 'The armchair in blush velvet from near, with light at the edges of its channels',
    model: 'armchair',
    camera: 'Detail',
    variant: 'blush',
  },
  {
    id: 'ring-sapphire',
    title: 'Sapphire',
    alt: 'A sapphire in a platinum setting from near',
    model: 'ring',
    camera: 'Stone',
    variant: 'sapphire',
    options: GLASS,
  },
  {
    id: 'tumbler-water',
    title: 'Water on ice',
    alt: 'A heavy tumbler of water with ice cubes',
    model: 'tumbler',
    camera: 'Front',
    variant: 'water',
    options: { ...GLASS, samples: 160 },
  },
  {
    id: 'knot-wax',
    title: 'Wax',
    alt: 'The trefoil knot in wax, glowing red where it is thin',
    model: 'knot',
    camera: 'Front',
    variant: 'wax',
    options: { ...INSIDE, samples: 160 },
  },
  {
    id: 'amplifier-knob',
    title: 'Turned knob',
    alt: 'The volume knob of the amplifier from near, with the fan-shaped highlights of turned aluminium',
    model: 'amplifier',
    camera: 'Knob',
  },
  {
    id: 'speedform-blue',
    title: 'Blue metallic',
    alt: 'The streamlined body in blue metallic paint',
    model: 'speedform',
    camera: 'Three quarters',
    variant: 'blue',
    options: { samples: 160 },
  },
  {
    id: 'tea-set-tenmoku',
    title: 'Tenmoku',
    alt: 'The tea set with its teapot in dark brown tenmoku glaze',
    model: 'tea-set',
    camera: 'Front',
    variant: 'tenmoku',
    options: { samples: 160 },
  },
  {
    id: 'mail-copper',
    title: 'Copper mail',
    alt: 'Mail of copper rings with a band of silver',
    model: 'mail',
    camera: 'Near',
    variant: 'copper',
    options: { samples: 160 },
  },
  {
    id: 'chess-frosted',
    title: 'Frosted glass',
    alt: 'The chess game with pieces of frosted glass',
    model: 'chess',
    camera: 'Low',
    variant: 'frosted',
    options: { ...GLASS, samples: 160 },
  },
];
