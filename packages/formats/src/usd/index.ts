export { readUsd, usdFiles, type UsdOptions } from './read';
