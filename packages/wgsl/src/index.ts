export { GlanzError, loadPart, type ErrorLocation, type GlanzErrorOptions } from './error';
export { gated, wgslModule, type GatedDependency, type WgslModule } from './module';
export { compose, WgslComposeError, type ComposedWgsl, type ComposeOptions, type WgslLocation } from './compose';
export { beginShaderModule, createShaderModule, ShaderError, type PendingShaderModule } from './shader';
export {
  struct,
  StructError,
  type StructField,
  type StructLayout,
  type StructValue,
  type WgslFieldType,
} from './struct';
