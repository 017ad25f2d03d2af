export * from './parameters/index';
