export { decodeHdr, type HdrImage } from './hdr-decode';
export { encodeHdr, type HdrSource } from './hdr-encode';
