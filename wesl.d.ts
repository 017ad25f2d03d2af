// What an import of a shader source is to TypeScript; tools/pipeline/wesl.mjs makes it so.
declare module '*.wesl' {
  import type { WgslModule } from './packages/wgsl/src/module';
  const module: WgslModule;
  export default module;
}
