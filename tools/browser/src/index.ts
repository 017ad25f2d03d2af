export { servePage, watch, type Served } from './page';
export { photograph, pixelsOf, type Pixels } from './pixels';
export { glb, hdr, quads, type Quad } from './files';
export { injectFaults } from './faults';
