import { wgslModule, type WgslModule } from '@glanz/wgsl';
import { BINDING_SCALE } from '../storage/layout';
import type { TexturedParameterInfo } from './materials';
import type { Sampling } from './textures';

/** What a texture does to a parameter; those that a map gives another meaning stand in {@link DIRECTION}. */
const FACTOR = {
  f32: 'value',
  vec3f: 'factor.rgb',
  any: 'select(vec3f(value), factor.rgb, (channels & 255u) == 4u)',
} as const;

const bent = (member: string) =>
  `(*result).${member} = (2.0 * texel.xyz - 1.0) * vec3f(vec2f(bitcast<f32>(attribute_1(at + ${BINDING_SCALE}u))), 1.0);`;

const DIRECTION: Readonly<Record<string, string>> = {
  geometry_normal: bent('normal'),
  geometry_coat_normal: bent('coat_normal'),
  geometry_tangent:
    '(*result).tangent = mat2x2f((*result).tangent, vec2f(-(*result).tangent.y, (*result).tangent.x)) * (2.0 * texel.xy - 1.0);',
};

/** The flags without which a parameter's map is not read. */
const NEEDED: Readonly<Record<string, string>> = {
  geometry_tangent: 'TANGENT_MAP',
  geometry_coat_normal: 'OPENPBR_COAT_FRAME',
};

/**
 * What `material.wesl` asks for in a scene with textures: a case for each way to read a texel, and one for each
 * parameter that some material textures.
 *
 * @param samplings In the order of the records' `sampling` numbers.
 * @param textured Parameters that are textured, with their number in the records and what they are.
 * @param flags Of the kernels.
 */
export function materialCases(
  samplings: readonly Sampling[],
  textured: readonly TexturedParameterInfo[],
  flags: Readonly<Record<string, boolean>>,
): WgslModule {
  const texels = samplings.map(
    ([texture, sampler, at], index) =>
      `case ${index}u: { return textureSampleLevel(scene_texture_${texture}, scene_sampler_${sampler}, ${at}, layer, lod); }`,
  );
  const parameters = textured
    .filter(({ name }) => !NEEDED[name] || flags[NEEDED[name]])
    .map(
      ({ name, id, type }) =>
        `case ${id}u: { ${type === 'direction' ? DIRECTION[name] : `(*result).parameters.${name} *= ${FACTOR[type]};`} }`,
    );
  return wgslModule(
    'renderer/material-cases',
    /* wgsl */ `
fn material_texel(sampling: u32, uv: vec2f, layer: u32, lod: f32) -> vec4f {
  switch (sampling) {
${texels.join('\n')}
default: { return vec4f(1.0); }
  }
}

fn material_texture(result: ptr<function, MaterialSample>, parameter: u32, at: u32, channels: u32, texel: vec4f, factor: vec4f) {
  let value = factor[min(channels & 255u, 3u)];
  switch (parameter) {
${parameters.join('\n')}
default: { }
  }
}
`,
  );
}
