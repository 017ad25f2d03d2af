export { RealtimeIntegrator } from '@glanz/denoise/temporal';
