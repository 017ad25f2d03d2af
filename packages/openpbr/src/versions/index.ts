export { fromOpenPbr12, type FromOpenPbr12, type OpenPbr12Parameters } from './from-1-2';
