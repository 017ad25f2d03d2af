import { FolderStore } from './folder-store';
import { S3Store } from './s3/s3-store';
import type { S3Module } from './s3/s3-module';
import type { FarmStore, StoreAddress } from './store';

/**
 * The store at an address: in a folder, or in a bucket for `s3://bucket/prefix`, which needs the package
 * `@aws-sdk/client-s3` and takes credentials and region as AWS's tools do.
 *
 * @param s3 `@aws-sdk/client-s3`. Default: imported when it is needed.
 * @throws {FarmError} `farm/missing-package`, `farm/option`, `farm/store-access`, `farm/store`
 */
export async function openFarmStore(address: StoreAddress, s3?: S3Module): Promise<FarmStore> {
  return address.url.startsWith('s3://') ? S3Store.open(address, s3) : new FolderStore(address.url);
}
