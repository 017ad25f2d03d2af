export * from './parameters/index';
export * from './wgsl/index';
