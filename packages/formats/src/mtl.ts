import type { Material, TextureBinding, TextureChannels, TexturedParameter } from '@glanz/scene';

/** An image that an MTL file asks for. */
export interface MtlMap {
  readonly parameter: TexturedParameter;
  readonly channels: TextureChannels;
  readonly colorSpace: 'srgb' | 'linear';
  readonly path: string;
  readonly clamp: boolean;
  readonly transform?: TextureBinding['transform'];
  readonly scale?: number;
}

/** A material of an MTL file. */
export interface MtlMaterial {
  readonly material: Material;
  readonly maps: readonly MtlMap[];
}

type Words = readonly string[];

/** How many words an option of a texture takes; `-s`, `-o` and `-t` take one to three. */
const OPTION_WORDS: Readonly<Record<string, number>> = {
  '-blendu': 1,
  '-blendv': 1,
  '-cc': 1,
  '-clamp': 1,
  '-boost': 1,
  '-texres': 1,
  '-imfchan': 1,
  '-type': 1,
  '-bm': 1,
  '-mm': 2,
};

const MAPS: Readonly<Record<string, readonly [TexturedParameter, TextureChannels, 'srgb' | 'linear']>> = {
  map_kd: ['base_color', 'rgb', 'srgb'],
  map_ke: ['emission_color', 'rgb', 'srgb'],
  map_d: ['geometry_opacity', 'r', 'linear'],
  map_pr: ['specular_roughness', 'r', 'linear'],
  map_pm: ['base_metalness', 'r', 'linear'],
  norm: ['geometry_normal', 'rgb', 'linear'],
};

function readMap(
  words: Words,
  [parameter, channels, colorSpace]: readonly [TexturedParameter, TextureChannels, 'srgb' | 'linear'],
): MtlMap | undefined {
  let clamp = false;
  const scale = [1, 1],
    offset = [0, 0];
  let strength: number | undefined;
  let i = 0;
  while (i < words.length && (words[i] as string).startsWith('-')) {
    const option = (words[i++] as string).toLowerCase();
    if (option === '-s' || option === '-o' || option === '-t') {
      for (let k = 0; k < 3 && i < words.length - 1 && Number.isFinite(Number(words[i])); k++, i++) {
        if (k < 2 && option !== '-t') (option === '-s' ? scale : offset)[k] = Number(words[i]);
      }
      continue;
    }
    if (option === '-clamp') clamp = words[i]?.toLowerCase() === 'on';
    if (option === '-bm') strength = Number(words[i]);
    i += OPTION_WORDS[option] ?? 1;
  }
  const path = words.slice(i).join(' ');
  if (path === '') return undefined;
  const [sx, sy, ox, oy] = [scale[0], scale[1], offset[0], offset[1]] as [number, number, number, number];
  // v runs up in OBJ and down here: v' = 1 − (sy (1 − v) + oy).
  const moved = sx !== 1 || sy !== 1 || ox !== 0 || oy !== 0;
  return {
    parameter,
    channels,
    colorSpace,
    path,
    clamp,
    ...(moved ? { transform: [sx, 0, 0, sy, ox, 1 - sy - oy] as const } : {}),
    ...(strength !== undefined && Number.isFinite(strength) && parameter === 'geometry_normal'
      ? { scale: strength }
      : {}),
  };
}

/**
 * Reads an MTL file: the classic Phong statements and the physically based ones that Blender and others add (Pr, Pm,
 * Ps, Pc, Pcr, aniso, norm). Phong's exponent becomes the roughness of the GGX lobe with the same width (B. Walter et
 * al., "Microfacet Models for Refraction through Rough Surfaces", 2007): α² = 2 / (Ns + 2).
 */
export function readMtl(text: string): Map<string, MtlMaterial> {
  const materials = new Map<string, MtlMaterial>();
  let statements = new Map<string, Words>();
  for (const line of text.replace(/\\\r?\n/g, ' ').split(/\r?\n/)) {
    const [key = '', ...words] = line.replace(/#.*/, '').trim().split(/\s+/);
    if (key === '') continue;
    if (key.toLowerCase() === 'newmtl') {
      statements = new Map();
      const name = words.join(' ');
      if (!materials.has(name)) materials.set(name, lazily(name, statements));
    } else statements.set(key.toLowerCase(), words);
  }
  return materials;
}

/** Made when it is asked for: by then all its statements have been read. */
function lazily(name: string, statements: ReadonlyMap<string, Words>): MtlMaterial {
  let made: MtlMaterial | undefined;
  const get = () => (made ??= makeMaterial(name, statements));
  return {
    get material() {
      return get().material;
    },
    get maps() {
      return get().maps;
    },
  };
}

function makeMaterial(name: string, statements: ReadonlyMap<string, Words>): MtlMaterial {
  const numbers = (key: string): number[] | undefined => {
    const words = statements.get(key);
    const values = words?.map(Number).filter((x) => Number.isFinite(x) && x >= 0);
    return values && values.length > 0 ? values : undefined;
  };
  const one = (key: string): number | undefined => numbers(key)?.[0];
  const unit = (key: string): number | undefined => {
    const value = one(key);
    return value === undefined ? undefined : Math.min(value, 1);
  };
  const color = (key: string): [number, number, number] | undefined => {
    const values = numbers(key);
    return values && [values[0] as number, values[1] ?? (values[0] as number), values[2] ?? (values[0] as number)];
  };
  const parameters: Record<string, unknown> = {};
  const set = (key: string, value: unknown) => {
    if (value !== undefined) parameters[key] = value;
  };
  const clamped = (c: [number, number, number] | undefined) => c?.map((x) => Math.min(x, 1));
  const maps = [...statements].flatMap(([key, words]) => {
    const map = MAPS[key] && readMap(words, MAPS[key]);
    return map ? [map] : [];
  });
  const has = (parameter: string) => maps.some((map) => map.parameter === parameter);
  set('base_color', clamped(color('kd')) ?? (has('base_color') ? [1, 1, 1] : undefined));
  const illumination = one('illum');
  const specular = color('ks');
  if (illumination === 0 || illumination === 1) set('specular_weight', 0);
  // Exporters write 0.5 for a dielectric of index 1.5.
  else if (specular) set('specular_weight', Math.min(1, 2 * Math.max(...specular)));
  const exponent = one('ns');
  const roughness = unit('pr');
  set(
    'specular_roughness',
    roughness ?? (has('specular_roughness') ? 1 : exponent === undefined ? undefined : (2 / (exponent + 2)) ** 0.25),
  );
  set('base_metalness', unit('pm') ?? (has('base_metalness') ? 1 : undefined));
  const index = one('ni');
  if (index !== undefined && index > 1) set('specular_ior', index);
  set('coat_weight', unit('pc'));
  set('coat_roughness', unit('pcr'));
  set('fuzz_weight', unit('ps'));
  set('specular_roughness_anisotropy', unit('aniso'));
  const emission = color('ke');
  const brightest = Math.max(...(emission ?? [0]));
  if (brightest > 0 || has('emission_color')) {
    set('emission_color', brightest > 0 ? (emission as number[]).map((x) => x / brightest) : [1, 1, 1]);
    set('emission_luminance', brightest > 0 ? brightest : 1);
  }
  const opacity = unit('d') ?? (unit('tr') === undefined ? undefined : 1 - (unit('tr') as number));
  if (illumination === 6 || illumination === 7) {
    set('transmission_weight', 1);
    set('transmission_color', clamped(color('tf')));
  } else if ((opacity ?? 1) < 1 || has('geometry_opacity')) set('geometry_opacity', opacity ?? 1);
  return { material: { name, parameters }, maps };
}
