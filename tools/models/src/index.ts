export { createCornellBox } from './cornell-box';
export { buildPushButton, createPushButton, type PushButtonLevel } from './push-button/index';
export type { Tessellation } from './shapes/tessellation';
