export { createCornellBox } from './cornell-box';
export { createPushButtonKit, PUSH_BUTTON_KIT } from './push-button/kit';
export { buildPushButton, createPushButton, type PushButtonLevel } from './push-button/index';
export type { Tessellation } from './shapes/tessellation';
