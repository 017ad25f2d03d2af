import { glanzPackage } from '../../tsup.base';

export default glanzPackage(
  { index: 'src/index.ts' },
  { platform: 'node', external: ['bullmq', 'ioredis', '@aws-sdk/client-s3'] },
);
