export { instrumentDevice, loseDevice } from './instrument';
export { FaultRecorder, FAULTS, faultsOf, LATE_MS, type Fault, type FaultPoint, type LiveObject } from './recorder';
