export { PathTracer, type PathTracerProps } from './path-tracer';
