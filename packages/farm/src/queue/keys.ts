import { FarmError } from '../error';

/** Names of the keys of a farm in Redis, in addition to those of BullMQ. */
export interface QueueKeys {
  /** Prefix of BullMQ's keys. */
  readonly prefix: string;
  readonly queue: string;
  /** A hash: jobs done, seconds spent. */
  readonly totals: string;
  /** A hash: a line of JSON for each worker. */
  readonly workers: string;
  /** A set: jobs to be stopped. */
  readonly cancelled: string;
  /** A list: results that were finished last. */
  readonly recent: string;
  /** A set of destinations for a job. */
  readonly destinations: (id: string) => string;
  /** A hash: how often a job has failed, by kind. */
  readonly tries: (id: string) => string;
}

/** @throws {FarmError} `farm/option` for a name that BullMQ cannot use. */
export function keysOf(name = 'glanz'): QueueKeys {
  if (!/^[\w.-]{1,80}$/.test(name))
    throw new FarmError('farm/option', `A queue's name has letters, digits, ".", "_" and "-", unlike "${name}".`);
  const prefix = 'glanz-farm';
  const own = `${prefix}:${name}`;
  return {
    prefix,
    queue: name,
    totals: `${own}:totals`,
    workers: `${own}:workers`,
    cancelled: `${own}:cancelled`,
    recent: `${own}:recent`,
    destinations: (id) => `${own}:to:${id}`,
    tries: (id) => `${own}:tries:${id}`,
  };
}
