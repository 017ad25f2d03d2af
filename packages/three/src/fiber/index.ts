'use client';

export { PathTracer, type PathTracerProps } from './path-tracer';
