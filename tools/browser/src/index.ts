export { checkAccessibility } from './accessibility';
export { buildApp, serveApp, servePage, watch, type Served } from './page';
export { photograph, pixelsOf, type Pixels } from './pixels';
export { glb, hdr, quads, triangle, type Quad } from './files';
export { animatedQuads } from './animated';
export { usdSquare, usdz } from './usd';
export { injectFaults, type GpuFaults } from './faults';
