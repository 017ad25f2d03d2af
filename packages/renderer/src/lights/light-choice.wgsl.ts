import { gated, wgslModule } from '@glanz/wgsl';
import { frameStruct, lightStruct } from '../storage/layout';
import { lightTree } from './light-tree.wgsl';

/**
 * `fn light_choice(light: u32, position: vec3f, normal: vec3f) -> f32`: how likely a light sample goes to this light.
 */
export const lightChoice = /* @__PURE__ */ wgslModule(
  'renderer/light-choice',
  /* wgsl */ `
fn light_choice(light: u32, position: vec3f, normal: vec3f) -> f32 {
  //#if LIGHT_TREE
  return (1.0 - frame.environment_probability) * light_tree_probability(light, position, normal);
  //#else
  return (1.0 - frame.environment_probability) * lights[light].probability;
  //#endif
}
`,
  [frameStruct.module, lightStruct.module, gated('LIGHT_TREE', lightTree)],
);
