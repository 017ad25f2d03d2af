import { FarmError } from '../../error';

/** What an answer of S3 holds, as far as the store reads it. */
export interface S3Answer {
  readonly ContentLength?: number | undefined;
  readonly LastModified?: Date | undefined;
  readonly ETag?: string | undefined;
  readonly UploadId?: string | undefined;
  readonly Body?: AsyncIterable<Uint8Array> | undefined;
  readonly Contents?:
    | readonly {
        readonly Key?: string | undefined;
        readonly Size?: number | undefined;
        readonly LastModified?: Date | undefined;
      }[]
    | undefined;
  readonly NextContinuationToken?: string | undefined;
}

type Command = new (input: never) => unknown;

/** The part of `@aws-sdk/client-s3` that the store calls. A program that bundles the package passes it itself. */
export interface S3Module {
  readonly S3Client: new (config: never) => { send(command: never): Promise<unknown> };
  readonly HeadObjectCommand: Command;
  readonly GetObjectCommand: Command;
  readonly PutObjectCommand: Command;
  readonly CopyObjectCommand: Command;
  readonly DeleteObjectCommand: Command;
  readonly ListObjectsV2Command: Command;
  readonly CreateMultipartUploadCommand: Command;
  readonly UploadPartCommand: Command;
  readonly CompleteMultipartUploadCommand: Command;
  readonly AbortMultipartUploadCommand: Command;
}

/** Imports `@aws-sdk/client-s3`. @throws {FarmError} `farm/missing-package` */
export async function importS3(): Promise<S3Module> {
  try {
    return await import('@aws-sdk/client-s3');
  } catch (cause) {
    throw new FarmError(
      'farm/missing-package',
      'A store in a bucket needs one more package: npm install @aws-sdk/client-s3. With a folder as the store it is not needed.',
      { cause },
    );
  }
}
